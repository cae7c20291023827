"""Clones of the project: a clean one, and one that is built."""

import pytest
from clone import Clone


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
