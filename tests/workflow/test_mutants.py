"""The deliberate bugs of tests/mutants still find what they change; run.py tries them."""

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
def test_its_text_is_there_once(mutant):
    found = (PROJECT / mutant.file).read_text(encoding="utf-8").count(mutant.text)
    assert found == 1, f"{mutant.text!r} is {found} times in {mutant.file}: give the bug a new one"


@pytest.mark.parametrize("tests", sorted({mutant.tests.split()[0] for mutant in mutants.MUTANTS}))
def test_its_tests_are_there(tests):
    assert (PROJECT / tests).exists()


@pytest.mark.parametrize(("module", "tests"), random_sample.TESTS.items())
def test_random_changes_have_modules_and_tests(module, tests):
    source = PROJECT / random_sample.SOURCE / module
    assert source.is_dir() or source.with_suffix(".py").exists()
    paths = [PROJECT / each for each in tests.split()]
    assert all(path.exists() for path in paths)
    # pytest passes over a folder of which a file was named before
    assert not any(one in other.parents for one in paths for other in paths)


def test_the_nearest_entry_has_the_tests_of_a_module():
    found = random_sample.tests_of
    assert found("tube/front") == random_sample.TESTS["tube/front"]
    assert found("tube/ledger") == random_sample.TESTS["tube"]
    assert found("bead/sensitivity") == random_sample.TESTS["bead"]
    assert not found("figures/style")
    assert not found("tubes")
