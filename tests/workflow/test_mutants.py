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
    ("module", "first"),
    [
        ("tube/front", "tests/tube/test_front.py"),
        ("bead/nonlinear", "tests/bead/test_nonlinear.py"),
        ("statements/separation", "tests/statements/test_paper.py"),  # by what gathers them
        ("finite_volume", "tests/test_finite_volume.py"),
    ],
)
def test_the_tests_that_import_a_module_come_first(module, first):
    assert random_sample.tests_of(module)[0] == first


def test_only_these_modules_are_run_by_no_test_that_imports_them():
    changed = filter(random_sample.is_changed, random_sample.imports()[0])
    without = {module for module in changed if not random_sample.tests_of(module)}
    assert without <= {
        "separation/phases",
        "truth/verification",
        "tube/flow_fields",
        "tube/uniform",
    }
