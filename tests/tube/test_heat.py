"""The pulse of heat: eqn:temp_field, its solution and its front."""

import numpy as np
import pytest

from gelpump.tube.heat import StepHeating, lewis_number


def test_front_constant_is_the_papers():
    tau = np.array([1e-3, 0.025, 0.1])
    front = StepHeating(Le=10.0).front(tau)
    assert np.allclose(front / np.sqrt(10 * tau), 0.953873, atol=5e-7)
    assert StepHeating().front(0.0) == 0


def test_temperature_is_critical_at_the_front():
    heat = StepHeating(Le=7.0)
    tau = np.array([1e-3, 0.02, 0.1])
    assert np.allclose(heat.theta(heat.front(tau), tau), 0, atol=1e-14)
    assert heat.theta(0.0, 0.01) == 1
    assert np.isclose(heat.theta(50.0, 0.01), -1)


def test_temperature_obeys_the_heat_equation():
    heat = StepHeating(Le=10.0)
    Z, tau, h, k = 0.3, 0.02, 1e-3, 1e-5
    rate = (heat.theta(Z, tau + k) - heat.theta(Z, tau - k)) / (2 * k)
    curvature = (heat.theta(Z + h, tau) - 2 * heat.theta(Z, tau) + heat.theta(Z - h, tau)) / h**2
    assert np.isclose(rate, 10 * curvature, rtol=1e-4)


def test_front_speed_is_the_derivative():
    heat, tau, k = StepHeating(), 0.03, 1e-7
    difference = (heat.front(tau + k) - heat.front(tau - k)) / (2 * k)
    assert np.isclose(heat.front_speed(tau), difference, rtol=1e-8)


def test_lewis_number_of_the_paper():
    assert np.isclose(lewis_number(1e-7, 1e-8), 10)


@pytest.mark.parametrize("Le", [0.0, -1.0, np.inf, np.nan])
def test_bad_lewis_number(Le):
    with pytest.raises(ValueError, match=r"Le = .* not allowed"):
        StepHeating(Le)
