"""Datasets on disk: netCDF-4 after CF-1.11, whole or not there, byte-identical from run to run."""

import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import gelpump

if TYPE_CHECKING:
    import xarray as xr

    from gelpump.provenance import Provenance

PAPER = (
    "Webber, J. J. & Montenegro-Johnson, T. D. (2025) Poromechanical modelling of responsive "
    "hydrogel pumps. J. Fluid Mech."
)


def variable(dims, values, long_name: str, comment: str = ""):
    """A dimensionless variable as xarray takes it, with the attributes that CF asks for."""
    attrs = {"long_name": long_name, "units": "1"}
    return dims, values, attrs | ({"comment": comment} if comment else {})


def write(
    dataset: "xr.Dataset",
    path: str | Path,
    title: str,
    parameters: Mapping[str, Any],
    provenance: "Provenance | None" = None,
):
    """Write ``dataset`` to ``path``, with ``parameters`` (the rule's config) in its attributes.

    ``provenance`` adds what it was made from; every rule gives it, a session by hand has none.

    The file appears under its name only when it is complete and on the disk.  Neither date nor
    path is stored, so that equal inputs give equal bytes.
    """
    path = Path(path)
    dataset = dataset.assign_attrs(
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
    encoding = {name: {"_FillValue": None} for name in dataset.variables}
    partial = path.with_name(f".{path.name}.partial")
    try:
        dataset.to_netcdf(partial, engine="netcdf4", format="NETCDF4", encoding=encoding)
        publish(partial, path)
    finally:
        partial.unlink(missing_ok=True)


def publish(partial: Path, path: Path) -> None:
    """Give a finished file its name: flushed to the disk first, then renamed in one step."""
    with partial.open("rb") as stream:
        os.fsync(stream.fileno())
    partial.replace(path)


def read(path: str | Path) -> "xr.Dataset":
    """The whole dataset of ``path`` in memory."""
    import xarray as xr

    return xr.load_dataset(path, engine="netcdf4")


def read_all(paths: Iterable[str | Path], folder: str | Path) -> dict[str, "xr.Dataset"]:
    """The datasets of ``paths`` by their path below ``folder``, without its suffix."""
    return {Path(path).relative_to(folder).with_suffix("").as_posix(): read(path) for path in paths}
