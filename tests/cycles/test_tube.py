"""Tubes under programmes: against the moving mesh, a second solver, geometry and water."""

from pathlib import Path

import numpy as np
import pytest
import yaml

from gelpump.cycles import production, tube
from gelpump.cycles.programme import Programme
from gelpump.design.material import from_energy
from gelpump.materials import from_config
from gelpump.second_solvers import tube_cycles
from gelpump.tube import pump, slender
from gelpump.tube.heat import StepHeating
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import lumen_share

ONE = Tubes(0.5, 0.1, 1.0, 1.0, 2.0)
STEP = Programme(-1.0, ((0.0, -1.0), (0.0, 1.0)))
BLOCKS = yaml.safe_load(
    (Path(__file__).parents[2] / "config/config.yaml").read_text(encoding="utf-8")
)["gels"]


@pytest.fixture(scope="module")
def HHT():
    return from_config("HHT", BLOCKS["HHT"])


@pytest.mark.parametrize("closure", ["conservative", "balanced"])
def test_a_single_heating_is_that_of_the_mesh_that_follows_the_front(closure):
    tau = np.array([1e-3, 1e-2])
    moving = slender.solve(ONE, StepHeating(10.0), tau, closure=closure)
    expected = pump.volumes(moving)["pumped_station"][0] / np.pi
    fixed = tube.solve(ONE, STEP, 10.0, tau, closure=closure)
    np.testing.assert_allclose(fixed.station[1:], expected, rtol=5e-4)


def test_fronts_that_turn_back_and_meet_agree_with_the_second_solver():
    period, outputs = 0.005, 20
    programme = Programme.cycles(-1.0, 1.0, period, 2)
    tau = np.linspace(0.0, 2 * period, 2 * outputs + 1)
    counts = [programme.fronts(0.0, t, 10.0).size for t in tau]
    assert {0, 1, 2} <= set(counts)  # they meet, and are two before
    runs = [tube.solve(ONE, programme, 10.0, tau, cell=c, tolerance=t)
            for c, t in ((1.0, 4e-2), (0.5, 1e-2), (0.25, 2.5e-3))]  # fmt: skip
    pumped, Z, Phi = tube_cycles.solve(tau, programme.breaks, 0.5, node=0.25, rtol=1e-5)
    stroke = runs[-1].station.max()
    errors = [np.abs(run.station - pumped).max() / stroke for run in runs]
    assert errors[0] > errors[1]
    assert errors[2] < 1.5e-3
    fine = runs[-1]
    middle = fine.Z[10] - 0.5 * np.diff(fine.Z[10], prepend=0.0)
    assert np.abs(np.interp(Z, middle, fine.Phi1[10]) - Phi[10])[1:].max() < 5e-3


def test_ten_heatings_keep_their_water_and_leave_none_past_the_station():
    period, cycles = 0.002, 10
    programme = Programme.cycles(-1.0, 1.0, period, cycles)
    tau = np.linspace(0.0, cycles * period, 16 * cycles + 1)
    run, coarse = (
        tube.solve(ONE, programme, 10.0, tau, cell=c, tolerance=t)
        for c, t in ((0.5, 1e-2), (1.0, 4e-2))
    )
    assert run.imbalance < 1e-10
    per, other = (production.per_cycle(each, period, cycles) for each in (run, coarse))
    error = np.abs(per["stroke"] - other["stroke"]) / 3
    assert (error < 1e-3 * per["stroke"]).all()
    # the wall is swollen again, but for what a period leaves of its relaxation
    assert np.abs(per["net"][-1]) < 1e-3 * per["stroke"][-1]
    assert per["net_within"][-1] > 0.05 * per["stroke"][-1]
    assert (np.diff(per["stroke"]) > 0).all()  # the tube is warmed further by each


def test_what_a_closed_cycle_leaves_past_a_section_is_drawn_through_the_wall():
    period = 0.01
    programme = Programme.cycles(-1.0, 1.0, period, 1)
    run = tube.solve(ONE, programme, 10.0, np.linspace(0, period, 21))
    back = np.abs(run.Phi1[-1] - 1).max()
    assert back < 1e-3
    sigma = lumen_share(0.5)
    np.testing.assert_allclose(
        run.passed[-1], sigma * run.axial[-1], atol=2 * back * run.station.max()
    )


