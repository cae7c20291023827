"""Swelling and drying of a spherical bead in the fully nonlinear model, on CVODE.

The free energy of eqn:app:helmholtz_free_energy without LENS's small deviatoric strains (Butler &
Montenegro-Johnson's model). R in [0, 1] is the dry radius of a material shell, r(R, t) where it
is; with the stretches l_r = dr/dR and l_t = r/R, the polymer fraction is f = 1/(l_r l_t^2) and the
effective stresses, from eqn:app:stress_from_energy, are

    s_r = -Pi(f, T)/mu + f l_r^2 - f^{1/3} ,     s_r - s_t = f (l_r^2 - l_t^2)

    dr/dt|_R = ds_r/dr + 2 (s_r - s_t)/r ,   r = 0 at R = 0 ,   s_r = 0 at R = 1 ,
    r(R, 0) = R phi_i^{-1/3} .

Lengths are in the dry radius, stresses in mu = mu_s(phi_00 = 1) = k_B T/Omega_p, times in
mu_l R_dry^2/(k mu): this is t_BMJ.

The equation is parabolic while the stiffness E = ds_r/d(ln l_r) > 0 at fixed l_t,

    E = phi dPi/dphi/mu + f^{1/3}/3 + f l_r^2 ;

E is D/mu where the deformation is isotropic. Beyond E = 0 it is ill-posed: phases separate.
At the surface s_r(f, l_t) = 0 holds at once (`gelpump.bead.stress_free`); where f_s runs into E = 0
(at 308 K in the first instant) phases separate there.

Discretisation. The unknowns are the radii of the shells' outer faces, so that a shell's polymer
fraction is exact. Faces lie at R = sin(pi s/2), s uniform: they cluster at the surface, where the
change begins. Stresses live at the mean square radius of a shell and are differenced in r^2, which
is exact for a parabola and keeps second order at the centre. Each face sees its two shells (the
surface also f_s), hence the banded Jacobian.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gelpump import progress
from gelpump.bead.dataset import Loss, bead_dataset
from gelpump.bead.stress_free import StressFreeSurface, bounds

if TYPE_CHECKING:
    import xarray as xr

    from gelpump.materials import Gel

LOSS = "the radial stress no longer grows with the radial stretch"
THINNEST_SHARE = 0.01
MAX_EVALUATIONS = 300_000  # of the rate; production needs some thousands
AGREEMENT = 2e-4  # of the times at which two courses end, relative
CONFIRMATIONS = 8  # at most; one is the rule
ABSOLUTE = 0.01  # absolute tolerance over the relative one: radii are of order one


class Bead:
    """The equations of the shells' outer face radii r, shape (cells,)."""

    def __init__(self, gel: Gel, temperature: float, phi_initial: float, cells: int) -> None:
        self.R = np.sin(np.pi / 2 * np.linspace(0, 1, cells + 1))
        self.volume = np.diff(self.R**3)
        self.mean_square = 0.6 * np.diff(self.R**5) / self.volume
        square = self.R[1:] ** 2
        # of each shell, in R^2: from its outer face to its mean, over the distance of two faces
        spacing = np.diff(square)
        self.inward = (self.mean_square - square) / np.append(spacing[0], spacing)
        # of each inner face: where between the means of its two shells it lies
        self.between = (square[:-1] - self.mean_square[:-1]) / np.diff(self.mean_square)
        self.bounds = bounds(gel)
        self.surface = StressFreeSurface(gel, temperature, phi_initial)

    def polymer_fraction(self, r: NDArray) -> NDArray:
        """f of each shell: its dry volume over its volume."""
        volume = r * r * r
        volume[1:] -= volume[:-1].copy()
        low, high = self.bounds  # a shell that is turned inside out counts as densest
        return np.maximum(self.volume / np.maximum(volume, self.volume / high), low)

    def hoop_stretch(self, r: NDArray) -> NDArray:
        """l_t of each shell: r/R is even in R, so it is taken linear in R^2, to the centre too."""
        stretch = r / self.R[1:]
        rise = np.empty_like(stretch)
        np.subtract(stretch[1:], stretch[:-1], out=rise[1:])
        rise[0] = rise[1]
        return stretch + rise * self.inward

    def rate(self, r: NDArray) -> NDArray:
        """dr/dt of the faces."""
        f, l_t = self.polymer_fraction(r), self.hoop_stretch(r)
        stretch = r / self.R[1:]
        f_s = self.surface.at(stretch[-1]).polymer_fraction
        cells = f.size
        stress, square, face = np.zeros(cells + 1), np.empty(cells + 1), np.empty(cells)
        stress[:-1] = self.surface.radial_stress(f, l_t)
        square[:-1], square[-1] = l_t**2 * self.mean_square, r[-1] ** 2
        face[:-1], face[-1] = f[:-1] + self.between * (f[1:] - f[:-1]), f_s
        gradient = 2 * r * (stress[1:] - stress[:-1]) / (square[1:] - square[:-1])
        hoop = stretch**2
        return gradient + 2 / r * (1 / (face * hoop**2) - face * hoop)

    def jacobian(self, r: NDArray, J: NDArray) -> None:
        """Fill J with d(rate)/dr, tridiagonal, by central differences.

        CVODE's own differences step by 1e-8 of r, too far and too coarse for shells that are as
        thin as 1e-5: its Newton iteration then stalls.
        """
        thickness = np.diff(r, prepend=0.0)
        step = 1e-4 * np.minimum(thickness, np.append(thickness[1:], np.inf))
        for first in range(3):
            j = np.arange(first, r.size, 3)
            shift = np.zeros(r.size)
            shift[j] = step[j]
            change = self.rate(r + shift) - self.rate(r - shift)
            for offset in (-1, 0, 1):
                column = j[(j + offset >= 0) & (j + offset < r.size)]
                J[column + offset, column] = change[column + offset] / (2 * step[column])

    def margin(self, r: NDArray) -> float:
        """Positive while the model is parabolic everywhere; falls through zero where it is lost."""
        inside = self.surface.stiffness(self.polymer_fraction(r), self.hoop_stretch(r)).min()
        return min(inside, self.surface.at(r[-1]).margin)

    def loss(self, t: float, r: NDArray) -> Loss:
        """What is lost at time t: the shell, or the surface, of least stiffness."""
        f, l_t = self.polymer_fraction(r), self.hoop_stretch(r)
        stiffness = self.surface.stiffness(f, l_t)
        surface = self.surface.at(r[-1])
        i = int(np.argmin(stiffness))
        if stiffness[i] < surface.margin:
            return Loss(t, float(l_t[i] * np.sqrt(self.mean_square[i])), float(f[i]), LOSS)
        return Loss(t, float(r[-1]), float(surface.polymer_fraction), LOSS)


