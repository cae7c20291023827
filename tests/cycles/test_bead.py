"""Beads under programmes: a second solver, constant temperature, hysteresis."""

from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.integrate import solve_ivp

from gelpump.bead import nonlinear
from gelpump.cycles import bead
from gelpump.cycles.programme import Programme
from gelpump.materials import from_config
from gelpump.second_solvers.nonlinear_bead import Elements

BLOCKS = yaml.safe_load(
    (Path(__file__).parents[2] / "config/config.yaml").read_text(encoding="utf-8")
)["gels"]
HHT, ANB = (from_config(name, BLOCKS[name]) for name in ("HHT", "ANB"))


def test_a_jump_is_the_bead_at_constant_temperature():
    times = np.array([0.0, 0.01, 0.1, 1.0])
    jump = Programme(304.0, ((0.0, 304.0), (0.0, 307.0)))
    loop = bead.solve(HHT, jump, times, 80, tolerance=1e-7)
    phi = HHT.equilibrium_polymer_fraction(304.0)
    constant = nonlinear.solve(HHT, 307.0, phi, times, 160, tolerance=1e-7)
    np.testing.assert_allclose(loop.radius, constant.radius, rtol=2e-4)


def test_a_ramp_agrees_with_spectral_elements():
    times = np.linspace(0.0, 10.0, 11)
    programme = Programme.cycles(304.0, 307.5, 10.0, 1, ramp=5.0)
    errors = []
    system = Elements(HHT, 304.0, 12)
    r = system.dry[1:] * HHT.equilibrium_polymer_fraction(304.0) ** (-1 / 3)

    def rate(t, r):
        system.T = programme.at(t)
        return system.rate(t, r)

    found = [r[-1]]
    for span in (times[:6], times[5:]):
        part = solve_ivp(rate, (span[0], span[-1]), r, "Radau", t_eval=span[1:],
                         jac_sparsity=system.sparsity(), rtol=1e-7, atol=1e-9)  # fmt: skip
        r = part.y[:, -1]
        found += list(part.y[-1])
    for cells in (40, 80):
        loop = bead.solve(HHT, programme, times, cells, tolerance=1e-6)
        assert not loop.lost
        errors.append(np.abs(loop.radius - found).max())
    assert max(errors) < 1e-4


@pytest.mark.parametrize("model", ["nonlinear", "lens"])
def test_a_slow_loop_without_hysteresis_closes_on_the_equilibria(model):
    area = []
    for period in (10.0, 100.0):
        programme = Programme.cycles(304.0, 306.0, period, 1, ramp=period / 2)
        loop = bead.solve(
            HHT, programme, np.linspace(0, period, 41), 40, tolerance=1e-6, model=model
        )
        equilibria = np.array([HHT.equilibrium_polymer_fraction(T) for T in loop.T]) ** (-1 / 3)
        area.append(np.abs(loop.radius - equilibria).max())
    assert area[1] < 0.2 * area[0] < 0.05


def test_interfaces_carry_a_bead_through_both_folds_and_a_loop_remains():
    programme = Programme.cycles(303.0, 307.0, 80.0, 1, ramp=40.0)
    times = np.linspace(0.0, 80.0, 161)
    loop = bead.solve(ANB, programme, times, 200, tolerance=1e-6, width=0.1)
    assert not loop.lost
    up, down = ANB.folds().temperature
    dry = loop.radius < 1.4
    heating = times <= 40
    assert up - 0.05 < loop.T[heating & dry].min() < up + 0.3
    assert down - 0.3 < loop.T[~heating & dry].min() < down + 0.1
    assert abs(loop.radius[-1] - loop.radius[0]) < 0.01 * loop.radius[0]
    sharp = bead.solve(ANB, programme, times, 40, tolerance=1e-6)
    assert "T = 30" in sharp.lost
    assert "phi = " in sharp.lost
    assert loop.t[-1] > sharp.t[-1]


def test_what_is_no_bead_is_refused():
    folds = Programme.cycles(303.0, 307.0, 1.0, 1)
    with pytest.raises(ValueError, match="shells of 20 on the swollen side"):
        bead.solve(ANB, folds, [0, 1], 20, tolerance=1e-5, width=0.1)
    with pytest.raises(ValueError, match="must be one of"):
        bead.solve(
            HHT, Programme.cycles(304.0, 305.0, 1.0, 1), [0, 1], 20, tolerance=1e-5, model="x"
        )
    with pytest.raises(ValueError, match="must increase from 0"):
        bead.solve(HHT, Programme.cycles(304.0, 305.0, 1.0, 1), [0.5, 1], 20, tolerance=1e-5)
