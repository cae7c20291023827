r"""Swelling and drying of a spherical bead in the LENS model, on FiPy.

Equations (section 2, eqn:lens_transport; q = 0 by spherical symmetry), for r < a(t):

    phi_t = r^-2 (r^2 D phi_r)_r ,    phi_r(0, t) = 0 ,    da/dt = -(D / phi) phi_r  at r = a

and at the surface sigma_rr = 0 with p = 0, where eps_rr = (2/3) div(xi) - 2 xi / r gives

    Pi(phi_s, T) = 4 mu_s [ 1/a - phi_s^(1/3) ] .

Lengths are in the dry radius (phi = 1), stresses in mu = mu_s(phi_00 = 1) (k_B T / Omega_p for the
energy-based gel), times in mu_l R_dry^2 / (k mu): this is t_BMJ.

Discretisation.  In the dry radius R of a material shell, polymer conservation is R^3 = const, and
u = r^3 obeys a local equation with no moving mesh and no convection:

    u_t = -(6 r^4 / R) dPsi / d(R^2) ,    1/phi = J = du / d(R^3) ,    Psi(phi) = Integral_0^phi D

The unknowns are u at the outer faces of the shells, so a shell's volume, its polymer and its phi
are exact by construction.  Psi lives in the shells, at their mean R^2 (which makes the difference
exact for a parabolic profile, so the centre keeps second order), and at the surface, where
Psi_s = Psi(phi_s(a)).  Divided by the geometric factor, the backward-difference equation of face i

    G_i = (alpha u_i + history_i) R_i dS_i / (6 u_i^(4/3)) + Psi_(i+1/2) - Psi_(i-1/2) ,

dS_i being the distance of its shells in R^2, has a tridiagonal Jacobian that *is* a finite-volume
diffusion operator, with face conductance D phi^2 / dR^3: one FiPy sweep is one Newton step,
quadratically convergent, surface condition and moving radius included.  Several meshes of the same
bead advance in the same sweeps.

Longer than 300 lines: equation, discretisation and Newton's matrix are read side by side.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from gelpump import bdf
from gelpump.bead.dataset import Loss, bead_dataset
from gelpump.finite_volume import NewtonSweep

if TYPE_CHECKING:
    import xarray as xr

FIRST_STEP = 1e-10
NEWTON_LIMIT = 8
TABULATED = 129  # states of the surface, from which Newton's method sets out
SURFACE_LIMIT = 100  # of its iterations, more than bisection takes
ROUNDED = 1e-15  # change of phi_s, relative, that is rounding
MARGIN = 1e-12  # from the ends of the admissible polymer fractions
FORGETTING = 0.9  # of the curvature measured before, when it is measured anew
NEWTON_SHARE = 0.03  # of the time tolerance, which the Newton iteration may leave


class PhaseSeparation(bdf.Barrier):
    """D < 0 at the polymer fraction phi and radius r: spinodal decomposition begins."""

    def __init__(self, phi: float, r: float):
        super().__init__(f"D < 0 at phi = {phi:.6g}, r = {r:.6g}")
        self.phi, self.r = phi, r


class Shells:
    """Material shells of one or more beads, in the dry radius; faces cluster at the surface.

    Faces lie at R = sin(pi s / 2), s uniform in [0, 1]; arrays run over all beads one after the
    other, shell i lying between the faces i - 1 and i.
    """

    def __init__(self, cells: Sequence[int]):
        dry_radius = [np.sin(0.5 * np.pi * np.linspace(0.0, 1.0, n + 1)) for n in cells]
        self.cells = tuple(cells)
        self.R = np.concatenate([R[1:] for R in dry_radius])
        self.thinnest = min(float(np.diff(R).min()) for R in dry_radius)
        self.volume = np.concatenate([np.diff(R**3) for R in dry_radius])
        mean_square = [0.6 * np.diff(R**5) / np.diff(R**3) for R in dry_radius]
        self.gap = np.concatenate([np.diff(S, append=1.0) for S in mean_square])
        self.outer = np.cumsum(cells) - 1
        self.inner = np.concatenate([[0], self.outer[:-1] + 1])

    def jump(self, u: np.ndarray) -> np.ndarray:
        """u_i - u_(i-1), with u = 0 at each centre."""
        jump = np.diff(u, prepend=0.0)
        jump[self.inner] = u[self.inner]
        return jump


@dataclass(frozen=True)
class Surface:
    """The stress-free surface: polymer fraction phi_s(a) on one interval of D > 0.

    h(phi) = Pi(phi, T) / mu + 4 phi^(1/3) has h' = D / (mu phi), so h = 4/a has one root while
    D > 0.  Where a spinodal interrupts, the surface stays on the side of the initial state until
    its root is lost.
    """

    gel: object
    temperature: float
    lower: float
    upper: float

    @classmethod
    def around(cls, gel, temperature: float, phi: float) -> "Surface":
        """The interval of D > 0 that holds phi; PhaseSeparation if D(phi) < 0."""
        if gel.diffusivity(phi, temperature) < 0.0:
            raise PhaseSeparation(phi, phi ** (-1 / 3))
        bottom, top = gel.polymer_fraction_bounds
        roots = gel.spinodal_polymer_fractions(temperature)
        lower = roots[roots < phi].max(initial=bottom + MARGIN)
        upper = roots[roots > phi].min(initial=min(top - MARGIN, 1.0 / MARGIN))
        return cls(gel, temperature, float(lower), float(upper))

    def load(self, phi: float) -> float:
        """Function h of the class's docstring, equal to 4/a at a stress-free surface."""
        mu = self.gel.shear_modulus(1.0)
        return self.gel.osmotic_pressure(phi, self.temperature) / mu + 4.0 * np.cbrt(phi)

    @cached_property
    def _tabulated(self) -> tuple[np.ndarray, np.ndarray]:
        """phi across the interval, and h there: where to begin and between what to stay."""
        phi = np.geomspace(self.lower, self.upper, TABULATED)
        return phi, self.load(phi)

    def require(self, radius: np.ndarray) -> None:
        """PhaseSeparation if the interval holds no stress-free surface at one of the radii."""
        h = self._tabulated[1]
        for a, load in zip(radius, 4.0 / radius, strict=True):
            if not h[0] < load < h[-1]:
                raise PhaseSeparation(self.lower if load <= h[0] else self.upper, float(a))

    def polymer_fraction(self, radius: np.ndarray) -> np.ndarray:
        """phi_s of each radius a, shape of ``radius``; where the interval ends, its end.

        By Newton's method between bounds that close in on the root.
        """
        phi, h = self._tabulated
        wanted = np.clip(4.0 / radius, h[0], h[-1])
        above = np.clip(np.searchsorted(h, wanted), 1, TABULATED - 1)
        low, high = phi[above - 1], phi[above]
        found = np.interp(wanted, h, phi)
        mu = self.gel.shear_modulus(1.0)
        for _ in range(SURFACE_LIMIT):
            excess = self.load(found) - wanted
            low, high = np.where(excess < 0.0, found, low), np.where(excess > 0.0, found, high)
            slope = self.gel.diffusivity(found, self.temperature) / (mu * found)
            with np.errstate(divide="ignore"):
                nearer = found - excess / slope
            nearer = np.where((low < nearer) & (nearer < high), nearer, 0.5 * (low + high))
            change = np.abs(nearer - found)
            found = np.where(excess == 0.0, found, nearer)
            if np.all((change <= ROUNDED * found) | (excess == 0.0)):
                break
        return found


