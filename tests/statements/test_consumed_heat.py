"""Statements on heat: on solved tubes, and on ones that were tampered with."""

import numpy as np
import pytest

from gelpump.materials import PiecewiseLinearGel
from gelpump.statements import heat
from gelpump.statements.statement import Evidence
from gelpump.tube import heat_study
from gelpump.tube.heat import FRONT_CONSTANT

SETTINGS = {"ell": 0.5, "pipe": [1.0], "insulated": [0.0], "N": [30.0], "range": [1.0, 1e5]}
NUMERICS = {"cells": [48, 48], "tolerance": 2e-3}
GEL = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=1.0, M=1.0)


@pytest.fixture(scope="module")
def solved():
    settings = SETTINGS | {"points": 4}
    return heat_study.study(GEL, {"eps": 0.1, "Le": 10.0}, settings, NUMERICS)


@pytest.fixture
def judged(hht, anb):
    def judge(data, gels=None):
        evidence = Evidence({"tube_heat": data}, gels or {"HHT": hht, "ANB": anb}, {}, {}, {}, {})
        return {each["id"]: each for each in heat.statements.records(evidence)}

    return judge


def test_each_has_the_status_that_its_numbers_give(solved, judged):
    found = judged(solved)
    assert {key: each["status"] for key, each in found.items()} == {
        "heat-front-limit": "reproduced",
        "heat-energy": "reproduced",
        "heat-decoupled": "deviates",
        "heat-large-lewis": "deviates",
        "heat-printed-front": "deviates",
        "heat-printed-term": "deviates",
        "heat-of-energies": "deviates",
    }
    assert found["heat-decoupled"]["computed"] == pytest.approx([0.9539, 0.7226, 0.6888], abs=5e-5)
    assert found["heat-printed-front"]["computed"] == pytest.approx([1.0], abs=0.02)
    assert found["heat-of-energies"]["computed"] == pytest.approx([381, 147], rel=0.01)


def test_they_can_come_out_otherwise(solved, judged, hht):
    data = solved.copy(deep=True)
    data["front_over_diffusion"][1, -1] *= 1.02
    data["energy_balance_error"][0, 1] = 1e-6
    data["front_limit"][:] = FRONT_CONSTANT
    data["front_limit_large_Le"][:] = FRONT_CONSTANT
    data["Z_C_printed"][:] = np.sqrt(data.tau_printed.values)
    found = judged(data)
    for key in ("front-limit", "energy"):
        assert found[f"heat-{key}"]["status"] == "deviates"
    for key in ("decoupled", "large-lewis", "printed-front"):
        assert found[f"heat-{key}"]["status"] == "reproduced"


def test_an_energy_that_agrees_with_calorimetry_is_said_to(solved, judged, hht):
    """chi that hardly depends on T takes up what was measured."""
    share = 5.75 / judged(solved)["heat-of-energies"]["computed"][0]

    class Measured:
        def osmotic_energy(self, phi, T):
            return share * hht.osmotic_energy(phi, T)

        def osmotic_pressure(self, phi, T):
            return -hht.osmotic_pressure(phi, T)

        equilibrium_polymer_fraction = staticmethod(hht.equilibrium_polymer_fraction)

    found = judged(solved, {"HHT": Measured(), "ANB": Measured()})
    assert found["heat-of-energies"]["status"] == "reproduced"
    assert min(found["heat-printed-term"]["computed"]) > 0


def test_without_its_dataset_what_rests_on_it_is_left_out(hht, anb):
    evidence = Evidence({}, {"HHT": hht, "ANB": anb}, {}, {}, {}, {})
    assert not list(heat.statements.records(evidence))


def test_the_printed_term_is_what_departing_water_leaves_behind(hht, anb, monkeypatch):
    evidence = Evidence({}, {"HHT": hht, "ANB": anb}, {}, {}, {}, {})
    (found,) = heat.printed.records(evidence)
    assert (found["status"], found["computed"]) == ("misprint", pytest.approx(0, abs=1e-12))
    assert found["measure"] == pytest.approx(1, rel=1e-12)
    behind = heat.warming(0.0)
    monkeypatch.setattr(heat, "warming", lambda carried: behind)
    (found,) = heat.printed.records(evidence)
    assert found["status"] == "reproduced"
