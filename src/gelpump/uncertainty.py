"""How far a computed value may be from the exact one.

Of a solution, by runs coarser and finer than it: with f_c, f, f_f on three resolutions that each
differ by the same factor, differences shrink by R = |f_c - f| / |f - f_f| from one to the next, so
that the limit lies |f - f_f| R / (R - 1) from f.  Roache's grid-convergence index adds a safety
factor of 1.25.

Of an integral, by the same rule with fewer nodes.  Of a closed formula, by more digits, and by the
last one of its arguments.
"""

from collections.abc import Callable

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


def quadrature_error(formula: Callable[[int], ArrayLike], nodes: int, fewer: int) -> NDArray:
    """Numerical uncertainty of ``formula(nodes)``, an integral by that many nodes, elementwise.

    What it differs by with ``fewer`` nodes, of which the error is the greater by far; and what the
    rounding of so many terms may add up to.
    """
    value = np.asarray(formula(nodes))
    return np.abs(value - formula(fewer)) + nodes * np.finfo(float).eps * np.abs(value)


def rounding_error(formula: Callable[..., ArrayLike], *arguments: ArrayLike) -> NDArray:
    """Numerical uncertainty of ``formula(*arguments)`` by rounding, elementwise.

    What it differs by in the machine's longest precision, where that is longer; how far it moves
    when each argument in turn becomes the next number that the machine knows; and a unit of its own
    last place.
    """
    arguments = [np.asarray(argument, dtype=float) for argument in arguments]
    value = np.asarray(formula(*arguments))
    longer = formula(*(argument.astype(np.longdouble) for argument in arguments))
    error = np.abs(np.asarray(longer - value, dtype=float)) + np.spacing(np.abs(value))
    for i, argument in enumerate(arguments):
        moved = [*arguments[:i], np.nextafter(argument, np.inf), *arguments[i + 1 :]]
        error = error + np.abs(np.asarray(formula(*moved)) - value)
    return error