def solve(
    gel: Gel,
    temperature: float,
    phi_initial: float,
    times: Sequence[float],
    cells: int,
    *,
    tolerance: float,
) -> xr.Dataset:
    """The bead from uniform `phi_initial`, at constant `temperature` for t > 0.

    times: increasing from 0, in t_BMJ. cells: number of shells, at least 3. tolerance: CVODE's,
    for the face radii; a hundredth of the thinnest shell if that is less. The dataset has dims
    (t, cell) and face: radius(t), r(t, cell) where a shell's stress lives, r_face(t, face),
    polymer_fraction(t, cell), surface_polymer_fraction(t), polymer_volume_error(t). When phases
    separate it ends there, and its attribute `stopped` says at which t, r and phi; otherwise
    `stopped` is empty.

    Raises ValueError for a phi_initial outside the gel's bounds, other times or too few cells, and
    RuntimeError when CVODE fails, takes more steps than any bead needs, or ends elsewhere with each
    tolerance.
    """
    times = np.asarray(times, dtype=float)
    low, high = gel.polymer_fraction_bounds
    if not low < phi_initial < high:
        raise ValueError(f"phi_initial = {phi_initial}: must be within ({low}, {high})")
    if times.ndim != 1 or times.size < 2 or times[0] != 0 or not np.all(np.diff(times) > 0):
        raise ValueError(f"times = {times}: must increase from 0")
    if cells < 3:
        raise ValueError(f"cells = {cells}: must be at least 3")

    bead = Bead(gel, temperature, phi_initial, cells)
    start = bead.R[1:] * phi_initial ** (-1 / 3)
    if bead.margin(start) <= 0:
        course = Course([0.0], [start], bead.loss(0.0, start), 0)
    else:
        # an error of the faces as large as a shell is thick would tangle them
        rtol = min(tolerance, THINNEST_SHARE * np.diff(bead.R).min())
        course = confirmed(bead, start, times, rtol)
        bead.surface.restart()  # follow the surface once more from its start
    faces = np.pad(course.r, ((0, 0), (1, 0)))
    if np.diff(faces, axis=1).min() <= 0:
        raise RuntimeError(f"shells tangled: tolerance = {tolerance} is too loose")
    later = [bead.surface.at(radius).polymer_fraction for radius in faces[1:, -1]]
    return bead_dataset(
        np.array(course.t),
        bead.R,
        faces,
        np.array([bead.surface.initial.polymer_fraction, *later]),
        course.loss,
        gel=gel.name,
        temperature=temperature,
        evaluations=course.evaluations,
    )


