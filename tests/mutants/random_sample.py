"""A random sample of small changes, one at a time in a copy: which of them do the tests notice?

    python tests/mutants/random_sample.py --count 200 --seed 1 --minutes 30

The changes are those of Cosmic Ray (``tests/mutants/requirements.txt``): numbers, arithmetic,
comparisons, signs and truth values. Every place of the physics, of the statements and their
verdicts and of the designs where one is possible is as likely as any other; the seed says which are
drawn, and then which change is made there. The tests whose file imports the changed module, then
those that import what imports it, are run until one fails, or until they have taken ``BUDGET``
seconds: what they would find later can only raise the score. What is in ``equivalent.yaml``, each
with its reason, changes no number and is not drawn.

A run goes on where the last one with the same seed and sources stopped. ``--again`` tries once more
what survived, after tests have changed. With ``--record FILE`` the score and the survivors take
their place in that file. Exit status 1 for a score that is less than ``LEAST`` beyond chance, and
for a test that fails without any change.
"""

import argparse
import ast
import compileall
import contextlib
import hashlib
import json
import multiprocessing
import os
import random
import shutil
import signal
import sys
import tempfile
import time
from functools import cache
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import yaml
from recorded import record, table
from scipy.stats import binomtest

PROJECT = Path(__file__).resolve().parents[2]
SOURCE = "src/gelpump"
PARTS = ("Snakefile", "config", "profiles", "workflow", "src", "tests", "pyproject.toml")
LEAST = 0.5  # what samples have reached so far; 0.85 is the aim
BUDGET = 20.0  # seconds of CPU of the tests of one change
PATIENCE = 300.0  # what has not ended after so many seconds has no end
# loaded once, for all the tests
HEAVY = ["numpy", "scipy.integrate", "scipy.interpolate", "scipy.optimize", "scipy.sparse.linalg",
         "xarray", "netCDF4", "pytest", "yaml", "hypothesis"]  # fmt: skip

CHANGED = ["bdf", "bead", "config", "coordinates", "design", "finite_volume",
           "integrity/reference", "known_solutions", "materials", "second_solvers", "separation",
           "statements", "sweep", "tridiagonal", "truth", "tube", "uncertainty"]  # fmt: skip
TESTED = ["*.py", "bead", "design", "integrity", "known_solutions", "materials", "second_solvers",
          "separation", "statements", "sweep", "truth", "tube"]  # fmt: skip  # below tests
WITH_A_BUILD = {"built", "clone"}  # fixtures whose tests build all of it
ARITHMETIC = ("Add", "Sub", "Mul", "Div", "Pow")
ORDER = ("Eq", "NotEq", "Lt", "LtE", "Gt", "GtE")
OPERATORS = [
    *(f"ReplaceBinaryOperator_{a}_{b}" for a in ARITHMETIC for b in ARITHMETIC if a != b),
    *(f"ReplaceComparisonOperator_{a}_{b}" for a in ORDER for b in ORDER if a != b),
    *("ReplaceBinaryOperator_BitOr_BitAnd", "ReplaceBinaryOperator_BitAnd_BitOr"),
    *("ReplaceUnaryOperator_USub_UAdd", "ReplaceUnaryOperator_Delete_Not", "AddNot"),
    *("ReplaceTrueWithFalse", "ReplaceFalseWithTrue", "ReplaceAndWithOr", "ReplaceOrWithAnd"),
    *("ReplaceBreakWithContinue", "ReplaceContinueWithBreak", "NumberReplacer"),
]


class Change(NamedTuple):
    """The line of the file, what stands there, what shall, and the whole changed text."""

    file: str
    line: int
    before: str
    after: str
    text: str

    @property
    def key(self) -> str:
        return hashlib.sha256(f"{self.file}\n{self.text}".encode()).hexdigest()


def is_changed(module: str) -> bool:
    """Whether a module, as in "tube/front", is in the sample."""
    return any(f"{module}/".startswith(f"{each}/") for each in CHANGED)


def equivalents() -> set[tuple[str, str, str]]:
    """File, line before and after of what is known to change nothing."""
    listed = yaml.safe_load((PROJECT / "tests/mutants/equivalent.yaml").read_text("utf-8"))
    return {(each["file"], each["before"], each["after"]) for each in listed or ()}


def imported(file: Path) -> set[str]:
    """What a file imports of gelpump, as in "tube/front"; a package by all that is named of it."""
    found = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {each.name for each in node.names}
        elif isinstance(node, ast.ImportFrom):
            near = file.relative_to(PROJECT / "src").parts[: -node.level] if node.level else ()
            module = ".".join([*near, *filter(None, [node.module])])
            found |= {module, *(f"{module}.{each.name}" for each in node.names)}
    return {each.removeprefix("gelpump.").replace(".", "/") for each in found if "gelpump." in each}


