"""CPU seconds and peak memory, and what follows from them."""

import os
import time
import traceback
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np


def cpu(run: Callable[[], Any], repeats: int = 2, enough: float = 1.0) -> tuple[float, Any]:
    """Least CPU seconds (user and system) of some runs, and what the last returned.

    A run of more than ``enough`` seconds is not repeated.
    """
    least = np.inf
    for _ in range(repeats):
        before = time.process_time()
        result = run()
        least = min(least, time.process_time() - before)
        if least > enough:
            break
    return float(least), result


class Used(NamedTuple):
    """What a process and those that it started took."""

    seconds: float  # of CPU time
    memory_mb: float  # at most, of the largest of them
    wall: float  # s


def forked(run: Callable[[], Any]) -> Used:
    """What ``run`` and all that it starts take, in a process of its own.

    ChildProcessError if it fails.
    """
    begun = time.perf_counter()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            run()
            status = 0
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(status)
    _, status, used = os.wait4(child, 0)
    wall = time.perf_counter() - begun
    if status:
        raise ChildProcessError(f"status {status}")
    return Used(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, wall)


class Cost(NamedTuple):
    """CPU seconds at some error, and whether that lies beyond the errors that were measured."""

    seconds: float
    extrapolated: bool


def cost_at(error: float, errors: Sequence[float], seconds: Sequence[float]) -> Cost | None:
    """Cost of ``error``, from runs: log-log between the runs that none beats in both.

    Beyond the smallest error, the power law of the last two such runs, of an order of cost between
    1/4 and 2 (one run alone: 1).  Looser than the largest: the cheapest run.  None without runs.
    """
    points, best = [], np.inf
    for spent, reached in sorted(zip(seconds, errors, strict=True)):
        if np.isfinite(reached) and reached < best:
            points.append((spent, reached))
            best = reached
    if not points:
        return None
    if points[0][1] <= error:
        return Cost(points[0][0], False)
    for (s0, e0), (s1, e1) in pairwise(points):
        if e1 <= error:
            share = np.log(e0 / error) / np.log(e0 / e1)
            return Cost(float(s0 * (s1 / s0) ** share), False)
    slope = 1.0
    if len(points) > 1:
        (s0, e0), (s1, e1) = points[-2:]
        slope = float(np.clip(np.log(s1 / s0) / np.log(e0 / e1), 0.25, 2.0))
    return Cost(float(points[-1][0] * (points[-1][1] / error) ** slope), True)


class Growth(NamedTuple):
    """Cost ~ n^exponent, and cost = fixed + slope n."""

    exponent: float
    exponent_uncertainty: float
    fixed: float
    slope: float

    @property
    def crossover(self) -> float:
        """n at which what grows costs as much as what is fixed; infinite without growth."""
        return self.fixed / self.slope if self.slope > 0 else np.inf


def growth(n: Sequence[float], cost: Sequence[float]) -> Growth:
    """Least squares in logarithms, with the standard error; and a line, weighted relatively."""
    x, y = np.log(np.asarray(n, float)), np.log(np.asarray(cost, float))
    if x.size < 3:
        raise ValueError(f"{x.size} runs: an exponent and its uncertainty need three")
    spread = ((x - x.mean()) ** 2).sum()
    exponent = ((x - x.mean()) * y).sum() / spread
    left = y - y.mean() - exponent * (x - x.mean())
    error = np.sqrt((left**2).sum() / (x.size - 2) / spread)
    columns = np.column_stack([np.ones_like(x), n]) / np.asarray(cost, float)[:, None]
    fixed, slope = np.linalg.lstsq(columns, np.ones_like(x), rcond=None)[0]
    return Growth(float(exponent), float(error), float(max(fixed, 0.0)), float(slope))
