"""Views of judged statements: counts, the claims and the ledger as tables.

The ledger holds the statements with which the paper disagrees: with what follows from its
equations, with itself, or with its own derivation.  Numbers are shown to the digits that their
uncertainty leaves.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from math import floor, log10
from operator import itemgetter
from typing import Any

import numpy as np

from gelpump.statements.statement import APART, STATUSES
from gelpump.tables import page

SIGNIFICANT = 6  # digits that are shown at most
SMALLEST = -4  # power of ten below which a number is shown with one
NOTHING = "–"
DISAGREE = ("deviates", "inconsistent-in-paper", "misprint")
Record = Mapping[str, Any]


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
    """Decimals to which ``value`` is shown: the first digit of the uncertainty as it is printed."""
    first = -floor(log10(float(f"{abs(uncertainty):.0e}")))
    return min(first, SIGNIFICANT - 1 - floor(log10(abs(value))))


def number(value: Any, uncertainty: Any = None) -> str:
    """A number, a list of numbers, a truth value or nothing, for a cell of a table.

    An uncertainty below half a unit of the last digit shown is left out.
    """
    if value is None:
        return NOTHING
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


def published(each: Record) -> str:
    """What the paper says, and what its figure does."""
    text, drawn = number(each["published"]), each["published_in_figure"]
    return text if drawn is None else f"{text} (figure: {number(drawn)})"


def measure(each: Record) -> str:
    """The number that decided or describes; its uncertainty where the latter is of its shape."""
    own = isinstance(each["computed"], bool) or each["computed"] is None
    return number(each["measure"], each["uncertainty"] if own else None) if each["measured"] else ""


def counts(records: Sequence[Record], statuses: Sequence[str] = STATUSES) -> dict[str, int]:
    """How many statements have each status, in the order of ``statuses``."""
    found = Counter(each["status"] for each in records)
    return {status: found[status] for status in statuses}


def headline(records: Sequence[Record]) -> str:
    """How the paper fares, and what could not have come out otherwise."""
    tested, apart = counts(records), counts(records, APART)
    return (
        f"Of {sum(tested.values())} statements of the paper that a computation could contradict: "
        + ", ".join(f"{count} {status}" for status, count in tested.items())
        + f".  Apart from these, {apart['identity']} could not come out otherwise (identity), and "
        f"{apart['misprint']} printed lines differ from their own derivation (misprint)."
    )


def _computed(each: Record) -> str:
    text = number(each["computed"], each["uncertainty"])
    decided = f"{text}: {each['measured']} {measure(each)}".removeprefix(f"{NOTHING}: ")
    return decided if each["measured"] else text


def _relative(each: Record) -> str:
    difference = each["relative_difference"]
    return NOTHING if difference is None else f"{difference:.2g}"


def claims(records: Sequence[Record]) -> str:
    """The statements of the paper as Markdown."""
    return _table("Statements of the paper", headline(records), records)


def beyond(records: Sequence[Record]) -> str:
    """The statements beyond the paper as Markdown."""
    intro = (
        f"{len(records)} statements that go beyond the paper; expected: what stands for its value."
    )
    return _table("Beyond the paper", intro, records)


def _table(title: str, intro: str, records: Sequence[Record]) -> str:
    columns = {
        "statement": itemgetter("id"),
        "where": itemgetter("where"),
        "it says": itemgetter("statement"),
        "published": published,
        "computed": _computed,
        "difference": _relative,
        "status": itemgetter("status"),
        "evidence": itemgetter("evidence"),
    }
    return page(title, intro, columns, records)


def ledger(records: Sequence[Record]) -> list[dict[str, Any]]:
    """The statements with which something disagrees, as entries of ``ledger.json``."""
    kept = "id", "where", "follows", "code", "evidence"
    return [
        {name: each[name] for name in kept}
        | {"printed": each["statement"], "verdict": each["status"]}
        | dict(zip(("size", "measured", "allowed"), _difference(each), strict=True))
        for each in records
        if each["status"] in DISAGREE
    ]


def _difference(each):
    """What decided; or computed minus published, of two values the one that disagrees, and what
    reading and numerics allow."""
    if isinstance(each["computed"], bool):
        return each["measure"], each["measured"].rstrip(": "), each["uncertainty"]
    found = [
        (np.subtract(each["computed"], each[value]), f"computed minus {name}", (each[doubt] or 0.0))
        for value, name, doubt in (
            ("published", "published", "resolution"),
            ("published_in_figure", "drawn", "resolution_in_figure"),
        )
        if each[value] is not None
    ]
    beyond = [
        (size.tolist(), name, np.add(doubt, np.abs(each["uncertainty"])).tolist())
        for size, name, doubt in found
    ]
    return max(beyond, key=lambda pair: np.max(np.abs(pair[0]) - pair[2]))


def ledger_table(entries: Sequence[Record]) -> str:
    """A row an entry: what is printed, what follows, how far apart, and the code that shows it."""
    columns = {
        "entry": itemgetter("id"),
        "where": itemgetter("where"),
        "the paper": itemgetter("printed"),
        "what follows": itemgetter("follows"),
        "difference": lambda each: f"{each['measured']}: {short(each['size'])}",
        "allowed": lambda each: short(each["allowed"]),
        "verdict": itemgetter("verdict"),
        "code": lambda each: f"`{each['code']}` on {each['evidence']}",
    }
    found = Counter(each["verdict"] for each in entries)
    kinds = ", ".join(f"{found[status]} {status}" for status in DISAGREE)
    return page("Ledger of disagreements", kinds, columns, entries)


def short(values: Any) -> str:
    """One number or several, to four digits; a dash for none."""
    return NOTHING if values is None else ", ".join(f"{v:.4g}" for v in np.atleast_1d(values))
