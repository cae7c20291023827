r"""Which two states of a gel meet at a front, and where the surface loses its own.

At a front r is continuous, so that both sides have one hoop stretch l_t, and so is the radial
stress S.  Nothing is dissipated in passing it (equal areas at fixed l_t):

    s_r(phi_1, l_t) = s_r(phi_2, l_t) = S ,     W_1 - W_2 = S (J_1 - J_2)

gives S and the two polymer fractions, of the swollen and of the dry side, as functions of l_t (in
LENS they are constants).  Without an energy of interfaces a phase is lost at its spinodal, E = 0,
instead: the surface s_r(phi_s, a) = traction(a) keeps its swollen root until

    E(phi, a) = 0 ,     s_r(phi, a) = traction(a) ,

which for each radius a holds at one temperature T*(a).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

NEWTON_LIMIT = 30
POINTS = 129  # of the table
MERGING = 6  # of them, next to the critical point, whose two sides are too near to be told apart
ROUNDED = 1e-13  # change of a polymer fraction, relative, that is rounding
LEAST, MOST = 1e-9, 1 - 1e-12  # polymer fractions that are sought
_SCAN = np.concatenate([np.geomspace(1e-4, 0.1, 400)[:-1], np.linspace(0.1, 0.999, 1200)])


class OnePhase(ValueError):
    """No two phases coexist there."""


def spinodal(energy, l_t: float) -> tuple[float, float]:
    """The two polymer fractions between which E < 0 at l_t; OnePhase if E > 0 everywhere.

    Of several such intervals, that of the least polymer fractions.
    """
    from scipy.optimize import brentq

    unstable = energy.stiffness(_SCAN, l_t) < 0
    if not unstable.any():
        raise OnePhase(f"no two phases at hoop stretch {l_t:.6g}")
    first = int(np.argmax(unstable))
    last = first + int(np.argmin(unstable[first:]))
    return tuple(
        brentq(energy.stiffness, _SCAN[i - 1], _SCAN[i], args=(l_t,), xtol=1e-16)
        for i in (first, last)
    )


def equal_area(energy, l_t: float, guess: tuple[float, float] | None = None):
    """Polymer fractions (swollen, dry) of the two sides of a front at hoop stretch l_t.

    From ``guess`` by Newton's method; else, or if that leads astray, by bisection in S between the
    two spinodals.  OnePhase if there are no two phases.
    """
    if guess is not None:
        found = _newton(energy, l_t, np.array(guess))
        if found is not None:
            return found
    from scipy.optimize import brentq

    inner, outer = spinodal(energy, l_t)
    ends = np.array([LEAST, inner, outer, MOST])
    at_most, low, high, at_least = energy.radial_stress(ends, l_t)
    low, high = max(low, at_least), min(high, at_most)

    def sides(S):
        def excess(phi):
            return energy.radial_stress(phi, l_t) - S

        return brentq(excess, LEAST, inner), brentq(excess, outer, MOST)

    def area(S):
        swollen, dry = sides(S)
        W = energy.density(np.array([swollen, dry]), l_t)
        return W[0] - W[1] - S * (1 / swollen - 1 / dry)

    margin = 1e-9 * (high - low)
    found = _newton(energy, l_t, np.array(sides(brentq(area, low + margin, high - margin))))
    if found is None:
        raise OnePhase(f"the two phases at hoop stretch {l_t:.6g} cannot be told apart")
    return found


def _newton(energy, l_t, phi):
    """The pair near ``phi`` = (swollen, dry) that has equal areas, or None."""
    apart = phi[1] - phi[0]
    for _ in range(NEWTON_LIMIT):
        s, W, J = energy.radial_stress(phi, l_t), energy.density(phi, l_t), 1 / phi
        slope = -energy.stiffness(phi, l_t) / phi
        if slope.max() >= 0:
            return None
        # d(area)/d(phi_1) = -slope_1 (J_1 - J_2), and nothing depends on phi_2 but s_1 - s_2
        area = W[0] - W[1] - s[0] * (J[0] - J[1])
        excess = s[0] - s[1]
        change = np.empty(2)
        change[0] = area / (slope[0] * (J[0] - J[1]))
        change[1] = (excess + slope[0] * change[0]) / slope[1]
        phi = phi + change
        if not 0 < phi[0] < phi[1] < 1 or phi[1] - phi[0] < 0.1 * apart:
            return None
        if np.all(np.abs(change) <= ROUNDED * phi):
            return phi
    return phi if np.all(np.abs(change) <= 1e3 * ROUNDED * phi) else None


@dataclass(frozen=True)
class Coexistence:
    """The two sides of a front over the hoop stretch, from where they become one (if they do)."""

    hoop_stretch: NDArray
    swollen: NDArray
    dry: NDArray
    critical: bool
    """Whether the first hoop stretch is the critical one, at which the two sides are one."""

    @classmethod
    def between(cls, energy, low: float, high: float, points: int = POINTS) -> "Coexistence":
        """From hoop stretch ``low``, or the critical one above it, to ``high``; OnePhase if that
        has one phase only."""
        first = critical_hoop_stretch(energy, low, high)
        # the sides part like the root of the distance from the critical point
        share = np.linspace(0.0, 1.0, points)
        l_t = first + (high - first) * share**2
        pairs = [equal_area(energy, high)]
        for each in l_t[-2::-1]:
            try:
                pairs.append(equal_area(energy, float(each), tuple(pairs[-1])))
            except OnePhase:
                break
        missing = points - len(pairs)
        if missing > (MERGING if first > low else 0):
            raise OnePhase(f"the two phases at hoop stretch {l_t[missing - 1]:.6g} are not found")
        swollen, dry = np.array(pairs)[::-1].T
        if missing:
            # the sides are too near each other: their mean is linear in l_t, their distance in
            # its root
            known, near = share[missing : missing + 2] ** 2, share[:missing]
            mean = 0.5 * (swollen + dry)[:2]
            slope = np.diff(mean) / np.diff(known)
            middle = mean[0] + slope * (near**2 - known[0])
            half = 0.5 * (dry - swollen)[0] * near / share[missing]
            swollen, dry = np.append(middle - half, swollen), np.append(middle + half, dry)
        return cls(l_t, swollen, dry, first > low)

    @cached_property
    def _spline(self):
        from scipy.interpolate import CubicSpline

        share = np.linspace(0.0, 1.0, self.hoop_stretch.size)
        return CubicSpline(share, [self.swollen, self.dry], axis=1)

    def sides(self, l_t: float) -> tuple[float, float]:
        """(swollen, dry) at one hoop stretch; at the nearest end beyond the table."""
        first, last = self.hoop_stretch[[0, -1]]
        share = np.sqrt(min(max((l_t - first) / (last - first), 0.0), 1.0))
        swollen, dry = self._spline(share)
        return float(swollen), float(dry)


def critical_hoop_stretch(energy, low: float, high: float) -> float:
    """Least hoop stretch from which up to ``high`` E < 0 somewhere: ``low``, or one above it."""
    spinodal(energy, high)
    within, outside = high, low
    try:
        spinodal(energy, low)
    except OnePhase:
        while within - outside > ROUNDED * high:
            middle = 0.5 * (within + outside)
            try:
                spinodal(energy, middle)
            except OnePhase:
                outside = middle
            else:
                within = middle
        return within
    return low


def surface_excess(energy, phi, a):
    """s_r - traction of a surface with polymer fraction phi at radius a: zero if it is free."""
    return energy.radial_stress(phi, a) - energy.traction(a)


def surface_interval(energy, a: float, phase: str) -> tuple[float, float]:
    """The interval of E > 0 at radius a that holds the states of ``phase``, swollen or dry."""
    try:
        inner, outer = spinodal(energy, a)
    except OnePhase:
        return LEAST, MOST
    return (LEAST, inner) if phase == "swollen" else (outer, MOST)


def surface_margin(energy, a: float, phase: str) -> float:
    """Positive while a surface of ``phase`` is free of stress somewhere at radius a."""
    low, high = surface_interval(energy, a, phase)
    return float(min(surface_excess(energy, low, a), -surface_excess(energy, high, a)))


@dataclass(frozen=True)
class Surface:
    """Stress-free surfaces of one phase, between the radii where it has them."""

    radius: NDArray
    polymer_fraction: NDArray
    lost_below: float | None
    """The radius below which the phase has no stress-free surface, or None."""
    lost_above: float | None

    @classmethod
    def between(cls, energy, phase: str, low: float, high: float, inside: float) -> "Surface":
        """Around the radius ``inside``, up to ``low`` and ``high`` or where the root is lost."""
        from scipy.optimize import brentq

        if surface_margin(energy, inside, phase) <= 0.0:
            raise OnePhase(f"no {phase} surface is free of stress at a = {inside:.6g}")
        ends = []
        for end in (low, high):
            ends.append(end)
            for a in np.linspace(inside, end, POINTS)[1:]:
                if surface_margin(energy, float(a), phase) <= 0.0:
                    step = (end - inside) / (POINTS - 1)
                    ends[-1] = brentq(
                        lambda a: surface_margin(energy, a, phase), a - step, a, xtol=1e-15
                    )
                    break
        first, last = ends
        # a root is lost like the root of the distance from there
        radius = first + (last - first) * (0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, POINTS)))
        roots = [stress_free(energy, float(a), phase) for a in radius]
        return cls(
            radius,
            np.array(roots),
            first if first > low else None,
            last if last < high else None,
        )

    @cached_property
    def _spline(self):
        from scipy.interpolate import CubicSpline

        return CubicSpline(np.linspace(0.0, np.pi, self.radius.size), np.log(self.polymer_fraction))

    def state(self, a: float) -> float:
        """Polymer fraction of the surface at radius a; at the nearest end beyond the table."""
        first, last = self.radius[[0, -1]]
        share = min(max((a - first) / (last - first), 0.0), 1.0)
        return float(np.exp(self._spline(np.arccos(1.0 - 2.0 * share))))

    def margin(self, a: float) -> float:
        """Distance of the radius a from where the phase's surface is lost; 1 if it never is."""
        below, above = self.lost_below, self.lost_above
        return min(1.0 if below is None else a - below, 1.0 if above is None else above - a)


def stress_free(energy, a: float, phase: str) -> float:
    """Polymer fraction of the stress-free surface of ``phase`` at radius a."""
    from scipy.optimize import brentq

    low, high = surface_interval(energy, a, phase)
    if surface_excess(energy, low, a) <= 0.0:
        return low
    if surface_excess(energy, high, a) >= 0.0:
        return high
    return brentq(lambda phi: surface_excess(energy, phi, a), low, high, xtol=1e-15)


def loss_temperature(model, gel, a: float, low: float, high: float) -> float:
    """T*(a), at which a swollen surface of radius a loses its stress-free state, in K.

    ``model`` is a class of ``gelpump.separation.energy``; by bisection between ``low``, where the
    state must exist, and ``high``, where it must not: OnePhase otherwise.
    """
    if (
        not surface_margin(model(gel, low), a, "swollen")
        > 0.0
        >= surface_margin(model(gel, high), a, "swollen")
    ):
        raise OnePhase(f"no loss between {low} and {high} K at a = {a:.6g}")
    while high - low > 1e-7:
        middle = 0.5 * (low + high)
        if surface_margin(model(gel, middle), a, "swollen") > 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
