"""Each device is solved thrice, with half and twice the cells and four times larger and smaller
tolerances in time, for the uncertainties (`gelpump.uncertainty`); all in SI units."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

TOLERANCE_FACTOR = 4.0


def variable(dims: Any, values: Any, unit: str, long_name: str) -> tuple[Any, Any, dict[str, str]]:
    """A variable in SI units as xarray takes it."""
    return dims, values, {"units": unit, "long_name": long_name}


def levels(numerics: Mapping) -> Iterator[tuple[list[int], float]]:
    """Coarser, given and finer cells with their tolerances; cells are a number or two."""
    for finer in (0.5, 1.0, 2.0):
        cells = [int(count * finer) for count in np.atleast_1d(numerics["cells"])]
        yield cells, numerics["tolerance"] * TOLERANCE_FACTOR ** -np.log2(finer)
