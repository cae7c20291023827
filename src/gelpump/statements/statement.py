"""One statement: who says it where, what is computed, and how its status follows.

===================== ============================================================================
reproduced            every computed value is as near to the paper's as the digits of the latter
                      (``resolution``) and our uncertainty allow, or the statement holds
deviates              it is not
inconsistent-in-paper the paper gives the quantity twice, and only one of the two is ours
qualitative           nothing that a number could decide was published
identity              reproduced, but it follows from how the number is made
misprint              a printed line differs from its own derivation, or from another line
===================== ============================================================================

The last two are not tests of the paper's results, and are counted apart.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

STATUSES = ("reproduced", "deviates", "inconsistent-in-paper", "qualitative")
APART = ("identity", "misprint")
RESULT, IDENTITY, LINE = "result", "identity", "printed line"  # kinds of statements
Number = float | Sequence[float] | bool | None


class Evidence(NamedTuple):
    """What statements are computed from.

    data: datasets by their name below results/data.  gels: those of the paper, by name, and that of
    the tubes as "tube".  cases, tube, scales, published: blocks of the configuration.
    """

    data: Mapping[str, Any]
    gels: Mapping[str, Any]
    cases: Mapping[str, Any]
    tube: Mapping[str, Any]
    scales: Mapping[str, float]
    published: Mapping[str, Mapping[str, Any]]

    def read(self, statement: str) -> np.ndarray:
        """The values that the paper gives for a statement; KeyError if there are none."""
        return np.asarray(self.published[statement]["value"], dtype=float)


@dataclass(frozen=True)
class Computed:
    """What was computed: a number or several, or whether the statement holds.

    uncertainty: numerical, of the shape of the value; of the ``measure`` beside a truth value.
    measure: the number that decided or that describes, and ``measured`` what it is.  follows: what
    is so instead, in words.  paper: what an equation of the paper gives, as an entry of
    ``published``, which goes before it.
    """

    value: Number
    uncertainty: Number
    measure: Number = None
    measured: str = ""
    follows: str = ""
    paper: Mapping[str, Any] | None = None


class Statement(NamedTuple):
    """A statement with the function that computes it; its text is that function's docstring."""

    id: str
    where: str
    evidence: str
    text: str
    kind: str
    compute: Callable[[Evidence], Computed | None]


class Collection(list[Statement]):
    """Statements in the order in which they are written."""

    def states(self, id: str, where: str, evidence: str, kind: str = RESULT, text: str = ""):
        """Decorator: the function below computes this statement, and says it unless ``text``
        does."""

        def of(compute):
            self.append(Statement(id, where, evidence, text or said(compute), kind, compute))
            return compute

        return of

    def records(self, evidence: Evidence) -> Iterator[dict[str, Any]]:
        """Each statement that can be computed, judged; ValueError for a number not finite."""
        for each in self:
            if (found := each.compute(evidence)) is not None:
                paper = {**(found.paper or {}), **evidence.published.get(each.id, {})}
                yield record(each, found, paper or None)


def where_from(evidence: str) -> str:
    """ "dataset: variables" as the file below results that holds them; anything else as it is."""
    dataset, colon, variables = evidence.partition(": ")
    if not colon or "." in dataset or dataset == "config":
        return evidence
    if dataset.startswith("truth/"):
        return f"{dataset}.nc: {variables}, by pump_truth"
    return f"data/{dataset}.nc: {variables}"


def said(function: Callable) -> str:
    """The docstring as part of a sentence: a first word that is no symbol is not capital."""
    first, *rest = function.__doc__.removesuffix(".").split()
    word = len(first) > 1 and first.isalpha() and first.istitle()
    return " ".join([first.lower() if word else first, *rest])


def holds(margin: float, uncertainty: float) -> bool:
    """Whether what is true for margin > 0 is so beyond numerical doubt."""
    return bool(margin > uncertainty)


def agrees(found: Computed, value: Any, resolution: Any) -> bool:
    """Whether what was computed is the paper's value, as far as either is known."""
    if isinstance(value, bool) or isinstance(found.value, bool):
        return found.value is value
    allowed = np.add(resolution, np.abs(found.uncertainty))
    return bool(np.all(np.abs(np.subtract(found.value, value)) <= allowed))


def status(kind: str, found: Computed, paper: Mapping[str, Any] | None) -> str:
    """The status, decided here and nowhere else."""
    if paper is None or found.value is None:
        return "qualitative"
    agree = agrees(found, paper["value"], paper.get("resolution", 0.0))
    if kind == LINE:
        return "reproduced" if agree else "misprint"
    if "drawn" in paper and agree != agrees(found, paper["drawn"], paper["drawn_resolution"]):
        return "inconsistent-in-paper"
    return {RESULT: "reproduced", IDENTITY: "identity"}[kind] if agree else "deviates"


def record(each: Statement, found: Computed, paper: Mapping[str, Any] | None) -> dict[str, Any]:
    """The statement as an entry of ``claims.json``; ValueError if a number in it is not finite."""
    code = getattr(each.compute, "func", each.compute)
    entry = {
        "id": each.id,
        "where": each.where,
        "statement": each.text,
        "published": None if paper is None else _plain(paper["value"]),
        "published_in_figure": None if paper is None else _plain(paper.get("drawn")),
        "resolution": None if paper is None else _plain(paper.get("resolution")),
        "resolution_in_figure": None if paper is None else _plain(paper.get("drawn_resolution")),
        "computed": _plain(found.value),
        "uncertainty": _plain(found.uncertainty),
        "relative_difference": relative_difference(found, paper),
        "measure": _plain(found.measure),
        "measured": found.measured,
        "follows": found.follows,
        "status": status(each.kind, found, paper),
        "evidence": where_from(each.evidence),
        "code": f"{code.__module__}.{code.__qualname__}",
    }
    for key in ("computed", "uncertainty", "measure"):
        if entry[key] is not None and not np.all(np.isfinite(entry[key])):
            raise ValueError(f"statement {each.id}: {key} = {entry[key]} is not finite")
    return entry


def relative_difference(found: Computed, paper: Mapping[str, Any] | None) -> float | None:
    """Largest |computed - published| / |published|; None where either is no number or is zero."""
    if paper is None or found.value is None or isinstance(found.value, bool):
        return None
    value = np.asarray(paper["value"], dtype=float)
    return float(np.max(np.abs((found.value - value) / value))) if np.all(value) else None


def _plain(value):
    if value is None or isinstance(value, bool):
        return value
    return np.asarray(value, dtype=float).tolist()
