"""The truth's numbers as they are kept with the project, so that each build can judge them.

`snakemake pump_truth` is no part of a build. Its datasets without their fields and profiles are
kept as JSON, a variable a line, with what each was made from and what the run took.
"""

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr

DATASETS = ("waves", "pulses", "walls", "verification", "slenderness")
LEFT_OUT = {"level", "line", "across", "node", "point"}  # dims of meshes, fields and profiles
DIGITS = 8
KEPT = ("parameters", "code_version", "config_digest", "package_versions")


def write(data: Mapping[str, xr.Dataset], run: Mapping, path: str | Path) -> None:
    """Keep the datasets, named as in DATASETS, with `run`: whatever is to be told of it."""
    lines = [f'"run": {json.dumps(run)}']
    for name in DATASETS:
        one = data[name]
        attrs = {key: one.attrs[key] for key in KEPT if key in one.attrs}
        kept = {key: each for key, each in one.variables.items() if not LEFT_OUT & {*each.dims}}
        rows = [
            f"  {json.dumps(key)}: {json.dumps([list(each.dims), _rounded(each.values)])}"
            for key, each in kept.items()
        ]
        head = f'"{name}": {{\n  "attrs": {json.dumps(attrs)},\n'
        lines.append(head + ",\n".join(rows) + "\n}")
    Path(path).write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


def read(path: str | Path) -> dict[str, xr.Dataset]:
    """The datasets by name, "truth/waves" and so on, as statements take them."""
    kept = json.loads(Path(path).read_text(encoding="utf-8"))
    return {f"truth/{name}": _dataset(kept[name]) for name in DATASETS}


def run(path: str | Path) -> dict:
    """What is told of the run."""
    return json.loads(Path(path).read_text(encoding="utf-8"))["run"]


def _dataset(kept):
    attrs, values = kept["attrs"], {key: each for key, each in kept.items() if key != "attrs"}
    named = {key: (dims, np.asarray(value)) for key, (dims, value) in values.items()}
    return xr.Dataset(
        {key: each for key, each in named.items() if each[0] != [key]},
        {key: each for key, each in named.items() if each[0] == [key]},
        attrs,
    )


def _rounded(values):
    if values.dtype.kind != "f":
        return values.tolist()
    return np.vectorize(lambda x: float(f"{x:.{DIGITS}g}"), otypes=[object])(values).tolist()
