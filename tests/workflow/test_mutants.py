"""The deliberate bugs of tests/mutants still find what they change; run.py tries them."""

import importlib.util
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]
spec = importlib.util.spec_from_file_location("mutants", PROJECT / "tests/mutants/run.py")
mutants = importlib.util.module_from_spec(spec)
spec.loader.exec_module(mutants)


@pytest.mark.parametrize("mutant", mutants.MUTANTS, ids=lambda mutant: mutant.bug)
def test_its_text_is_there_once(mutant):
    found = (PROJECT / mutant.file).read_text(encoding="utf-8").count(mutant.text)
    assert found == 1, f"{mutant.text!r} is {found} times in {mutant.file}: give the bug a new one"


@pytest.mark.parametrize("tests", sorted({mutant.tests.split()[0] for mutant in mutants.MUTANTS}))
def test_its_tests_are_there(tests):
    assert (PROJECT / tests).exists()
