"""A finding: what our results say about one statement of the paper."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Finding:
    """One statement, in our words, and what was computed.

    computed: a number or a list of them, or whether the statement holds.  uncertainty: numerical,
    of the same shape; of the ``measure`` where ``computed`` is a truth value.  measure: the number
    that decided, or that describes a qualitative statement, and ``measured`` what it is.
    evidence: file and variable it was read from.
    """

    id: str
    where: str
    statement: str
    computed: float | Sequence[float] | bool | None
    uncertainty: float | Sequence[float] | None
    evidence: str
    measure: float | Sequence[float] | None = None
    measured: str = ""


def holds(margin: float, uncertainty: float) -> bool:
    """Whether a statement that is true for margin > 0 is, beyond numerical doubt."""
    return bool(margin > uncertainty)
