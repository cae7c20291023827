"""The LENS bead on FiPy: against a second solver, exact limits, orders, conservation, stops."""

import numpy as np
import pytest
from scipy.optimize import brentq

from gelpump.bead import lens
from gelpump.materials import PiecewiseLinearGel
from gelpump.second_solvers import lens_bead

SWELLING = (308.0, 304.0, np.array([0.0, 1e-3, 0.01, 0.05, 0.1, 0.3, 1.0]))
DRYING = (304.0, 307.6, np.array([0.0, 0.05, 0.2, 1.0, 2.0, 3.0, 4.0, 5.0, 5.5, 6.0, 8.0]))


@pytest.mark.parametrize(
    ("case", "bound"), [(SWELLING, 8e-4), (DRYING, 3e-4)], ids=["swelling", "drying"]
)
def test_radius_agrees_with_an_independent_solver(hht, case, bound):
    before, after, times = case
    phi = hht.equilibrium_polymer_fraction(before)
    reference = lens_bead.solve(hht, after, phi, times, 160).radius
    bead = lens.solve(hht, after, phi, times, 80, tolerance=2e-5)
    np.testing.assert_allclose(bead.radius, reference, rtol=0.0, atol=bound)
    assert np.abs(bead.polymer_volume_error).max() < 1e-12
    assert float(bead.radius[-1]) == pytest.approx(reference[-1], abs=2e-4)


def test_second_order_in_space(hht):
    phi = hht.equilibrium_polymer_fraction(308.0)
    times = SWELLING[2][:5]
    meshes = [40, 80, 160, 320]
    beads = lens.solve_meshes(hht, 304.0, phi, times, meshes, tolerance=1e-4)
    radius = np.array([bead.radius[1:] for bead in beads])
    steps = np.abs(np.diff(radius, axis=0))
    assert np.all(np.log2(steps[:-1] / steps[1:]) >= 1.9)
    assert steps[0].max() < 5e-4
    assert steps[2].max() < 3e-5


def test_meshes_that_share_sweeps_do_not_touch(hht):
    phi = hht.equilibrium_polymer_fraction(308.0)
    alone = lens.solve(hht, 304.0, phi, SWELLING[2], 40, tolerance=1e-4)
    together = lens.solve_meshes(hht, 304.0, phi, SWELLING[2], [40, 40], tolerance=1e-4)
    for bead in together:
        np.testing.assert_allclose(bead.r_face, alone.r_face, rtol=0.0, atol=1e-10)


@pytest.mark.parametrize(("order", "bound"), [(2, 5e-4), (3, 2e-4)])
def test_order_in_time(hht, order, bound):
    """Error against the number of steps, on one mesh, past the singular start."""
    phi = hht.equilibrium_polymer_fraction(308.0)
    times = np.array([0.0, 0.01])

    def run(tolerance, order):
        bead = lens.solve(hht, 304.0, phi, times, 24, tolerance=tolerance, order=order)
        return bead.attrs["steps"], float(bead.radius[-1])

    (n_coarse, a_coarse), (n_fine, a_fine) = run(1e-3, order), run(1.5e-5, order)
    _, exact = run(1e-6, 3)
    slope = np.log(abs(a_coarse - exact) / abs(a_fine - exact)) / np.log(n_fine / n_coarse)
    assert slope >= 1.9
    assert abs(a_fine - exact) < bound


def test_equilibrium_does_not_move(hht):
    phi = hht.equilibrium_polymer_fraction(304.0)
    bead = lens.solve(hht, 304.0, phi, np.array([0.0, 1.0]), 30, tolerance=1e-4)
    np.testing.assert_allclose(bead.polymer_fraction[-1], phi, rtol=2e-13)


def test_swelling_ends_in_equilibrium(hht):
    phi = hht.equilibrium_polymer_fraction(308.0)
    bead = lens.solve(hht, 304.0, phi, np.array([0.0, 30.0]), 30, tolerance=1e-4)
    np.testing.assert_allclose(
        bead.polymer_fraction[-1], hht.equilibrium_polymer_fraction(304.0), rtol=1e-6
    )


