"""The content of a report, gathered from what a build has made: one source for page and article.

Nothing here is typed: verdicts, deviations and digests are those of the files in ``results``.
Captions are the templates of ``workflow/report``, which Snakemake's own report takes too.
"""

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from gelpump.report.figures import DRAWINGS
from gelpump.report.notation import Text, from_plain, from_rst
from gelpump.statements import views
from gelpump.statements.statement import APART, STATUSES
from gelpump.statements.views import NOTHING, number, short


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


def gather(
    config: Mapping[str, Any],
    figures: Mapping[str, Mapping[str, Any]],
    tables: Mapping[str, Mapping[str, Any]],
    digests: Mapping[str, str],
    results: Path = Path("results"),
    seconds: Path = Path("workflow/reference/seconds.json"),
    citation: Path = Path("CITATION.cff"),
) -> Content:
    """The content of the build in ``results``.

    figures and tables: by the name of their rules, what `rules/report.smk` takes from these:
    ``data``, ``files``, ``caption`` and ``params``.  digests: SHA-256 of the rule's inputs by path.
    A figure that has no entry in ``seconds`` has no time.  OSError if a file is missing, ValueError
    or KeyError if one is not what it should be.
    """
    import yaml

    import gelpump
    from gelpump.provenance import digest, packages

    judged = _read(results / "claims.json")
    claims, beyond = (
        [claim(rank, entry) for rank, entry in enumerate(entries, start=1)]
        for entries in (judged, _read(results / "beyond.json"))
    )
    ledger = [disagreement(entry) for entry in _read(results / "ledger.json")]
    times = _read(seconds) if seconds.exists() else {}
    key_numbers = _read(results / "tables/figure_numbers.json")
    drawn = {
        name: _figure(name, rule, config, claims, ledger, times, key_numbers)
        for name, rule in figures.items()
    }
    datasets = [
        _dataset(Path(path), sha256) for path, sha256 in digests.items() if path.endswith(".nc")
    ]
    return Content(
        verdict=views.counts(judged, STATUSES),
        apart=views.counts(judged, APART),
        claims=claims,
        beyond=beyond,
        ledger=ledger,
        verification_figure=drawn.pop("verification"),
        figures=[each for each in drawn.values() if each.number],
        beyond_figures=[each for each in drawn.values() if not each.number],
        tables=[_table(name, rule, config) for name, rule in tables.items()],
        verification=_read(results / "verification.json"),
        cross_check=_read(results / "cross_check.json"),
        datasets=datasets,
        version=gelpump.__version__,
        config_digest=digest(dict(config)),
        code_digest=digest({each.path: each.code for each in datasets}),
        packages=packages(),
        citation=yaml.safe_load(citation.read_text(encoding="utf-8")),
    )


def claim(rank: int, entry: Mapping[str, Any]) -> Claim:
    """A claim of ``claims.json`` for people."""
    return Claim(
        number=rank,
        id=entry["id"],
        where=entry["where"],
        statement=from_plain(entry["statement"]),
        published=views.published(entry),
        computed=_computed(entry),
        measured=from_plain(entry["measured"].rstrip(": ")),
        deviation=entry["relative_difference"],
        status=entry["status"],
        evidence=entry["evidence"],
    )


def _computed(entry):
    """The number, or for a statement whether it holds and the number that decided."""
    if isinstance(entry["computed"], bool) or entry["computed"] is None:
        holds = {True: "holds", False: "does not hold", None: ""}[entry["computed"]]
        return ": ".join(filter(None, (holds, views.measure(entry)))) or NOTHING
    text = number(entry["computed"], entry["uncertainty"])
    return f"{text}; {views.measure(entry)}" if entry["measured"] else text


def disagreement(entry: Mapping[str, Any]) -> Disagreement:
    """An entry of ``ledger.json`` for people."""
    return Disagreement(
        id=entry["id"],
        where=entry["where"],
        printed=from_plain(entry["printed"]),
        follows=from_plain(entry["follows"]),
        measured=from_plain(entry["measured"]),
        size=short(entry["size"]),
        allowed=short(entry["allowed"]),
        verdict=entry["verdict"],
        code=entry["code"],
        evidence=entry["evidence"],
    )


def key_number(row: Mapping[str, Any]) -> KeyNumber:
    """A row of ``figure_numbers.json`` for people."""
    return KeyNumber(
        quantity=from_plain(row["quantity"]),
        printed=row["printed"],
        unit=from_plain(row["unit"]),
        source=row["source"],
    )


def caption(template: str | Path, config: Mapping[str, Any], params: Mapping[str, Any]):
    """The paragraphs of a caption, its template filled as Snakemake's report fills it."""
    import jinja2

    text = Path(template).read_text(encoding="utf-8")
    strict = jinja2.Environment(undefined=jinja2.StrictUndefined)
    job = SimpleNamespace(config=config, params=SimpleNamespace(**params))
    return from_rst(strict.from_string(text).render(snakemake=job))


def _figure(name, rule, config, claims, ledger, times, key_numbers):
    found = re.match(r"fig(\d+)_", name)
    rank = int(found[1]) if found else None
    drawing = DRAWINGS[name]
    return Figure(
        name=name,
        number=rank,
        title=drawing.title,
        alt=drawing.alt,
        caption=caption(rule["caption"], config, rule["params"]),
        data=list(rule["data"]),
        files=dict(rule["files"]),
        seconds=times.get(name),
        claims=[each for each in claims if rank in each.figures],
        ledger=[each for each in ledger if rank in each.figures],
        numbers=[key_number(row) for row in key_numbers if row["figure"] == name],
    )


def _table(name, rule, config):
    import csv

    with open(rule["files"]["csv"], encoding="utf-8", newline="") as stream:
        heading, *rows = csv.reader(stream)
    return Table(
        name=name,
        number=int(re.match(r"table(\d+)_", name)[1]),
        caption=caption(rule["caption"], config, rule["params"]),
        heading=heading,
        rows=rows,
        files=dict(rule["files"]),
    )


def _dataset(path, sha256):
    import netCDF4

    with netCDF4.Dataset(path) as dataset:
        attributes = dataset.__dict__
    return Dataset(
        path=path.as_posix(),
        size=path.stat().st_size,
        sha256=sha256,
        title=attributes["title"],
        code=attributes["code_version"].rpartition("sha256:")[2],
        config=attributes["config_digest"].rpartition("sha256:")[2],
    )


def _read(path):
    return json.loads(Path(path).read_text(encoding="utf-8"))