def test_a_real_gel_converges_and_its_linear_picture_errs(HHT):
    material = from_energy(HHT, 304.0, 307.5, 3e-29)
    shape = Tubes(0.6, 1 / 12, **material.numbers)
    heat = Programme(304.0, ((0.0, 304.0), (0.0, 307.5)))
    tau = [1 / (0.9539**2 * 200.0)]
    runs = [tube.solve(shape, heat, 200.0, tau, gel=HHT, cell=c, tolerance=t).station[-1]
            for c, t in ((0.5, 1e-2), (0.25, 2.5e-3), (0.125, 6e-4))]  # fmt: skip
    assert abs(runs[1] - runs[2]) < abs(runs[0] - runs[1]) < 1e-3 * runs[2]
    linear = tube.solve(shape, STEP, 200.0, tau).station[-1]
    assert 0.2 < linear / runs[2] - 1 < 0.5


def test_a_gel_that_is_nearly_linear_is_the_piecewise_linear_one():
    """Uniform small heating: D and Phi_0 hardly change, so both pictures meet."""
    gel = from_config("HHT", BLOCKS["HHT"])
    changes = []
    for step in (0.2, 0.05):
        material = from_energy(gel, 303.0, 303.0 + step, 3e-29)
        shape = Tubes(0.5, 0.1, **material.numbers)
        # heat at once: T is uniform, and so is the tube
        heat = Programme(303.0, ((0.0, 303.0), (0.0, 303.0 + step)))
        tau = np.array([2e-4])
        real = tube.solve(shape, heat, 1e9, tau, gel=gel).Phi1[-1, 0]
        linear = tube.solve(shape, STEP, 1e7, tau).Phi1[-1, 0]
        changes.append(abs(real - linear) / (material.Phi_inf - 1))
    assert changes[1] < 0.4 * changes[0]
    assert changes[0] < 0.05


def test_a_path_through_D_below_zero_stops_with_place_and_time(HHT):
    shape = Tubes(0.5, 0.1)
    run = tube.solve(shape, Programme(304.0, ((0.0, 304.0), (0.0, 308.0))), 10.0, [0.01], gel=HHT)
    when, where, state = run.lost
    assert 0 < when < 0.01
    assert 0 <= where < 0.1
    assert HHT.diffusivity(state.polymer_fraction, state.temperature) <= 0
    assert run.tau[-1] < 0.01


def test_what_cannot_be_solved_is_refused_in_words():
    with pytest.raises(ValueError, match="conserve water"):
        tube.solve(ONE, STEP, 10.0, [1e-3], closure="printed")
    with pytest.raises(ValueError, match="from 0 on"):
        tube.solve(ONE, STEP, 10.0, [-1e-3])
    with pytest.raises(ValueError, match="must be one"):
        tube.solve(Tubes([0.5, 0.6]), STEP, 10.0, [1e-3])


def test_between_its_folds_a_gel_stays_on_its_branch(HHT):
    """Heated to 307.587 K from below it stays swollen; past the fold and back, it stays dry."""
    shape, between = Tubes(0.5, 0.1), 307.587
    swollen, dry = (HHT.equilibrium_polymer_fraction(between, name) for name in ("swollen", "dry"))
    start = HHT.equilibrium_polymer_fraction(304.0)
    for highest, low, high in ((between, start, swollen), (307.61, swollen, dry)):
        # Le so large that the tube is as hot throughout as its end
        heat = Programme(304.0, ((0.0, 304.0), (0.0, highest), (0.1, highest), (0.1, between)))
        run = tube.solve(shape, heat, 1e8, [0.2], gel=HHT, cell=1.0, tolerance=4e-2)
        phi = run.Phi1[-1, 0] * start
        assert not run.lost
        assert low < phi < 1.01 * high
        assert phi == pytest.approx(high, rel=0.05)
