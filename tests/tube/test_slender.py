"""The family of slender tubes: accuracy, orders, conservation, limits.

The errors are maxima over all cells and the front, relative to the independent solution of
`gelpump.second_solvers.tube` where one is needed.
"""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from gelpump.second_solvers.tube import solve as method_of_lines
from gelpump.tube import slender
from gelpump.tube.deswelling import deswelling_curve
from gelpump.tube.heat import StepHeating
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes

HEAT = StepHeating(Le=10.0)
TAU = np.array([1e-4, 1e-3, 0.005, 0.025, 0.1])
FAMILY = Tubes(
    ell=[0.1, 0.5, 0.9, 0.3],
    eps=[0.1, 0.1, 0.1, 0.2],
    M=[1, 1, 1, 0.3],
    Pi_ratio=[1, 1, 1, 3],
    Phi_inf=[2, 2, 2, 4],
)


@pytest.fixture(scope="module")
def reference():
    """Z and Phi_1 of each tube, known to about 1e-5 (the last to 7e-5)."""
    keys = ("ell", "eps", "M", "Pi_ratio", "Phi_inf")
    nodes = [400, 400, 400, 800]
    return [
        method_of_lines(TAU, **{k: getattr(FAMILY, k)[i] for k in keys}, nodes=n)
        for i, n in enumerate(nodes)
    ]


@pytest.fixture(scope="module")
def solution():
    return solve(FAMILY, HEAT, TAU)


def errors(dataset, reference):
    """Largest error of Phi_1 for each tube and time."""
    found = np.zeros((dataset.sizes["ell"], len(TAU)))
    hot = dataset.hot.values
    for i, (Z, Phi) in enumerate(reference):
        front = Z.shape[1] // 2
        for j in range(len(TAU)):
            at = dataset.isel(ell=i, tau=j)
            worst = abs(float(at.Phi1_front) - Phi[j, front])
            for side, nodes in ((hot, slice(0, front + 1)), (~hot, slice(front, None))):
                exact = CubicSpline(Z[j, nodes], Phi[j, nodes])
                there = np.minimum(at.Z.values[side], Z[j, -1])
                worst = max(worst, np.abs(exact(there) - at.Phi1.values[side]).max())
            found[i, j] = worst
    return found


def test_defaults_agree_with_an_independent_solution(solution, reference):
    found = errors(solution, reference)
    assert found[:3].max() < 4e-4
    assert found[3].max() < 1e-3
    assert solution.attrs["sweeps"] < 400


def test_second_order_in_space_even_at_the_front(solution, reference):
    late = slice(2, None)  # where the error of the time steps is negligible
    coarse, fine = (
        errors(solve(FAMILY, HEAT, TAU, cells=cells, tolerance=6e-5), reference)[:, late]
        for cells in ((32, 20), (128, 80))
    )
    middle = errors(solution, reference)[:, late]
    assert (coarse / middle > 3.4).all()
    assert (coarse / middle < 4.9).all()
    assert (middle / fine > 3.0).all()  # less than 4: the reference itself has an error
    assert fine.max() < 3e-4


def test_orders_in_time():
    tau = [5e-5, 2e-4]  # while the tube collapses

    def run(tolerance, order):
        tube = solve(Tubes(0.5), HEAT, tau, cells=(24, 16), tolerance=tolerance, order=order)
        return np.stack([tube.Phi1_front, tube.Phi1.isel(cell=0)]), tube.attrs["steps"]

    exact, _ = run(3e-6, order=3)
    for order, bound in ((2, 5e-4), (3, 4e-4)):
        (coarse, few), (fine, many) = run(1e-3, order), run(1.5e-5, order)
        error = np.abs(coarse - exact).max(), np.abs(fine - exact).max()
        assert np.log(error[0] / error[1]) / np.log(many / few) > order - 0.3
        assert error[1] < bound


def test_front_face_is_the_front(solution):
    assert solution.front_error.max() < 2e-7
    assert np.allclose(solution.Z_face.isel(face=solution.attrs["cells_behind"]), HEAT.front(TAU),
                       atol=2e-7)  # fmt: skip


