"""The claims as a Markdown table, each number to the digits that its uncertainty leaves."""

from collections import Counter
from collections.abc import Mapping, Sequence
from math import floor, log10
from typing import Any

STATUSES = ("reproduced", "deviates", "inconsistent-in-paper", "qualitative")


SIGNIFICANT = 6  # digits that are shown at most
SMALLEST = -4  # power of ten below which a number is shown with one


def digits(value: float, uncertainty: float | None) -> str:
    """``value`` rounded to the first digit of ``uncertainty``, SIGNIFICANT ones at most."""
    if not uncertainty:
        return f"{value:.{SIGNIFICANT}g}"
    if abs(value) <= abs(uncertainty):
        return f"{value:.1g}"
    decimals, size = _shown(value, uncertainty), floor(log10(abs(value)))
    if size < SMALLEST:
        return f"{value:.{decimals + size}e}"
    return f"{round(value, decimals):.{max(decimals, 0)}f}"


def _shown(value: float, uncertainty: float) -> int:
    """Decimals to which ``value`` is shown."""
    return min(_decimals(uncertainty), SIGNIFICANT - 1 - floor(log10(abs(value))))


def _decimals(uncertainty: float) -> int:
    """Of the first digit of ``uncertainty``, as that is printed: 0.00096 is 0.001."""
    return -floor(log10(float(f"{abs(uncertainty):.0e}")))


def number(value: Any, uncertainty: Any = None) -> str:
    """A number, a list of numbers, a truth value or nothing, for a cell of the table.

    An uncertainty below half a unit of the last digit shown is left out.
    """
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        many = uncertainty if isinstance(uncertainty, list) else [uncertainty] * len(value)
        return ", ".join(number(v, u) for v, u in zip(value, many, strict=True))
    text = digits(value, uncertainty)
    if not uncertainty:
        return text
    seen = abs(value) <= uncertainty or uncertainty >= 0.5 * 10.0 ** -_shown(value, uncertainty)
    doubt = f"{uncertainty:.1g}"
    doubt = f"{float(doubt):.0f}" if "e+" in doubt else doubt
    return f"{text} ± {doubt}" if seen else text


def counts(claims: Sequence[Mapping[str, Any]]) -> dict[str, int]:
    """How many claims have each status, in the order of STATUSES."""
    found = Counter(claim["status"] for claim in claims)
    return {each: found[each] for each in STATUSES}


def markdown(claims: Sequence[Mapping[str, Any]]) -> str:
    """The whole page: how many of each status, then a row a claim."""
    lines = [
        "# Claims of the paper",
        "",
        ", ".join(f"{count} {name}" for name, count in counts(claims).items()),
        "",
        "| claim | where | statement | published | computed | difference | status | evidence |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for claim in claims:
        if isinstance(claim["computed"], bool) or claim["computed"] is None:
            computed = number(claim["computed"])
            if claim["measure"] is not None:
                measure = number(claim["measure"], claim["uncertainty"])
                computed = f"{computed}: {claim['measured']} {measure}".removeprefix("–: ")
        else:
            computed = number(claim["computed"], claim["uncertainty"])
        difference = claim["relative_difference"]
        published = number(claim["published"])
        if claim["published_in_figure"] is not None:
            published += f" (figure: {number(claim['published_in_figure'])})"
        cells = [
            claim["id"],
            claim["where"],
            claim["statement"],
            published,
            computed,
            "–" if difference is None else f"{difference:.2g}",
            claim["status"],
            claim["evidence"],
        ]
        lines.append("| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"