class Bead:
    """Newton's method for the backward-difference equations G = 0 of one or more beads."""

    def __init__(self, gel, surface: Surface, shells: Shells, sweep: NewtonSweep, tolerance: float):
        self.gel, self.surface, self.shells, self.sweep = gel, surface, shells, sweep
        self.temperature = surface.temperature
        self.mu = gel.shear_modulus(1.0)
        # shells thinner than what the iteration leaves would be tangled by it
        self.accuracy = NEWTON_SHARE * min(tolerance, shells.thinnest)
        self.curvature = 1.0 / self.accuracy  # a correction leaves curvature * correction^2

    def radius(self, u: np.ndarray) -> np.ndarray:
        """Radius a of each bead."""
        return np.cbrt(u[self.shells.outer])

    def polymer_fraction(self, u: np.ndarray) -> np.ndarray:
        """Polymer fraction phi of each shell."""
        return self.shells.volume / self.shells.jump(u)

    def possible_polymer_fraction(self, u: np.ndarray) -> np.ndarray:
        """The same; bdf.NotConverged of an iterate whose shells no gel can have."""
        phi = self.polymer_fraction(u)
        low, high = self.gel.polymer_fraction_bounds
        if phi.min() <= low or phi.max() >= high:
            raise bdf.NotConverged
        return phi

    def displacement_norm(self, u: np.ndarray, du: np.ndarray) -> float:
        """Largest change of a face's radius, relative to its bead's."""
        a = np.repeat(self.radius(u), self.shells.cells)
        return float(np.max(np.abs(du) / (3.0 * np.cbrt(u) ** 2 * a)))

    def advance(self, t: float, guess: np.ndarray, alpha: float, history: np.ndarray):
        """Solve G(u) = 0 by FiPy sweeps from ``guess``; bdf.NotConverged if that fails."""
        u, previous = guess, None
        for _ in range(NEWTON_LIMIT):
            du = self.sweep.correction(*self.linearised(u, alpha, history))
            u = u + du
            if not np.all(np.isfinite(u)) or u.min() <= 0.0:
                raise bdf.NotConverged
            change = self.displacement_norm(u, du)
            if previous is not None:
                self.curvature = max(change / previous**2, FORGETTING * self.curvature)
            if self.curvature * change**2 <= self.accuracy:
                self.require_one_phase(u)
                return u
            previous = change
        raise bdf.NotConverged

    def linearised(self, u, alpha, history):
        """Conductance K, reaction c and residual G of FiPy's sweep at the iterate u."""
        shells, gel, T, mu = self.shells, self.gel, self.temperature, self.mu
        phi = self.possible_polymer_fraction(u)
        a = self.radius(u)
        self.surface.require(a)
        phi_s = self.surface.polymer_fraction(a)
        K = gel.diffusivity(phi, T) / mu * phi**2 / shells.volume
        Psi = gel.flux_potential(phi, T) / mu
        rise = np.diff(Psi, append=0.0)
        rise[shells.outer] = gel.flux_potential(phi_s, T) / mu - Psi[shells.outer]

        geometry = shells.R * shells.gap / (6.0 * u ** (4.0 / 3.0))
        rate = alpha * u + history
        G = geometry * rate + rise
        c = geometry * (alpha - 4.0 / 3.0 * rate / u)
        c[shells.inner] += K[shells.inner]  # the centre, where u = 0
        c[shells.outer] -= 4.0 * phi_s / (3.0 * a**4)  # dPsi_s/du, from h(phi_s) = 4/a
        conductance = np.append(K, 0.0)
        conductance[shells.inner] = 0.0
        return conductance, c, G

    def require_one_phase(self, u: np.ndarray) -> None:
        """PhaseSeparation if the surface or a shell reaches polymer fractions where D < 0."""
        phi = self.possible_polymer_fraction(u)
        self.surface.require(self.radius(u))
        outside = (phi <= self.surface.lower) | (phi >= self.surface.upper)
        if outside.any():
            i = int(np.argmax(outside))
            raise PhaseSeparation(float(phi[i]), float(np.cbrt(u[i])))


