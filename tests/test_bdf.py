"""Backward differences with variable steps: exactness, order and failure."""

import numpy as np
import pytest

from gelpump import bdf


@pytest.mark.parametrize("points", [2, 3, 4])
def test_weights_are_exact_for_polynomials(points):
    times = np.array([2.0, 1.7, 1.1, 0.3])[:points]
    y = times ** (points - 1)
    slope = bdf.derivative_weights(times) @ y
    assert slope == pytest.approx((points - 1) * 2.0 ** (points - 2), rel=1e-12)
    assert bdf.interpolation_weights(times, 1.9) @ y == pytest.approx(
        1.9 ** (points - 1), rel=1e-12
    )


def riccati(t, guess, alpha, history):
    """The step of dy/dt = -y^2, solved exactly: alpha y + history = -y^2."""
    return (-alpha + np.sqrt(alpha**2 - 4.0 * history)) / 2.0


def stepped(advance, end, order=2, tolerance=1e-5, first_step=1e-4):
    """From y(0) = 1 to ``end``."""

    def norm(y, dy):
        return float(np.abs(dy).max())

    options = {"order": order, "tolerance": tolerance, "first_step": first_step}
    return bdf.integrate(advance, np.ones(1), end, error_norm=norm, **options)


def march(order, tolerance):
    """Steps taken and error at t = 3 for dy/dt = -y^2, y(0) = 1, whose solution is 1/(1 + t)."""
    steps = list(stepped(riccati, 3.0, order, tolerance, first_step=1e-6))
    assert steps[-1].time == 3.0
    return len(steps), abs(float(steps[-1].solution[0]) - 0.25), steps


@pytest.mark.parametrize(("order", "bound"), [(2, 5e-5), (3, 2e-5)])
def test_error_falls_with_the_order_of_the_method(order, bound):
    (n_coarse, e_coarse, _), (n_fine, e_fine, _) = march(order, 1e-6), march(order, 1e-9)
    slope = np.log(e_coarse / e_fine) / np.log(n_fine / n_coarse)
    assert slope >= order - 0.15
    assert e_coarse < bound
    assert e_fine < 1e-2 * bound


def test_a_step_interpolates_between_its_ends():
    _, _, steps = march(3, 1e-8)
    step = steps[len(steps) // 2]
    t = 0.5 * (step.start + step.time)
    assert step.at(step.time) == pytest.approx(step.solution, rel=1e-14)
    assert float(step.at(t)[0]) == pytest.approx(1.0 / (1.0 + t), abs=1e-6)


def test_a_newton_failure_shortens_the_step():
    failures = []

    def fragile(t, guess, alpha, history):
        if alpha < 50.0 and len(failures) < 3:
            failures.append(t)
            raise bdf.NotConverged
        return riccati(t, guess, alpha, history)

    *_, last = stepped(fragile, 3.0)
    assert len(failures) == 3
    assert float(last.solution[0]) == pytest.approx(0.25, abs=1e-3)


def test_a_barrier_is_closed_in_on():
    def walled(t, guess, alpha, history):
        if t > 1.234:
            raise bdf.Barrier
        return riccati(t, guess, alpha, history)

    steps = stepped(walled, 3.0)
    times = [0.0]
    with pytest.raises(bdf.Barrier):
        times.extend(step.time for step in steps)
    reached = times[-1]
    assert 1.234 * (1 - 2e-3) < reached <= 1.234


def test_a_step_that_never_converges_ends_with_an_error():
    def hopeless(t, guess, alpha, history):
        raise bdf.NotConverged

    with pytest.raises(RuntimeError, match="time step fell"):
        list(stepped(hopeless, 1.0))