def test_small_disturbances_relax_at_the_analytic_rate(hht):
    """Linearised about phi_0: displacements j_1(kr) decay as exp(-D k^2 t), where the surface
    condition reads D (u' + 2 u / a) = 4 u / a^2."""
    phi = hht.equilibrium_polymer_fraction(304.0)
    a, D = phi ** (-1 / 3), float(hht.diffusivity(phi, 304.0)) / hht.shear_modulus(1.0)

    def condition(x):  # x = k a, with u = j_1(x r / a)
        j0, j1 = np.sin(x) / x, np.sin(x) / x**2 - np.cos(x) / x
        return D * (x * j0 / a) - 4.0 * j1 / a**2

    k = brentq(condition, 1e-3, np.pi) / a
    t = np.array([0.0, 1.6, 2.4]) / (D * k**2)
    bead = lens.solve(hht, 304.0, phi * (1 + 1e-4), t, 60, tolerance=1e-10)
    departure = np.log(np.abs(bead.radius.values - a))
    assert (departure[1] - departure[2]) / (t[2] - t[1]) == pytest.approx(D * k**2, rel=2e-4)


def test_phases_separate_at_308_K(hht):
    phi = hht.equilibrium_polymer_fraction(304.0)
    times = np.array([0.0, 0.05, 0.1, 1.0, 8.0])
    coarse, fine = lens.solve_meshes(hht, 308.0, phi, times, [40, 80], tolerance=5e-5)
    lowest = hht.spinodal_polymer_fractions(308.0)[0]
    for bead in (coarse, fine):
        assert "D < 0" in bead.attrs["stopped"]
        assert bead.attrs["stopped_polymer_fraction"] == pytest.approx(lowest, rel=1e-9)
        assert bead.attrs["stopped_t"] == float(bead.t[-1])
        assert bead.attrs["stopped_r"] == pytest.approx(float(bead.radius[-1]), rel=4e-4)
        assert bead.sizes["t"] == 4  # what came before is kept
        assert np.isfinite(bead.radius).all()
    # each mesh at a time of its own
    assert 0.0 < float(coarse.t[-1] - fine.t[-1]) < 4e-4
    assert float(fine.t[-1]) == pytest.approx(0.1452, abs=2e-4)
    assert float(coarse.radius[-1]) == pytest.approx(float(fine.radius[-1]), abs=5e-4)


@pytest.mark.parametrize(("temperature", "phi"), [(308.0, 0.05), (308.0, 0.6), (304.0, 0.05)])
def test_the_surface_is_free_of_stress_up_to_the_ends_of_its_interval(hht, temperature, phi):
    """Next to a spinodal too, where the load hardly changes with phi_s any more."""
    surface = lens.Surface.around(hht, temperature, phi)
    lowest, highest = surface.load(surface.lower), surface.load(surface.upper)
    share = np.concatenate([np.geomspace(1e-12, 0.5, 30), 1 - np.geomspace(1e-12, 0.5, 30)])
    load = lowest + share * (highest - lowest)
    load = load[load > 0.0]
    found = surface.polymer_fraction(4.0 / load)
    slope = hht.Omega * hht.diffusivity(found, temperature)  # d(load)/d(ln phi_s)
    rounding = np.finfo(float).eps * (slope + np.abs(load) + hht.Omega)
    assert np.all(np.abs(surface.load(found) - load) <= 8 * rounding)
    assert np.all((surface.lower <= found) & (found <= surface.upper))
    for outside in (highest * (1 + 1e-9), lowest - 1e-9 * abs(lowest)):
        if outside > 0.0:
            with pytest.raises(lens.PhaseSeparation):
                surface.require(np.array([4.0 / outside]))


def test_a_profile_that_reaches_the_spinodal_is_told_of(hht):
    shells = lens.Shells([8])
    surface = lens.Surface.around(hht, 308.0, 0.05)
    bead = lens.Bead(hht, surface, shells, lens.NewtonSweep(8), 1e-4)
    volume = shells.volume / 0.05
    bead.require_one_phase(np.cumsum(volume))
    volume[3] = shells.volume[3] / 0.3
    with pytest.raises(lens.PhaseSeparation, match=r"D < 0 at phi = 0\.3, r = "):
        bead.require_one_phase(np.cumsum(volume))


def test_a_bead_inside_the_spinodal_does_not_start(hht):
    bead = lens.solve(hht, 308.0, 0.3, np.array([0.0, 1.0]), 30, tolerance=1e-4)
    assert "t = 0," in bead.attrs["stopped"]
    assert bead.sizes["t"] == 1


def test_another_kind_of_gel_dries_to_its_equilibrium():
    gel = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=1.0, M=1.0)
    bead = lens.solve(gel, 1.0, 1.0, np.array([0.0, 0.01, 5.0]), 40, tolerance=1e-4)
    np.testing.assert_allclose(bead.polymer_fraction[-1], 2.0, rtol=2e-8)
    assert 1.0 > float(bead.radius[1]) > float(bead.radius[2])
