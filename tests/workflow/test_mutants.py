"""The deliberate bugs of tests/mutants still find what they change; run.py tries them."""

import ast
import importlib.util
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]


def script(name):
    spec = importlib.util.spec_from_file_location(name, PROJECT / f"tests/mutants/{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


mutants, random_sample = script("run"), script("random_sample")


@pytest.mark.parametrize("mutant", mutants.MUTANTS, ids=lambda mutant: mutant.bug)
def test_its_text_is_there_once_and_the_bug_is_code(mutant):
    source = (PROJECT / mutant.file).read_text(encoding="utf-8")
    found = source.count(mutant.text)
    if mutant.file.endswith(".py"):
        ast.parse(source.replace(mutant.text, mutant.wrong))
    assert found == 1, f"{mutant.text!r} is {found} times in {mutant.file}: give the bug a new one"


@pytest.mark.parametrize("tests", sorted({mutant.tests.split()[0] for mutant in mutants.MUTANTS}))
def test_its_tests_are_there(tests):
    assert (PROJECT / tests).exists()


@pytest.mark.parametrize("module", random_sample.CHANGED)
def test_random_changes_have_modules(module):
    source = PROJECT / random_sample.SOURCE / module
    assert source.is_dir() or source.with_suffix(".py").exists()
    assert random_sample.is_changed(module)


def test_what_draws_is_not_changed():
    assert random_sample.is_changed("tube/front")
    assert not random_sample.is_changed("figures/style")
    assert not random_sample.is_changed("tubes")


@pytest.mark.parametrize("each", random_sample.equivalents())
def test_what_changes_nothing_is_there_and_explained(each):
    file, before, _ = each
    assert before in (PROJECT / random_sample.SOURCE / file).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("line", "lines", "inside"),
    [(1, [1], False), (3, [3, 4], False), (5, [5, 6], True), (7, [7], True), (8, [8], True)],
)
def test_a_change_belongs_to_its_statement(line, lines, inside):
    text = "a = 1\n\ndef f(\n    x=1):\n    y = (x +\n         1)\n    if y:\n        return y\n"
    found, within = random_sample.statement_lines(ast.parse(text), line)
    assert (list(found), within) == (lines, inside)


def test_the_tests_that_run_a_statement_come_first(monkeypatch):
    """Those of it, cheap files first; then the others of these files, as far as time goes."""
    covered = {
        "tests/slow.py": {"seconds": {"tests/slow.py::a": 9.0, "tests/slow.py::b": 40.0},
                          "lines": {"bdf": {"66": ["tests/slow.py::a"]}}},
        "tests/fast.py": {"seconds": {"tests/fast.py::c": 2.0, "tests/fast.py::d": 1.0},
                          "lines": {"bdf": {"66": ["tests/fast.py::c"]}}},
        "tests/else.py": {"seconds": {"tests/else.py::e": 0.1},
                          "lines": {"bdf": {"1": ["tests/else.py::e"]}}},
    }  # fmt: skip
    bench = object.__new__(random_sample.Bench)
    bench.covered = covered
    monkeypatch.setattr(random_sample, "statement_lines", lambda *of: (range(66, 68), True))
    change = random_sample.Change("src/gelpump/bdf.py", 66, "", "", "")
    files, tests, seconds = bench.tests(change)
    assert files == ["tests/fast.py", "tests/slow.py"]
    assert [test[-1] for test in tests] == ["c", "a", "d"]
    assert seconds == 12.0
