"""Statements on tubes that conserve water: on solved tubes, and on ones that were tampered with."""

import numpy as np
import pytest

from gelpump.materials import PiecewiseLinearGel
from gelpump.statements import pumping
from gelpump.statements.statement import Evidence
from gelpump.tube import pump
from gelpump.tube.heat import StepHeating
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_times import wall_times

NUMERICS = {"cells": [32, 20], "tolerance": 2e-4, "reach": 12.0}
GEL = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=1.0, M=1.0)


@pytest.fixture(scope="module")
def solved():
    heat, tau = StepHeating(10.0), np.geomspace(1e-3, 0.1, 13)
    pulses, coarse = (
        pump.closures(Tubes([0.25, 0.75]), heat, tau, numerics)
        for numerics in (NUMERICS, pump.coarser(NUMERICS))
    )
    varied = {"ell": [0.25, 0.75], "M": [1.0, 10.0]}
    return {
        "pump_balance": pump.balance(pulses, heat, coarse),
        "wall_times": wall_times(GEL, {"eps": 0.1}, {"ell": 0.5, "varied": varied}),
    }


def judged(data):
    evidence = Evidence(data, {}, {}, {}, {}, {})
    return {each["id"]: each for each in pumping.statements.records(evidence)}


def test_each_has_the_status_that_its_numbers_give(solved):
    found = judged(solved)
    assert {key: each["status"] for key, each in found.items()} == {
        "beyond-conservation": "reproduced",
        "beyond-pump-direction": "reproduced",
        "beyond-pump-geometry": "reproduced",
        "beyond-pump-early": "reproduced",
        "beyond-pump-order": "reproduced",
        "beyond-pump-printed": "deviates",
        "beyond-wall-time": "deviates",
        "beyond-wall-stiffness": "deviates",
    }
    assert found["beyond-wall-time"]["computed"] == pytest.approx([1.775, 1.708], rel=1e-2)


def test_they_can_come_out_otherwise(solved):
    balance, walls = solved["pump_balance"].copy(deep=True), solved["wall_times"].copy(deep=True)
    balance["V_far"][1, 0, 3] *= -1
    balance["V_far"][0] = balance.V_far[1]
    balance["water_balance_error"][2, 0, 0] = 1e-6
    balance["V_far"][1, 1, -1] *= 1.01
    balance["V_far"][1, 1, 6] *= 1.03  # tau = 0.01
    balance["V_far_order"][1] = 0.5
    walls["tau99"][:] = walls.tau99_printed
    found = judged({"pump_balance": balance, "wall_times": walls})
    for statement in (
        "conservation",
        "pump-direction",
        "pump-geometry",
        "pump-order",
        "pump-early",
    ):
        assert found[f"beyond-{statement}"]["status"] == "deviates", statement
    for statement in ("pump-printed", "wall-time", "wall-stiffness"):
        assert found[f"beyond-{statement}"]["status"] == "reproduced", statement


def test_without_their_datasets_they_are_left_out():
    assert judged({}) == {}
