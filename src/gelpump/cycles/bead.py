r"""A bead under a temperature programme, T(t) the same throughout: loops of a(T).

Both models of `gelpump.separation.energy` on its shells (`shells.motion`), with T = T(t),

    dr/dt|_R = ds_r/dr + 2 (s_r - s_t)/r ,   r(0) = 0 ,   s_r = traction at R = 1 ,

from equilibrium at the programme's start.  The surface has the polymer fraction that balances it at
once; at a jump of T it goes there through states with E > 0, or phases separate.  Where E = 0 is
met the bead ends, with time and place; with a ``width`` of interfaces (`separation.diffuse`) it
goes on, and through the folds of a gel with hysteresis.

CVODE integrates from each jump or bend of T(t) to the next.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gelpump.cycles.programme import Programme
from gelpump.separation import diffuse
from gelpump.separation.blocks import banded
from gelpump.separation.coexistence import equal_area
from gelpump.separation.energy import ENERGIES
from gelpump.separation.shells import (
    at_means,
    clustered_outside,
    motion,
    polymer_fraction,
    soundness,
)
from gelpump.separation.watch import PER_WIDTH, WIDTH_AT

SOUGHT = 600  # polymer fractions among which the surface's is bracketed
BOUNDS = 1e-6, 1 - 1e-9
NEWTON = 30
EXACT = 1e-14
THINNEST_SHARE = 0.01
ABSOLUTE = 0.01  # absolute tolerance over the relative one
MAX_STEPS = 50_000


class Loop(NamedTuple):
    """A bead at some times: (time,) for T, radius; (time, cell) for phi; what ended it."""

    t: NDArray
    T: NDArray
    radius: NDArray
    r: NDArray
    phi: NDArray
    polymer_error: float
    lost: str


class Shells:
    """Shells of one phase: rate of the outer faces' radii, and how far E is above zero."""

    def __init__(self, energy, cells: int):
        self.energy, self.R = energy, clustered_outside(cells)
        self.bands = 2

    def surface(self, f: float, a: float) -> float | None:
        """The polymer fraction that balances a surface of radius a, from f on through E > 0."""
        from scipy.optimize import brentq

        pull = self.energy.traction(a)

        def excess(phi):
            return self.energy.radial_stress(phi, a) - pull

        drive = excess(f)
        way = np.geomspace(f, BOUNDS[1 if drive > 0 else 0], SOUGHT)
        stable = np.logical_and.accumulate(self.energy.stiffness(way, a) > 0)
        balanced = np.flatnonzero(stable & (excess(way) * drive <= 0))
        if not balanced.size:
            return None
        if balanced[0] == 0:
            return f
        return brentq(excess, *way[[balanced[0] - 1, balanced[0]]], xtol=EXACT)

    def settle(self, r: NDArray) -> bool:
        """Bring the surface to where it is balanced; whether there is such a state."""
        found = self.surface(self.f, r[-1])
        if found is not None:
            self.f = found
        return found is not None

    def start(self, phi: float) -> NDArray:
        """Uniform."""
        self.f = phi
        return phi ** (-1 / 3) * self.R[1:]

    def at_surface(self, a: float) -> tuple[float, float]:
        """Polymer fraction and E of the surface, by Newton's method from the last one settled."""
        f, pull = self.f, self.energy.traction(a)
        for _ in range(NEWTON):
            E = self.energy.stiffness(f, a)
            if not E > 0:
                return f, float(E)
            change = (self.energy.radial_stress(f, a) - pull) / E
            f = float(np.clip(f * (1 + np.clip(change, -0.1, 0.1)), *BOUNDS))
            if abs(change) < EXACT:
                break
        return f, float(E)

    def rate(self, r: NDArray) -> NDArray:
        """dr/dt."""
        return motion(self.energy, self.R, np.append(0.0, r), None, self.at_surface(r[-1])[0]).rate[
            1:
        ]

    def margin(self, r: NDArray) -> float:
        """The least E."""
        inside = soundness(self.energy, self.R, np.append(0.0, r))["stiffness"]
        return min(inside, self.at_surface(r[-1])[1])

    def phi(self, r: NDArray) -> NDArray:
        """Polymer fraction of the shells."""
        return polymer_fraction(self.R, np.append(0.0, r))

    def place(self, r: NDArray) -> str:
        """Where E is least, in words."""
        faces = np.append(0.0, r)
        f, E = self.at_surface(r[-1])
        inside = self.energy.stiffness(self.phi(r), at_means(self.R, faces)[1])
        i = int(np.argmin(inside))
        if inside[i] >= E:
            return f"at the surface, r = {r[-1]:.6g}, phi = {f:.6g}"
        return f"at r = {0.5 * (faces[i] + faces[i + 1]):.6g}, phi = {self.phi(r)[i]:.6g}"


