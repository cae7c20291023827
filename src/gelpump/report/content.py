"""The content of a report, gathered from what a build has made: one source for page and article.

Nothing here is typed: verdicts, deviations and digests are those of the files in ``results``.
Captions are the templates of ``workflow/report``, which Snakemake's own report takes too.
"""

import json
import re
from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from gelpump.report.figures import DRAWINGS
from gelpump.report.notation import from_plain, from_rst
from gelpump.report.records import (
    Claim,
    Content,
    Dataset,
    Disagreement,
    Figure,
    KeyNumber,
    Table,
)
from gelpump.statements import views
from gelpump.statements.statement import APART, STATUSES
from gelpump.statements.views import NOTHING, number, short


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
