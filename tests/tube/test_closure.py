"""The closures of the slender tube: water, surfaces, and a second solver of each."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from gelpump.known_solutions import manufactured
from gelpump.known_solutions import tube as known
from gelpump.known_solutions.study import require_all
from gelpump.second_solvers import tube as second
from gelpump.tube import slender
from gelpump.tube.budget import water_budget
from gelpump.tube.closure import named
from gelpump.tube.heat import StepHeating
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import lumen_share

HEAT = StepHeating(Le=10.0)
TAU = np.array([1e-4, 1e-3, 1e-2, 0.1])
FAMILY = Tubes(
    ell=[0.1, 0.5, 0.9, 0.3],
    eps=[0.1, 0.1, 0.1, 0.2],
    M=[1, 1, 1, 0.3],
    Pi_ratio=[1, 1, 1, 3],
    Phi_inf=[2, 2, 2, 4],
)
CONSERVING = ("conservative", "balanced")


@pytest.fixture(scope="module", params=CONSERVING)
def pulse(request):
    return solve(FAMILY, HEAT, TAU, closure=request.param)


def unaccounted(pulse):
    """Loss less source, axial flow and what the front swept, on either side, over Z_C."""
    across = (pulse.axial - pulse.swept).values
    left = [
        (pulse.loss - pulse.source).isel(side=side).values + sign * across
        for side, sign in ((0, 1), (1, -1))
    ]
    return np.abs(left).max() / pulse.Z_C.values.min()


def test_water_is_conserved_over_the_device_and_in_each_step(pulse):
    assert pulse.water_balance_error.max() < 1e-10
    assert pulse.attrs["water_balance_step"] < 1e-10
    assert unaccounted(pulse) < 1e-10
    dry = np.diff(pulse.Z_face) / pulse.Phi1 ** (-1 / 3)  # dX of the cells
    loss = ((1 - 1 / pulse.Phi1) * dry).sum("cell")
    np.testing.assert_allclose(pulse.loss.sum("side"), loss, rtol=1e-6)
    assert pulse.front_error.max() < 1e-6


def test_the_printed_wall_does_not_conserve_water():
    printed = solve(FAMILY, HEAT, TAU, closure="printed", books=True)
    assert (printed.water_balance_error > 1e-3).all()
    again = solve(FAMILY, HEAT, TAU)
    assert np.array_equal(printed.Phi1, again.Phi1)
    assert again.water_balance_error.max() < 6e-5  # it conserves length instead
    assert "loss" not in again


def test_books_of_the_printed_wall_have_the_flow_of_its_velocities():
    """Through the front's section, by the polymer's and the water's velocities of section 3.6.2."""
    printed = solve(Tubes([0.3, 0.6]), HEAT, [1e-3, 4e-3], cells=(64, 40), books=True)
    flow = water_budget(printed).axial_rate_front / (np.pi * (1 - printed.ell**2))
    np.testing.assert_allclose(printed.axial_rate, flow, rtol=1e-4)


def largest_error(run, reference):
    """Of Phi_1 for each tube, at the front and in the cells."""
    worst = np.zeros(len(reference))
    for i, (Z, Phi) in enumerate(reference):
        middle = Z.shape[1] // 2
        for j in range(len(Z)):
            at = run.isel(ell=i, tau=j)
            hot = at.hot.values
            errors = [abs(at.Phi1_front.item() - Phi[j, middle])]
            for side, nodes in ((hot, slice(0, middle + 1)), (~hot, slice(middle, None))):
                there = np.minimum(at.Z.values[side], Z[j, -1])
                exact = CubicSpline(Z[j, nodes], Phi[j, nodes])(there)
                errors.append(np.abs(exact - at.Phi1.values[side]).max())
            worst[i] = max(worst[i], *errors)
    return worst


@pytest.mark.parametrize("closure", CONSERVING)
def test_a_second_solver_agrees(closure):
    tubes, tau = Tubes([0.1, 0.5], 0.1, [1.0, 0.3], [1.0, 3.0], [2.0, 4.0]), [1e-3, 1e-2]
    keys = ("ell", "eps", "M", "Pi_ratio", "Phi_inf")
    reference = [
        second.solve(tau, **{k: getattr(tubes, k)[i] for k in keys}, closure=closure)
        for i in range(2)
    ]
    coarse, fine = (
        largest_error(solve(tubes, HEAT, tau, cells=cells, closure=closure), reference)
        for cells in ((32, 20), (64, 40))
    )
    assert (coarse / fine > 3.2).all()
    assert fine[0] < 3e-4
    assert fine[1] < 8e-4


def test_manufactured_solution_with_the_balance_of_forces():
    require_all(manufactured.spreading_front("balanced"))


def test_a_wrong_term_misses_the_manufactured_solution(monkeypatch):
    closure = named("conservative")
    monkeypatch.setattr(type(closure), "conductivity", lambda self, y, s, M: 3 * s / y**3)
    _, error, _ = manufactured.manufactured((16, 16), 1e-4, "printed")
    assert np.abs(error).max() < 4e-3
    monkeypatch.setattr(type(closure), "potential", lambda self, y, s, M: -1.5 * s / y**2)
    _, error, _ = manufactured.manufactured((16, 16), 1e-4, "conservative")
    assert np.abs(error).max() > 2e-2


