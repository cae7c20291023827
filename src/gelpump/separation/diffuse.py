r"""A bead that separates, with an energy of interfaces: no front is put in, none is followed.

To the energy of ``gelpump.separation.energy`` one of gradients is added, per current volume,

    E / 4 pi = Integral W R^2 dR + w(a) + Integral (kappa/2) phi_r^2 r^2 dr

and the flow dr/dt = -(1/r^2) dE/dr / 4 pi is well-posed where E < 0 too.  Its natural conditions at
the surface are phi_r = 0 and s_r + kappa phi phi_rr = traction.  kappa is given as the width of a
flat interface at hoop stretch WIDTH_AT, its jump of phi over its steepest slope:

    (kappa/2) phi_r^2 = f(phi) = phi [W - W_1 - S (J - J_1)] ,
    width = (phi_dry - phi_swollen) sqrt(kappa / (2 max f)) .

Discretisation.  The energy is written for shells, uniform in R: W at a shell's J and mean r/R, the
gradient between the middles of two shells.  The rate is its exact derivative with respect to the
radii of the faces, so that the energy of the shells can only fall; a face sees two shells on either
side, and CVODE gets the five diagonals.

Too few shells across an interface would give layers that are not there, with an energy that falls
and a smooth radius.  A run is refused, or stopped in words, unless PER_WIDTH shells lie across the
width on the swollen side, shells keep their order, energy falls and there is one front at most.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump import progress
from gelpump.separation import observed
from gelpump.separation.coexistence import equal_area

if TYPE_CHECKING:
    import xarray as xr

WIDTH_AT = 2.0  # the hoop stretch
PER_WIDTH = 3.0  # shells across a width
WIDEST = 0.1  # of the dry radius: beyond it interface and bead are one
DIFFERENCE = 1e-5  # of a Jacobian, over the thickness of a shell
ABSOLUTE = 0.01  # absolute tolerance over the relative one
RISE = 1e-9  # of the energy between two outputs, relative, that is the integrator's
MAX_STEPS = 50_000


class UnderResolved(RuntimeError):
    """The shells do not resolve what happens: its words say what was met, and when."""


def width_per_root_kappa(energy, l_t: float = WIDTH_AT) -> float:
    """Width of a flat interface at hoop stretch l_t over sqrt(kappa)."""
    swollen, dry = equal_area(energy, l_t)
    S, W = energy.radial_stress(swollen, l_t), energy.density(swollen, l_t)
    phi = np.linspace(swollen, dry, 2001)
    f = phi * (energy.density(phi, l_t) - W - S * (1 / phi - 1 / swollen))
    return float((dry - swollen) / np.sqrt(2 * f.max()))


class Bead:
    """The shells' energy, and the rate of the radii r of their outer faces."""

    def __init__(self, energy, kappa: float, cells: int):
        self.energy, self.kappa = energy, kappa
        self.R = np.linspace(0.0, 1.0, cells + 1)
        self.dry = np.diff(self.R**3)
        self.twice = self.R[1:] + self.R[:-1]

    def shells(self, r: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        """r of all faces, phi and mean l_t of the shells."""
        faces = np.append(0.0, r)
        volume = np.diff(faces**3)
        phi = np.clip(self.dry / np.where(volume > 0, volume, self.dry), 1e-9, 1 - 1e-9)
        return faces, phi, (faces[1:] + faces[:-1]) / self.twice

    def energy_of(self, r: NDArray) -> float:
        """E / 4 pi."""
        faces, phi, l_t = self.shells(r)
        apart = 0.5 * (faces[2:] - faces[:-2])
        gradients = 0.5 * self.kappa * np.diff(phi) ** 2 * faces[1:-1] ** 2 / apart
        bulk = self.energy.density(phi, l_t) * self.dry / 3
        return float(bulk.sum() + gradients.sum() + self.energy.surface_energy(r[-1]))

    def rate(self, r: NDArray) -> NDArray:
        """dr/dt: minus dE/dr over the volume from the middle of a face's shells to the next."""
        faces, phi, l_t = self.shells(r)
        apart = 0.5 * (faces[2:] - faces[:-2])
        slope = np.diff(phi) / apart
        square = faces[1:-1] ** 2
        # dE/dphi of each shell, of the gradients that it has part in
        pull = np.zeros_like(phi)
        pull[:-1] -= self.kappa * slope * square
        pull[1:] += self.kappa * slope * square
        s = self.energy.radial_stress(phi, l_t) - pull * 3 * phi**2 / self.dry
        hoop = -2 / (phi * l_t) * self.energy.stress_difference(phi, l_t)
        hoop *= self.dry / (3 * self.twice)
        push = faces[1:] ** 2 * np.append(s[:-1] - s[1:], s[-1] - self.energy.traction(r[-1]))
        push += hoop
        push[:-1] += hoop[1:]
        # the gradients' own dependence on the radii: r^2 / apart
        half = 0.25 * self.kappa * slope**2
        push[:-1] += self.kappa * slope**2 * apart * faces[1:-1]
        push[1:] -= half * square
        push[:-2] += half[1:] * square[1:]
        middle = 0.5 * (faces[1:] + faces[:-1])
        return -push / (np.diff(np.append(middle, faces[-1]) ** 3) / 3)

    def jacobian(self, r: NDArray, J: NDArray) -> None:
        """Fill J with d(rate)/dr, five diagonals."""
        thickness = np.diff(r, prepend=0.0)
        step = DIFFERENCE * np.minimum(thickness, np.append(thickness[1:], np.inf))
        for first in range(5):
            j = np.arange(first, r.size, 5)
            shift = np.zeros(r.size)
            shift[j] = step[j]
            change = self.rate(r + shift) - self.rate(r - shift)
            for offset in range(-2, 3):
                column = j[(j + offset >= 0) & (j + offset < r.size)]
                J[column + offset, column] = change[column + offset] / (2 * step[column])


def solve(
    energy,
    phi_initial: float,
    times: Sequence[float],
    cells: int,
    *,
    width: float,
    tolerance: float = 1e-6,
) -> "xr.Dataset":
    """The bead of ``energy`` from uniform ``phi_initial``, interfaces as wide as ``width``.

    times: increasing from 0, in t_BMJ.  width: of a flat interface at WIDTH_AT, in R_dry.  The
    dataset is ``gelpump.separation.observed``; its energy is that of the shells, and a front is
    where phi passes the mean of the two phases at WIDTH_AT.

    Raises ValueError for a width that the shells do not resolve, or as large as the bead,
    UnderResolved when a run shows that it is, RuntimeError when CVODE fails.
    """
    times = np.asarray(times, dtype=float)
    sides = equal_area(energy, WIDTH_AT)
    stretch = 1 / (sides[0] * WIDTH_AT**2)
    least = PER_WIDTH * stretch / cells
    if not least <= width <= WIDEST:
        raise ValueError(
            f"width = {width}: must be at least {least:.3g}, {PER_WIDTH:g} shells of {cells} on "
            f"the swollen side, and at most {WIDEST}, beyond which it is as large as the bead"
        )
    bead = Bead(energy, (width / width_per_root_kappa(energy)) ** 2, cells)
    t, states = _integrate(bead, float(phi_initial) ** (-1 / 3) * bead.R[1:], times, tolerance)
    middle = 0.5 * sum(sides)
    r = np.pad(states, ((0, 0), (1, 0)))
    E = np.array([bead.energy_of(each) for each in states])
    fronts = [_fronts(bead, each, middle) for each in states]
    for i, found in enumerate(fronts):
        if len(found) > 1:
            raise UnderResolved(
                f"at t = {t[i]:.6g} there are {len(found)} fronts, not one: the bead decomposes "
                "into layers, or its shells are too few"
            )
        if i and E[i] > E[i - 1] + RISE * abs(E[i - 1]):
            raise UnderResolved(f"at t = {t[i]:.6g} the energy rises by {E[i] - E[i - 1]:.3g}")
        if np.diff(r[i]).min() <= 0.0:
            raise UnderResolved(f"at t = {t[i]:.6g} shells are tangled: tolerance {tolerance}")
    front = np.array([found[0] if found else (np.nan, np.nan) for found in fronts])
    events = {}
    if (met := np.flatnonzero(np.isfinite(front[:, 0]))).size:
        events = {"birth_t": float(t[met[0]])}
        if met[-1] + 1 < t.size:
            events["completion_t"] = float(t[met[-1] + 1])
    dry = np.broadcast_to(bead.R, r.shape)
    surface = np.array([bead.shells(each)[1][-1] for each in states])
    attributes = {"phi_initial": phi_initial, "width": width, "kappa": bead.kappa}
    run = observed.dataset(energy, t, dry, r, surface, front, attributes | events)
    return run.assign(energy=run.energy.copy(data=E))


def _integrate(bead, start, times, tolerance):
    """Times and states of CVODE's."""
    from sksundae.cvode import CVODE

    def rate(t, r, drdt):
        drdt[:] = bead.rate(r)

    def jacobian(t, r, drdt, J):
        bead.jacobian(r, J)

    solver = CVODE(
        rate,
        jacfn=jacobian,
        rtol=tolerance,
        atol=ABSOLUTE * tolerance,
        linsolver="band",
        lband=2,
        uband=2,
        max_num_steps=MAX_STEPS,
    )
    solver.init_step(0.0, start)
    t, states = [0.0], [start]
    for time in times[1:]:
        step = solver.step(time)
        if not step.success:
            raise RuntimeError(f"CVODE at t = {step.t}: {step.message}")
        progress.at(float(step.t), float(times[-1]))
        t.append(float(step.t))
        states.append(np.array(step.y))
    return np.array(t), np.array(states)


def _fronts(bead, r, middle):
    """(R, r) wherever phi passes ``middle``, linear between the middles of shells."""
    faces, phi, _ = bead.shells(r)
    i = np.flatnonzero((phi[1:] > middle) != (phi[:-1] > middle))
    share = (middle - phi[i]) / (phi[i + 1] - phi[i])
    at = [0.5 * (each[1:] + each[:-1]) for each in (bead.R, faces)]
    return [
        tuple(x[k] + part * (x[k + 1] - x[k]) for x in at) for k, part in zip(i, share, strict=True)
    ]