def test_shortening_is_the_water_lost(solution):
    assert solution.water_balance_error.max() < 6e-5
    assert solution.water_balance_error.isel(tau=-1).max() < 2.5e-5


def test_polymer_fraction_stays_between_its_equilibria(solution):
    assert solution.Phi1.min() > 1 - 1e-10
    assert (solution.Phi1 < solution.Phi_inf + 1e-10).all()


def test_the_printed_equation_holds():
    """eqn:tube_model with its integral of Phi^{-2/3} Phi_tau, term by term at fixed Z."""
    d = 1e-3
    tau = 2e-3 * np.array([1 - d, 1, 1 + d])
    tube = solve(Tubes(0.5), HEAT, tau, cells=(192, 160), tolerance=1e-5).isel(ell=0)
    Phi, Z, hot = tube.Phi1.values, tube.Z.values, tube.hot.values
    step = tau[2] - tau[0]
    Phi_Z = np.r_[np.gradient(Phi[1][hot], Z[1][hot]), np.gradient(Phi[1][~hot], Z[1][~hot])]
    Phi_tau = (Phi[2] - Phi[0]) / step - Phi_Z * (Z[2] - Z[0]) / step
    Phi, Z, Z_face = Phi[1], Z[1], tube.Z_face.values[1]
    s, Phi_0 = np.where(hot, 0.5, 1.0), np.where(hot, 2.0, 1.0)
    D = s * Phi + 4 / 3 * np.cbrt(Phi)
    F = 16 * Phi ** (2 / 3) * D * (Phi_0 - Phi) / (0.1 * 0.5) ** 2
    pieces = Phi ** (-2 / 3) * Phi_tau * np.diff(Z_face)
    integral = np.cumsum(pieces) - pieces / 2
    left = Phi_tau + D / Phi * Phi_Z**2 - Phi ** (-1 / 3) * Phi_Z * integral / 3
    right = F + np.diff(tube.flux.values[1]) / np.diff(Z_face)
    residual = np.abs(left - right) / np.abs(F).max()
    nearby = np.abs(np.arange(len(Z)) - hot.sum() + 0.5) < 2  # one-sided differences
    assert np.abs(Phi_Z * integral).max() / np.abs(F).max() > 0.05  # the integral does matter
    assert residual[~nearby].max() < 7e-5
    assert residual.max() < 1e-2


def test_end_of_the_domain_is_harmless():
    """Twice the domain with the same cells near the front changes nothing that counts."""
    tau = [1e-4, 1e-3]
    near, far = (
        solve(Tubes(0.3), HEAT, tau, cells=(64, ahead), tolerance=1e-4, reach=reach).isel(ell=0)
        for ahead, reach in ((80, 12.0), (160, 24.0))
    )
    assert np.abs(near.Phi1_front - far.Phi1_front).max() < 1e-4
    assert np.abs(near.Phi1 - 1).isel(cell=-1).max() < 4e-7


def test_tubes_collapse_on_one_another(solution):
    """Since Z_C ~ sqrt(tau), Phi_1 is a function of Z/w and tau/w^2 only, w = eps (1-ell)/4."""
    thick = solution.isel(ell=1).sel(tau=0.025)
    thin = solution.isel(ell=2).sel(tau=0.001)
    assert np.allclose(thick.Z / 5, thin.Z, rtol=4e-7)
    assert np.allclose(thick.Phi1, thin.Phi1, rtol=0, atol=1e-6)


def test_a_member_does_not_feel_the_family(solution):
    alone = solve(Tubes(0.5), HEAT, TAU[:3]).isel(ell=0)
    together = solution.isel(ell=1, tau=slice(3))
    assert np.abs(alone.Phi1_front - together.Phi1_front).max() < 1e-4