class Course(NamedTuple):
    """Face radii r at the times t, what ended them (None: the last time), and what they took."""

    t: list[float]
    r: list[NDArray]
    loss: Loss | None
    evaluations: int


def confirmed(bead: Bead, start: NDArray, times: NDArray, rtol: float) -> Course:
    """The course to the last of the ``times``, or to where E = 0 whatever the tolerance.

    CVODE bounds the root mean square of the errors of all faces, so that a single one may be off by
    sqrt(cells) of it: far enough for a step to end in another solution of its equations, in which
    the outermost shell has collapsed to E < 0. So an end is believed when the course ends there
    with that factor in the tolerance as well.
    """
    course = integrated(bead, start, times, rtol)
    if course.loss is None:
        return course
    for _ in range(CONFIRMATIONS):
        before, rtol = course, rtol / np.sqrt(len(start))
        course = integrated(bead, start, times, rtol)
        if abs(course.t[-1] - before.t[-1]) <= AGREEMENT * before.t[-1]:
            return course
    raise RuntimeError(
        f"phases separate at t = {before.t[-1]:.6g} or {course.t[-1]:.6g}: it depends on CVODE's "
        f"tolerance, down to {rtol:.2g}"
    )


def integrated(bead: Bead, start: NDArray, times: NDArray, rtol: float) -> Course:
    """From ``start`` on by CVODE, up to the last of the ``times`` or E = 0.

    E is judged at the ends of CVODE's steps, and between them only to find where it vanishes.
    """
    from sksundae.cvode import CVODE

    def rate(t, r, drdt):
        drdt[:] = bead.rate(r)

    def jacobian(t, r, drdt, J):
        bead.jacobian(r, J)

    def parabolic(t, r, events):
        events[0] = bead.margin(r)

    bead.surface.restart()
    solver = CVODE(
        rate,
        rtol=rtol,
        atol=ABSOLUTE * rtol,
        linsolver="band",
        lband=1,
        uband=1,
        jacfn=jacobian,
        max_num_steps=20_000,
        eventsfn=parabolic,
        num_events=1,
    )
    solver.init_step(0.0, start)
    t, r = [0.0], [start]
    for time in times[1:]:
        step = solver.step(time)
        if not step.success:
            raise RuntimeError(f"CVODE at t = {step.t}: {step.message}")
        progress.at(float(step.t), float(times[-1]))
        t.append(float(step.t))
        r.append(np.array(step.y))
        if step.nfev > MAX_EVALUATIONS:
            raise RuntimeError(f"CVODE at t = {step.t}: {step.nfev} evaluations of the rate")
        if step.i_events is not None:
            return Course(t, r, bead.loss(float(step.t), r[-1]), int(step.nfev))
    return Course(t, r, None, int(step.nfev))


def solve_meshes(
    gel: Gel,
    temperature: float,
    phi_initial: float,
    times: Sequence[float],
    cells: Sequence[int],
    *,
    tolerance: float,
) -> list[xr.Dataset]:
    """The same bead on several meshes, one after the other."""
    return [solve(gel, temperature, phi_initial, times, n, tolerance=tolerance) for n in cells]
