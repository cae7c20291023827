"""The wall: radial structure, velocities, and where the water goes."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.interpolate import CubicSpline

from gelpump.tube import wall_flow
from gelpump.tube.budget import water_budget
from gelpump.tube.heat import StepHeating
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import Wall

ELLS = [0.01, 0.25, 0.5, 0.9]


@pytest.fixture(scope="module")
def pulse():
    return solve(
        Tubes([0.25, 0.75], M=[1.0, 0.3], Pi_ratio=[1.0, 2.0], Phi_inf=[2.0, 3.0]),
        StepHeating(),
        np.geomspace(1e-4, 2e-2, 24),
        cells=(64, 40),
        tolerance=1e-4,
    )


@pytest.mark.parametrize("ell", ELLS)
@pytest.mark.parametrize("form", [wall_flow.Phi2_printed, wall_flow.Phi2_consistent])
def test_midline_and_edges(form, ell):
    np.testing.assert_allclose(
        form(np.array([ell, (1 + ell) / 2, 1.0]), 7.0, ell), [7, 0, 7], atol=1e-9
    )


@pytest.mark.parametrize("ell", ELLS)
def test_consistent_form_solves_its_equation(ell):
    """(1/R) (R Phi_2')' is the same everywhere: f/D, with kappa for the printed 16."""
    s, h = np.linspace(ell, 1, 9)[1:-1], 1e-4 * (1 - ell)
    up, here, down = (wall_flow.Phi2_consistent(s + d, 1.0, ell) for d in (h, 0, -h))
    laplacian = (up - 2 * here + down) / h**2 + (up - down) / (2 * h) / s
    kappa = wall_flow.source_coefficient(ell)
    np.testing.assert_allclose(laplacian, kappa / (1 - ell) ** 2, rtol=1e-4)


@pytest.mark.parametrize("ell", ELLS)
def test_printed_form_has_eight_in_the_mean(ell):
    outer, inner = (wall_flow._slope_printed(s, ell) for s in (1.0, ell))
    flux = 2 * np.pi * (outer - ell * inner)
    area = np.pi * (1 - ell**2)
    assert np.isclose(flux / area * (1 - ell) ** 2, 8)


def test_source_coefficient_is_below_eight_and_tends_to_it():
    kappa = wall_flow.source_coefficient(np.array([0.01, 0.5, 0.9, 0.99]))
    assert (np.diff(kappa) > 0).all()
    assert (kappa < 8).all()
    assert np.isclose(kappa[-1], 8, rtol=1e-5)


@pytest.mark.parametrize("ell", ELLS)
def test_lumen_share_is_that_of_the_consistent_slopes(ell):
    inward = -ell * wall_flow._slope_consistent(ell, ell)
    outward = wall_flow._slope_consistent(1.0, ell)
    assert np.isclose(wall_flow.lumen_share(ell), inward / (inward + outward))


def test_velocity_is_the_printed_expression(pulse):
    """eqn:ug with eqn:phi2, written out; times Phi_1 it is what the lumen's section prints."""
    tube = pulse.isel(ell=1, tau=-1)
    wall, ell, eps = Wall.of(tube), 0.75, 0.1
    s = np.array([0.75, 0.8, 1.0])
    Phi, hot = tube.Phi1.values, tube.hot.values
    D = np.where(hot, 2 / 3, 1.0) * Phi + 4 * 0.3 / 3 * np.cbrt(Phi)
    drive = np.where(hot, 3.0, 1.0) - Phi
    R = s * Phi[:, np.newaxis] ** (-1 / 3)
    printed = (8 * Phi ** (2 / 3) * D * drive)[:, np.newaxis] / (eps * (1 - ell)) ** 2
    printed = printed * (R - (1 + ell) / 2 * Phi[:, np.newaxis] ** (-1 / 3))
    ours = wall.radial_velocity_printed(s) * Phi[:, np.newaxis]
    np.testing.assert_allclose(ours, printed, rtol=1e-10, atol=1e-9 * np.abs(printed).max())


def test_velocity_is_the_slope_of_Phi2(pulse):
    wall, h = Wall.of(pulse.isel(ell=0, tau=-1)), 1e-6
    D_over_Phi = wall.F * (1 - 0.25) ** 2 / 16 / wall.Phi1 ** (5 / 3) / wall.drive
    for form, velocity in (
        (wall_flow.Phi2_printed, wall.radial_velocity_printed),
        (wall_flow.Phi2_consistent, wall.radial_velocity_consistent),
    ):
        slope = (form(0.9 + h, wall.drive, 0.25) - form(0.9 - h, wall.drive, 0.25)) / (2 * h)
        expected = D_over_Phi * slope * np.cbrt(wall.Phi1)
        np.testing.assert_allclose(
            velocity(np.array([0.9]))[:, 0], expected, rtol=1e-6, atol=1e-6 * abs(expected).max()
        )


def test_flow_is_outwards_behind_and_inwards_ahead(pulse):
    wall, hot = Wall.of(pulse), pulse.hot.values
    outer = wall.radial_velocity_printed(np.ones(1))[..., 0]
    rounding = 1e-12 * outer.max()
    assert (outer[..., hot] >= -rounding).all()
    assert (outer[..., ~hot] <= rounding).all()
    assert (wall.axial_velocity <= rounding).all()


def test_radial_flow_is_fastest_at_the_front(pulse):
    """There |U_g| = 4 D |Phi_0 - Phi_1| Phi_1^(-2/3)/(eps^2 (1-ell)) with Phi_1 at Z_C, the larger
    of both sides."""
    wall, Phi = Wall.of(pulse), pulse.Phi1_front
    sides = []
    for stiffness, Phi_0 in ((pulse.Pi_ratio / pulse.Phi_inf, pulse.Phi_inf), (1.0, 1.0)):
        D = stiffness * Phi + 4 / 3 * pulse.M * np.cbrt(Phi)
        drive = np.abs(Phi_0 - Phi) / pulse.eps**2
        sides.append((4 * D * drive * Phi ** (-2 / 3) / (1 - pulse.ell)).values)
    exact = np.max(sides, axis=0)
    in_cells = np.abs(wall.radial_velocity_printed(np.ones(1))[..., 0]).max(axis=-1)
    error = np.abs(wall.largest_radial_velocity / exact - 1)
    assert error.max() < 2.5e-3
    assert error.max() < 0.1 * np.abs(in_cells / exact - 1).max()


def test_shrinkage_is_the_change_of_the_material(pulse):
    """Volume shed, differenced in time, against the rate from DPhi_1/Dtau."""
    budget = water_budget(pulse)
    error = budget.shed_volume_error / budget.shed_volume.isel(tau=-1)
    assert np.abs(error).max() < 2e-3


def test_printed_edges_let_out_half_of_the_source(pulse):
    budget = water_budget(pulse)
    ell = pulse.ell.values[:, np.newaxis, np.newaxis]
    out = (budget.outer_rate_printed + budget.lumen_rate_printed).values
    wall = Wall.of(pulse)
    source = (np.pi * (1 - ell**2))[..., 0] * wall.integral(wall.F * wall.Phi1 ** (-5 / 3))[..., -1]
    np.testing.assert_allclose(out.sum(axis=-1), source / 2, rtol=1e-10)


def test_share_of_a_thin_wall():
    """Half each way, and the whole of it by integration of the mean source."""
    assert np.isclose(wall_flow.lumen_share(0.9999), 0.5, atol=1e-4)
    ell = 0.3
    mean = quad(lambda s: s * wall_flow.source_coefficient(ell) / (1 - ell) ** 2, ell, 1)[0]
    ends = wall_flow._slope_consistent(1.0, ell) - ell * wall_flow._slope_consistent(ell, ell)
    assert np.isclose(mean, ends)


def test_tubes_of_one_wall_length_differ_by_their_cross_sections():
    """With eps (1-ell) the same, Phi_1(Z) is: what the wall moves goes with its area, and what
    the printed slopes let out of an edge with its circumference and thickness."""
    ell = np.array([0.25, 0.75])
    tubes = Tubes(ell, 0.1 * 0.75 / (1 - ell))
    pulse = solve(tubes, StepHeating(), np.geomspace(1e-3, 4e-3, 4), cells=(48, 30), tolerance=1e-4)
    found = water_budget(pulse)
    for name, size in {
        "axial_rate_front": 1 - ell**2,
        "shed_rate": 1 - ell**2,
        "shed_volume": 1 - ell**2,
        "outer_rate_printed": 1 - ell,
        "lumen_rate_printed": ell * (1 - ell),
    }.items():
        one, other = found[name].values / np.expand_dims(size, tuple(range(1, found[name].ndim)))
        np.testing.assert_allclose(one, other, rtol=1e-5, err_msg=name)


@pytest.mark.parametrize("closure", ["printed", "conservative"])
def test_the_polymer_moves_as_its_points_do(closure):
    """dZ/dtau at a fixed content X of polymer, X = Integral Phi_1^(1/3) dZ, differenced."""
    tau = 2e-3 * np.array([0.999, 1.0, 1.001])
    numerics = {"cells": (192, 120), "tolerance": 1e-6}
    pulse = solve(Tubes([0.5]), StepHeating(10.0), tau, **numerics, closure=closure)
    wall = Wall.of(pulse)
    content = np.cumsum(np.cbrt(wall.Phi1) * wall.cell_length, axis=-1)[0]
    content = np.insert(content, 0, 0.0, axis=-1)
    before, after = (CubicSpline(content[i], wall.Z_face[0, i])(content[1]) for i in (0, 2))
    moved = (after - before) / (tau[2] - tau[0])
    np.testing.assert_allclose(
        wall.polymer_velocity_face[0, 1], moved, rtol=0, atol=1e-3 * np.abs(moved).max()
    )
