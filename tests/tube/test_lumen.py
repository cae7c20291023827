"""Flow in the lumen: the published values, brute force, and conservation of water."""

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import quad

from gelpump.materials import PiecewiseLinearGel
from gelpump.tube import lumen
from gelpump.tube.front import tanh_profile
from gelpump.tube.heat import StepHeating
from gelpump.tube.lumen_pulse import lumen_pulse
from gelpump.tube.pump import volumes
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import Wall

TABLE_1 = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=1.0, M=1.0)
Z_C = float(StepHeating().front(0.1))


def test_published_height_and_far_value():
    peak, far = lumen.velocity_tanh(TABLE_1, 100.0, [Z_C, 9.0], Z_C)
    assert np.isclose(peak, 0.01472, atol=5e-6)
    assert np.isclose(far, 0.00255, atol=5e-6)


def test_height_times_sharpness_is_constant():
    A = np.geomspace(10, 500, 9)
    np.testing.assert_allclose(A * lumen.velocity_tanh(TABLE_1, A, Z_C, Z_C), 1.472, rtol=1e-3)


@pytest.mark.parametrize("gel", [TABLE_1, PiecewiseLinearGel(5.0, 3.0, 0.1)])
@pytest.mark.parametrize("Z", [0.01, 0.05, 0.0999, 0.13, 0.5])
def test_against_brute_force(gel, Z):
    A, front = 30.0, 0.1

    def integrand(u):
        Phi, theta = tanh_profile(A * (u - front), gel.Phi_inf), 1.0 if u < front else -1.0
        drive = gel.equilibrium_polymer_fraction(theta) - Phi
        return Phi * gel.diffusivity(Phi, theta) * drive

    expected = quad(integrand, 0, min(Z, front), epsabs=1e-13)[0]
    expected += quad(integrand, front, max(Z, front), epsabs=1e-13, limit=200)[0]
    found = lumen.velocity_tanh(gel, A, Z, front)
    assert np.isclose(found, expected, rtol=1e-9, atol=1e-12)


@pytest.fixture(scope="module")
def pulse():
    tau = 5e-3 * np.array([1 - 1e-3, 1, 1 + 1e-3])
    return solve(Tubes([0.2, 0.6]), StepHeating(), tau, cells=(128, 80), tolerance=1e-4)


def test_printed_and_matched_are_the_written_out_integrals(pulse):
    tube = pulse.isel(ell=0, tau=1)
    Phi, hot = tube.Phi1.values, tube.hot.values
    D = np.where(hot, 0.5, 1.0) * Phi + 4 / 3 * np.cbrt(Phi)
    common = 8 / (0.1 * 0.8) ** 2 * D * (np.where(hot, 2.0, 1.0) - Phi) * np.diff(tube.Z_face)
    wall = Wall.of(tube)
    np.testing.assert_allclose(lumen.velocity_printed(wall)[1:], np.cumsum(Phi * common), rtol=1e-9)
    plotted = wall.integral(Phi * D * (np.where(hot, 2.0, 1.0) - Phi))
    np.testing.assert_allclose(
        lumen.velocity_printed(wall), lumen.prefactor(0.1, 0.8) * plotted, rtol=1e-9
    )
    matched = 0.8 / 0.2 * np.cumsum(common / np.cbrt(Phi))
    np.testing.assert_allclose(lumen.velocity_matched(wall)[1:], matched, rtol=1e-9)


def test_matched_velocity_meets_the_wall(pulse):
    wall = Wall.of(pulse)
    U = lumen.radial_rate(wall, lumen.velocity_matched(wall)) * wall.ell * wall.Phi1 ** (-1 / 3)
    for i, ell in enumerate(pulse.ell.values):
        edge = wall.radial_velocity_printed(np.array([ell]))[i, ..., 0]
        np.testing.assert_allclose(U[i], edge, rtol=1e-8, atol=1e-8 * np.abs(edge).max())


def test_lumen_conserves_water():
    """(pi B_0^2)_tau at fixed Z, differenced, against what flows in through wall and ends."""
    d = 1e-3
    tau = 2e-3 * np.array([1 - d, 1, 1 + d])
    tubes, heat = Tubes([0.25, 0.75]), StepHeating(10.0)
    pulse = solve(tubes, heat, tau, cells=(192, 120), tolerance=1e-5, closure="conservative")
    wall = Wall.of(pulse)
    area = (np.pi * wall.ell**2 * (wall.Phi1 ** (-2 / 3) - 1) * wall.cell_length).sum(axis=-1)
    filling = (area[:, 2] - area[:, 0]) / (tau[2] - tau[0])
    inflow = volumes(pulse, rate=True)["inner"][:, 1]
    outflow = np.pi * pulse.ell.values**2 * lumen.velocity_conserving(wall)[:, 1, -1]
    assert (np.abs(filling + outflow - inflow) / inflow < 2e-3).all()
    pumped = volumes(pulse, rate=True)["pumped_station"][:, 1]
    np.testing.assert_allclose(outflow, pumped, rtol=2e-3)


def test_a_wall_that_does_not_conserve_water_is_refused(pulse):
    with pytest.raises(ValueError, match="the printed equation does not conserve water"):
        lumen.velocity_conserving(Wall.of(pulse))


def test_velocity_is_highest_at_the_front(pulse):
    wall, front = Wall.of(pulse), int(pulse.hot.sum())
    assert (lumen.velocity_printed(wall).argmax(axis=-1) == front).all()


def test_the_dataset_of_the_pulse_says_one_thing_twice(pulse):
    """Figure 12b at the A of 12a is the last curve of 12a, at its front and far ahead."""
    tau = pulse.tau.values.tolist()
    settings = {"tau": tau[:2], "drawn_A": 100.0, "A": [10.0, 500.0], "A_count": 5}
    settings |= {"Z": [0.0, 1.5], "Z_count": 31}
    fit = xr.Dataset(
        {"exponent": 1.1, "exponent_uncertainty": 0.0, "prefactor": 32.0}
        | {"A_tau": (("ell", "tau"), np.full((2, 3), 50.0))},
        coords={"ell": pulse.ell, "tau": pulse.tau},
    )
    found = lumen_pulse(TABLE_1, {"eps": 0.1}, settings, pulse, fit)
    at, last = found.sel(A=100.0), found.isel(tau=-1)
    peak = last.V_plotted.sel(Z=float(last.Z_C))
    np.testing.assert_allclose(at.V_max_plotted, peak, rtol=1e-12)
    np.testing.assert_allclose(at.V_far_plotted, last.V_plotted[-1], rtol=1e-9)
    np.testing.assert_allclose(at.V_max, last.V.sel(Z=float(last.Z_C)), rtol=1e-12)
    before = 8.0 / (0.1 * (100.0 / 32.0) ** (-1 / 1.1)) ** 2
    np.testing.assert_allclose(at.V_far, before * at.V_far_plotted, rtol=1e-12)
    own = lumen.velocity_tanh(TABLE_1, 50.0, float(last.Z_C), float(last.Z_C))
    expected = 8.0 / (0.1 * (1.0 - pulse.ell.values)) ** 2 * own
    np.testing.assert_allclose(last.V_front_tanh, expected, rtol=1e-12)
