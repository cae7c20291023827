"""Backward differentiation with variable steps, for solvers that do their own Newton iteration.

At the new time t_0 the polynomial through y(t_0), y(t_-1), ..., y(t_-k) has the derivative

    dy/dt (t_0)  ~  alpha y(t_0) + history,      history = sum_j w_j y(t_-j)

with weights that depend on the last k + 1 times only (``derivative_weights``), so no step-size
ratio has to be special.  The order starts at one and rises to k as history accumulates.  The same
polynomial, shifted back by one point, predicts y(t_0); the distance between prediction p and
solution y gives the local error of the step h (Jackson & Sacks-Davis 1980),

    error = h / (t_0 - t_-(k+1)) * |y - p| .

Diffusion has a real, negative spectrum, so every order up to six is stable here; the package uses
two and three.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from gelpump import progress

SAFETY = 0.9
SHRINK_LIMIT = 0.2
MAX_TRIALS = 20_000  # steps, accepted or not: production needs some hundreds
GROWTH_LIMIT = 1.5  # at a constant ratio, third order is stable up to 1.53


class NotConverged(ArithmeticError):
    """A Newton iteration gave up: the step is tried again with a shorter length."""


class Barrier(ArithmeticError):
    """The model itself ends within this step (say, a diffusivity turns negative).

    ``integrate`` closes in on the time where that happens, then lets the exception through.
    """


def derivative_weights(times: np.ndarray) -> np.ndarray:
    """Weights w with sum_j w_j y(times_j) = dy/dt at times[0], exact for degree len(times) - 1."""
    t = np.asarray(times, dtype=float)
    gaps = t[:, None] - t[None, :]
    np.fill_diagonal(gaps, 1.0)
    barycentric = 1.0 / gaps.prod(axis=1)
    weights = np.zeros_like(t)
    weights[1:] = barycentric[1:] / barycentric[0] / (t[0] - t[1:])
    weights[0] = -weights[1:].sum()
    return weights


def interpolation_weights(times: np.ndarray, t: complex) -> np.ndarray:
    """Weights w with sum_j w_j y(times_j) = y(t) for polynomials of degree len(times) - 1."""
    nodes = np.asarray(times, dtype=float)
    gaps = nodes[:, None] - nodes[None, :]
    np.fill_diagonal(gaps, 1.0)
    distance = np.broadcast_to(t - nodes, gaps.shape).copy()
    np.fill_diagonal(distance, 1.0)
    return (distance / gaps).prod(axis=1)


@dataclass(frozen=True)
class Step:
    """An accepted step, with the points whose polynomial interpolates it to the method's order."""

    times: np.ndarray  # newest first, shape (points,)
    solutions: np.ndarray  # shape (points, unknowns)

    @property
    def time(self) -> float:
        """Time at the end of the step."""
        return float(self.times[0])

    @property
    def start(self) -> float:
        """Time at the start of the step."""
        return float(self.times[1])

    @property
    def solution(self) -> np.ndarray:
        """Solution at the end of the step."""
        return self.solutions[0]

    def at(self, t: float) -> np.ndarray:
        """Solution at a time t within the step."""
        return interpolation_weights(self.times, t) @ self.solutions


Advance = Callable[[float, np.ndarray, float, np.ndarray], np.ndarray]
"""advance(t, guess, alpha, history) solves  alpha y + history = f(t, y)  for y."""


def integrate(
    advance: Advance,
    initial: np.ndarray,
    end: float,
    *,
    order: int,
    tolerance: float,
    first_step: float,
    error_norm: Callable[[np.ndarray, np.ndarray], float],
    trials: int = MAX_TRIALS,
) -> Iterator[Step]:
    """March dy/dt = f(t, y) from y(0) = initial to t = end, one accepted Step at a time.

    ``error_norm(y, difference)`` measures a local error; steps keep it at or below ``tolerance``.
    ``advance`` may raise NotConverged (the step is shortened) or Barrier (the time of the barrier
    is closed in on to one part in a thousand, then the Barrier is raised).  RuntimeError if the
    step shrinks below what double precision can resolve, or after `trials` steps.
    """
    times, solutions = [0.0], [np.array(initial, dtype=float)]
    step = min(first_step, end)
    for _ in range(trials):
        if times[0] >= end:
            return
        last = step >= end - times[0]
        t = end if last else times[0] + step
        step = t - times[0]
        if step <= 16 * np.finfo(float).eps * max(t, first_step):
            raise RuntimeError(f"the time step fell to {step:.3g} at t = {t:.8g}")
        used = min(order, len(times))
        weights = derivative_weights(np.array([t, *times[:used]]))
        history = weights[1:] @ np.array(solutions[:used])
        points = min(used + 1, len(times))
        predicted = interpolation_weights(times[:points], t) @ np.array(solutions[:points])
        try:
            solution = advance(t, predicted, weights[0], history)
        except NotConverged:
            step *= 0.25
            continue
        except Barrier:
            if step <= 1e-3 * max(times[0], first_step):
                raise
            step *= 0.5
            continue
        # one step back there is no third point yet: the backward Euler error is half the distance
        share = step / (t - times[points - 1]) if points > used else 0.5
        error = share * error_norm(solution, solution - predicted) / tolerance
        if not np.isfinite(error):
            step *= 0.25
            continue
        optimum = SAFETY * max(error, 1e-12) ** (-1.0 / (used + 1))
        if error > 1.0 and len(times) > 1:
            step *= max(SHRINK_LIMIT, min(optimum, SAFETY))
            continue
        times.insert(0, t)
        solutions.insert(0, solution)
        del times[order + 1 :], solutions[order + 1 :]
        progress.at(t, end)
        yield Step(np.array(times), np.array(solutions))
        step *= min(GROWTH_LIMIT, max(SHRINK_LIMIT, optimum))
    raise RuntimeError(f"{trials} steps ended at t = {times[0]:.8g}, before t = {end:.8g}")
