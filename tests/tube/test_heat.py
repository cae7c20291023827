"""The pulse of heat: eqn:temp_field, its solution and its front."""

import numpy as np
import pytest
from scipy.special import erfc

from gelpump.tube.heat import StepHeating


def test_front_constant_is_the_papers():
    tau = np.array([1e-3, 0.025, 0.1])
    front = StepHeating(Le=10.0).front(tau)
    assert np.allclose(front / np.sqrt(10 * tau), 0.953873, atol=5e-7)
    assert StepHeating().front(0.0) == 0


def theta(heat, Z, tau):
    """(T - T_C)/Delta T by eqn:temp_field_sol."""
    return 2 * erfc(Z / (2 * np.sqrt(heat.Le * tau))) - 1


def test_temperature_is_critical_at_the_front():
    heat, tau = StepHeating(Le=7.0), np.array([1e-3, 0.02, 0.1])
    assert np.allclose(theta(heat, heat.front(tau), tau), 0, atol=1e-14)
    assert theta(heat, 0.0, 0.01) == 1
    assert np.isclose(theta(heat, 50.0, 0.01), -1)
    Z, at, h, k = 0.3, 0.02, 1e-3, 1e-5
    rate = (theta(heat, Z, at + k) - theta(heat, Z, at - k)) / (2 * k)
    curvature = theta(heat, Z + h, at) - 2 * theta(heat, Z, at) + theta(heat, Z - h, at)
    assert np.isclose(rate, 7 * curvature / h**2, rtol=1e-4)  # and obeys eqn:temp_field


def test_front_speed_is_the_derivative():
    heat, tau, k = StepHeating(), 0.03, 1e-7
    difference = (heat.front(tau + k) - heat.front(tau - k)) / (2 * k)
    assert np.isclose(heat.front_speed(tau), difference, rtol=1e-8)


@pytest.mark.parametrize("Le", [0.0, -1.0, np.inf, np.nan])
def test_bad_lewis_number(Le):
    with pytest.raises(ValueError, match=r"Le = .* not allowed"):
        StepHeating(Le)
