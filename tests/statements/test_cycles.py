"""Statements on tubes that are heated and cooled: on solved ones, and on tampered ones."""

import pytest

from gelpump.cycles import production
from gelpump.materials import PiecewiseLinearGel
from gelpump.statements import cycles
from gelpump.statements.statement import Evidence

GEL = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=1.0, M=1.0)
SETTINGS = {"ell": 0.5, "periods": [0.0025, 0.01], "cycles": 2, "outputs": 20}
NUMERICS = {"cell": 0.5, "tolerance": 1e-2, "node": 0.5, "rtol": 1e-4}


@pytest.fixture(scope="module")
def solved():
    return production.tubes(GEL, {"eps": 0.1, "Le": 10.0}, SETTINGS, NUMERICS)


def judged(data):
    evidence = Evidence({"cycle_tube": data}, {}, {}, {}, {}, {})
    return {each["id"]: each["status"] for each in cycles.statements.records(evidence)}


def test_each_holds(solved):
    assert judged(solved) == {
        "beyond-cycle-left": "reproduced",
        "beyond-cycle-stroke": "reproduced",
        "beyond-cycle-root": "reproduced",
    }


def test_they_can_come_out_otherwise(solved):
    other = solved.copy(deep=True)
    other["net"][-1, -1] = 1e-2 * other.stroke[-1, -1]
    other["stroke_second"][0] *= 1.01
    other["stroke"][-1, 0] *= 1.2
    assert set(judged(other).values()) == {"deviates"}
    assert not list(cycles.statements.records(Evidence({}, {}, {}, {}, {}, {})))
