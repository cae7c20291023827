"""The map of a build: what each figure and table is drawn from, and how long it all takes.

A build is a set of jobs, each with its rule, its inputs and its outputs; seconds are those that
Snakemake measured of each job.  From its datasets a figure leads to the modules that state their
equations, from these to the paper's labels, in their docstrings, and to their tests, and by its
number to what the paper prints or draws of it.
"""

import ast
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

PACKAGE = Path(__file__).resolve().parent
SHOWN = ("fig", "table")  # how the rules of what is shown begin
UNMEASURED = "–"

# The modules that state what is solved, by the rule that makes the dataset.
MODELS = {
    "materials": ("materials.energy_based",),
    "bead_lens": ("bead.lens",),
    "bead_nonlinear": ("bead.nonlinear",),
    "coexistence": ("separation.coexistence",),
    "separation_front": ("separation.sharp", "separation.lens_front"),
    "deswelling_map": ("tube.deswelling",),
    "deswelling_curves": ("tube.deswelling",),
    "wall_times": ("tube.wall",),
    "tube_pulse": ("tube.slender", "tube.heat"),
    "refine_tube_pulse": ("tube.slender", "tube.heat"),
    "front_fit": ("tube.front",),
    "tube_flow": ("tube.wall_flow", "tube.lumen"),
    "water_budget": ("tube.wall_flow",),
    "lumen_pulse": ("tube.lumen",),
    "tube_heat": ("tube.heated", "tube.stefan"),
    "pump_balance": ("tube.closure", "tube.pump"),
    "cycle_beads": ("cycles.bead",),
    "cycle_tube": ("cycles.tube", "cycles.programme"),
}


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
    """The map as Markdown; a job whose seconds were not measured yet leaves its figure's open."""
    lines = [
        "| figure or table (= rule) | datasets | seconds | from nothing |",
        "| --- | --- | ---: | ---: |",
    ]
    for row in rows:
        datasets = ", ".join(f"`{name}`" for name in row.datasets) or "the configuration"
        alone, whole = (
            f"{sum(seconds[name] for name in jobs):.1f}"
            if seconds.keys() >= set(jobs)
            else UNMEASURED
            for jobs in (row.jobs[-1:], row.jobs)
        )
        lines.append(f"| {row.rule} | {datasets} | {alone} | {whole} |")
    return "\n".join(lines)


def models(row: Row, jobs: Mapping[str, Job]) -> list[str]:
    """Modules that state what a row's datasets solve; KeyError for a rule that ``MODELS`` lacks."""
    solved = (jobs[name].rule for name in row.jobs[:-1])
    return list(dict.fromkeys(module for rule in solved for module in MODELS[rule]))


def labels(module: str) -> list[str]:
    """The paper's equations that a module's docstring names, by their labels."""
    text = (PACKAGE / f"{module.replace('.', '/')}.py").read_text(encoding="utf-8")
    return list(
        dict.fromkeys(re.findall(r"eqn:\w+(?::\w+)*", ast.get_docstring(ast.parse(text)) or ""))
    )


def test_of(module: str) -> str:
    """The test of a module's physics."""
    package, _, name = module.rpartition(".")
    return f"tests/{package}/test_{name}.py"


def place(rule: str) -> str:
    """What the paper calls a figure or table: ``figure 9``; beyond it there is no such place."""
    kind, number = re.match(r"(fig|table)(X?\d+)", rule).groups()
    return f"{'figure' if kind == 'fig' else kind} {number.lstrip('0')}"


def published(rule: str, statements: Iterable[Any], values: Mapping[str, Any]) -> dict[str, Any]:
    """What the paper prints or draws of a figure, by the statements that stand there.

    values: the block ``published`` of the configuration; a statement that only says how something
    is, not how much, has the value True.
    """
    return {
        each.id: values[each.id]["value"]
        for each in statements
        if each.id in values and place(rule) in _places(each.where)
    }


def _places(where: str) -> set[str]:
    """Figures and tables in a place such as ``section 3.6, figures 10 and 11a``."""
    named = re.findall(r"(figure|table)s? (\d+)[a-z]?(?: and (\d+))?", where)
    return {f"{kind} {number}" for kind, *numbers in named for number in numbers if number}


def model_table(
    rows: Iterable[Row],
    jobs: Mapping[str, Job],
    statements: Iterable[Any],
    values: Mapping[str, Any],
) -> str:
    """Equations, tests and published values of each figure and table, as Markdown."""
    lines = [
        "| figure or table | model: its equations in the paper | tests | datasets | published |",
        "| --- | --- | --- | --- | --- |",
    ]
    for row in rows:
        modules = models(row, jobs)
        stated = [
            f"[{module}](../src/gelpump/{module.replace('.', '/')}.py): "
            + (", ".join(f"`{label}`" for label in labels(module)) or "derived there")
            for module in modules
        ]
        cells = (
            stated,
            [f"[{Path(test).stem}](../{test})" for test in map(test_of, modules)],
            [f"`{name}`" for name in row.datasets] or ["the configuration"],
            _values(published(row.rule, statements, values)),
        )
        said = (f" {'<br>'.join(cell) or UNMEASURED} " for cell in cells)
        lines.append(f"| {row.rule} |{'|'.join(said)}|")
    return "\n".join(lines)


def _values(published: Mapping[str, Any]) -> list[str]:
    """``id``, and its value if that is a number or several."""
    listed = {name: each if isinstance(each, list) else [each] for name, each in published.items()}
    return [
        f"`{name}`" + ("" if each == [True] else " " + ", ".join(f"{value:g}" for value in each))
        for name, each in listed.items()
    ]


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
