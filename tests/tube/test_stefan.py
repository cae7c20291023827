"""The similarity solution of a front that latent heat holds back, by surrounding."""

import numpy as np
import pytest
from scipy.integrate import solve_bvp

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
