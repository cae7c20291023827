"""A bead with interfaces, watched at every step that its integrator accepts.

Too few cells across an interface give layers that are not there, with an energy that falls and a
smooth radius.  So of each accepted step, not of each output, it is asserted that the energy falls,
that the cells hold the bead's polymer and keep their order, that at least PER_WIDTH of them would
lie across a flat interface as steep as the steepest place, and that there is one front at most.
"""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from gelpump import progress
from gelpump.separation import observed
from gelpump.separation.coexistence import equal_area
from gelpump.separation.shells import LOST

if TYPE_CHECKING:
    import xarray as xr

WIDTH_AT = 2.0  # hoop stretch of the flat interface
PER_WIDTH = 3.0  # cells across a width
RISE = 1e-9  # of the energy in a step, relative, that is the integrator's


class UnderResolved(RuntimeError):
    """The cells do not resolve what happens: its words say what was met, and when."""


class Step(Protocol):
    """An accepted step: its end, and any time within it (``bdf.Step`` is one)."""

    time: float
    solution: NDArray

    def at(self, t: float) -> NDArray:
        """The solution at a time within."""


class Watch:
    """The states of one run: what is asserted of them, and what they tell."""

    def __init__(self, sides: tuple[float, float], layers: bool):
        self.sides, self.layers = sides, layers
        self.energy, self.cells, self.most = np.inf, np.inf, 0
        self.events: dict[str, float] = {}
        self.wavelength = 0.0

    def fronts(self, R: NDArray, r: NDArray) -> NDArray:
        """(R, r) wherever phi passes the mean of the two phases, from the centre outwards."""
        phi, middle = np.diff(R**3) / np.diff(r**3), 0.5 * sum(self.sides)
        i = np.flatnonzero((phi[1:] > middle) != (phi[:-1] > middle))
        share = (middle - phi[i]) / (phi[i + 1] - phi[i])
        at = (0.5 * (each[1:] + each[:-1]) for each in (R, r))
        return np.column_stack([x[i] + share * (x[i + 1] - x[i]) for x in at])

    def see(self, t: float, R: NDArray, r: NDArray, energy: float) -> None:
        """UnderResolved unless this state may follow the one before."""
        if not (np.diff(r).min() > 0 and np.diff(R).min() > 0):
            raise UnderResolved(f"at t = {t:.6g} shells are tangled: the tolerance is too loose")
        if abs(R[-1] ** 3 - 1) > LOST:
            raise UnderResolved(f"at t = {t:.6g} cells hold {R[-1] ** 3:.12g} of the polymer")
        if energy > self.energy + RISE * abs(self.energy):
            raise UnderResolved(f"at t = {t:.6g} the energy rises by {energy - self.energy:.3g}")
        self.energy = energy
        phi = np.diff(R**3) / np.diff(r**3)
        steepest = float(np.abs(np.diff(phi)).max(initial=1e-300))
        cells = (self.sides[1] - self.sides[0]) / steepest
        if cells < PER_WIDTH:
            raise UnderResolved(
                f"at t = {t:.6g} there are {cells:.2g} cells across a width, of {PER_WIDTH:g}"
            )
        self.cells = min(self.cells, cells)
        found = self.fronts(R, r)
        if len(found) > 1 and not self.layers:
            raise UnderResolved(
                f"at t = {t:.6g} there are {len(found)} fronts, not one: the bead decomposes "
                "into layers, or its shells are too few"
            )
        if len(found):
            self.events.setdefault("birth_t", t)
            self.events.setdefault("birth_radius", float(r[-1]))
            self.events.pop("completion_t", None)
        elif "birth_t" in self.events:
            self.events.setdefault("completion_t", t)
        if len(found) > max(self.most, 1):
            self.wavelength = float(2 * np.diff(found[[0, -1], 1])[0] / (len(found) - 1))
        self.most = max(self.most, len(found))


def course(
    energy, bead, steps: Iterable[Step], times: NDArray, *, layers: bool, **attributes
) -> "xr.Dataset":
    """The dataset ``observed`` of the ``steps`` of a bead that has ``faces`` and ``energy_of``,
    at the ``times``; UnderResolved if it is not sound at one of its steps."""
    watch, kept, due = Watch(equal_area(energy, WIDTH_AT), layers), [], list(times)
    for step in steps:
        progress.at(step.time, float(times[-1]))
        watch.see(step.time, *bead.faces(step.solution), bead.energy_of(step.solution))
        while due and due[0] <= step.time:
            y = step.at(due[0]) if due[0] < step.time else step.solution
            kept.append((due.pop(0), *bead.faces(y), bead.energy_of(y)))
    t, R, r, E = (np.array(each) for each in zip(*kept, strict=True))
    found = [watch.fronts(*each) for each in zip(R, r, strict=True)]
    front = np.array([each[-1] if len(each) else (np.nan, np.nan) for each in found])
    surface = np.diff(R**3)[:, -1] / np.diff(r**3)[:, -1]
    events = watch.events | {"fronts": watch.most, "least_cells_per_width": watch.cells}
    if watch.most > 1:
        events["wavelength"] = watch.wavelength
    run = observed.dataset(energy, t, R, r, surface, front, attributes | events)
    return run.assign(energy=run.energy.copy(data=E))
