"""What the article says: sentences and tables, all of whose numbers and verdicts are computed.

A sentence that rests on a verdict is written from it.
"""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from gelpump.article.markup import caption, plain, runs
from gelpump.report.notation import from_plain
from gelpump.report.records import Content, Figure

# what a reader should know first, in this order
FOREMOST = (
    "swell-radius-lens",
    "dry-radius-lens",
    "A-values",
    "A-exponent",
    "figure-12-prefactor",
    "radial-structure",
    "printed-digits-of-table-2",
)


def telling(content: Content, config: Mapping[str, Any], seconds: Mapping[str, float]):
    """Everything that the template sets, made of what JSON knows."""
    ledger = {entry.id: (rank, entry) for rank, entry in enumerate(content.ledger, start=1)}
    return {
        "abstract": [runs(from_plain(text)) for text in _abstract(content)],
        "extent": [_extent(figure, ledger) for figure in content.figures],
        "figures": [_figure(figure, ledger) for figure in content.figures],
        "beyond_figures": [_figure(figure, ledger) for figure in content.beyond_figures],
        "verification_figure": _figure(content.verification_figure, ledger),
        "tables": [_table(table) for table in content.tables],
        "foremost": [_disagreement(*ledger[name]) for name in FOREMOST if name in ledger],
        "claims": [_claim(each) for each in content.claims],
        "ledger": [_disagreement(rank, each) for rank, each in ledger.values()],
        "beyond": [_claim(each) for each in content.beyond],
        "verification": [_study(each) for each in content.verification],
        "cross_check": [_comparison(each) for each in content.cross_check],
        "evidence": [runs(from_plain(text)) for text in _evidence(content)],
        "reading": runs(from_plain(_reading(content))),
        "equations": runs(from_plain(_equations(content))),
        "numerics": config["numerics"],
        "version": content.version,
        "digest": content.config_digest,
        "packages": dict(content.packages),
        "jobs": len(seconds),
        "minutes": f"{sum(seconds.values()) / 60:.1f}",
        "authors": [author["name"] for author in content.citation["authors"]],
        "licence": content.citation["license"],
    }


def listed(words: Sequence[str]) -> str:
    """Words as an enumeration: "3, 4 and 9"."""
    words = list(map(str, words))
    return " and ".join(filter(None, [", ".join(words[:-1]), words[-1]])) if words else "none"


def extent(figure: Figure) -> str:
    """How far a figure was reproduced: fully, partly, not, or nothing to compare.

    Fully if every statement about it that can be decided is reproduced, and the ledger holds no
    disagreement about it.
    """
    apart = "qualitative", "identity", "misprint"
    decided = [claim.status for claim in figure.claims if claim.status not in apart]
    found = bool(figure.ledger)
    if not decided:
        return "partly" if found else "nothing to compare"
    if "reproduced" not in decided:
        return "not"
    return "fully" if set(decided) == {"reproduced"} and not found else "partly"


def _abstract(content):
    counts = content.verdict
    by_extent = {}
    for figure in content.figures:
        by_extent.setdefault(extent(figure), []).append(figure.number)
    yield (
        f"All {len(content.figures)} figures were computed anew from the equations that the paper "
        f"states and its printed parameters, which the {len(content.tables)} tables repeat."
    )
    yield (
        f"Of {content.tested} statements that a computation could contradict, "
        f"{counts['reproduced']} are reproduced within the printed digits and our numerical "
        f"uncertainty, {counts['deviates']} deviate, {counts['inconsistent-in-paper']} are "
        f"inconsistent within the paper, and {counts['qualitative']} are qualitative. Apart from "
        f"these, {content.apart['identity']} could not have come out otherwise, and "
        f"{content.apart['misprint']} printed lines differ from their own derivation."
    )
    yield (
        f"Figures {listed(by_extent.get('fully', []))} are reproduced fully, "
        f"{listed(by_extent.get('partly', []))} partly, {listed(by_extent.get('not', []))} not; "
        f"in figures {listed(by_extent.get('nothing to compare', []))} there is nothing printed to "
        "compare with."
    )


def _evidence(content):
    passed = sum(study["passes"] for study in content.verification)
    agreed = [row for row in content.cross_check if row["agrees"]]
    nearest = max(content.cross_check, key=lambda row: row["difference"] / row["limit"])
    yield (
        f"{passed} of {len(content.verification)} studies of the solvers on problems with known "
        "solutions pass."
    )
    yield (
        f"{len(agreed)} of {len(content.cross_check)} quantities agree with the second solver "
        "within the sum of the two numerical uncertainties. The one that comes nearest to its "
        f"limit is the {nearest['quantity']}, with a difference of {nearest['difference']:.1e} "
        f"where {nearest['limit']:.1e} is allowed."
    )


