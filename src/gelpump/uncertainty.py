"""How far a computed value may be from its limit, from runs coarser and finer than it.

With f_c, f, f_f on three resolutions that each differ by the same factor, differences shrink by
R = |f_c - f| / |f - f_f| from one to the next, so that the limit lies |f - f_f| R / (R - 1) from f.
Roache's grid-convergence index adds a safety factor of 1.25.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

SAFETY = 1.25
SLOWEST, FASTEST = 1.5, 16.0  # what is believed of R: 2^0.6 to 2^4


def convergence_index(coarse: ArrayLike, value: ArrayLike, fine: ArrayLike) -> NDArray:
    """Numerical uncertainty of ``value``, elementwise, shape of the arguments.

    Where differences do not shrink by at least SLOWEST, that factor is assumed.
    """
    before = np.abs(np.subtract(coarse, value))
    after = np.abs(np.subtract(value, fine))
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.nan_to_num(before / after, nan=FASTEST, posinf=FASTEST)
    ratio = np.clip(ratio, SLOWEST, FASTEST)
    return SAFETY * after * ratio / (ratio - 1.0)
