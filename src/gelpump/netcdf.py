"""Datasets on disk: netCDF-4 after CF-1.11, whole or not there, byte-identical from run to run."""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import gelpump
from gelpump.files import whole

if TYPE_CHECKING:
    import xarray as xr

    from gelpump.provenance import Provenance

PAPER = (
    "Webber, J. J. & Montenegro-Johnson, T. D. (2025) Poromechanical modelling of responsive "
    "hydrogel pumps. J. Fluid Mech."
)


LABEL = "_label"  # after that of the dimension which it labels


Variable = tuple[Any, Any, dict[str, str]]
"""Dimensions, values and attributes, as xarray takes them."""


def variable(dims: Any, values: Any, long_name: str, comment: str = "") -> Variable:
    """A dimensionless variable as xarray takes it, with the attributes that CF asks for."""
    attrs = {"long_name": long_name, "units": "1"}
    return dims, values, attrs | ({"comment": comment} if comment else {})


def write(
    dataset: "xr.Dataset",
    path: str | Path,
    title: str,
    parameters: Mapping[str, Any],
    provenance: "Provenance | None" = None,
    flag: str | None = None,
) -> None:
    """Write ``dataset`` to ``path``, with ``parameters`` (the rule's config) in its attributes.

    ``provenance`` adds what it was made from; every rule gives it, a session by hand has none.

    The file appears under its name only when it is complete and on the disk.  Neither date nor
    path is stored, so that equal inputs give equal bytes.  ValueError if a number in it is not
    finite, unless the variable ``flag`` says of its row that it failed; OSError if it cannot be
    written.
    """
    _require_finite(dataset, title, flag)
    dataset = _labelled(dataset).assign_attrs(
        Conventions="CF-1.11",
        title=title,
        institution="gelpump, a replication project",
        source=f"gelpump {gelpump.__version__}",
        history=f"computed by gelpump {gelpump.__version__}",
        references=PAPER,
        comment="quantities are dimensionless unless their units say otherwise",
        parameters=json.dumps(parameters, sort_keys=True),
        **(provenance.attributes() if provenance else {}),
        **{k: v for k, v in dataset.attrs.items() if v != ""},
    )
    for name in list(dataset.attrs):
        if dataset.attrs[name] == "":
            del dataset.attrs[name]
    missing = np.nan if flag else None
    encoding = {
        name: {"_FillValue": missing if each.dtype.kind == "f" and name in dataset else None}
        for name, each in dataset.variables.items()
    }
    for name in dataset.coords:
        encoding[name]["_FillValue"] = None
    with whole(path) as partial:
        dataset.to_netcdf(partial, engine="netcdf4", format="NETCDF4", encoding=encoding)


def _labelled(dataset):
    """Names along a dimension as CF has them: labels, under a name that is not the dimension's."""
    names = [str(each) for each in dataset.indexes if dataset[each].dtype.kind in "OU"]
    return dataset.reset_index(names).rename_vars({name: f"{name}{LABEL}" for name in names})


def _require_finite(dataset, title, flag):
    for name, each in dataset.variables.items():
        if each.dtype.kind == "f":
            unknown = ~np.isfinite(each.values)
            if flag and each.dims[:1] == dataset[flag].dims:
                unknown = unknown[dataset[flag].values == 0]
            bad = int(unknown.sum())
            if bad:
                raise ValueError(f"{title}: {bad} values of {name} are not finite")


def read(path: str | Path) -> "xr.Dataset":
    """The whole dataset of ``path`` in memory; labels of a dimension index it."""
    import xarray as xr

    dataset = xr.load_dataset(path, engine="netcdf4")
    labels = {
        f"{name}{LABEL}": name for name in dataset.dims if f"{name}{LABEL}" in dataset.variables
    }
    named = dataset.rename_vars(labels).set_coords(labels.values())
    for name in labels.values():
        named = named.set_xindex(name)
    return named


def read_all(paths: Iterable[str | Path], folder: str | Path) -> dict[str, "xr.Dataset"]:
    """The datasets of ``paths`` by their path below ``folder``, without its suffix."""
    return {Path(path).relative_to(folder).with_suffix("").as_posix(): read(path) for path in paths}
