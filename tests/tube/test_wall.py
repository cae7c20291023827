"""Walls resolved in r: eigenvalues, thin walls, relaxation, and the slender closures' times."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_bvp

from gelpump.tube import wall
from gelpump.tube.deswelling import deswelling_time
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import mean_source_coefficient, source_coefficient

THIN = Tubes(0.99, 0.1, [0.1, 1.0, 10.0])


@pytest.mark.parametrize(
    ("ell", "coefficient", "eigenvalue"),
    [(0.1, 7.356, 8.896), (0.25, 7.718, 9.445), (0.5, 7.923, 9.753), (0.9, 7.998, 9.867)],
)
def test_coefficients_and_eigenvalues(ell, coefficient, eigenvalue):
    """To the digits of a hand's work; then each by another way, to its own digits."""
    assert source_coefficient(ell) == pytest.approx(coefficient, abs=1e-3)
    assert wall.first_eigenvalue(ell) == pytest.approx(eigenvalue, abs=1e-3)
    m = (1 + ell) / 2
    conditions = [[x**2, np.log(x), 1.0] for x in (ell, 1.0, m)]
    alpha = np.linalg.solve(conditions, [1.0, 1.0, 0.0])[0]
    assert source_coefficient(ell) == pytest.approx(4 * (1 - ell) ** 2 * alpha, rel=1e-9)
    gain = 4 * (1 - ell) ** 2 / mean_source_coefficient(ell)
    alpha, gamma = 1 / gain, -(1 - ell**2) / gain / np.log(1 / ell)
    mean = quad(lambda s: (alpha * (s**2 - 1) + gamma * np.log(s) + 1) * s, ell, 1)[0]
    assert abs(mean) < 1e-9
    nodes, x = cheb(40)
    s = (1 + ell + (1 - ell) * x) / 2
    D = 2 / (1 - ell) * nodes
    operator = (D @ D + np.diag(1 / s) @ D)[1:-1, 1:-1]
    slowest = np.min(np.abs(np.linalg.eigvals(operator)))
    assert wall.first_eigenvalue(ell) == pytest.approx(slowest * (1 - ell) ** 2, rel=1e-10)


def cheb(n):
    """Chebyshev's differentiation matrix and its points."""
    x = np.cos(np.pi * np.arange(n + 1) / n)
    c = np.r_[2, np.ones(n - 1), 2] * (-1) ** np.arange(n + 1)
    gaps = x[:, None] - x[None, :]
    D = np.outer(c, 1 / c) / (gaps + np.eye(n + 1))
    return D - np.diag(D.sum(axis=1)), x


def test_thin_walls_take_as_long_as_worked_out_by_hand():
    times, error = wall.deswelling_times(THIN)
    h_squared = (THIN.eps * (1 - THIN.ell)) ** 2
    hand = {"conservative": [0.3222, 0.1369, 0.0203], "balanced": [0.3691, 0.3353, 0.3142]}
    for surface, found, doubt in zip(wall.SURFACES, times, error, strict=True):
        np.testing.assert_allclose(found[0] / h_squared, hand[surface], rtol=0.01)
        assert (doubt / found).max() < 6e-3
    np.testing.assert_allclose(
        deswelling_time(THIN) / h_squared, [0.1956, 0.0806, 0.0118], rtol=3e-3
    )


def test_order_in_space():
    """And what is told of walls, extrapolated, is right within its uncertainty."""
    tubes = Tubes([0.1, 0.5])
    runs = [wall.relax(tubes, "balanced", n, 4e-6 * (40 / n) ** 3) for n in (10, 20, 40)]
    orders = np.log2((runs[0] - runs[1]) / (runs[1] - runs[2]))
    assert orders.min() > 1.8
    assert orders.max() < 2.3
    times, error = wall.deswelling_times(tubes)
    limit = runs[2] + (runs[2] - runs[1]) / 3
    assert (np.abs(times[1] - limit) < error[1]).all()
    assert (error / times).max() < 5e-3


@pytest.mark.parametrize("surface", wall.SURFACES)
def test_small_changes_decay_with_the_slowest_mode(surface):
    """Phi_inf near one: the time from 90 to 99 per cent is ln(10) over the mode's rate."""
    tubes = Tubes(0.98, 0.1, M=2.0, Phi_inf=1.0001)
    walls = wall.Walls(tubes, surface, 48, 1e-9)
    from gelpump.bdf import integrate

    left = {}
    for step in integrate(
        walls.advance, np.ones(48), 1.0, order=3, tolerance=1e-9, first_step=1e-4,
        error_norm=walls.error_norm,
    ):  # fmt: skip
        left[step.time**2] = 1 - (walls.observed(step.solution)[1, 0] - 1) / 1e-4
    t, share = np.array(list(left)), np.array(list(left.values()))
    late = share < 0.2
    rate = -np.polyfit(t[late], np.log(share[late]), 1)[0] / walls.unit.item()
    k = wall.thin_wall_eigenvalue(2.0, 1.0, 1.0) if surface == "balanced" else np.pi
    expected = k**2 * (1 + 8 / 3) / (1 - 0.98) ** 2
    assert rate == pytest.approx(expected, rel=5e-3)


def test_thin_wall_eigenvalue_is_that_of_the_mode():
    """cos(k y) with its surface a share r of its mean, by a boundary-value solver."""
    k = wall.thin_wall_eigenvalue(1.0, 0.5, 2.0)
    r = (4 / 3) * np.cbrt(2) / (1 + 4 / 3 * np.cbrt(2))

    def equation(x, y, p):
        return np.array([y[1], -(p[0] ** 2) * y[0], y[0]])

    def ends(a, b, p):
        return np.array([a[0] - 1, a[1], a[2], b[0] - r * b[2] * 2])

    x = np.linspace(0, 0.5, 21)
    guess = np.array([np.cos(2 * x), -2 * np.sin(2 * x), x])
    found = solve_bvp(equation, ends, x, guess, p=[2.0], tol=1e-8)
    assert k == pytest.approx(found.p[0], rel=1e-6)
    assert k**2 == pytest.approx(4.158, abs=1e-3)


def test_closures_times_are_quadratures():
    tubes = Tubes([0.1, 0.5], 0.1, [1.0, 0.1], [1.0, 2.0], [2.0, 4.0])
    np.testing.assert_allclose(
        wall.closure_time(tubes, "printed"), deswelling_time(tubes), rtol=1e-13
    )
    ratio = wall.closure_time(tubes, "conservative") / deswelling_time(tubes)
    np.testing.assert_allclose(ratio, 16 / source_coefficient(tubes.ell), rtol=1e-12)
