"""What the truth's settings refuse, before any job starts."""

import copy
from pathlib import Path

import pytest
import yaml

from gelpump import config as checked
from gelpump import config_physics

PROJECT = Path(__file__).resolve().parents[2]


@pytest.fixture
def config():
    schema = yaml.safe_load((PROJECT / "workflow/schemas/config.schema.yaml").read_text())
    config = yaml.safe_load((PROJECT / "config/config.yaml").read_text())
    checked.fill_defaults(config, schema)
    return copy.deepcopy(config)


@pytest.mark.parametrize(
    ("block", "key", "value", "said"),
    [
        ("waves", "Pe", [0.1, 1.0], "truth.waves.Pe = [0.1, 1.0]: must begin with 0"),
        ("pulses", "T", [1.0, 0.5], "truth.pulses.T = [1.0, 0.5]: must increase"),
        ("pulses", "cells", [6, 24, 24], "truth.pulses.cells = [6, 24, 24]: the first must be"),
        ("bead", "gel", "linear", "truth.bead.gel = 'linear': must be one of the gels with an"),
    ],
)
def test_a_setting_that_cannot_be_is_refused_by_name(config, block, key, value, said):
    assert not [each for each in config_physics.problems(config) if each.startswith("truth")]
    config["truth"][block][key] = value
    (refusal,) = config_physics.problems(config)
    assert refusal.startswith(said)
