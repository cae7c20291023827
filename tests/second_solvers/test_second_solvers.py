"""The second solvers by themselves, and the comparison's verdicts."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from gelpump.bead import lens, nonlinear
from gelpump.materials import PiecewiseLinearGel, from_config
from gelpump.second_solvers import course, cross_check, lens_bead, nonlinear_bead, tube

TIMES = np.array([0.0, 1e-3, 0.01, 0.1])


def test_bead_jacobian_is_that_of_the_rate(hht):
    shells = lens_bead.Shells(hht, 304.0, 0.6, 12)
    J = 1 / np.linspace(0.5, 0.1, 12)
    steps = 1e-6 * np.eye(12)
    differences = np.array([shells.rate(J + e) - shells.rate(J - e) for e in steps]).T / 2e-6
    np.testing.assert_allclose(shells.jacobian(J), differences, atol=1e-7 * abs(differences).max())


def test_bead_is_of_second_order_within_its_uncertainty(hht):
    phi = hht.equilibrium_polymer_fraction(308.0)
    radius = [lens_bead.solve(hht, 304.0, phi, TIMES, n).radius[1:] for n in (40, 80, 160)]
    steps = np.abs(np.diff(radius, axis=0))
    assert np.log2(steps[0] / steps[1]).min() > 1.7
    observed = course.observed(lens_bead.solve, hht, 304.0, phi, TIMES, 80, 1e-8)
    limit = lens_bead.solve(hht, 304.0, phi, TIMES, 320).radius
    assert (np.abs(observed.radius[0] - limit) <= observed.radius_uncertainty + 1e-12).all()


def test_bead_stops_where_phases_separate(hht):
    phi = hht.equilibrium_polymer_fraction(304.0)
    found = lens_bead.solve(hht, 308.0, phi, np.array([0.0, 0.1, 1.0]), 80)
    assert found.stop == pytest.approx(0.14525, abs=2e-5)
    assert found.t.tolist() == [0.0, 0.1]


def test_elements_differentiate_and_integrate_polynomials_exactly():
    x, weights, D = nonlinear_bead.lobatto(3)
    for degree in range(4):
        np.testing.assert_allclose(D @ x**degree, degree * x ** max(degree - 1, 0), atol=1e-13)
    for degree in range(6):
        exact = (1 - (-1) ** (degree + 1)) / (degree + 1)
        assert weights @ x**degree == pytest.approx(exact, abs=1e-14)


def test_the_elements_rest_in_equilibrium(hht):
    phi = hht.equilibrium_polymer_fraction(304.0)
    elements = nonlinear_bead.Elements(hht, 304.0, 12)
    assert np.abs(elements.rate(0.0, elements.dry[1:] * phi ** (-1 / 3))).max() < 1e-9


@pytest.mark.parametrize(
    ("before", "after", "times"),
    [(308.0, 304.0, [0, 1e-3, 0.01, 0.1, 1]), (304.0, 307.6, [0, 0.2, 1, 3, 5, 5.5, 8])],
    ids=["swelling", "drying"],
)
def test_the_nonlinear_bead_agrees_with_its_second_solver(hht, before, after, times):
    phi = hht.equilibrium_polymer_fraction(before)
    times = np.array(times, dtype=float)
    second = course.observed(nonlinear_bead.solve, hht, after, phi, times, 40, 1e-6)
    first = nonlinear.solve(hht, after, phi, times, 100, tolerance=1e-8)
    difference = np.abs(second.radius.values[0] - first.radius.values)
    assert difference.max() < 3e-5
    assert second.radius_uncertainty.max() < 3e-5
    assert np.abs(np.diff(second.radius, axis=0)).max() > 0  # two runs that could differ


@pytest.mark.parametrize(("T", "stop"), [(307.65, 1.87973), (307.75, 0.74189), (308.0, 0.0)])
def test_the_nonlinear_bead_stops_where_its_second_solver_does(hht, T, stop):
    phi = hht.equilibrium_polymer_fraction(304.0)
    found = nonlinear_bead.solve(hht, T, phi, np.array([0.0, 0.1, 8.0]), 60, rtol=1e-6)
    assert found.stop == pytest.approx(stop, rel=2e-4, abs=1e-6)
    assert found.t.size == found.radius.size == (1 if stop == 0 else 2)


@pytest.mark.parametrize(
    ("elasticity", "ions"), [("affine", {}), ("phantom", {"charges_per_chain": 0.5, "salt": 2.0})]
)
def test_both_beads_of_a_gel_of_the_literature_agree(elasticity, ions):
    """The library's formulae and those that are written again here, through two solvers."""
    network = {"elasticity": elasticity, "reference_polymer_fraction": 0.2, "chain_length": 80.0}
    chi = {"chi_1": {"A": -6.0, "Theta": 312.0}, "chi_2": 0.3, "chi_3": 0.1}
    block = {"model": "flory-rehner", "chi": chi, "network": network}
    gel = from_config(
        "mine", block | {"temperature_range": [280.0, 330.0]} | ({"ions": ions} if ions else {})
    )
    phi = gel.equilibrium_polymer_fraction(308.0)
    first = lens.solve(gel, 295.0, phi, TIMES, 160, tolerance=1e-6)
    second = lens_bead.solve(gel, 295.0, phi, TIMES, 160)
    np.testing.assert_allclose(first.radius.values[1:], second.radius[1:], rtol=5e-4)
    swollen = second.radius[-1] / second.radius[0]
    assert swollen > 1.02