def test_fast_heat_leaves_the_end_to_uniform_deswelling():
    """The start from tau = 0 is right: Phi_1 - 1 is tau times a function of Z/sqrt(tau)."""
    tau, tubes = np.array([1e-5, 1e-4, 3e-4]), Tubes([0.1, 0.6])
    tube = solve(tubes, StepHeating(Le=1e4), tau, cells=(256, 40), tolerance=1e-4)
    end = tube.Phi1.isel(cell=0).values.T
    assert np.allclose(end, deswelling_curve(tau[:, np.newaxis], tubes), atol=1e-3)


def test_slopes_of_the_flux_are_its_derivatives():
    """What Newton's iteration is given, on both sides of the front and at it."""
    family = slender.Family(Tubes(0.5, M=0.3, Pi_ratio=3.0, Phi_inf=4.0), HEAT, (8, 6), 12.0, 1e-9)
    X = family.faces(0.1, family.front(0.1))
    stretch = np.linspace(0.7, 1.0, 14)[np.newaxis]
    _, (left, right), _, (face_left, face_right) = family.inner_faces(stretch, X)
    shift = 1e-6 * (np.arange(14) % 2)  # every second cell: each face has one that moves
    ends = [family.inner_faces(stretch + sign * shift, X) for sign in (1, -1)]
    moves_right = np.arange(13) % 2 == 0
    for which, slopes in ((0, (left, right)), (2, (face_left, face_right))):
        found = (ends[0][which] - ends[1][which]) / 2e-6
        np.testing.assert_allclose(found, np.where(moves_right, *slopes[::-1]), rtol=1e-5)


def test_without_a_jump_nothing_happens():
    tube = solve(Tubes(0.5, Phi_inf=1.0, Pi_ratio=3.0), HEAT, [1e-3, 0.1])
    assert np.abs(tube.Phi1 - 1).max() < 1e-13


class Backwards(StepHeating):
    def front(self, tau):
        return super().front(tau) * (0.05 - np.asarray(tau))


@pytest.mark.parametrize("tau", [[0.0, 0.1], [0.1, 0.1], [0.1, 0.05], [np.nan]])
def test_times_must_increase(tau):
    with pytest.raises(ValueError, match=r"tau = .* not allowed: positive and increasing"):
        solve(Tubes(0.5), HEAT, tau)


def test_front_must_move_ahead():
    with pytest.raises(ValueError, match=r"heat\.front is not allowed"):
        solve(Tubes(0.5), Backwards(), [0.01, 0.04])


def test_length_out_of_equilibrium_does_not_count_whole_cells():
    tubes = Tubes(np.array([0.1, 0.5, 0.9]), 0.1, 1.0, 1.0, 2.0)
    coarse, fine = (
        solve(tubes, StepHeating(10.0), [1e-3, 1e-2], cells=cells).departed_length.values
        for cells in ((24, 15), (96, 60))
    )
    np.testing.assert_allclose(coarse, fine, rtol=0.015)
    assert not np.allclose(coarse, fine, rtol=1e-4)  # they are two computations


@pytest.mark.parametrize("closure", ["printed", "conservative"])
def test_cells_tolerance_and_output_times_change_no_answer_beyond_its_error(closure):
    """A scan: each run ends at the last time asked for, and tells the same front."""
    tubes = Tubes(np.array([0.25, 0.75]))
    times = ([0.01], [1e-6, 0.01], list(np.linspace(0.0005, 0.01, 20)))

    def front(cells, tolerance, tau):
        found = slender.solve(
            tubes, StepHeating(10.0), tau, cells=cells, tolerance=tolerance, closure=closure
        )
        assert found.tau.values[-1] == tau[-1]
        return found.Phi1_front.values[:, -1]

    reference = front((128, 80), 1e-5, times[0])
    errors = {
        (cells, tolerance): max(
            np.abs(front(cells, tolerance, tau) / reference - 1).max() for tau in times
        )
        for cells in ((24, 16), (48, 32))
        for tolerance in (1e-3, 1e-4)
    }
    assert all(error < 5e-3 for (cells, _), error in errors.items() if cells == (24, 16)), errors
    assert all(error < 2e-3 for (cells, _), error in errors.items() if cells == (48, 32)), errors
