"""The profile of a cluster, as far as it can be tested without one."""

from pathlib import Path

import yaml

PROJECT = Path(__file__).resolve().parents[2]


def profile(path):
    return yaml.safe_load((PROJECT / path / "config.yaml").read_text())


def test_the_two_profiles_say_different_things():
    """Both are loaded, and where both said something, profiles/default would win."""
    default, slurm = profile("profiles/default"), profile("workflow/profiles/slurm")
    assert not set(default) & set(slurm)
    assert slurm["executor"] == "slurm"
