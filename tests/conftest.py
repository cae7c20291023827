"""Gels and beads that several tests use."""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import pytest
from clone import Clone

from gelpump.materials import EnergyBasedGel


@pytest.fixture(scope="session")
def hht() -> EnergyBasedGel:
    return EnergyBasedGel("HHT", -62.22, -58.28, 0.20470, 0.19044, 720.0, (290.0, 320.0))


@pytest.fixture(scope="session")
def anb() -> EnergyBasedGel:
    return EnergyBasedGel("ANB", -12.947, 17.92, 0.04496, -0.0569, 100.0, (290.0, 320.0))


@pytest.fixture
def clone(tmp_path) -> Clone:
    """A clean clone, in a path with a space and a letter beyond ASCII."""
    return Clone(tmp_path / "a clöne")


@pytest.fixture(scope="session")
def built(tmp_path_factory) -> Clone:
    """A clone in which everything was built with the quick configuration."""
    clone = Clone(tmp_path_factory.mktemp("built") / "project")
    result = clone.snakemake()
    assert result.returncode == 0, result.stdout + result.stderr
    return clone


SLOWER = ("hostile", "known_solutions", "second_solvers", "test_verify.py")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """The slower evidence is asked for by name, so that the first test run stays short.

    Tests that share a build, or what their module solves once, share a process.
    """
    for item in items:
        if any(part in SLOWER for part in item.path.parts):
            item.add_marker(pytest.mark.evidence)
        fixtures = item._fixtureinfo.name2fixturedefs
        if "built" in fixtures:
            item.add_marker(pytest.mark.xdist_group("built"))
        elif any(each[-1].scope == "module" for each in fixtures.values()):
            item.add_marker(pytest.mark.xdist_group(item.path.stem))
