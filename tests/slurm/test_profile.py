"""The profile of a cluster, as far as it can be tested without one."""

from pathlib import Path

import yaml

PROJECT = Path(__file__).resolve().parents[2]


def profile(path):
    return yaml.safe_load((PROJECT / path / "config.yaml").read_text())


def test_nothing_is_lost_whichever_way_the_profile_is_named():
    """--workflow-profile takes the place of profiles/default, --profile stands behind it."""
    default, slurm = profile("profiles/default"), profile("workflow/profiles/slurm")
    assert default.items() <= slurm.items()
