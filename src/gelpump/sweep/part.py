"""Some designs of a dataset on disk, without reading the others."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import xarray as xr


def read(path: str | Path, chosen: Callable[[int], slice | np.ndarray]) -> xr.Dataset:
    """The designs of `path` that `chosen` names, given how many there are; no attributes."""
    with xr.open_dataset(path, engine="netcdf4") as dataset:
        here = dataset.isel(index=chosen(dataset.sizes["index"])).load()
    return here.drop_attrs(deep=False)