def _reading(content):
    drawn = [str(each.number) for each in content.claims if "figure" in each.where]
    return (
        f"{len(drawn)} of the {len(content.claims)} statements rest on figures, whose values "
        "had to be read off the drawings; how well each could be read is part of the comparison."
    )


def _equations(content):
    ranks = [
        f"L{rank}" for rank, entry in enumerate(content.ledger, start=1) if "eqn" in entry.where
    ]
    if not ranks:
        return "No printed equation was found to disagree with what it is derived from."
    return (
        f"{len(ranks)} entries of the ledger ({listed(ranks)}) concern printed equations that do "
        "not follow from the others or from the conditions that are stated with them."
    )


def _extent(figure, ledger):
    names = {status: [] for status in ("reproduced", "deviates", "inconsistent-in-paper")}
    for claim in figure.claims:
        names.setdefault(claim.status, []).append(str(claim.number))
    ranks = [f"L{ledger[entry.id][0]}" for entry in figure.ledger]
    other = names["deviates"] + names["inconsistent-in-paper"]
    return {
        "number": figure.number,
        "title": figure.title,
        "extent": extent(figure),
        "reproduced": ", ".join(names["reproduced"]) or "–",
        "other": ", ".join(other) or "–",
        "ledger": ", ".join(ranks) or "–",
    }


def _figure(figure, ledger):
    ranks = [f"L{ledger[entry.id][0]}" for entry in figure.ledger]
    claims = [f"{each.number} ({each.status})" for each in figure.claims]
    parts = []
    if claims:
        parts.append(f"Statements in appendix A: {', '.join(claims)}.")
    if ranks:
        parts.append(f"Disagreements in appendix B: {', '.join(ranks)}.")
    return {
        "name": figure.name,
        "number": figure.number,
        "label": figure.label,
        "title": figure.title,
        "alt": figure.alt,
        "caption": [caption(paragraph) for paragraph in figure.caption],
        "judged": plain(" ".join(parts)),
        "numbers": [
            {
                "quantity": runs(each.quantity),
                "printed": number(each.printed),
                "unit": runs(each.unit),
                "source": each.source,
            }
            for each in figure.numbers
        ],
    }


def number(text: str):
    """One number or several, as a printer sets them: with a minus sign and powers of ten."""
    return runs(from_plain(re.sub(r"(?<!\w)-(?=\d)", "−", text)))


def _table(table):
    return {
        "number": table.number,
        "caption": [caption(paragraph) for paragraph in table.caption],
        "heading": table.heading,
        "rows": table.rows,
    }


def _claim(claim):
    return {
        "number": claim.number,
        "where": claim.where,
        "statement": runs(claim.statement),
        "published": number(claim.published),
        "computed": number(claim.computed),
        "measured": runs(claim.measured),
        "deviation": claim.deviation_text,
        "status": claim.status,
    }


def _disagreement(rank, entry):
    return {
        "rank": rank,
        "where": entry.where,
        "printed": runs(entry.printed),
        "follows": runs(entry.follows),
        "measured": runs(entry.measured),
        "size": number(entry.size),
        "allowed": number(entry.allowed),
        "verdict": entry.verdict,
        "code": entry.code.removeprefix("gelpump.statements."),
    }


def _study(study):
    return {
        "problem": study["problem"],
        "quantity": runs(from_plain(study["quantity"])),
        "finest": f"{study['resolutions'][-1]} {study['against']}" if study["against"] else "–",
        "error": number(f"{study['errors'][-1]:.1e}"),
        "orders": ", ".join(f"{order:.2f}" for order in study["orders"]) or "–",
        "least": "–" if study["least_order"] is None else f"{study['least_order']:g}",
        "bound": number(f"{study['bound']:.0e}"),
        "verdict": "passes" if study["passes"] else "fails",
    }


def _comparison(row):
    return {
        "quantity": runs(from_plain(row["quantity"])),
        "at": runs(from_plain(row["at"])),
        "difference": number(f"{row['difference']:.1e}"),
        "first": number(f"{row['uncertainty_first']:.1e}"),
        "second": number(f"{row['uncertainty_second']:.1e}"),
        "limit": number(f"{row['limit']:.1e}"),
        "verdict": "agrees" if row["agrees"] else "differs",
    }
