r"""The sharp front of a LENS bead on FiPy: a Stefan problem in the dry volume m = R^3.

With u = r^3, J = 1/phi and Psi(phi) = Integral_0^phi D (``gelpump.bead.lens``),

    u_t|_m = q = -(6 r^4 / R) dPsi / d(R^2) ,     J = du/dm ,     Psi_s = Psi(phi_s(a)) at m = 1 ,

and at the front, m_f, Psi and J have the two sides' constant values of the coexistence, so that

    dm_f/dt = -(q_+ - q_-) / (J_+ - J_-) ,     du_f/dt = (J_+ q_- - J_- q_+) / (J_+ - J_-) .

Faces move with the front, where u_t = u_t|_m + J dm/dt.  The backward-difference equations of the
faces are tridiagonal but for m_f, on which all of them depend: of two blocks of one FiPy mesh one
is solved for the residual and one for its derivative with m_f, and the front's own equation closes
them.  One sweep is one Newton step.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump import bdf
from gelpump.bead import lens
from gelpump.finite_volume import NewtonSweep
from gelpump.separation import observed
from gelpump.separation.blocks import CORE, Divided, graded_core
from gelpump.separation.coexistence import Coexistence, OnePhase, Surface
from gelpump.separation.energy import Lens
from gelpump.separation.sharp import SKIN
from gelpump.separation.shells import interpolated, polymer_fraction, require_sound

if TYPE_CHECKING:
    import xarray as xr

NEWTON_LIMIT = 10
NEWTON_SHARE = 0.03  # of the tolerance, which the iteration may leave
THINNEST_SHARE = 0.03  # of the thinnest shell, likewise
DIFFERENCE = 1e-5  # of a Jacobian, over the volume of a shell
FIRST_STEP = 1e-12
ORDER = 3


class Front:
    """Newton's method for y = (u of the outer faces, m_f)."""

    def __init__(self, divided: Divided, surface: lens.Surface, tolerance: float):
        self.divided, self.surface, self.tolerance = divided, surface, tolerance
        self.gel, self.temperature = surface.gel, surface.temperature
        self.mu = self.gel.shear_modulus(1.0)
        self.sides = divided.at_hoop_stretch(1.0)
        self.faces = divided.core + divided.s.size - 1
        self.sweep = NewtonSweep(2 * self.faces, drifts=True)

    def mesh(self, m: float) -> tuple[NDArray, NDArray]:
        """R of all faces, and dR/dR_f."""
        front, s = np.cbrt(m), self.divided.s[1:]
        skin = front ** (1 - s)
        R = np.concatenate([front * self.divided.X, skin])
        return R, np.concatenate([self.divided.X, (1 - s) * skin / front])

    def potential(self, phi):
        """Psi."""
        return self.gel.flux_potential(phi, self.temperature) / self.mu

    def residual(self, y: NDArray, rate: NDArray) -> NDArray:
        """Of the faces' equations and the front's, dy/dt being ``rate``."""
        u, m, f = y[:-1], y[-1], self.divided.core - 1
        R, moving = self.mesh(m)
        square, volume = R**2, np.diff(R**3)
        mean = 0.6 * np.diff(R**5) / volume
        J = np.diff(u, prepend=0.0) / volume
        Psi = self.potential(1 / J)
        radius = np.cbrt(u[-1:])
        Psi = np.append(Psi, self.potential(self.surface.polymer_fraction(radius)))
        place = np.append(mean, 1.0)
        slope = np.diff(Psi) / np.diff(place)
        inside, outside = self.potential(np.array(self.sides))
        before = (inside - Psi[f]) / (square[f + 1] - mean[f])
        behind = (Psi[f + 1] - outside) / (mean[f + 1] - square[f + 1])
        J_in, J_out = (1 / phi for phi in self.sides)

        between = (square[1:-1] - mean[:-1]) / np.diff(mean)
        J_face = np.append(J[:-1] + between * np.diff(J), 0.0)
        drift = R[1:] ** 2 * moving[1:] * rate[-1] / m ** (2 / 3)
        geometry = R[1:] / (6.0 * u ** (4.0 / 3.0))
        G = geometry * (rate[:-1] - J_face * drift) + slope
        G[f] = geometry[f] * rate[f] + (J_out * before - J_in * behind) / (J_out - J_in)
        front = geometry[f] * rate[-1] - (behind - before) / (J_out - J_in)
        # of the order of a difference of Psi, like the finite volumes of the bead of one phase
        return np.append(G * np.append(np.diff(mean), 1.0 - mean[-1]), front)

    def advance(self, t: float, guess: NDArray, alpha: float, history: NDArray) -> NDArray:
        """Solve the backward-difference equations, or raise bdf.NotConverged."""
        y = guess
        for _ in range(NEWTON_LIMIT):
            if not self.in_order(y):
                raise bdf.NotConverged
            change = self.correction(y, alpha, history)
            y = y + change
            if not np.all(np.isfinite(y)):
                raise bdf.NotConverged
            thinnest = np.diff(np.cbrt(y[:-1]), prepend=0.0).min()
            left = min(NEWTON_SHARE * self.tolerance, THINNEST_SHARE * thinnest)
            if self.norm(y, change) <= left:
                if not self.in_order(y):
                    raise bdf.NotConverged
                return y
        raise bdf.NotConverged

    def in_order(self, y: NDArray) -> bool:
        """Whether shells are not tangled and the front lies within the bead."""
        if not 0.0 < y[-1] < 1.0 or y[0] <= 0.0:
            return False
        phi = np.diff(self.mesh(y[-1])[0] ** 3) / np.diff(y[:-1], prepend=0.0)
        return bool(np.all((phi > 0.0) & (phi < 1.0)))

    def norm(self, y: NDArray, change: NDArray) -> float:
        """Largest change of a radius, in the bead's, or of the front's dry radius."""
        u, a = y[:-1], np.cbrt(y[-2])
        moved = np.abs(change[:-1]) / (3 * np.cbrt(u) ** 2 * a)
        return float(max(moved.max(), abs(change[-1]) / (3 * np.cbrt(y[-1]) ** 2)))

    def correction(self, y: NDArray, alpha: float, history: NDArray) -> NDArray:
        """Newton's, by one sweep of FiPy over two blocks."""

        def residual(z):
            return self.residual(z, alpha * z + history)

        G = residual(y)
        n = self.faces
        volume = np.diff(y[:-1], prepend=0.0)
        step = DIFFERENCE * np.minimum(volume, np.append(volume[1:], np.inf))
        lower, main, upper, front = (np.zeros(n) for _ in range(4))
        for first in range(3):
            j = np.arange(first, n, 3)
            z = y.copy()
            z[j] += step[j]
            change = residual(z) - G
            main[j] = change[j] / step[j]
            above, below = j[j > 0], j[j < n - 1]
            upper[above - 1] = change[above - 1] / step[above]
            lower[below + 1] = change[below + 1] / step[below]
            near = j[np.abs(j - (self.divided.core - 1)) <= 1]
            front[near] = change[-1] / step[near]  # of these three only one is in each third
        z = y.copy()
        z[-1] += DIFFERENCE * y[-1] * (1 - y[-1])
        with_front = (residual(z) - G) / (z[-1] - y[-1])

        a, b = -upper[:-1], -lower[1:]
        seam = np.zeros(1)
        K = np.concatenate([seam, 0.5 * (a + b), seam, 0.5 * (a + b), seam])
        drift = np.concatenate([seam, a - b, seam, a - b, seam])
        c = main - np.append(b, 0.0) - np.append(0.0, a)
        sides = np.append(G[:-1], with_front[:-1])
        found, along = np.split(self.sweep.correction(K, np.append(c, c), sides, drift), 2)
        moved = -(G[-1] + front @ found) / (with_front[-1] + front @ along)
        return np.append(found + moved * along, moved)


