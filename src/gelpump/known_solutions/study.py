"""What a verification study measures, when it is content, and the table of all."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from operator import attrgetter
from typing import Any

import numpy as np

from gelpump.tables import page

ORDER = 1.9  # least order of convergence, in space and in time


class NotVerified(ArithmeticError):
    """A solver misses a known solution, or converges to it too slowly."""


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


def space(
    problem: str,
    quantity: str,
    cells: Sequence[int],
    errors: Sequence[float],
    bound: float,
    order: float | None = ORDER,
) -> Study:
    """Errors on finer and finer meshes."""
    return Study(problem, quantity, "cells", cells, errors, bound, order)


def time(
    problem: str,
    quantity: str,
    steps: Sequence[int],
    errors: Sequence[float],
    bound: float,
    order: float | None = ORDER,
) -> Study:
    """Errors with more and more steps on one mesh."""
    return Study(problem, quantity, "steps", steps, errors, bound, order)


def one_run(problem: str, quantity: str, error: float, bound: float) -> Study:
    """An error on one mesh: of an identity, which holds but for rounding, or of a limit."""
    return Study(problem, quantity, "", [1], [error], bound)


def require_all(studies: Sequence[Study]) -> None:
    """NotVerified, with every study that fails, if one does."""
    failed = [
        f"{each.problem}, {each.quantity}: error {each.errors[-1]:.2e}, bound {each.bound:.0e}, "
        f"orders {', '.join(f'{order:.2f}' for order in each.orders) or 'none'}"
        for each in studies
        if not each.passes
    ]
    if failed:
        raise NotVerified("; ".join(failed))


def markdown(studies: Sequence[Study]) -> str:
    """The studies as a page."""
    passed = sum(each.passes for each in studies)
    columns = {
        "problem": attrgetter("problem"),
        "quantity": attrgetter("quantity"),
        "resolution": lambda each: (
            f"{', '.join(map(str, each.resolutions))} {each.against}" if each.against else "–"
        ),
        "error": lambda each: ", ".join(f"{error:.1e}" for error in each.errors),
        "order": lambda each: ", ".join(f"{order:.2f}" for order in each.orders) or "–",
        "least order": lambda each: "–" if each.least_order is None else f"{each.least_order:g}",
        "bound": lambda each: f"{each.bound:.0e}",
        "verdict": lambda each: "passes" if each.passes else "fails",
    }
    intro = f"{passed} of {len(studies)} studies pass."
    return page("The FiPy solvers on known solutions", intro, columns, studies)
