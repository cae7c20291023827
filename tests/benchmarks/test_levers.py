"""What is left out to see its worth is left out only there, and the answers stay the same."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from benchmarks import cost, levers, page, tools
from benchmarks.problems import Bead, Tubes
from benchmarks.settings import paper
from gelpump import bdf, finite_volume
from gelpump.tube import slender


@pytest.fixture(scope="module")
def drying():
    return cost.with_bead_reference(Bead.of(paper(), "drying"), tools.second_bead, 60, 1e-7)


def test_a_bead_dries_the_same_by_public_terms(drying):
    before = finite_volume.trusted
    radius = levers.without(tools.our_bead, (finite_volume, "trusted", levers.public_terms))(
        drying, 24, 1e-4
    )
    assert drying.error(radius) < 1.5e-3
    assert finite_volume.trusted is before


def test_public_terms_give_the_same_to_rounding(drying):
    patched = levers.without(tools.our_bead, (finite_volume, "trusted", levers.public_terms))
    radius, same = (run(drying, 16, 1e-3) for run in (patched, tools.our_bead))
    assert np.allclose(radius, same, rtol=1e-9)


def test_orders_of_the_time_steps(drying):
    errors = [drying.error(levers.bead_of_order(order)(drying, 32, 1e-4)) for order in (1, 2, 3)]
    assert errors[0] > errors[1] > errors[2]


def test_even_steps_are_backward_euler():
    """y' = -y: the error is of first order, and the steps are even in sqrt(t)."""

    def advance(t, guess, alpha, history):
        return -history / (1 + alpha)

    errors = []
    for n in (50, 100):
        steps = list(
            levers.even_steps(n)(
                advance, [1.0], 1.0, order=1, tolerance=0, first_step=0, error_norm=None
            )
        )
        assert np.allclose([s.time for s in steps], np.linspace(0, 1, n + 1)[1:] ** 2)
        errors.append(abs(steps[-1].solution[0] - np.exp(-1)))
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.05)
    assert levers.lens.bdf.integrate is bdf.integrate


def test_even_cells_of_tubes_are_production_s_domain():
    tube = Tubes.of(paper(), "tube", [0.25], [1e-3])
    tube = cost.with_tube_reference(tube, 100, 1e-6)
    even = levers.without(tools.our_tubes, (slender, "Family", levers.EvenTubes))
    graded = tube.error(tools.our_tubes(tube, 32, 20, 1e-3))
    errors = [tube.error(even(tube, *cells, 1e-3)) for cells in ((64, 40), (256, 160))]
    assert errors[1] < min(errors[0] / 4, 1e-3)
    assert graded < errors[0]


def test_the_table_says_what_each_is_worth():
    rows = [
        {"lever": "a", "instead": "b", "where": "c", "with": 0.5, "without": 2.0},
        {"lever": "d", "instead": "e", "where": "f", "with": 0.5, "without": None},
    ]
    shown = page.levers_table(rows)
    assert "| a | b | c | 0.5 | 2 | 4.0 |" in shown
    assert "| d | e | f | 0.5 | error above 1 % | – |" in shown