def solve(
    gel,
    temperature: float,
    phi_initial: float,
    times: Sequence[float],
    cells: tuple[int, int],
    *,
    tolerance: float,
    skin: float = SKIN,
) -> "xr.Dataset":
    """The LENS bead from uniform ``phi_initial`` on, its surface drying, to the end.

    Until its surface loses its swollen state it is ``gelpump.bead.lens``; arguments and result are
    as of ``gelpump.separation.sharp.solve``, tolerance that of ``gelpump.bead.lens.solve``.
    """
    times = np.asarray(times, dtype=float)
    energy = Lens(gel, temperature)
    whole = lens.solve(gel, temperature, phi_initial, times, sum(cells), tolerance=tolerance)
    R = np.broadcast_to(whole.dry_radius.values, whole.r_face.shape)
    kept = [whole.t.values, R, whole.r_face.values, whole.surface_polymer_fraction.values]
    kept.append(np.full((whole.t.size, 2), np.nan))
    kept = [list(each) for each in kept]
    events: dict[str, float] = {}
    stopped = ""
    if whole.attrs["stopped"]:
        events = {"birth_t": whole.stopped_t, "birth_radius": float(whole.radius[-1])}
        try:
            _through(energy, times, cells, tolerance, skin, kept, events)
        except (OnePhase, RuntimeError) as why:
            stopped = str(why)
    numerics = {"tolerance": tolerance, "skin": skin, "stopped": stopped}
    return observed.dataset(
        energy,
        *(np.array(each) for each in kept),
        events | {"phi_initial": phi_initial} | numerics,
    )


