"""Temperature programmes: what they say, and the heat that they send along a tube."""

from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.integrate import solve_ivp

from gelpump import config_physics
from gelpump.config import fill_defaults
from gelpump.cycles.programme import Programme
from gelpump.tube.heat import StepHeating


def test_cycles_jump_or_ramp_between_cold_and_hot():
    jumps = Programme.cycles(-1.0, 1.0, 2.0, 2, share=0.25)
    assert [jumps.at(t) for t in (0.0, 0.49, 0.51, 1.99, 2.0, 2.49, 2.51, 9.0)] == [
        1, 1, -1, -1, 1, 1, -1, -1,
    ]  # fmt: skip
    assert jumps.before(2.0) == -1
    np.testing.assert_allclose(jumps.breaks, [0.0, 0.5, 2.0, 2.5])
    ramps = Programme.cycles(300.0, 310.0, 10.0, 1, ramp=5.0)
    np.testing.assert_allclose(
        [ramps.at(t) for t in (0, 2.5, 5, 7.5, 10)], [300, 305, 310, 305, 300]
    )
    assert ramps.extremes == (300.0, 310.0)


def test_one_jump_is_the_papers_step_and_its_front():
    step = Programme(-1.0, ((0.0, -1.0), (0.0, 1.0)))
    heat = StepHeating(10.0)
    for tau in (1e-6, 1e-3, 0.1):
        np.testing.assert_allclose(step.fronts(0.0, tau, 10.0), [heat.front(tau)], rtol=1e-9)


def test_the_field_solves_the_heat_equation_by_finite_differences():
    programme = Programme(0.0, ((0.1, 0.0), (0.1, 1.0), (0.4, 2.5), (0.7, 2.5), (0.7, -1.0)))
    Z = np.linspace(0.0, 12.0, 1201)
    h = Z[1]

    def rate(t, T):
        full = np.concatenate([[programme.at(t)], T, [0.0]])
        return np.diff(full, 2) / h**2

    T, t = np.zeros(Z.size - 2), 0.0
    for end in (0.1, 0.4, 0.7, 1.2):
        T = solve_ivp(rate, (t, end - 1e-12), T, "LSODA", rtol=1e-8, atol=1e-9, lband=1, uband=1).y[
            :, -1
        ]
        np.testing.assert_allclose(T, programme.along(Z[1:-1], end - 1e-12, 1.0), atol=2e-4)
        t = end


@pytest.mark.parametrize(
    ("knots", "told"),
    [
        ((), "no steps"),
        (((1.0, 2.0), (0.5, 3.0)), "t = 0.5 follows t = 1"),
        (((1.0, 2.0), (1.0, 3.0), (1.0, 4.0)), "three knots at t = 1"),
        (((1.0, np.nan),), "must be finite"),
        (((-1.0, 2.0),), "must not be less"),
    ],
)
def test_what_is_no_programme_is_refused_in_words(knots, told):
    with pytest.raises(ValueError, match=told):
        Programme(1.0, knots)


@pytest.mark.parametrize("given", [(0.0, 2), (1.0, 0), (1.0, 1.5)])
def test_what_is_no_cycle_is_refused(given):
    with pytest.raises(ValueError, match="period"):
        Programme.cycles(0.0, 1.0, *given)
    with pytest.raises(ValueError, match="ramp"):
        Programme.cycles(0.0, 1.0, 1.0, 1, ramp=0.6)


@pytest.mark.parametrize(
    ("key", "value", "told"),
    [
        ("gel", "linear", "gel = 'linear': must be one of"),
        ("hot", 500.0, "hot = 500.0: must increase, within"),
        ("cold", 308.0, "cold = 308.0, hot = 307.5: must increase"),
        ("ramp", 9.0, "ramp = 9.0: must be within"),
    ],
)
def test_a_configured_loop_that_cannot_be_is_refused_by_its_key(key, value, told):
    project = Path(__file__).parents[2]
    config, schema = (
        yaml.safe_load((project / name).read_text(encoding="utf-8"))
        for name in ("config/config.yaml", "workflow/schemas/config.schema.yaml")
    )
    fill_defaults(config, schema)
    assert not list(config_physics.problems(config))
    config["cycles"]["beads"]["cases"]["HHT, period 10"][key] = value
    (problem,) = config_physics.problems(config)
    assert problem.startswith("cycles.beads.cases.HHT, period 10")
    assert told in problem
