"""Where the CPU seconds of a rebuild go.

The paper is built in a folder of its own while every Python process samples itself
(`sampling/sitecustomize.py`); production code knows nothing of it.  Each sample is a stack, and the
first of `CATEGORIES` that fits tells what the time was spent on.  What the system counted and no
process did is the end of the interpreters, and the shells that start them.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmarks.measure import forked
from benchmarks.settings import PROJECT

PARTS = ("Snakefile", "CITATION.cff", "config", "profiles", "workflow", "src")
SCHEDULER = "Snakemake"
FIGURE = "fig09_relax"
GROUPS = {
    SCHEDULER: r"$",
    "figures": r"fig",
    "beads": r"bead",
    "tubes": r"tube|refine|deswelling|front|lumen|water",
    "evidence": r"verif|second|cross|statements",
    "others": r"",
}

START, END, SAMPLING = "interpreter: start", "interpreter: end, and shells", "the sampling itself"
IMPORTS, SCHEDULING, REST = "imports", "Snakemake: plan and schedule", "the rest"

Stack = Sequence[str]


def _any(pattern: str) -> Callable[[Stack], bool]:
    found = re.compile(pattern).search
    return lambda stack: any(map(found, stack))


def _below(above: str, pattern: str) -> Callable[[Stack], bool]:
    """Whether `pattern` is called, directly or not, by `above`."""
    caller, found = re.compile(above).search, re.compile(pattern).search

    def fits(stack):
        at = next((i for i, frame in enumerate(stack) if caller(frame)), None)
        return at is not None and any(map(found, stack[at:]))

    return fits


# a frame is file:function; the first that fits counts
CATEGORIES: dict[str, Callable[[Stack], bool]] = {
    IMPORTS: _any(r"^<frozen importlib._bootstrap>:_find_and_load"),
    "linear solves": _any(r"/(scipy|numpy)/linalg/|:_solve_$"),
    "FiPy: matrix assembly": _any(r"/fipy/terms/.*:(_prepareLinearSystem|_buildAndAddMatrices)$"),
    "FiPy: the rest": _any(r"/fipy/"),
    "SUNDIALS and the rates it asks for": _any(r"/sksundae/"),
    "netCDF: writing": _any(r"/gelpump/netcdf\.py:write$"),
    "netCDF: reading": _any(r"/gelpump/netcdf\.py:read|/netCDF4/"),
    "figures: saving PDF": _any(r"/backend_pdf\.py:"),
    "figures: saving SVG": _any(r"/backend_svg\.py:"),
    "figures: saving PNG": _below(r"/figures/style\.py:save$", r"/backend_agg\.py:print_png"),
    "figures: layout": _any(r"/figures/style\.py:save$"),
    "figures: drawing": _any(r"/gelpump/figures/"),
    "digests and provenance": _any(r"/gelpump/(provenance|integrity/\w+)\.py:"),
    "page and article": _any(r"/gelpump/(report|article)/"),
    "our own Python": _any(r"/gelpump/"),
}
ROWS = (START, END, SCHEDULING, *CATEGORIES, REST)


def category(stack: Stack) -> str:
    """What a sample's time was spent on."""
    return next((name for name, fits in CATEGORIES.items() if fits(stack)), REST)


def imported(stack: Stack) -> str:
    """The package outside gelpump whose import the outermost import of a stack waits for."""
    first = next(i for i, frame in enumerate(stack) if CATEGORIES[IMPORTS]((frame,)))
    for frame in stack[first:]:
        package = re.search(r"/site-packages/(\w+)", frame)
        if package and "/gelpump/" not in frame:
            return package[1]
    return "Python's own and gelpump"


def job(command: Sequence[str]) -> str:
    """The rule whose script a process ran; SCHEDULER's is empty."""
    script = re.fullmatch(r"tmp[^.]*\.(\w+)\.py", Path(command[0]).name)
    return script[1] if script else ""