@cache
def imports() -> tuple[dict[str, set[str]], dict[str, set[str]]]:
    """Of each module and of each file of tests what it imports."""
    source = PROJECT / SOURCE
    paths = {
        path.relative_to(source).with_suffix("").as_posix(): path for path in source.rglob("*.py")
    }
    modules = {name.removesuffix("/__init__"): imported(path) for name, path in paths.items()}
    folders = [one for each in TESTED for one in (PROJECT / "tests").glob(each)]
    files = [file for one in folders for file in ([one] if one.is_file() else one.rglob("*.py"))]
    tests = [file for file in files if file.name.startswith("test_")]
    return modules, {str(file.relative_to(PROJECT)): imported(file) for file in sorted(tests)}


def tests_of(module: str) -> list[str]:
    """Files of tests of a module, as in "tube/front": near ones first, then small ones."""
    modules, tests = imports()
    stem, reached, found, distance = module.split("/")[-1], {module}, {}, 0
    while reached and distance < 5:
        for file, names in tests.items():
            if names & reached:
                own = file.endswith(f"/test_{stem}.py")
                found.setdefault(file, (distance, not own, (PROJECT / file).stat().st_size))
        reached = {name for name, names in modules.items() if names & reached} - reached
        distance += 1
    return sorted(found, key=found.get)


def annotates(node) -> bool:
    """Whether a node is part of a type, where | is no operator."""
    while node.parent is not None:
        if node.parent.type in ("annassign", "tfpdef", "param"):
            return True
        if node.parent.type == "funcdef":
            return node.parent.annotation is node
        node = node.parent
    return False


class Sample:
    """Changes in random order, each of them in another place."""

    def __init__(self, seed: int):
        from cosmic_ray.ast import ast_nodes, get_ast
        from cosmic_ray.plugins import get_operator

        self.random = random.Random(seed)
        self.operators = {name: get_operator(f"core/{name}")() for name in OPERATORS}
        self.places: dict[tuple, list] = {}  # (file, where): operators, each with its occurrence
        for path in sorted((PROJECT / SOURCE).rglob("*.py")):
            module = path.relative_to(PROJECT / SOURCE).with_suffix("").as_posix()
            if not is_changed(module):
                continue
            count = dict.fromkeys(OPERATORS, 0)
            for node in ast_nodes(get_ast(path.read_text(encoding="utf-8"))):
                for name, operator in self.operators.items():
                    for where in operator.mutation_positions(node):
                        if not annotates(node):
                            place = self.places.setdefault((path, where), [])
                            place.append((name, count[name]))
                        count[name] += 1

    def __iter__(self):
        from cosmic_ray.mutating import mutate_code

        passed_over = equivalents()
        for path, where in self.random.sample(sorted(self.places), len(self.places)):
            name, occurrence = self.random.choice(self.places[path, where])
            text = path.read_text(encoding="utf-8")
            changed = mutate_code(text, self.operators[name], occurrence)
            with contextlib.suppress(SyntaxError):  # for ** of a dictionary, not of numbers
                compile(changed, path.name, "exec")
                lines = zip(text.splitlines(), changed.splitlines(), strict=True)
                line, pair = next((i, each) for i, each in enumerate(lines) if each[0] != each[1])
                file, (before, after) = str(path.relative_to(PROJECT)), pair
                if (file.removeprefix(f"{SOURCE}/"), before.strip(), after.strip()) in passed_over:
                    continue
                yield Change(file, line + 1, before, after, changed)


class First:
    """As a plugin of pytest: the first test that fails, and what it says; it stops in time."""

    test, said = "", ""

    def pytest_collection_modifyitems(self, items):
        items[:] = [each for each in items if not WITH_A_BUILD & set(each.fixturenames)]

    def pytest_runtest_logfinish(self, nodeid):
        if time.process_time() > BUDGET:
            self.session.shouldstop = "enough"

    def pytest_sessionstart(self, session):
        self.session = session

    def pytest_runtest_logreport(self, report):
        if report.failed and not self.test:
            self.test = report.nodeid
            crash = getattr(report.longrepr, "reprcrash", None)
            self.said = crash.message if crash else str(report.longrepr)[-300:]

    def pytest_collectreport(self, report):
        self.pytest_runtest_logreport(report)


def run(copy: Path, tests: list[str], answer) -> None:
    """In a process of its own: send pytest's exit status, the first failing test, what it says."""
    os.setsid()
    os.chdir(copy)
    os.environ["PYTHONPATH"] = str(copy / "src")
    sys.path[:0] = [str(copy / "src")]
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nowhere, stream)
    import pytest

    first = First()
    options = ["-x", "-q", "-n", "0", "-m", "", "-p", "no:cacheprovider"]
    status = pytest.main([*options, *tests], [first])
    answer.send((int(status), first.test, first.said))


