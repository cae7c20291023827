"""The map of a build: what each figure and table is drawn from, and how long it all takes.

A build is a set of jobs, each with its rule, its inputs and its outputs; seconds are those that
Snakemake measured of each job.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

SHOWN = ("fig", "table")  # how the rules of what is shown begin


class Job(NamedTuple):
    """A job by its rule, the paths that it reads (code apart) and those that it writes."""

    rule: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


class Row(NamedTuple):
    """A figure or table, the datasets it reads, and the jobs that it needs, itself the last."""

    rule: str
    datasets: tuple[str, ...]
    jobs: tuple[str, ...]


def jobs_of_manifest(manifest: Mapping[str, Any]) -> dict[str, Job]:
    """The jobs of ``results/manifest.json`` by name."""
    outputs: dict[str, list[str]] = {name: [] for name in manifest["jobs"]}
    for path, output in manifest["outputs"].items():
        outputs[output["job"]].append(path)
    return {
        name: Job(job["rule"], tuple(job["inputs"]), tuple(outputs[name]))
        for name, job in manifest["jobs"].items()
    }


def rows(jobs: Mapping[str, Job]) -> list[Row]:
    """A row for each figure and table, in the order of their names."""
    made_by = {path: name for name, job in jobs.items() for path in job.outputs}

    def needed(name, found):
        for path in jobs[name].inputs:
            if path in made_by and made_by[path] not in found:
                needed(made_by[path], found)
        found.append(name)
        return found

    return [
        Row(
            jobs[name].rule,
            tuple(Path(path).stem for path in jobs[name].inputs if path.endswith(".nc")),
            tuple(needed(name, [])),
        )
        for name in sorted(jobs)
        if jobs[name].rule.startswith(SHOWN)
    ]


def measured(benchmark: str | Path) -> float:
    """Seconds that a benchmark file of Snakemake gives; OSError if it is not there."""
    heading, values = Path(benchmark).read_text(encoding="utf-8").splitlines()[:2]
    return round(float(values.split("\t")[heading.split("\t").index("s")]), 1)


def table(rows: Iterable[Row], seconds: Mapping[str, float]) -> str:
    """The map as Markdown; KeyError if a job's seconds are not known."""
    lines = [
        "| figure or table (= rule) | datasets | seconds | from nothing |",
        "| --- | --- | ---: | ---: |",
    ]
    for row in rows:
        datasets = ", ".join(f"`{name}`" for name in row.datasets) or "the configuration"
        alone, whole = seconds[row.jobs[-1]], sum(seconds[name] for name in row.jobs)
        lines.append(f"| {row.rule} | {datasets} | {alone:.1f} | {whole:.1f} |")
    return "\n".join(lines)


def between(marker: str, text: str) -> str:
    """What stands between ``<!-- marker -->`` and ``<!-- end marker -->``; ValueError without."""
    begin, end = _ends(marker, text)
    return text[begin:end].strip("\n")


def replaced(marker: str, text: str, content: str) -> str:
    """``text`` with ``content`` between the markers."""
    begin, end = _ends(marker, text)
    return f"{text[:begin]}\n{content}\n{text[end:]}"


def _ends(marker: str, text: str) -> tuple[int, int]:
    opening, closing = f"<!-- {marker} -->", f"<!-- end {marker} -->"
    if text.count(opening) != 1 or text.count(closing) != 1:
        raise ValueError(f"the markers {opening} and {closing} do not stand there once each")
    return text.index(opening) + len(opening), text.index(closing)
