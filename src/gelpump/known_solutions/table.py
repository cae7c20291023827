"""The studies as a Markdown table, and the refusal to go on when one fails."""

from collections.abc import Sequence

from gelpump.known_solutions.study import Study
from gelpump.tables import page


class NotVerified(ArithmeticError):
    """A solver misses a known solution, or converges to it too slowly."""


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
    """The table as a page."""
    passed = sum(each.passes for each in studies)
    columns = {
        "problem": lambda each: each.problem,
        "quantity": lambda each: each.quantity,
        "resolution": _counts,
        "error": lambda each: ", ".join(f"{error:.1e}" for error in each.errors),
        "order": lambda each: ", ".join(f"{order:.2f}" for order in each.orders) or "–",
        "least order": lambda each: "–" if each.least_order is None else f"{each.least_order:g}",
        "bound": lambda each: f"{each.bound:.0e}",
        "verdict": lambda each: "passes" if each.passes else "fails",
    }
    intro = f"{passed} of {len(studies)} studies pass."
    return page("The FiPy solvers on known solutions", intro, columns, studies)


def _counts(study: Study) -> str:
    counts = ", ".join(map(str, study.resolutions))
    return f"{counts} {study.against}" if study.against else "–"
