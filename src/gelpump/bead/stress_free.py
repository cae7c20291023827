r"""The surface of the fully nonlinear bead: its polymer fraction at a hoop stretch.

The radial stress vanishes there at once, s_r(f, l_t) = 0, which with the stress of
`gelpump.bead.nonlinear` is

    load(f) = f [ Pi(f, T)/mu + f^{1/3} ] = l_t^{-4} ,     d(load)/df = E(f, l_t) ,

E the stiffness. So stress-free surfaces are one curve, which f itself parametrises, and E changes
its sign where that curve folds. A surface stays on the part between two folds that it starts on,
its branch, on which f is a function of l_t alone: it does not matter what an integrator tries on
its way. At the fold E = 0, and beyond it the branch holds no surface: phases separate.

From the uniform initial state the surface changes f at the l_t that the bead has, until it is free
of stress. If E = 0 comes first, phases separate in the first instant.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from gelpump.materials import Gel

SOUGHT = 2000  # polymer fractions among which a root or a fold is bracketed
NEWTON_LIMIT = 10
NEWTON_SQUARE = 1e-12  # of a last correction, over E: what it leaves, far below any tolerance
NEAR = 0.05  # relative to f and to 1 - f: as far as Newton's method is trusted to go
EXACT = 1e-15
MARGIN = 1e-9  # trial steps of CVODE may tangle shells: keeps their f within the gel's bounds


class Surface(NamedTuple):
    """Surface state: polymer fraction, stiffness E, and the stress that E > 0 cannot relieve."""

    polymer_fraction: float
    stiffness: float
    stress: float

    @property
    def margin(self) -> float:
        """Positive on the branch; it falls through zero where the surface leaves it."""
        return self.stiffness - abs(self.stress)


def bounds(gel: Gel) -> tuple[float, float]:
    """Least and largest polymer fraction that are evaluated."""
    low, high = gel.polymer_fraction_bounds
    return low + MARGIN, min(high - MARGIN, 1 / MARGIN)


class StressFreeSurface:
    """The surface of a bead of the uniform initial polymer fraction, at a constant temperature."""

    def __init__(self, gel: Gel, temperature: float, phi_initial: float) -> None:
        self.gel, self.temperature = gel, temperature
        self.mu = gel.shear_modulus(1.0)
        self.initial = self._relieved(phi_initial, phi_initial ** (-1 / 3))
        self.l_t = phi_initial ** (-1 / 3)
        if self.initial.stiffness > 0:
            self.branch = self._fold(0), self._fold(1)
            self.loads = tuple(map(self.load, self.branch))
            self.restart()

    def radial_stress(self, f, l_t):
        """s_r at polymer fraction f and hoop stretch l_t."""
        osmotic = self.gel.osmotic_pressure(f, self.temperature) / self.mu
        return -osmotic + 1 / (f * l_t**4) - np.cbrt(f)

    def stiffness(self, f, l_t):
        """E = ds_r/d(ln l_r) at fixed l_t, which is also -f ds_r/df."""
        osmotic = self.gel.osmotic_modulus(f, self.temperature) / self.mu
        return osmotic + np.cbrt(f) / 3 + 1 / (f * l_t**4)

    def load(self, f):
        """l_t^-4 of the stress-free surface with polymer fraction f."""
        return f * (self.gel.osmotic_pressure(f, self.temperature) / self.mu + np.cbrt(f))

    def slope(self, f):
        """d(load)/df, which is the stiffness of the stress-free surface."""
        gel, T = self.gel, self.temperature
        osmotic = gel.osmotic_pressure(f, T) + gel.osmotic_modulus(f, T)
        return osmotic / self.mu + 4 / 3 * np.cbrt(f)

    def _relieved(self, f: float, l_t: float) -> Surface:
        """Where the stress vanishes at l_t, from f on, or where E = 0 if that comes first."""
        from scipy.optimize import brentq

        stress = self.radial_stress(f, l_t)
        # the stress falls with f while E > 0, so its root lies above f if it is positive
        f = np.geomspace(f, bounds(self.gel)[1 if stress > 0 else 0], SOUGHT)
        parabolic = np.logical_and.accumulate(self.stiffness(f, l_t) > 0)
        relieved = np.flatnonzero(parabolic & (self.radial_stress(f, l_t) * stress <= 0))
        if relieved.size:
            ends = f[max(relieved[0] - 1, 0)], f[relieved[0]]
            root = brentq(self.radial_stress, *ends, args=(l_t,), xtol=EXACT)
            return Surface(root, self.stiffness(root, l_t), 0.0)
        last = max(np.count_nonzero(parabolic) - 1, 0)
        return Surface(f[last], 0.0, self.radial_stress(f[last], l_t))

    def _fold(self, end: int) -> float:
        """The fold next to the initial surface, below (0) or above it (1); a bound if none is."""
        from scipy.optimize import brentq

        f = np.geomspace(self.initial.polymer_fraction, bounds(self.gel)[end], SOUGHT)
        beyond = np.flatnonzero(self.slope(f) <= 0)
        if not beyond.size or beyond[0] == 0:
            return float(f[-1 if not beyond.size else 0])
        return brentq(self.slope, f[beyond[0] - 1], f[beyond[0]], xtol=EXACT)

    def restart(self) -> None:
        """Let Newton's method set out from the initial surface again."""
        self._follow(self.initial.polymer_fraction, self.l_t, self.initial.stiffness)

    def _follow(self, f: float, l_t: float, stiffness: float) -> None:
        """Set out from here next: d(ln f)/d(ln l_t) = -4/(f l_t^4 E) along the curve."""
        self._latest = f, l_t, -4 / (f * l_t**4 * stiffness)

    def at(self, l_t: float) -> Surface:
        """The surface at hoop stretch l_t on the initial one's branch; beyond, that at the fold.

        The latest surface only tells where Newton's method sets out: its root is taken if it lies
        on the branch, which holds one.
        """
        if not self.initial.stiffness > 0:
            return self.initial
        load = l_t**-4
        if not self.loads[0] < load < self.loads[1]:
            f = self.branch[0 if load <= self.loads[0] else 1]
            return Surface(f, 0.0, self.radial_stress(f, l_t))
        f = self._newton(l_t)
        if f is None:
            from scipy.optimize import brentq

            f = brentq(self.radial_stress, *self.branch, args=(l_t,), xtol=EXACT)
            self._follow(f, l_t, self.stiffness(f, l_t))
        return Surface(f, self.stiffness(f, l_t), 0.0)

    def _newton(self, l_t: float) -> float | None:
        """By Newton's method from the latest surface; None if it leads away or off the branch."""
        latest, l_t_latest, power = self._latest
        ratio = l_t / l_t_latest
        if not 0.5 < ratio < 2:  # CVODE also tries beads that are turned inside out
            return None
        f = latest * ratio**power
        if not abs(f - latest) < NEAR * latest * (1 - latest):
            return None
        for _ in range(NEWTON_LIMIT):
            stiffness = self.stiffness(f, l_t)
            change = self.radial_stress(f, l_t) / stiffness  # of ln f
            if stiffness <= 0 or abs(change) > NEAR * (1 - f):
                return None
            f *= 1 + change
            if change**2 < NEWTON_SQUARE * min(1.0, stiffness):
                break
        else:
            return None
        if not self.branch[0] <= f <= self.branch[1]:
            return None
        self._follow(f, l_t, stiffness)
        return f
