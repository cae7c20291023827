"""What page and article tell: a record for each kind of thing, from claims to datasets."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from gelpump.report.notation import Text
from gelpump.statements.views import NOTHING


@dataclass(frozen=True)
class Claim:
    """One statement of the paper; numbers are printed to the digits that uncertainty leaves.

    number: of the claim in the table, from 1.  deviation: |computed - published| / |published|,
    or None.
    """

    number: int
    id: str
    where: str
    statement: Text
    published: str
    computed: str
    measured: Text
    deviation: float | None
    status: str
    evidence: str

    @property
    def deviation_text(self) -> str:
        """The deviation in per cent, to two digits."""
        return NOTHING if self.deviation is None else percent(self.deviation)

    @property
    def figures(self) -> set[int]:
        """Numbers of the figures that the claim is about."""
        return set(figure_numbers(self.where))


@dataclass(frozen=True)
class Disagreement:
    """An entry of the ledger; verdict: which kind of disagreement it is."""

    id: str
    where: str
    printed: Text
    follows: Text
    measured: Text
    size: str
    allowed: str
    verdict: str
    code: str
    evidence: str

    @property
    def figures(self) -> set[int]:
        """Numbers of the figures that the entry is about."""
        return set(figure_numbers(self.where))


@dataclass(frozen=True)
class KeyNumber:
    """A number, or several, that a figure shows; printed to the digits that uncertainty leaves."""

    quantity: Text
    printed: str
    unit: Text
    source: str


@dataclass(frozen=True)
class Figure:
    """A figure with all that is said about it.

    name: of its rule.  number: as in the paper, None if it is ours.  caption: paragraphs.  seconds:
    CPU time of its rule from existing data, or None if it was not measured.  files: path by suffix.
    numbers: its key numbers.
    """

    name: str
    number: int | None
    title: str
    alt: str
    caption: list[Text]
    data: list[str]
    files: dict[str, str]
    seconds: float | None
    claims: list[Claim]
    ledger: list[Disagreement]
    numbers: list[KeyNumber] = field(default_factory=list)

    @property
    def label(self) -> str:
        """What it is called: "Figure 3", or "Figure X1" beyond the paper."""
        if self.number:
            return f"Figure {self.number}"
        ours = re.match(r"fig(X\d+)_", self.name)
        return f"Figure {ours[1]}" if ours else "Verification"


@dataclass(frozen=True)
class Table:
    """A table of the paper; cells as in its CSV file."""

    name: str
    number: int
    caption: list[Text]
    heading: list[str]
    rows: list[list[str]]
    files: dict[str, str]


@dataclass(frozen=True)
class Dataset:
    """A dataset, with the digests of its bytes and of what it was made from."""

    path: str
    size: int
    sha256: str
    title: str
    code: str
    config: str


@dataclass(frozen=True)
class Content:
    """Everything that page and article tell.

    verdict: claims by status, apart: those that no computation could contradict.  beyond: what is
    stated beyond the paper, and beyond_figures: what is drawn of it.  verification and cross_check:
    as in their JSON files.  code_digest: of the code of all datasets.  packages: versions by name.
    citation: the parsed CITATION.cff.
    """

    verdict: dict[str, int]
    apart: dict[str, int]
    claims: list[Claim]
    beyond: list[Claim]
    ledger: list[Disagreement]
    figures: list[Figure]
    beyond_figures: list[Figure]
    verification_figure: Figure
    tables: list[Table]
    verification: list[dict[str, Any]]
    cross_check: list[dict[str, Any]]
    datasets: list[Dataset]
    version: str
    config_digest: str
    code_digest: str
    packages: dict[str, str]
    citation: dict[str, Any]

    @property
    def references(self) -> list[str]:
        """This replication and the paper, as BibTeX."""
        return [bibtex("gelpump", self.citation)] + [
            bibtex(each["authors"][0]["family-names"].lower() + str(each["year"]), each)
            for each in self.citation["references"]
        ]

    @property
    def tested(self) -> int:
        """How many statements a computation could contradict."""
        return sum(self.verdict.values())


def figure_numbers(where: str) -> Iterable[int]:
    """The numbers of the figures that a place in the paper names: "figures 10, 11", "figure 7a"."""
    for listed in re.findall(r"figures? ([\d\w]+(?:(?:, | and )\d+[a-z]?\b)*)", where):
        yield from map(int, re.findall(r"\d+", listed))


def percent(share: float) -> str:
    """A share as per cent, to two digits."""
    value = 100 * share
    if value and abs(value) < 0.001:
        return f"{value:.0e} %".replace("e-0", "e-")
    return f"{value:.2g} %" if abs(value) < 100 else f"{value:.0f} %"


def bibtex(key: str, work: Mapping[str, Any]) -> str:
    """A work of a CITATION.cff as BibTeX."""

    def name(author):
        if "name" in author:
            return f"{{{author['name']}}}"
        return f"{author['family-names']}, {author['given-names']}"

    fields = {
        "author": " and ".join(map(name, work["authors"])),
        "title": f"{{{work['title']}}}",
        "journal": work.get("journal"),
        "year": work.get("year"),
        "version": work.get("version"),
        "doi": work.get("doi"),
        "url": work.get("repository-code"),
    }
    lines = [f"  {field} = {{{value}}}," for field, value in fields.items() if value is not None]
    kind = "article" if work["type"] == "article" else "misc"
    return "\n".join([f"@{kind}{{{key},", *lines, "}"])
