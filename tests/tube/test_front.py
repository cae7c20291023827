"""The tanh fit and the power law recover what they are given."""

import numpy as np
import pytest
import xarray as xr

from gelpump.tube import front
from gelpump.tube.front_fit import consistent_sharpness
from gelpump.tube.heat import StepHeating
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes

ELL, TAU = np.array([0.2, 0.8]), np.array([0.01, 0.1])
SHARP = np.array([[40.0, 41.0], [150.0, 165.0]])


def tubes_of(form, Phi_inf=2.0, faces=801, grading=3.0):
    """Tubes whose Phi_1 is form(A (Z - Z_C)) on cells graded to the front."""
    Z_C = StepHeating().front(TAU)
    w = 0.1 * (1 - ELL) / 4
    s = np.linspace(-1, 1, faces)
    steps = 12 * np.sinh(grading * s) / np.sinh(grading)
    Z_face = Z_C[:, np.newaxis] + w[:, np.newaxis, np.newaxis] * steps
    Z = (Z_face[..., 1:] + Z_face[..., :-1]) / 2
    x = SHARP[..., np.newaxis] * (Z - Z_C[:, np.newaxis])
    return xr.Dataset(
        {
            "Phi1": (("ell", "tau", "cell"), form(x)),
            "Z": (("ell", "tau", "cell"), Z),
            "Z_face": (("ell", "tau", "face"), Z_face),
            "Phi1_front": (("ell", "tau"), np.full((2, 2), float(form(0.0)))),
            "Z_C": ("tau", Z_C),
            "hot": ("cell", s[1:] < 1e-9),
            "eps": ("ell", [0.1, 0.1]),
            "Phi_inf": ("ell", [Phi_inf] * 2),
        },
        coords={"ell": ELL, "tau": TAU},
    )


@pytest.mark.parametrize("Phi_inf", [1.2, 2.0, 9.0])
@pytest.mark.parametrize(("window", "own"), [(8.0, False), (0.5, False), (2.0, True)])
def test_a_tanh_is_recovered(Phi_inf, window, own):
    A, rms = front.sharpness(
        tubes_of(lambda x: front.tanh_profile(x, Phi_inf), Phi_inf), window, own
    )
    np.testing.assert_allclose(A, SHARP, rtol=1e-10)
    assert rms.max() < 1e-10


def test_misfit_of_an_offset_is_the_offset():
    """An even disturbance leaves A, whose sensitivity is odd, where it is."""
    A, rms = front.sharpness(tubes_of(lambda x: front.tanh_profile(x, 2.0) + 0.01))
    np.testing.assert_allclose(A, SHARP, rtol=1e-10)
    np.testing.assert_allclose(rms, 0.01, rtol=1e-10)


def test_the_fit_does_not_depend_on_where_the_cells_are():
    def steeper_ahead(x):
        return 2 - (1 + np.tanh(np.where(x > 0, 1.3 * x, x))) / 2

    (coarse, _), (fine, _), (clustered, _) = (
        front.sharpness(tubes_of(steeper_ahead, faces=n, grading=grading))
        for n, grading in ((401, 3.0), (1601, 3.0), (1601, 5.0))
    )
    np.testing.assert_allclose(coarse, fine, rtol=1e-4)
    np.testing.assert_allclose(clustered, fine, rtol=1e-4)
    assert (fine > SHARP).all()
    assert (fine < 1.3 * SHARP).all()


def test_power_law_is_recovered():
    ell = 1 - np.geomspace(0.05, 0.95, 24)
    A = 32.0 * (1 - ell) ** -1.1
    law = front.power_law(ell, A, 0 * A)
    assert np.isclose(law.exponent, 1.1)
    assert np.isclose(law.prefactor, 32.0)
    assert law.exponent_uncertainty < 1e-12
    np.testing.assert_allclose(law.one_minus_ell(law.sharpness(ell)), 1 - ell)
    np.testing.assert_allclose(front.local_exponent(ell, A), 1.1)


def test_power_law_uncertainty_holds_the_worst_error():
    ell = 1 - np.geomspace(0.05, 0.95, 24)
    error = 0.003 * np.sign(np.log(1 - ell) - np.log(1 - ell).mean())  # tilts the line most
    law = front.power_law(ell, 32.0 / (1 - ell), 32.0 / (1 - ell) * 0.003)
    tilted = front.power_law(ell, 32.0 / (1 - ell) * np.exp(error), 0 * ell)
    assert np.isclose(abs(tilted.exponent - 1), law.exponent_uncertainty, rtol=1e-6)


def test_difference_of_profiles():
    one = tubes_of(lambda x: front.tanh_profile(x, 2.0))
    other = tubes_of(lambda x: front.tanh_profile(x, 2.0) + 0.02 / np.cosh(x), faces=601)
    np.testing.assert_allclose(front.largest_difference(one, other), 0.02, rtol=2e-3)
    assert front.largest_difference(one, one).max() < 1e-14


def test_consistent_source_needs_no_other_solution():
    """A tube with kappa for 16 is one whose eps is larger by sqrt(16/kappa)."""
    from gelpump.tube.wall_flow import source_coefficient

    tau = np.geomspace(1e-3, 4e-3, 6)
    eps = 0.1 * np.sqrt(16 / source_coefficient(0.5))
    tubes = solve(Tubes(0.5, [0.1, eps]), StepHeating(), tau, cells=(48, 30), tolerance=1e-4)
    A, _ = front.sharpness(tubes)
    found = consistent_sharpness(np.array([0.5]), tau, A[:1], tau[-1])
    np.testing.assert_allclose(found, A[1, -1], rtol=1e-3)


@pytest.mark.parametrize("own", [False, True])
def test_the_window_is_what_it_says(own):
    """An offset beyond half of the window leaves A, and makes half of the squared misfit."""
    tubes = tubes_of(lambda x: front.tanh_profile(x, 2.0), faces=4001)
    distance = np.abs((tubes.Z - tubes.Z_C).values)
    length = 1 / SHARP if own else 0.1 * (1 - ELL[:, np.newaxis]) / 4 * np.ones((1, 2))
    window = 2.0 if own else 8.0
    tubes["Phi1"] = tubes.Phi1 + 0.01 * (distance > window / 2 * length[..., np.newaxis])
    A, rms = front.sharpness(tubes, window, True) if own else front.sharpness(tubes)
    np.testing.assert_allclose(A, SHARP, rtol=1e-10)
    np.testing.assert_allclose(rms, 0.01 * np.sqrt(0.5), rtol=2e-3)
