r"""A temperature programme, and the temperature that it gives along a tube.

A programme is a value T(t) that is constant, jumps and ramps: a start T_0, then pieces.  Of a tube
it is the temperature of the end Z = 0; the tube starts at T_0 throughout and ends far away.  Heat
spreads by conduction alone (eqn:temp_field), which is linear, so that with the jumps j_k and the
changes of slope b_k of T(t) at the times t_k, x_k = Z/(2 sqrt(kappa (t - t_k))),

    T(Z, t) = T_0 + sum_k j_k erfc(x_k) + sum_k b_k (t - t_k) 4 i2erfc(x_k) ,
    4 i2erfc(x) = (1 + 2 x^2) erfc(x) - (2/sqrt(pi)) x exp(-x^2) ,

exactly.  One jump to T_C + Delta T is eqn:temp_field_sol.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erfc

FINEST = 1e-4  # of the conduction length of the shortest time: where fronts are looked for
SOUGHT = 120
ROUNDS = 40
ROUNDED = 1e-11  # of T, in its own unit
FAR = 26.0  # x beyond which erfc(x) is nothing


@dataclass(frozen=True)
class Programme:
    """T(t), linear between the knots (time, value); two knots at one time are a jump.

    ``start``: T before t = 0 and the first knot's value if that is later.  ValueError, with the
    knot, for times that decrease or are negative, three knots at one time, and what is not finite.
    """

    start: float
    knots: tuple[tuple[float, float], ...]

    def __post_init__(self) -> None:
        knots = np.asarray(self.knots, float).reshape(-1, 2)
        if not len(knots):
            raise ValueError("programme: has no steps: it needs one at least")
        if not np.isfinite([self.start, *knots.ravel()]).all():
            raise ValueError(f"programme = {self.knots}: times and values must be finite")
        t = np.append(0.0, knots[:, 0])
        for k in np.flatnonzero(np.diff(t) < 0):
            raise ValueError(f"programme: t = {t[k + 1]:g} follows t = {t[k]:g}: must not be less")
        if len(t) > 3 and (three := np.flatnonzero(t[3:] == t[1:-2])).size:
            raise ValueError(f"programme: three knots at t = {t[three[0] + 1]:g}: must be two")

    @classmethod
    def cycles(
        cls, cold: float, hot: float, period: float, count: int, share: float = 0.5, ramp: float = 0
    ) -> Programme:
        """``count`` times hot for ``share`` of the ``period``, then cold; each change takes
        ``ramp`` (0: a jump)."""
        if not (period > 0 and 0 < share < 1 and count >= 1 and count == int(count)):
            raise ValueError(
                f"period = {period!r}, share = {share!r}, cycles = {count!r}: "
                "must be period > 0, 0 < share < 1, whole cycles >= 1"
            )
        if not 0 <= ramp <= period * min(share, 1 - share):
            raise ValueError(f"ramp = {ramp!r}: must be within 0 and the shorter part of a period")
        knots = []
        for k in range(int(count)):
            for begin, end, before, after in (
                (k * period, (k + share) * period, cold, hot),
                ((k + share) * period, (k + 1) * period, hot, cold),
            ):
                knots += [(begin, before), (begin + ramp, after)]
                if begin + ramp < end:
                    knots.append((end, after))
        # a knot that repeats the one before it tells nothing
        kept = [each for i, each in enumerate(knots) if not i or each != knots[i - 1]]
        return cls(cold, tuple(kept))

    @cached_property
    def _courses(self) -> tuple[NDArray, NDArray, NDArray]:
        """Times, jumps and changes of slope."""
        t = np.append(0.0, [float(each[0]) for each in self.knots])
        T = np.append(self.start, [float(each[1]) for each in self.knots])
        gap, rise = np.diff(t), np.diff(T)
        slope = np.append(np.divide(rise, gap, out=np.zeros_like(gap), where=gap > 0), 0.0)
        jump = np.append(0.0, np.where(gap > 0, 0.0, rise))
        before = np.append(0.0, slope[:-1])
        # a jump has no slope of its own: that before it lasts up to it
        times = np.unique(t)
        jumps = np.array([jump[t == each].sum() for each in times])
        last = [slope[np.flatnonzero(t == each)[-1]] for each in times]
        first = [before[np.flatnonzero(t == each)[0]] for each in times]
        return times, jumps, np.array(last) - np.array(first)

    @property
    def breaks(self) -> NDArray:
        """Times at which T(t) jumps or changes its slope."""
        times, jump, bend = self._courses
        return times[(jump != 0) | (bend != 0)]

    @property
    def end(self) -> float:
        """Time of the last knot; T stays as it is afterwards."""
        return float(self.knots[-1][0])

    @property
    def extremes(self) -> tuple[float, float]:
        """Least and largest T(t)."""
        values = [self.start, *(T for _, T in self.knots)]
        return min(values), max(values)

    def at(self, t: float) -> float:
        """T(t); at a jump, what it jumps to."""
        return float(self.along(0.0, t, 1.0))

    def before(self, t: float) -> float:
        """T(t); at a jump, what it jumps from."""
        return self.at(np.nextafter(t, -np.inf))

    def along(self, Z: ArrayLike, t: float, kappa: float) -> NDArray:
        """T(Z, t) of a tube whose end follows the programme, at one time."""
        Z = np.asarray(Z, float)
        times, jump, bend = self._courses
        on = times <= t
        if not on.any():
            return np.full(Z.shape, float(self.start))
        since, jump, bend = t - times[on], jump[on], bend[on]
        with np.errstate(divide="ignore", invalid="ignore"):
            x = np.where(Z[..., np.newaxis] > 0, Z[..., np.newaxis] / np.sqrt(4 * kappa * since), 0)
        there = erfc(x)
        T = self.start + there @ jump
        if bend.any():
            x = np.minimum(x, FAR)
            gauss = 2 / np.sqrt(np.pi) * x * np.exp(-x * x)
            T = T + ((1 + 2 * x * x) * there - gauss) @ (bend * since)
        return T

    def fronts(self, T_C: float, t: float, kappa: float) -> NDArray:
        """All Z > 0 with T(Z, t) = T_C, sorted."""
        began = self.breaks[self.breaks < t]
        if not began.size:
            return np.empty(0)
        far = 12 * np.sqrt(kappa * (t - began[0]))
        near = FINEST * np.sqrt(kappa * (t - began[-1]))
        Z = np.append(0.0, np.geomspace(near, far, SOUGHT))
        above = self.along(Z, t, kappa) - T_C
        i = np.flatnonzero((above[1:] > 0) != (above[:-1] > 0))
        low, high, f_low, f_high = Z[i], Z[i + 1], above[i], above[i + 1]
        for _ in range(ROUNDS):  # regula falsi, of Illinois, all at once
            middle = low - f_low * (high - low) / (f_high - f_low)
            f = self.along(middle, t, kappa) - T_C
            left = (f > 0) == (f_low > 0)
            f_high = np.where(left, np.where(f_high == 0, 0, f_high / 2), f)
            f_low = np.where(left, f, f_low / 2)
            low, high = np.where(left, middle, low), np.where(left, high, middle)
            if not i.size or np.abs(f).max() < ROUNDED:
                return middle
        return middle
