"""The studies as a Markdown table, and the refusal to go on when one fails."""

from collections.abc import Sequence

from gelpump.known_solutions.study import Study


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
    lines = [
        "# The FiPy solvers on known solutions",
        "",
        f"{passed} of {len(studies)} studies pass.",
        "",
        "| problem | quantity | resolution | error | order | least order | bound | verdict |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for each in studies:
        counts = ", ".join(map(str, each.resolutions))
        cells = [
            each.problem,
            each.quantity,
            f"{counts} {each.against}" if each.against else "–",
            ", ".join(f"{error:.1e}" for error in each.errors),
            ", ".join(f"{order:.2f}" for order in each.orders) or "–",
            "–" if each.least_order is None else f"{each.least_order:g}",
            f"{each.bound:.0e}",
            "passes" if each.passes else "fails",
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"
