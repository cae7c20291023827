"""Gels from config blocks, and the blocks that are refused."""

import pytest

from gelpump.materials import EnergyBasedGel, PiecewiseLinearGel, from_config

ENERGY = {
    "model": "energy-based",
    "A0": -62.22,
    "A1": -58.28,
    "B0": 0.2047,
    "B1": 0.19044,
    "Omega": 720,
    "temperature_range": [290, 320],
}
PIECEWISE = {"model": "piecewise-linear", "Phi_inf": 2, "Pi_ratio": 1, "M": 0}


def test_gels_from_config():
    assert from_config("HHT", ENERGY) == EnergyBasedGel(
        "HHT", -62.22, -58.28, 0.2047, 0.19044, 720.0, (290.0, 320.0)
    )
    assert from_config("tube", PIECEWISE) == PiecewiseLinearGel(2.0, 1.0, 0.0, name="tube")


@pytest.mark.parametrize(
    ("block", "change", "message"),
    [
        (ENERGY, {"Omega": -720}, r"gel.Omega = -720: must be greater than 0"),
        (ENERGY, {"Omega": 0}, r"gel.Omega = 0: must be greater than 0"),
        (ENERGY, {"A0": "low"}, r"gel.A0 = 'low': must be a finite number"),
        (ENERGY, {"B1": float("nan")}, r"gel.B1 = nan: must be a finite number"),
        (ENERGY, {"B0": True}, r"gel.B0 = True: must be a finite number"),
        (ENERGY, {"B0": 0, "B1": 0}, r"B0 = B1 = 0"),
        (ENERGY, {"temperature_range": [320, 290]}, r"the first must be lower"),
        (ENERGY, {"temperature_range": [-1, 290]}, r"temperature_range = -1: must be greater"),
        (ENERGY, {"temperature_range": 300}, r"must be two temperatures"),
        (ENERGY, {"omega": 720}, r"gel.omega = 720: unknown key; energy-based takes"),
        (ENERGY, {"model": "ideal"}, r"gel.model = 'ideal': must be one of energy-based"),
        (PIECEWISE, {"Phi_inf": 0}, r"gel.Phi_inf = 0: must be greater than 0"),
        (PIECEWISE, {"Pi_ratio": -1}, r"gel.Pi_ratio = -1: must be greater than 0"),
        (PIECEWISE, {"M": -0.1}, r"gel.M = -0.1: must be 0 or greater"),
    ],
)
def test_refusals_name_key_value_and_what_is_allowed(block, change, message):
    with pytest.raises(ValueError, match=message):
        from_config("gel", block | change)


def test_missing_key_is_refused():
    with pytest.raises(ValueError, match=r"gel.M is missing"):
        from_config("gel", {key: PIECEWISE[key] for key in PIECEWISE if key != "M"})