def test_the_tube_satisfies_the_printed_integral_equation():
    """Put into eqn:tube_model with differences in Z and tau and a quadrature of the integral."""
    M, w, n, t = 1.0, 0.1 * 0.5 / 4, 200, 1e-2
    step = 1e-3 * t
    Z, Phi = tube.solve(np.array([t - step, t, t + step]), 0.5, nodes=n, rtol=1e-8)
    here = slice(2, n - 2)  # behind the front, in nodes of the middle time
    before, after = (CubicSpline(Z[i, : n + 1], Phi[i, : n + 1])(Z[1]) for i in (0, 2))
    Phi_tau = ((after - before) / (2 * step))[: n + 1]
    spline = CubicSpline(Z[1, : n + 1], Phi[1, : n + 1])
    Z, Phi = Z[1, : n + 1], Phi[1, : n + 1]
    D = Phi / 2 + 4 * M / 3 * np.cbrt(Phi)
    slope = spline(Z, 1)
    G = CubicSpline(Z, Phi ** (-2 / 3) * Phi_tau).antiderivative()(Z)
    F = Phi ** (2 / 3) * D * (2 - Phi) / w**2
    left = Phi_tau + D / Phi * slope**2 - np.cbrt(Phi) ** -1 / 3 * slope * G
    right = F + CubicSpline(Z, D * slope)(Z, 1)
    assert np.abs(left - right)[here].max() < 0.03 * np.abs(slope * G / np.cbrt(Phi) / 3).max()


def test_tube_uncertainty_covers_its_error():
    gel = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=1.0, M=1.0)
    tau = np.array([1e-3, 1e-2])
    observed = tube.observed(gel, {"eps": 0.1, "Le": 10.0}, [0.5], tau, 100, 1e-6)
    limit = tube.solve(tau, 0.5, nodes=400, rtol=1e-8)[1][:, 400]
    assert (np.abs(observed.Phi1_front[0] - limit) <= observed.Phi1_front_uncertainty[0]).all()
    with pytest.raises(ValueError, match="nodes = 33: must be even"):
        tube.observed(gel, {"eps": 0.1, "Le": 10.0}, [0.5], tau, 33, 1e-6)


@pytest.mark.parametrize(
    ("difference", "first", "second", "agrees"),
    [
        (3e-4, 2e-4, 2e-4, True),
        (5e-4, 2e-4, 2e-4, False),  # more than both claim
        (2e-3, 5e-3, 0.0, False),  # within what is claimed, but beyond the bound
        (np.nan, 1.0, 1.0, False),
    ],
)
def test_verdict(difference, first, second, agrees):
    row = cross_check.row("radius", difference, first, second, bound=1e-3)
    assert row["agrees"] is agrees
    if agrees:
        cross_check.require_agreement([row])
    else:
        with pytest.raises(cross_check.Disagreement, match="radius by"):
            cross_check.require_agreement([row])