class Bench:
    """A copy of the project in which one change at a time is tried."""

    def __init__(self, folder: Path):
        self.copy = folder / "project"
        self.copy.mkdir()
        for part in PARTS:
            if (PROJECT / part).is_dir():
                ignored = shutil.ignore_patterns("__pycache__", "*.egg-info")
                shutil.copytree(PROJECT / part, self.copy / part, ignore=ignored)
            else:
                shutil.copy2(PROJECT / part, self.copy / part)
        compileall.compile_dir(self.copy / "src", quiet=2)
        self.context = multiprocessing.get_context("forkserver")
        self.context.set_forkserver_preload(HEAVY)
        self.sound: dict[str, bool] = {}  # tests that pass without any change
        self.tried = 0

    def pytest(self, tests: list[str]) -> tuple[int, str, str] | None:
        """Exit status, failing test and what it says; None when the time is over."""
        mine, theirs = self.context.Pipe(duplex=False)
        process = self.context.Process(target=run, args=(self.copy, tests, theirs))
        process.start()
        theirs.close()
        try:
            return mine.recv() if mine.poll(PATIENCE) else None
        except EOFError:
            return 3, "the process", "died"
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.join()

    def verdict(self, change: Change) -> dict:
        """What became of a change; RuntimeError if its test fails without it, too."""
        file = self.copy / change.file
        module = file.relative_to(self.copy / SOURCE).with_suffix("").as_posix()
        tests = tests_of(module.removesuffix("/__init__"))
        entry = change._asdict() | {"key": change.key, "test": "", "said": ""}
        del entry["text"]
        if not tests:
            return entry | {"verdict": "no test"}
        self.tried += 1
        file.write_text(change.text, encoding="utf-8")
        os.utime(file, (self.tried, self.tried))  # so that nobody takes older bytecode for it
        try:
            answer = self.pytest(tests)
        finally:
            shutil.copy2(PROJECT / change.file, file)
        if answer is None:
            return entry | {"verdict": "no end"}
        status, test, said = answer
        if not test and status in (0, 2):  # the latter where time was over
            return entry | {"verdict": "survived"}
        if not test:
            raise RuntimeError(f"{change.file}:{change.line}: pytest ends with {status}")
        if "::" in test and test not in self.sound:
            unchanged = self.pytest([test])
            self.sound[test] = unchanged is not None and not unchanged[1]  # in time
        if not self.sound.get(test, True):
            raise RuntimeError(f"{test} fails without any change")
        return entry | {"verdict": "caught", "test": test, "said": said}


def kept(file: Path) -> dict[str, dict]:
    """What earlier runs found, by key: the last verdict on a change, and the first."""
    entries = {}
    for line in file.read_text(encoding="utf-8").splitlines() if file.exists() else []:
        entry = json.loads(line)
        first = entries.get(entry["key"], {"first": entry["verdict"]})["first"]
        entries[entry["key"]] = entry | {"first": first}
    return entries


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--again", action="store_true", help="try what survived once more")
    parser.add_argument("--record", type=Path)
    arguments = parser.parse_args()
    deadline = time.monotonic() + 60.0 * arguments.minutes
    found_before = PROJECT / f"build/random_mutants_{arguments.seed}.jsonl"
    found_before.parent.mkdir(exist_ok=True)
    known, drawn = kept(found_before), []
    sample = Sample(arguments.seed)
    with tempfile.TemporaryDirectory(prefix="mutants-") as folder:
        bench = Bench(Path(folder))
        for change, _ in zip(sample, range(arguments.count), strict=False):
            before = known.get(change.key)
            late = time.monotonic() > deadline
            if late and before is None:
                break  # the next run goes on here
            drawn.append(change.key)
            if late or (before and not (arguments.again and before["verdict"] != "caught")):
                continue
            entry = bench.verdict(change)
            with open(found_before, "a", encoding="utf-8") as stream:
                stream.write(json.dumps(entry) + "\n")
            place = f"{change.file.removeprefix(SOURCE + '/')}:{change.line}"
            print(f"{entry['verdict']:9s} {place}: {change.after.strip()}", flush=True)
    known = kept(found_before)
    found = [known[key] for key in drawn]
    caught, at_first = (
        sum(entry[which] == "caught" for entry in found) for which in ("verdict", "first")
    )
    size = max(len(found), 1)
    counted = (
        f"Of {len(found)} random changes (seed {arguments.seed}, of {len(sample.places)} places) "
        f"the tests noticed {at_first} ({100 * at_first / size:.0f} %) when they were first tried, "
        "which is the score."
    )
    if caught != at_first:
        counted += f" With the tests that were written since against the others it is {caught}."
    print(counted)
    if arguments.record:
        rows = [
            [f"{entry['file'].removeprefix(SOURCE + '/')}:{entry['line']}",
             f"`{entry['before'].strip()}`", f"`{entry['after'].strip()}`", entry["verdict"]]
            for entry in sorted(found, key=lambda entry: (entry["file"], entry["line"]))
            if entry["verdict"] != "caught"
        ]  # fmt: skip
        heads = ["where", "line", "changed to", "verdict"]
        record(arguments.record, "random mutants", counted, table(heads, rows))
    beyond_chance = found and binomtest(at_first, len(found), LEAST, "less").pvalue < 0.01
    return int(bool(beyond_chance))


if __name__ == "__main__":
    sys.exit(main())