def test_resting_front_of_table_1():
    """Nothing is shed, Phi_1 = 1.3901 at the front, and A w = 0.8021."""
    tubes = Tubes(0.5)
    error, shed = known.resting_front((128, 80), tubes)
    assert error < 2e-4
    assert shed < 1e-8
    family, stretch, X = known.at_rest(tubes, (128, 80))
    Phi = family.inner_faces(stretch, X)[2][0, family.behind - 1] ** -3.0
    assert Phi == pytest.approx(1.3901, abs=2e-4)
    length = stretch[0] * np.diff(X[0])
    Z = np.cumsum(length) - length / 2 - known.RESTING
    near = np.abs(Z) < 8

    def misfit(A):
        tanh = 2 - (1 + np.tanh(A * Z)) / 2
        return (length * (stretch[0] ** -3 - tanh) ** 2)[near].sum()

    assert minimize_scalar(misfit, (0.6, 1.0)).x == pytest.approx(0.8021, rel=1e-3)


@pytest.mark.parametrize("closure", CONSERVING)
def test_flow_far_ahead_tends_to_what_geometry_says(closure):
    ell, tau = np.array([0.5, 0.9]), np.array([0.01, 0.02, 0.04, 0.08])
    run = solve(Tubes(ell), HEAT, tau, closure=closure)
    p, q = 2 ** (1 / 3), 2 ** (-2 / 3)
    gain = (lumen_share(ell) * (1 - ell**2) / ell**2)[:, np.newaxis]
    V = (run.loss_rate.sum("side") - run.shorter_rate + gain * run.source_rate.sum("side")).values
    error = V / HEAT.front_speed(tau) / (1 - q + gain * (p - q)) - 1
    assert np.abs(error[:, 0]).max() < 0.02
    order = -np.polyfit(np.log(tau), np.log(np.abs(error.T)), 1)[0]
    np.testing.assert_allclose(order, 1.0, atol=0.05)


@pytest.mark.parametrize("ell", [0.05, 0.25, 0.9])
def test_the_surface_bears_no_force_in_thick_walls_either(ell):
    """Displacements from div xi = 3 (1 - Phi^{1/3}), stresses from them, all by quadrature."""
    s, M, Phi_0 = 0.5, 0.7, 2.0
    nodes, weight = np.polynomial.legendre.leggauss(200)
    b_0, b_1 = ell, 1.0  # any current radii
    r = (b_1 + b_0 + (b_1 - b_0) * nodes) / 2

    def root(Phi_s):  # Phi^{1/3} of a profile that is Phi_s on both edges
        return lambda r: np.cbrt(Phi_s) - 0.3 * (r - b_0) * (b_1 - r) * (1 + r) / (b_1 - b_0) ** 2

    def mean(values):
        return (weight * values * r).sum() / (weight * r).sum()

    Phi_s = 1.5
    for _ in range(100):
        stretch = 1 / mean(root(Phi_s)(r))
        Phi_s, slope = named("balanced").surface(np.array(stretch), s, Phi_0, M)
    shift = 1e-6
    ends = [
        named("balanced").surface(np.array(stretch + d), s, Phi_0, M)[0] for d in (-shift, shift)
    ]
    assert slope == pytest.approx((ends[1] - ends[0]) / (2 * shift), rel=1e-6)
    axial = 1 - 1 / stretch
    fine = np.linspace(b_0, b_1, 4001)
    swelling = 3 * (1 - root(Phi_s)(fine))
    integrand = (swelling - axial) * fine
    running = np.r_[0, np.cumsum((integrand[1:] + integrand[:-1]) / 2 * np.diff(fine))]
    hoop = (axial * b_0**2 + running) / fine**2
    assert hoop[-1] == pytest.approx(axial, abs=1e-6)
    C = s * (Phi_s - Phi_0) + 4 * M * np.cbrt(Phi_s)
    effective = C - 4 * M * root(Phi_s)(fine)  # p + Pi
    radial = -effective + 2 * M * (2 * swelling / 3 - hoop - axial)
    hooping = -effective + 2 * M * (hoop - swelling / 3)
    axially = -effective + 2 * M * (axial - swelling / 3)
    size = np.abs(hooping).max()
    assert np.abs(radial[[0, -1]]).max() < 1e-6 * size
    force = (axially * fine)[1:-1].sum() + (axially * fine)[[0, -1]].sum() / 2
    assert abs(force) < 1e-6 * np.abs(axially * fine).sum()
    balance = np.gradient(radial, fine) + (radial - hooping) / fine
    assert np.abs(balance[2:-2]).max() < 1e-4 * np.abs(np.gradient(radial, fine)).max()


@pytest.mark.parametrize("closure", ["printed", *CONSERVING])
def test_slopes_are_derivatives(closure):
    closure, y, d = named(closure), np.linspace(0.6, 1.1, 7), 1e-6
    for slope, function in (
        (closure.content_slope(y), closure.content),
        (closure.conductivity(y, 0.3, 0.7), lambda y: closure.potential(y, 0.3, 0.7)),
        (closure.source(y, 0.3, 4.0, 0.7)[1], lambda y: closure.source(y, 0.3, 4.0, 0.7)[0]),
    ):
        found = (function(y + d) - function(y - d)) / (2 * d)
        np.testing.assert_allclose(slope * np.ones(7), found, rtol=1e-6)


def test_an_unknown_closure_is_refused():
    with pytest.raises(ValueError, match="closure = 'leaky' is not allowed: one of printed, cons"):
        slender.solve(Tubes(0.5), HEAT, [0.1], closure="leaky")
