"""Any gel, temperature and geometry: finite, conserving, monotone in time, or an error in words.

Solves end: their steps are limited, far above what the paper needs.
"""

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

from gelpump import bdf
from gelpump.bead import lens, nonlinear
from gelpump.materials import EnergyBasedGel, PiecewiseLinearGel
from gelpump.tube.deswelling import deswelling_curve, deswelling_time
from gelpump.tube.heat import StepHeating
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes

SOLVER_REFUSALS = (ValueError, RuntimeError), "phi_initial", "step", "CVODE", "shells"
TIMES = np.array([0.0, 1e-3, 0.1, 1.0])
SHARE = st.floats(1e-3, 0.999)
TIMES_OF_ONE = st.floats(-3.0, 3.0).map(lambda exponent: 10.0**exponent)


def energy_based(draw):
    """Table 2's HHT with all its parameters shifted a little, the temperature a lot."""
    near = st.floats(0.97, 1.03)
    return EnergyBasedGel(
        "gel",
        -62.22 * draw(near),
        -58.28 * draw(near),
        0.2047 * draw(near),
        0.19044 * draw(near),
        draw(st.floats(10.0, 3000.0)),
        (250.0, 350.0),
    )


def check_bead(bead, low, high):
    phi = bead.polymer_fraction.values
    assert np.all((phi > low) & (phi < high))
    assert np.all((bead.surface_polymer_fraction > low) & (bead.surface_polymer_fraction < high))
    for name in bead.variables:
        if bead[name].dtype.kind == "f":
            assert np.isfinite(bead[name].values).all(), name
    assert np.all(np.diff(bead.t) > 0)
    assert np.all(np.diff(bead.r_face, axis=1) > 0)
    assert np.abs(bead.polymer_volume_error).max() < 1e-10
    assert bead.attrs["stopped"] or bead.t[-1] == TIMES[-1]


@pytest.mark.parametrize(("model", "tolerance"), [(lens, 1e-2), (nonlinear, 1e-4)])
@given(data=st.data())
@settings(max_examples=8)
def test_a_bead_of_any_energy_based_gel(model, tolerance, data):
    gel = energy_based(data.draw)
    phi, T = data.draw(SHARE), data.draw(st.floats(250.0, 350.0))
    with refused(*SOLVER_REFUSALS):
        check_bead(model.solve(gel, T, phi, TIMES, 16, tolerance=tolerance), 0.0, 1.0)


@pytest.mark.parametrize(("model", "tolerance"), [(lens, 1e-2), (nonlinear, 1e-4)])
@given(
    contrast=st.floats(0.1, 10.0),
    Pi_ratio=st.floats(0.01, 100.0),
    M=st.floats(0.01, 100.0),
    Phi=st.floats(0.2, 5.0),
    theta=st.sampled_from([-1.0, 1.0]),
)
@settings(max_examples=5)
def test_a_bead_of_any_piecewise_linear_gel(model, tolerance, contrast, Pi_ratio, M, Phi, theta):
    gel = PiecewiseLinearGel(contrast, Pi_ratio, M)
    with refused(*SOLVER_REFUSALS):
        check_bead(model.solve(gel, theta, Phi, TIMES, 16, tolerance=tolerance), 0.0, np.inf)


@given(
    ell=st.floats(),
    eps=st.floats(),
    M=st.floats(),
    Pi_ratio=st.floats(),
    Phi_inf=st.floats(),
)
@settings(max_examples=200)
def test_any_tube_is_taken_or_refused_by_name(ell, eps, M, Pi_ratio, Phi_inf):
    given_values = {"ell": ell, "eps": eps, "M": M, "Pi_ratio": Pi_ratio, "Phi_inf": Phi_inf}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        with refused(ValueError, *(f"{key} = " for key in given_values)):
            assert np.isfinite(Tubes(**given_values).wall_length)


@given(
    ell=SHARE,
    eps=st.floats(1e-3, 0.4),
    M=st.one_of(st.just(0.0), TIMES_OF_ONE),
    Pi_ratio=TIMES_OF_ONE,
    Phi_inf=st.floats(1.001, 50.0),
    reswelling=st.booleans(),
)
@settings(max_examples=100)
def test_uniform_deswelling_is_monotone(ell, eps, M, Pi_ratio, Phi_inf, reswelling):
    tube = Tubes(ell, eps, M, Pi_ratio, Phi_inf)
    end = float(deswelling_time(tube, reswelling=reswelling))
    assert np.isfinite(end)
    assert end > 0
    Phi = deswelling_curve(np.linspace(0.0, end, 9), tube, reswelling)
    assert np.all(np.diff(Phi) < 0) if reswelling else np.all(np.diff(Phi) > 0)
    assert 1 - 1e-12 <= Phi.min() <= Phi.max() <= Phi_inf * (1 + 1e-12)


@given(
    ell=st.floats(0.05, 0.95),
    M=st.floats(0.1, 10.0),
    Pi_ratio=st.floats(0.1, 10.0),
    Phi_inf=st.floats(1.05, 6.0),
    Le=st.floats(0.1, 100.0),
)
@settings(max_examples=6)
def test_a_pulse_in_any_tube(ell, M, Pi_ratio, Phi_inf, Le):
    tube = Tubes(ell, 0.1, M, Pi_ratio, Phi_inf)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # that the cells are too coarse
        with refused(RuntimeError, "step") as refusal:
            pulse = solve(tube, StepHeating(Le), [1e-3, 1e-2], cells=(16, 12), tolerance=3e-3)
    if refusal.happened:
        return
    for name in pulse.variables:
        if pulse[name].dtype.kind == "f":
            assert np.isfinite(pulse[name].values).all(), name
    assert pulse.Phi1.min() > 1 - 0.1
    assert pulse.Phi1.max() < Phi_inf + 0.1 * (Phi_inf - 1)
    assert np.all(np.diff(pulse.Z_face.values, axis=-1) > 0)


def explosive(t, guess, alpha, history):
    """A step of dy/dt = f that resolves nothing: every one is refused for its error."""
    return guess + 1.0


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_an_error_that_is_not_finite_is_never_accepted(wrong):
    with pytest.raises(RuntimeError, match="time step fell"):
        list(
            bdf.integrate(
                explosive,
                np.ones(1),
                1.0,
                order=2,
                tolerance=1e-5,
                first_step=1e-4,
                error_norm=lambda y, dy: wrong,
            )
        )


def test_steps_are_limited(monkeypatch):
    with pytest.raises(RuntimeError, match=r"50 steps ended at t = .* before t = 1000"):
        list(
            bdf.integrate(
                lambda t, guess, alpha, history: -history / (alpha + 1.0),
                np.ones(1),
                1000.0,
                order=2,
                tolerance=1e-12,
                first_step=1e-6,
                error_norm=lambda y, dy: float(np.abs(dy).max()),
                trials=50,
            )
        )
    monkeypatch.setattr(nonlinear, "MAX_EVALUATIONS", 10)
    gel = EnergyBasedGel("HHT", -62.22, -58.28, 0.20470, 0.19044, 720.0, (290.0, 320.0))
    with pytest.raises(RuntimeError, match="evaluations of the rate"):
        nonlinear.solve(gel, 304.0, 0.6, TIMES, 16, tolerance=1e-4)
