"""Newton's iteration for the equations of `gelpump.truth.elements`."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import splu

from gelpump.bdf import NotConverged

Equations = Callable[[NDArray, bool], tuple[NDArray, csr_matrix | None]]
ITERATIONS = 30
SMALLEST_SHARE = 1e-3
LAST_CORRECTION = 1e-7  # converges quadratically: what it leaves is rounding


def newton(equations: Equations, guess: NDArray, moves: csr_matrix) -> NDArray:
    """The y = guess + moves x with moves^T residual(y) = 0; what `moves` leaves out is held.

    ``equations(y, tangent)`` gives the residual and, if asked for, its derivative. A step that
    turns elements over (not a number) or raises the residual is halved. NotConverged if that does
    not help or after ITERATIONS.
    """
    y = guess.copy()
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        residual, tangent = equations(y, True)
        for _ in range(ITERATIONS):
            before = np.linalg.norm(moves.T @ residual)
            if not np.isfinite(before):
                raise NotConverged("the first guess turns elements over")
            step = moves @ splu((moves.T @ tangent @ moves).tocsc()).solve(-(moves.T @ residual))
            share = 1.0
            while True:
                residual, _ = equations(y + share * step, False)
                after = np.linalg.norm(moves.T @ residual)
                if np.isfinite(after) and (after < 2 * before or after < LAST_CORRECTION):
                    break
                share /= 2
                if share < SMALLEST_SHARE:
                    raise NotConverged("no step along Newton's direction helps")
            y = y + share * step
            if np.abs(step).max() < LAST_CORRECTION:
                return y
            residual, tangent = equations(y, True)
    raise NotConverged(f"{ITERATIONS} iterations left a correction of {np.abs(step).max():.2g}")