class Diffuse:
    """The same with an energy of interfaces: nothing ends it."""

    def __init__(self, energy, cells: int, width: float, at: float):
        energy.temperature = at
        sides = equal_area(energy, WIDTH_AT)
        least = PER_WIDTH / (sides[0] * WIDTH_AT**2) / cells
        if not least <= width <= diffuse.WIDEST:
            raise ValueError(
                f"width = {width}: must be at least {least:.3g}, {PER_WIDTH:g} shells of {cells} "
                f"on the swollen side, and at most {diffuse.WIDEST}"
            )
        self.middle = 0.5 * sum(sides)
        kappa = (width / diffuse.width_per_root_kappa(energy)) ** 2
        self.bead = diffuse.Bead(energy, kappa, cells)
        self.R, self.bands = self.bead.R, 2
        self.rate = self.bead.rate

    def start(self, phi: float) -> NDArray:
        """Uniform."""
        return phi ** (-1 / 3) * self.R[1:]

    def settle(self, r: NDArray) -> bool:
        """It has no surface state of its own."""
        return True

    def margin(self, r: NDArray) -> float:
        """Never lost, while shells keep their order and there is one front at most."""
        dense = self.phi(r) > self.middle
        if np.count_nonzero(dense[1:] != dense[:-1]) > 1:
            return -1.0
        return float(np.diff(r, prepend=0.0).min())

    def phi(self, r: NDArray) -> NDArray:
        """Polymer fraction of the shells."""
        return self.bead.shells(r)[1]

    def place(self, r: NDArray) -> str:
        """What it stands for."""
        return "in layers: its shells are too few, or it decomposes"


def solve(
    gel,
    programme: Programme,
    times: Sequence[float],
    cells: int,
    *,
    tolerance: float,
    model: str = "nonlinear",
    width: float | None = None,
    width_temperature: float | None = None,
) -> Loop:
    """The bead at the ``times`` (increasing from 0, in t_BMJ), T(t) that of the programme in K.

    ``tolerance`` is CVODE's for the radii.  With ``width``, of a flat interface at
    ``width_temperature`` in R_dry, the bead of `separation.diffuse` on uniform shells.  ValueError
    for other times, an unknown model or a start without equilibrium; RuntimeError if CVODE fails.
    """
    times = np.asarray(times, float)
    if times.ndim != 1 or times.size < 2 or times[0] != 0 or not np.all(np.diff(times) > 0):
        raise ValueError(f"times = {times}: must increase from 0")
    if model not in ENERGIES:
        raise ValueError(f"model = {model!r}: must be one of {list(ENERGIES)}")
    phi_0 = gel.equilibrium_polymer_fraction(programme.start)
    energy = ENERGIES[model](gel, programme.start)
    if width is None:
        system = Shells(energy, cells)
        tolerance = min(tolerance, THINNEST_SHARE * np.diff(system.R).min())
    else:
        at = programme.extremes[1] if width_temperature is None else width_temperature
        system = Diffuse(energy, cells, width, at)
    r = system.start(phi_0)
    energy.temperature = programme.start
    marks = programme.breaks
    begins = np.unique(np.append(0.0, marks[marks < times[-1]]))
    found, reached, lost = [r], [0.0], ""
    for begin, end in zip(begins, np.append(begins[1:], times[-1]), strict=True):
        energy.temperature = programme.at(begin)
        if not system.settle(r):
            lost = f"t = {begin:.6g}, T = {energy.temperature:.6g} K {system.place(r)}"
            break
        asked = times[(times > begin * (1 + 1e-12)) & (times <= end)]
        last, r, stopped = _segment(system, programme, begin, end, asked, r, tolerance)
        found += last[1]
        reached += last[0]
        if stopped is not None:
            energy.temperature = programme.at(stopped)
            lost = f"t = {stopped:.6g}, T = {energy.temperature:.6g} K {system.place(r)}"
            break
    states = np.array(found)
    phi = np.array([system.phi(each) for each in states])
    volume = np.diff(np.pad(states, ((0, 0), (1, 0))) ** 3, axis=1)
    error = np.abs((phi * volume).sum(axis=1) - 1).max()
    T = np.array([programme.at(each) for each in reached])
    return Loop(np.array(reached), T, states[:, -1], states, phi, float(error), lost)


def _segment(system, programme, begin, end, asked, r, tolerance):
    """Times asked for and their states, the last state, and when E = 0, up to ``end``."""
    from sksundae.cvode import CVODE

    def at(t):
        # the programme's value from the left at the end of the segment
        system.energy.temperature = programme.before(t) if t >= end else programme.at(t)

    system.energy = getattr(system, "energy", None) or system.bead.energy

    def rate(t, y, out):
        at(t)
        out[:] = system.rate(y)

    def jacobian(t, y, out, J):
        at(t)
        J[:] = banded(system.rate, y, np.diff(y, prepend=0.0))

    def stable(t, y, events):
        at(t)
        events[0] = system.margin(y)

    solver = CVODE(
        rate, jacfn=jacobian, rtol=tolerance, atol=ABSOLUTE * tolerance, linsolver="band",
        lband=2, uband=2, max_num_steps=MAX_STEPS, eventsfn=stable, num_events=1,
    )  # fmt: skip
    solver.init_step(begin, r)
    t, states = [], []
    for time in np.unique(np.append(asked, end)):
        step = solver.step(float(time), tstop=float(end))
        if not step.success:
            raise RuntimeError(f"CVODE at t = {step.t}: {step.message}")
        r = np.array(step.y)
        if step.i_events is not None:
            return (t, states), r, float(step.t)
        if isinstance(system, Shells):
            at(float(time))
            system.f = system.at_surface(r[-1])[0]
        if time in asked:
            t.append(float(step.t))
            states.append(r)
    return (t, states), r, None
