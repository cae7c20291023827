"""Coordinates put together from values that somebody named and others that fill the range.

0.05^2 and 0.0025 are one time, though not one number. Whoever differentiates along a coordinate
that holds both divides by their rounding.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

ROUNDED = 1e-9  # values that differ by less, relative, are one


def merged(named: ArrayLike, *spaced: ArrayLike) -> NDArray:
    """All values in increasing order, each once: as it was named, where it was."""
    values = np.unique(np.asarray(named, dtype=float))
    for each in spaced:
        others = np.unique(np.asarray(each, dtype=float))
        new = ~np.isclose(others[:, np.newaxis], values, rtol=ROUNDED, atol=0.0).any(axis=1)
        values = np.union1d(values, others[new])
    return values
