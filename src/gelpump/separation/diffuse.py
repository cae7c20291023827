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

A run is refused, or stopped in words (``gelpump.separation.watch``), unless PER_WIDTH shells lie
across the width on the swollen side and each step of CVODE's is sound.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump.separation import watch
from gelpump.separation.coexistence import equal_area
from gelpump.separation.watch import PER_WIDTH, WIDTH_AT

if TYPE_CHECKING:
    import xarray as xr
    from sksundae.cvode import CVODE

WIDEST = 0.1  # of the dry radius: beyond it interface and bead are one
DIFFERENCE = 1e-5  # of a Jacobian, over the thickness of a shell
ABSOLUTE = 0.01  # absolute tolerance over the relative one
MAX_STEPS = 50_000
TOLERANCE = 1e-7  # CVODE's, at most: more lets the energy rise
PER_SQUARE = 0.01  # the same, times the number of shells squared


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

    def faces(self, r: NDArray) -> tuple[NDArray, NDArray]:
        """R and r of all faces."""
        return self.R, np.append(0.0, r)

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


@dataclass(frozen=True)
class Step:
    """An accepted step of CVODE's, which interpolates within its last one."""

    time: float
    solution: NDArray
    solver: "CVODE"

    def at(self, t: float) -> NDArray:
        """The radii at a time within the step."""
        return np.array(self.solver.step(t).y)


def steps(bead: Bead, start: NDArray, end: float) -> Iterator[Step]:
    """From the radii ``start`` on, one accepted step at a time, the last of them at ``end``;
    RuntimeError when CVODE fails.

    A face's error changes the strain by itself over the thickness of a shell, and the rate by
    itself over its square; CVODE's tolerance is that much smaller.
    """
    from sksundae.cvode import CVODE

    tolerance = min(TOLERANCE, PER_SQUARE / start.size**2)

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
    )
    solver.init_step(0.0, start)
    yield Step(0.0, start, solver)
    for _ in range(MAX_STEPS):
        step = solver.step(end, method="onestep", tstop=end)
        if not step.success:
            raise RuntimeError(f"CVODE at t = {step.t}: {step.message}")
        yield Step(float(step.t), np.array(step.y), solver)
        if step.t >= end:
            return
    raise RuntimeError(f"CVODE at t = {step.t}: {MAX_STEPS} steps")


def kappa_of(energy, width: float) -> float:
    """kappa of interfaces as wide as ``width``; ValueError beyond a tenth of the bead."""
    if not 0.0 < width <= WIDEST:
        raise ValueError(
            f"width = {width}: must be at most {WIDEST}, beyond which it is as large as the bead"
        )
    return (width / width_per_root_kappa(energy)) ** 2


def require_resolved(width: float, thickest: float, cells: int) -> None:
    """ValueError unless PER_WIDTH cells of the ``thickest`` of an interface lie across it."""
    if width < PER_WIDTH * thickest:
        raise ValueError(
            f"width = {width}: must be at least {PER_WIDTH * thickest:.3g}, {PER_WIDTH:g} of "
            f"{cells} cells on the swollen side"
        )


def solve(
    energy,
    phi_initial: float,
    times: Sequence[float],
    cells: int,
    *,
    width: float,
    layers: bool = False,
) -> "xr.Dataset":
    """The bead of ``energy`` from uniform ``phi_initial``, interfaces as wide as ``width``.

    times: increasing from 0, in t_BMJ.  width: of a flat interface at WIDTH_AT, in R_dry.
    layers: whether more than one front is let pass, and told of.  The dataset is
    ``gelpump.separation.observed``; its energy is that of the shells, and a front is where phi
    passes the mean of the two phases at WIDTH_AT.

    Raises ValueError for a width that the shells do not resolve, or as large as the bead,
    UnderResolved when a run shows that it is, RuntimeError when CVODE fails.
    """
    times = np.asarray(times, dtype=float)
    bead = Bead(energy, kappa_of(energy, width), cells)
    require_resolved(width, 1 / (equal_area(energy, WIDTH_AT)[0] * WIDTH_AT**2) / cells, cells)
    start = float(phi_initial) ** (-1 / 3) * bead.R[1:]
    return watch.course(
        energy,
        bead,
        steps(bead, start, float(times[-1])),
        times,
        layers=layers,
        phi_initial=phi_initial,
        width=width,
        kappa=bead.kappa,
    )