def solve(
    gel,
    temperature: float,
    phi_initial: float,
    times: np.ndarray,
    cells: int,
    *,
    tolerance: float,
    order: int = 3,
) -> "xr.Dataset":
    """The bead from uniform ``phi_initial``, at constant ``temperature`` for t > 0.

    ``times`` (increasing, from 0) are in t_BMJ; ``tolerance`` bounds the local error of a step in
    the radius of any shell relative to a (the dry thickness of the thinnest shell does, if that is
    less); ``order`` is that of the backward differences.  The dataset is described in
    ``gelpump.bead.dataset``; if phases separate it ends there, and its attribute ``stopped`` says
    at which t, r and phi.
    """
    return solve_meshes(
        gel, temperature, phi_initial, times, [cells], tolerance=tolerance, order=order
    )[0]


def solve_meshes(
    gel,
    temperature: float,
    phi_initial: float,
    times: np.ndarray,
    cells: Sequence[int],
    *,
    tolerance: float,
    order: int = 3,
) -> list["xr.Dataset"]:
    """The same bead on several meshes, which share every time step and sweep.

    Each mesh loses its phases at a time of its own; if one does, each mesh is solved by itself.
    """
    shells = Shells(cells)
    tolerance = min(tolerance, shells.thinnest)  # a larger error would tangle shells
    start = shells.R**3 / phi_initial
    sweep = NewtonSweep(len(shells.R))
    kept_times, states = [0.0], [start]
    reached, latest, steps, loss, surface_follows = 0.0, start, 0, None, False
    try:
        surface = Surface.around(gel, temperature, phi_initial)
        bead = Bead(gel, surface, shells, sweep, tolerance)
        surface.require(bead.radius(start))
        surface_follows = True
        for step in bdf.integrate(
            bead.advance,
            start,
            times[-1],
            order=order,
            tolerance=tolerance,
            first_step=FIRST_STEP,
            error_norm=bead.displacement_norm,
        ):
            reached, latest, steps = step.time, step.solution, steps + 1
            while len(states) < len(times) and times[len(states)] <= reached:
                kept_times.append(times[len(states)])
                states.append(step.at(kept_times[-1]))
    except PhaseSeparation as separation:
        if len(cells) > 1:
            settings = {"tolerance": tolerance, "order": order}
            return [solve(gel, temperature, phi_initial, times, n, **settings) for n in cells]
        loss = Loss(reached, separation.r, separation.phi, "D < 0, spinodal decomposition")
        if reached > kept_times[-1]:
            kept_times.append(reached)
            states.append(latest)
    radii = np.cbrt(np.array(states)[:, shells.outer])
    surface_fractions = np.full(radii.shape, phi_initial)
    if surface_follows:  # between two steps the radius may, by what a step leaves, be past its end
        surface_fractions = surface.polymer_fraction(radii.ravel()).reshape(radii.shape)
    ends = np.cumsum(cells)[:-1]
    return [
        bead_dataset(
            np.array(kept_times),
            np.append(0.0, R),
            np.pad(np.cbrt(u), ((0, 0), (1, 0))),
            surface_fractions[:, mesh],
            loss,
            gel=gel.name,
            temperature=temperature,
            steps=steps,
            sweeps=sweep.sweeps,
        )
        for mesh, (R, u) in enumerate(
            zip(
                np.split(shells.R, ends),
                np.split(np.array(states), ends, axis=1),
                strict=True,
            )
        )
    ]
