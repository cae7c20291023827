"""Key numbers of figures, and the uncertainties that are theirs alone."""

import numpy as np
import pytest
import xarray as xr

from gelpump.statements import numbers
from gelpump.statements.numbers import half_time, row
from gelpump.statements.tubes import slope
from gelpump.tube.front_fit import relative_error


@pytest.mark.parametrize("count", [60, 120, 240])
def test_half_of_the_change_is_found_between_outputs(count):
    t = np.linspace(0.0, 1.0, count) ** 2
    found, error = half_time(t, 1.0 + np.tanh(3.0 * t))
    exact = np.arctanh(0.5 * np.tanh(3.0)) / 3.0
    assert abs(found - exact) <= error <= 1e-3 / (count / 60) ** 2.5


def test_a_fold_is_located_by_its_curvature():
    def curve(phi):
        return 300.0 + 40.0 * (phi - 0.3) ** 2

    error = numbers._located(curve, 0.3)
    assert curve(0.3 + 0.5 * error) == pytest.approx(300.0, abs=np.spacing(300.0))
    assert error == pytest.approx(np.sqrt(np.spacing(300.0) / 40.0), rel=0.05)


def test_a_power_is_as_uncertain_as_what_follows_it():
    x = np.array([0.1, 0.25, 0.5, 0.75, 0.9])
    power, doubt = slope(x, x**-2.0, 0.01)
    assert power == pytest.approx(-2.0)
    worst = slope(x, x**-2.0 * (1.0 + 0.01 * np.sign(np.log(x / 0.35))))[0]
    assert abs(worst + 2.0) <= 1.01 * doubt
    assert slope(x, x**-2.0)[1] < 1e-14


def test_a_number_is_printed_to_its_uncertainty():
    record = row("fig", "radius", [1.5, 2.0], [1e-3, 1e-9], "refinement", "fit: A")
    assert record["evidence"] == "data/fit.nc: A"
    assert record["printed"] == "1.500 ± 0.001, 2.00000"
    page = numbers.markdown([record])
    assert page.count("\n| fig |") == 1


def test_a_number_that_is_not_finite_is_an_error():
    with pytest.raises(ValueError, match="fig, radius"):
        row("fig", "radius", np.nan, 0.0, "refinement", "file")


def test_uncertainties_between_refined_tubes_are_those_of_the_thickness():
    """Relative, the largest of the times, linear in ln(1-ell), whatever the order of the tubes."""
    ell, tau = np.array([0.9, 0.2, 0.6]), np.array([1e-3, 1e-2])
    share = 1e-3 - 2e-4 * np.log(1.0 - ell)
    A = np.array([[30.0, 40.0], [60.0, 20.0], [10.0, 80.0]])
    refinement = xr.Dataset(
        {
            "A": (("level", "ell", "tau"), np.stack([A, 7.0 * A])),
            "A_uncertainty": (("ell", "tau"), A * share[:, np.newaxis] * [1.0, 0.5]),
        },
        coords={"ell": ell, "tau": tau},
    )
    between = np.array([0.25, 0.5, 0.8])
    expected = 1e-3 - 2e-4 * np.log(1.0 - between)
    np.testing.assert_allclose(numbers._relative(refinement, "A", between), expected, rtol=1e-12)
    found = relative_error(refinement, xr.Dataset(coords={"ell": between}))
    np.testing.assert_allclose(found, expected[:, np.newaxis], rtol=1e-12)
