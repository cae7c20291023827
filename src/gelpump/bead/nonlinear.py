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
At the surface s_r(f, l_t) = 0 holds at once; f_s stays on the interval of E > 0 it starts from, and
when that interval holds no stress-free state (at 308 K from the first instant) E = 0 is met there.

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

if TYPE_CHECKING:
    import xarray as xr

    from gelpump.materials import Gel

LOSS = "the radial stress no longer grows with the radial stretch"
THINNEST_SHARE = 0.01
MAX_EVALUATIONS = 300_000  # of the rate; production needs some thousands
ABSOLUTE = 0.01  # absolute tolerance over the relative one: radii are of order one
NEWTON_SQUARE = 1e-12  # of a last correction, over E: what it leaves, far below any tolerance
MARGIN = 1e-9  # trial steps of CVODE may tangle shells: keeps their f within the gel's bounds


class Surface(NamedTuple):
    """Surface state: polymer fraction, stiffness E, and the stress that E > 0 cannot relieve."""

    polymer_fraction: float
    stiffness: float
    stress: float


class Bead:
    """The equations of the shells' outer face radii r, shape (cells,)."""

    def __init__(self, gel: Gel, temperature: float, phi_initial: float, cells: int) -> None:
        self.gel, self.temperature = gel, temperature
        self.mu = gel.shear_modulus(1.0)
        self.R = np.sin(np.pi / 2 * np.linspace(0, 1, cells + 1))
        self.volume = np.diff(self.R**3)
        self.mean_square = 0.6 * np.diff(self.R**5) / self.volume
        square = self.R[1:] ** 2
        # of each shell, in R^2: from its outer face to its mean, over the distance of two faces
        spacing = np.diff(square)
        self.inward = (self.mean_square - square) / np.append(spacing[0], spacing)
        # of each inner face: where between the means of its two shells it lies
        self.between = (square[:-1] - self.mean_square[:-1]) / np.diff(self.mean_square)
        low, high = gel.polymer_fraction_bounds
        self.bounds = low + MARGIN, min(high - MARGIN, 1 / MARGIN)
        self.follow_surface(phi_initial)

    def radial_stress(self, f, l_t):
        """s_r at polymer fraction f and hoop stretch l_t."""
        osmotic = self.gel.osmotic_pressure(f, self.temperature) / self.mu
        return -osmotic + 1 / (f * l_t**4) - np.cbrt(f)

    def stiffness(self, f, l_t):
        """E = ds_r/d(ln l_r) at fixed l_t, which is also -f ds_r/df."""
        osmotic = self.gel.osmotic_modulus(f, self.temperature) / self.mu
        return osmotic + np.cbrt(f) / 3 + 1 / (f * l_t**4)

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
        f_s = self.surface(stretch[-1]).polymer_fraction
        cells = f.size
        stress, square, face = np.zeros(cells + 1), np.empty(cells + 1), np.empty(cells)
        stress[:-1] = self.radial_stress(f, l_t)
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

    def follow_surface(self, f: float, l_t: float = 1.0, stiffness: float = np.inf) -> None:
        """Let the next surface be sought from that with polymer fraction f at hoop stretch l_t.

        d(ln f)/d(ln l_t) = -4/(f l_t^4 E) along stress-free surfaces; unknown yet, it is zero.
        """
        self.followed = f, l_t, -4 / (f * l_t**4 * stiffness)

    def surface(self, l_t: float) -> Surface:
        """Stress-free surface at hoop stretch l_t, on the last one's interval of E > 0."""
        last, l_t_last, power = self.followed
        ratio = l_t / l_t_last
        if not 0.5 < ratio < 2:  # CVODE also tries beads that are turned inside out
            return self._search(l_t)
        f = last * ratio**power
        if not abs(f - last) < 0.05 * last * (1 - last):
            return self._search(l_t)
        for _ in range(10):
            stiffness = self.stiffness(f, l_t)
            change = self.radial_stress(f, l_t) / stiffness  # of ln f
            if stiffness <= 0 or abs(change) > 0.05 * (1 - f):
                return self._search(l_t)
            f *= 1 + change
            if change**2 < NEWTON_SQUARE * min(1.0, stiffness):
                break
        self.follow_surface(f, l_t, stiffness)
        return Surface(f, stiffness, 0.0)

    def _search(self, l_t: float) -> Surface:
        from scipy.optimize import brentq

        f = self.followed[0]
        stress = self.radial_stress(f, l_t)
        # the stress falls with f while E > 0, so its root lies above f if it is positive
        f = np.geomspace(f, self.bounds[1 if stress > 0 else 0], 2000)
        parabolic = np.logical_and.accumulate(self.stiffness(f, l_t) > 0)
        relieved = np.flatnonzero(parabolic & (self.radial_stress(f, l_t) * stress <= 0))
        if relieved.size:
            ends = f[max(relieved[0] - 1, 0)], f[relieved[0]]
            root = brentq(self.radial_stress, *ends, args=(l_t,), xtol=1e-15)
            self.follow_surface(root, l_t, self.stiffness(root, l_t))
            return Surface(root, self.stiffness(root, l_t), 0.0)
        last = max(np.count_nonzero(parabolic) - 1, 0)
        return Surface(f[last], 0.0, self.radial_stress(f[last], l_t))

    def margin(self, r: NDArray) -> float:
        """Positive while the model is parabolic everywhere; falls through zero where it is lost."""
        inside = self.stiffness(self.polymer_fraction(r), self.hoop_stretch(r)).min()
        surface = self.surface(r[-1])
        return min(inside, surface.stiffness - abs(surface.stress))

    def loss(self, t: float, r: NDArray) -> Loss:
        """What is lost at time t: the shell, or the surface, of least stiffness."""
        f, l_t = self.polymer_fraction(r), self.hoop_stretch(r)
        stiffness = self.stiffness(f, l_t)
        surface = self.surface(r[-1])
        i = int(np.argmin(stiffness))
        if stiffness[i] < surface.stiffness - abs(surface.stress):
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
    RuntimeError when CVODE fails or takes more steps than any bead needs.
    """
    from sksundae.cvode import CVODE

    times = np.asarray(times, dtype=float)
    low, high = gel.polymer_fraction_bounds
    if not low < phi_initial < high:
        raise ValueError(f"phi_initial = {phi_initial}: must be within ({low}, {high})")
    if times.ndim != 1 or times.size < 2 or times[0] != 0 or not np.all(np.diff(times) > 0):
        raise ValueError(f"times = {times}: must increase from 0")
    if cells < 3:
        raise ValueError(f"cells = {cells}: must be at least 3")

    bead = Bead(gel, temperature, phi_initial, cells)
    # an error of the faces as large as a shell is thick would tangle them
    rtol = min(tolerance, THINNEST_SHARE * np.diff(bead.R).min())

    def rate(t, r, drdt):
        drdt[:] = bead.rate(r)

    def jacobian(t, r, drdt, J):
        bead.jacobian(r, J)

    def parabolic(t, r, events):
        events[0] = bead.margin(r)

    start = bead.R[1:] * phi_initial ** (-1 / 3)
    t, r, loss, evaluations = [0.0], [start], None, 0
    if bead.margin(start) <= 0:
        loss = bead.loss(0.0, start)
    else:
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
        for time in times[1:]:
            step = solver.step(time)
            if not step.success:
                raise RuntimeError(f"CVODE at t = {step.t}: {step.message}")
            progress.at(float(step.t), float(times[-1]))
            t.append(float(step.t))
            r.append(np.array(step.y))
            evaluations = int(step.nfev)
            if evaluations > MAX_EVALUATIONS:
                raise RuntimeError(f"CVODE at t = {step.t}: {evaluations} evaluations of the rate")
            if step.t < time:
                loss = bead.loss(float(step.t), r[-1])
                break
    bead.follow_surface(phi_initial)  # follow the surface once more from its start
    if np.min(np.diff(r, axis=1, prepend=0.0)) <= 0:
        raise RuntimeError(f"shells tangled: tolerance = {tolerance} is too loose")
    surface = [bead.surface(row[-1]).polymer_fraction for row in r]
    return bead_dataset(
        np.array(t),
        bead.R,
        np.pad(r, ((0, 0), (1, 0))),
        np.array(surface),
        loss,
        gel=gel.name,
        temperature=temperature,
        evaluations=evaluations,
    )


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