def group(rule: str) -> str:
    """The first of GROUPS that the rule's name begins with."""
    return next(name for name, pattern in GROUPS.items() if re.match(pattern, rule))


def summed(records: Sequence[Mapping[str, Any]], total: float) -> dict:
    """CPU seconds by category and group, of imports by package, and by rule."""
    table = {name: Counter() for name in GROUPS}
    packages: dict[str, Counter] = {}
    rules: dict[str, dict] = {}
    functions: Counter = Counter()
    for record in records:
        rule = job(record["command"])
        here = table[group(rule)]
        here[START] += record["start"]
        loaded = Counter()
        for stack, seconds in record["stacks"]:
            name = category(stack)
            if name == IMPORTS:
                loaded[imported(stack)] += seconds
            elif not rule:
                name = SCHEDULING
            else:
                for frame in set(stack):
                    functions[re.sub(r"/tmp[^./]*\.", "/", frame)] += seconds
            here[name] += seconds
        for package, seconds in loaded.items():
            packages.setdefault(package, Counter())[rule] += seconds
            packages[package]["processes"] += 1
        spent = record["seconds"] - record["sampling"]
        entry = rules.setdefault(
            rule or SCHEDULER, {"number": 0, "seconds": 0.0, "wall": 0.0, "memory_mb": 0.0}
        )
        entry["number"] += 1
        entry["seconds"] += spent
        entry["wall"] += record["wall"]
        entry["memory_mb"] = max(entry["memory_mb"], record["memory_mb"])
    sampling = sum(record["sampling"] for record in records)
    unseen = total - sum(record["seconds"] for record in records)
    jobs = [group(rule) for record in records if (rule := job(record["command"]))]
    for name in jobs:  # each ends one interpreter, and has one shell
        table[name][END] += unseen / len(jobs)
    return {
        "seconds": total - sampling,
        "sampling": sampling,
        "table": {name: dict(counted) for name, counted in table.items()},
        "imports": {
            package: [counted.pop("processes"), sum(counted.values())]
            for package, counted in packages.items()
        },
        "rules": rules,
        "functions": functions.most_common(60),
    }


def rebuild() -> dict:
    """The paper in a folder of its own, sampled; ChildProcessError if the build fails."""
    with tempfile.TemporaryDirectory() as folder:
        tree, samples = Path(folder, "tree"), Path(folder, "samples")
        tree.mkdir()
        samples.mkdir()
        ignored = shutil.ignore_patterns("__pycache__", "*.egg-info")
        for part in PARTS:
            if (PROJECT / part).is_dir():
                shutil.copytree(PROJECT / part, tree / part, ignore=ignored)
            else:
                shutil.copy2(PROJECT / part, tree / part)
        environment = os.environ | {
            "PYTHONPATH": f"{Path(__file__).parent / 'sampling'}{os.pathsep}{tree / 'src'}",
            "GELPUMP_PROFILE": str(samples),
            "OMP_NUM_THREADS": "1",
        }

        def build(*what, **others):
            command = [sys.executable, "-m", "snakemake", "--cores", "2", "--quiet", "all"]
            run = (
                [*command, "--", *what] if what else [*command, "--forcerun", FIGURE, "--", FIGURE]
            )
            subprocess.run(run, cwd=tree, env=environment | others, check=True)

        used = forked(lambda: build())
        records = [json.loads(file.read_text(encoding="utf-8")) for file in samples.iterdir()]
        unsampled = {"PYTHONPATH": str(tree / "src")}
        again = {
            "nothing to do": forked(lambda: build(**unsampled)),
            f"{FIGURE} from data": forked(
                lambda: build("--forcerun", FIGURE, "--", FIGURE, **unsampled)
            ),
        }
    return summed(records, used.seconds) | {
        "wall": used.wall,
        "again": {what: each._asdict() for what, each in again.items()},
    }
