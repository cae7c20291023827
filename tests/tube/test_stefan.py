"""The similarity solution of a front that latent heat holds back, by surrounding."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_bvp
from scipy.special import erfcinv, i0e, i1e, jv

from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.stefan import Surrounding, bath_shift, front_constant, tolerated
from gelpump.tube.tubes import Tubes

ELL = 0.5
KINDS = ["pipe", "pipe", "pipe", "insulated", "bath"]
F_ST = np.array([0.0, 0.1, 1.0, 0.0, 2.0])  # of sections as wide as the tube
ST = F_ST / (1 - ELL**2)


def tubes(count):
    return Tubes(np.full(count, ELL))


def test_roots_of_the_similarity_solution():
    root = front_constant(tubes(len(KINDS)), ST, Surrounding(KINDS))
    assert root == pytest.approx([0.9539, 0.9189, 0.7226, 0.7271, 0.9539], abs=6e-5)


def test_similarity_profile_by_another_solver():
    """The two-sided boundary-value problem of a pipe, without erf: the fluxes differ by L."""
    y = float(front_constant(tubes(1), ST[2], Surrounding("pipe"))[0]) / 2

    def flux(start, end, at, where):
        x = np.linspace(start, end, 200)
        run = solve_bvp(
            lambda x, u: [u[1], -2 * x * u[1]],
            lambda a, b: [a[0] - at[0], b[0] - at[1]],
            x,
            np.zeros((2, x.size)),
            tol=1e-9,
        )
        return run.y[1, where]

    jump = flux(y, 7.0, (0, -1), 0) - flux(0.0, y, (1, 0), -1)
    assert jump == pytest.approx(2 * y * F_ST[2] * np.cbrt(2), rel=1e-6)


def test_tolerated_shift_is_that_of_the_root():
    for shift, known in ((0.01, 0.0328), (0.05, 0.1762)):
        limit = tolerated(shift)
        assert limit == pytest.approx(known, rel=2e-3)
        root = front_constant(tubes(1), limit / 0.75 / np.cbrt(2), Surrounding("pipe"))
        assert root[0] == pytest.approx((1 - shift) * FRONT_CONSTANT, rel=1e-10)


def test_bath_holds_a_thin_tube_back_in_proportion_and_a_fat_one_as_a_pipe():
    thin = bath_shift(Tubes(ELL, 0.1), 1.0)
    assert float(thin) == pytest.approx(-0.0207, abs=1e-4)
    assert bath_shift(Tubes(ELL, 0.1), 2.0, 2.0) == pytest.approx(float(thin), rel=0.02)
    small = 1e-6
    pipe = np.log(front_constant(tubes(1), small, Surrounding("pipe")) / FRONT_CONSTANT) / small
    fat = bath_shift(Tubes(ELL, 0.4), 1.0, 1e-3)  # heat stays within a tube that is a wide plate
    assert float(fat) == pytest.approx(pipe[0], rel=2e-3)


def test_heat_of_a_disc_that_stays_within_it():
    """The closed form of `bath_shift` against Hankel's transform of a disc that spreads."""
    for y in (0.05, 1.0, 20.0):
        stays, _ = quad(lambda k, y=y: 2 * jv(1, k) ** 2 / k * np.exp(-(k**2) / (2 * y)), 0, 200)
        assert 1 - i0e(y) - i1e(y) == pytest.approx(stays, rel=2e-3)


def test_shift_in_a_bath_by_summing_point_sinks():
    """What the sinks that the front has left behind do to theta at it, one by one in time."""
    eps, Le, tau = 0.1, 10.0, 0.11
    c = 2 * erfcinv(0.5)
    Z_C = c * np.sqrt(Le * tau)

    def felt(v):  # at the time tau (1 - v^2)
        s, then = tau * v**2, Z_C * np.sqrt(1 - v**2)
        y = eps**2 / (2 * Le * s)
        disc, _ = quad(lambda k: 2 * jv(1, k) ** 2 / k * np.exp(-(k**2) / (2 * y)), 0, 60)
        line = np.exp(-((Z_C - then) ** 2) / (4 * Le * s)) - np.exp(
            -((Z_C + then) ** 2) / (4 * Le * s)
        )
        advance = Z_C * v / np.sqrt(1 - v**2)
        return disc * line / np.sqrt(4 * np.pi * Le * s) * advance

    cooled, _ = quad(felt, 0, 1, epsrel=1e-4, limit=200)
    gradient = 2 / np.sqrt(np.pi) * np.exp(-(c**2) / 4) / np.sqrt(Le * tau)
    expected = -0.75 * np.cbrt(2) * cooled / (gradient * Z_C)
    assert float(bath_shift(Tubes(ELL, eps), 1.0, Z_C)) == pytest.approx(expected, rel=2e-3)
