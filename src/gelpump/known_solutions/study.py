"""What a verification study measures, and when it is content."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

ORDER = 1.9  # least order of convergence, in space and in time


@dataclass(frozen=True)
class Study:
    """Errors against a known solution.

    quantity: what is in error, and in which problem.  against: what ``resolutions`` counts: "cells"
    or "steps", or nothing where there is one run.  bound: the most that the last error may be.
    least_order: of convergence from the first to the last resolution, None where not asked for.
    """

    problem: str
    quantity: str
    against: str
    resolutions: Sequence[int]
    errors: Sequence[float]
    bound: float
    least_order: float | None = None

    @property
    def orders(self) -> list[float]:
        """Order of convergence from each resolution to the next."""
        if len(self.errors) < 2:
            return []
        finer = np.diff(np.log(self.resolutions))
        return [float(order) for order in -np.diff(np.log(self.errors)) / finer]

    @property
    def passes(self) -> bool:
        """Whether the error is within its bound, and the last two resolutions show the order."""
        converges = self.least_order is None or self.orders[-1] >= self.least_order
        return bool(self.errors[-1] <= self.bound and converges)

    def record(self) -> dict[str, Any]:
        """The study with its orders and its verdict, for JSON."""
        return asdict(self) | {
            "resolutions": [int(each) for each in self.resolutions],
            "errors": [float(each) for each in self.errors],
            "orders": self.orders,
            "passes": self.passes,
        }


def space(problem, quantity, cells, errors, bound, order=ORDER) -> Study:
    """Errors on finer and finer meshes."""
    return Study(problem, quantity, "cells", cells, errors, bound, order)


def time(problem, quantity, steps, errors, bound, order=ORDER) -> Study:
    """Errors with more and more steps on one mesh."""
    return Study(problem, quantity, "steps", steps, errors, bound, order)


def one_run(problem, quantity, error, bound) -> Study:
    """An error on one mesh: of an identity, which holds but for rounding, or of a limit."""
    return Study(problem, quantity, "", [1], [error], bound)
