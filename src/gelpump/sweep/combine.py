"""All chunks as one dataset, of which no more than one chunk is ever in memory.

The netCDF library writes slices of a dataset on disk, and xarray opens the result lazily: neither
dask nor zarr is needed for that.
"""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path

import netCDF4
import numpy as np

from gelpump.files import whole

ATTRIBUTES = ("Conventions", "institution", "source", "history", "references", "comment")


def combine(
    paths: Iterable[str | Path],
    target: str | Path,
    size: int,
    title: str,
    parameters: Mapping,
    extra: Mapping[str, str],
) -> int:
    """Write `size` designs of the chunks, in their order, to `target`; the number that failed."""
    failed = start = 0
    reasons = {}
    with whole(target) as partial, netCDF4.Dataset(partial, "w", format="NETCDF4") as out:
        for path in paths:
            with netCDF4.Dataset(path) as chunk:
                if start == 0:
                    _declare(out, chunk, size)
                    out.setncatts({key: chunk.getncattr(key) for key in ATTRIBUTES})
                    text = {"parameters": json.dumps(parameters, sort_keys=True)}
                    out.setncatts({"title": title, **text, **extra})
                stop = start + len(chunk.dimensions["index"])
                for name, each in chunk.variables.items():
                    if each.dimensions[:1] == ("index",):
                        out[name][start:stop] = each[:]
                failed += int((chunk["status"][:] == 3).sum())
                reasons |= json.loads(chunk.reasons)
                start = stop
        out.reasons = json.dumps(reasons)
        if start != size:
            raise ValueError(f"the chunks hold {start} designs instead of {size}")
    return failed


def _declare(out, chunk, size):
    for name, dimension in chunk.dimensions.items():
        out.createDimension(name, size if name == "index" else len(dimension))
    for name, each in chunk.variables.items():
        fill = each.getncattr("_FillValue") if "_FillValue" in each.ncattrs() else False
        made = out.createVariable(name, each.dtype, each.dimensions, fill_value=fill)
        made.setncatts({k: each.getncattr(k) for k in each.ncattrs() if k != "_FillValue"})
        made.set_auto_mask(False)
        if each.dimensions[:1] != ("index",):
            made[:] = np.asarray(each[:])
    for each in chunk.variables.values():
        each.set_auto_mask(False)
