"""What is measured along a bead's run, its refinement, and its sensitivity."""

import numpy as np
import pytest
import xarray as xr

from gelpump.bead import nonlinear, production
from gelpump.bead.dataset import Loss, bead_dataset
from gelpump.bead.sensitivity import sensitivity
from gelpump.uncertainty import convergence_index

CASE = {
    "temperature_initial": 308.0,
    "temperature_final": 304.0,
    "branch": "swollen",
    "end": 1.0,
    "published_times": [0.0123],
    "profile_times": [0.0456],
}


def test_output_times_hold_the_published_ones_and_are_dense_early():
    times = production.output_times(CASE, 200)
    assert {0.0, 0.0123, 0.0456, 1.0} <= set(times.tolist())
    assert times.size >= 200
    assert np.all(np.diff(times) > 0)
    assert np.count_nonzero(times < 1e-3) > 30


def uniform_bead(phi, stretch=1.0):
    R = np.linspace(0.0, 1.0, 11)
    faces = np.outer(np.ones(2), R * phi ** (-1 / 3) * stretch)
    return bead_dataset(np.array([0.0, 1.0]), R, faces, np.full(2, phi))


def test_a_uniform_bead_has_no_gradient_and_one_diffusivity(hht):
    bead = production.measured(uniform_bead(0.2), hht, 304.0)
    np.testing.assert_allclose(bead.polymer_fraction, 0.2, rtol=1e-12)
    np.testing.assert_allclose(bead.steepest_gradient, 0.0, atol=1e-12)
    np.testing.assert_allclose(
        bead.smallest_diffusivity, hht.diffusivity(0.2, 304.0) * hht.Omega, rtol=1e-12
    )


def test_the_smallest_diffusivity_is_sought_between_the_shells_and_the_surface(hht):
    """D < 0 somewhere between 0.05 and 0.64 at 308 K, though at neither end."""
    bead = uniform_bead(0.05)
    bead["surface_polymer_fraction"] = "t", np.full(2, 0.64)
    assert hht.diffusivity(0.05, 308.0) > 0 < hht.diffusivity(0.64, 308.0)
    assert float(production.measured(bead, hht, 308.0).smallest_diffusivity[0]) < 0


def fake_run(cells, tolerance, stop=None):
    """Radius 1 + 1/cells^2 + 10 tolerance: orders that the index must see."""
    t = np.linspace(0.0, 1.0, 5)
    series = {
        name: ("t", np.full(5, 1.0 + cells**-2.0 + 10 * tolerance), {"long_name": name})
        for name in production.MEASURED
    }
    attrs = {} if stop is None else {"stopped_t": stop}
    return xr.Dataset(series, coords={"t": t}, attrs=attrs)


def fake_runs(run):
    return lambda asked: [run(cells, common) for meshes, common in asked for cells in meshes]


def test_refinement_estimates_the_true_error():
    bead, refined = production.refined(fake_runs(fake_run), 100, 1e-6)
    assert bead.identical(fake_run(100, 1e-6))
    true_error = 100**-2.0 + 10e-6
    estimate = refined.radius_uncertainty.values
    assert np.all(estimate >= true_error)
    assert np.all(estimate < 2 * true_error)
    assert refined.sizes == {"level": 5, "t": 5}


def test_runs_that_stop_are_compared_up_to_the_first_stop():
    def stopping(cells, tolerance):
        return fake_run(cells, tolerance, stop=0.6 + 1.0 / cells)

    _, refined = production.refined(fake_runs(stopping), 100, 1e-6)
    assert refined.t.values.max() == 0.5
    assert refined.stop_time[0] == pytest.approx(0.61)
    assert float(refined.stop_time_uncertainty) > 0


def test_the_convergence_index_of_a_second_order_sequence():
    h = np.array([0.2, 0.1, 0.05])
    coarse, value, fine = 3.0 + h**2
    assert convergence_index(coarse, value, fine) == pytest.approx(1.25 * h[1] ** 2)
    assert convergence_index(1.0, 1.0, 1.0) == 0.0
    # not converging: the slowest believable rate is assumed
    assert convergence_index(1.0, 1.1, 1.0) == pytest.approx(1.25 * 0.1 * 3.0)


def test_a_loss_tells_when_where_and_why():
    attributes = Loss(0.5, 2.0, 0.13, "D < 0").attributes()
    assert attributes["stopped"] == "phase separation at t = 0.5, r = 2, phi = 0.13: D < 0"
    assert attributes["stopped_t"] == 0.5


def test_sensitivity_is_the_derivative_times_half_a_unit(hht):
    times = np.array([0.0, 0.01])

    def radius(gel, temperature):
        phi = gel.equilibrium_polymer_fraction(308.0)
        return nonlinear.solve(gel, temperature, phi, times, 24, tolerance=1e-9).radius

    half = {"Omega": 0.5, "temperature_final": 0.05}
    found = sensitivity(radius, hht, 304.0, half)
    assert found.parameter_name.values.tolist() == ["Omega", "temperature_final"]
    found = found.radius_change[1]
    wide = (radius(hht, 304.01) - radius(hht, 303.99)) / 0.02 * 0.05
    assert float(found[-1]) == pytest.approx(float(wide[-1]), rel=1e-2)
    assert abs(float(found[-1])) > 1e-4