def _through(energy, times, cells, tolerance, skin, kept, events):
    """From the state that ``kept`` ends with: the front, then the bead of the other phase."""
    R, r = kept[1][-1], kept[2][-1]
    a = float(r[-1])
    dry = Surface.between(energy, "dry", 1.0, 1.01 * a, a)
    sides = Coexistence.between(energy, 1.0, 2.0)
    divided = Divided(energy, sides, dry, True, *cells)
    layer = divided.layer(a, float(polymer_fraction(R, r)[-1]), skin)
    divided.X = graded_core(cells[0], layer)
    y = divided.born(R, r, skin, layer)
    surface = lens.Surface.around(energy.gel, energy.temperature, divided.at_hoop_stretch(a)[1])
    front = Front(divided, surface, tolerance)
    start = np.append(y[:-1] ** 3, y[-1] ** 3)

    def keep(t, R, u, at):
        r = np.append(0.0, np.cbrt(u))
        require_sound(energy, t, R, r)
        states = t, R, r, float(surface.polymer_fraction(np.cbrt(u[-1:]))[0])
        for column, value in zip(kept, [*states, at], strict=True):
            column.append(value)

    birth = events["birth_t"]
    due = times[times > max(birth, kept[0][-1])]
    for step in bdf.integrate(
        front.advance,
        start,
        times[-1] - birth,
        order=ORDER,
        tolerance=tolerance,
        first_step=FIRST_STEP,
        error_norm=front.norm,
    ):
        y = np.cbrt(step.solution)
        require_sound(energy, birth + step.time, front.mesh(y[-1] ** 3)[0], np.append(0.0, y[:-1]))
        while due.size and due[0] - birth <= step.time:
            z = step.at(due[0] - birth)
            at = np.cbrt([z[-1], z[divided.core - 1]])
            keep(due[0], front.mesh(z[-1])[0], z[:-1], at)
            due = due[1:]
        if y[-1] <= CORE:
            break
    if not due.size:
        return
    reached = birth + step.time
    events["completion_t"] = divided.completion(reached, y)
    shells = lens.Shells([sum(cells)])
    R, r = divided.completed(y)
    start = interpolated(R, r, shells.R) ** 3
    bead = lens.Bead(energy.gel, surface, shells, NewtonSweep(sum(cells)), tolerance)
    for step in bdf.integrate(
        bead.advance,
        start,
        times[-1] - reached,
        order=ORDER,
        tolerance=tolerance,
        first_step=FIRST_STEP,
        error_norm=bead.displacement_norm,
    ):
        while due.size and due[0] - reached <= step.time:
            keep(due[0], np.append(0.0, shells.R), step.at(due[0] - reached), np.full(2, np.nan))
            due = due[1:]
