"""Known solutions for the LENS bead, through the code of production runs.

Barenblatt's solution.  For D = phi a drop of polymer that nothing holds together spreads as

    phi = A (1 - r^2/b^2) ,   b^5 = 25 t ,   A = 5/(2 b^3) ,

an exact solution of eqn:lens_transport in the sphere: -(D/phi) phi_r = r b'/b, so every shell
keeps its x = r/b.  The bead is what lies within x <= x_1, with the moving radius a = x_1 b and the
surface phi_s = A (1 - x_1^2), a function of a.  ``lens.Bead``, ``lens.Shells``, FiPy's sweeps and
``bdf.integrate`` solve it from t = 1 on; the problem brings its own gel, D = phi, its own surface
and that surface's slope in the Jacobian.  With x_1 = 1 the surface is where phi = 0 and J = 1/phi
is infinite: there the scheme falls to first order.  Beads of the paper never get near it.

Relaxation.  A bead in equilibrium at phi_0 whose shells are displaced by delta j_1(k r) returns as
exp(-D k^2 t), if the displacement v satisfies the linearised surface condition
D (v' + 2 v/a) = 4 v/a^2.  Here gel and surface are those of production runs as well.  Two beads,
displaced either way, share the sweeps: half their difference is free of terms in delta^2.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from scipy.optimize import brentq

from gelpump import bdf
from gelpump.bead import lens
from gelpump.finite_volume import NewtonSweep
from gelpump.known_solutions.study import Study, one_run, space, time
from gelpump.materials import PiecewiseLinearGel

ORDER = 3  # of the time steps, as in production
SPREAD = 1.0  # how long Barenblatt's solution is followed, from t = 1
INSIDE = 0.8  # x_1
GEL = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=1.0, M=1.0)
SWOLLEN = -1.0  # a temperature at which phi_0 = 1
AMPLITUDE = 1e-3  # of the linear mode, relative to a


class LinearMobility:
    """A gel with D = phi, of which nothing else is asked."""

    name = "D = phi"
    polymer_fraction_bounds: ClassVar = (0.0, np.inf)

    def shear_modulus(self, phi_00):
        """The unit of stress."""
        return 1.0

    def diffusivity(self, phi, T):
        """D."""
        return phi

    def flux_potential(self, phi, T):
        """Integral of D."""
        return phi**2 / 2


@dataclass(frozen=True)
class Cut:
    """The surface x = x_1 of Barenblatt's solution, whose polymer fraction is ``dry_share``/a^3."""

    dry_share: float
    temperature = 0.0
    lower, upper = 0.0, np.inf

    def polymer_fraction(self, radius):
        """phi_s."""
        return self.dry_share / radius**3

    def require(self, radius):
        """Every radius has such a surface."""


class CutBead(lens.Bead):
    """A bead with such a surface: Psi_s = phi_s^2/2, so that dPsi_s/du = -phi_s^2/u."""

    def linearised(self, u, alpha, history):
        """K, c and G as in production, but for the slope of Psi_s."""
        K, c, G = super().linearised(u, alpha, history)
        outer, a = self.shells.outer, self.radius(u)
        phi_s = self.surface.polymer_fraction(a)
        c[outer] += 4.0 * phi_s / (3.0 * a**4) - phi_s**2 / u[outer]
        return K, c, G


class Barenblatt:
    """The part x <= x_1 of Barenblatt's solution, of polymer volume one (in spheres of radius 1).

    Of the polymer of all x, the share m(x) = (5 x^3 - 3 x^5)/2 is within x.  Dividing lengths by
    m(x_1)^(1/5) and A by its square makes the bead's polymer one.
    """

    def __init__(self, inside: float):
        self.inside = inside
        self.share = (5 * inside**3 - 3 * inside**5) / 2
        self.surface = Cut(2.5 * inside**3 * (1 - inside**2) / self.share)

    def faces(self, R, t):
        """Radius r, at time t, of the faces of dry radius R."""
        x = np.array([self._position(cube) for cube in R**3])
        return x * (25 * t / self.share) ** 0.2

    def _position(self, cube: float) -> float:
        if cube >= 1:
            return self.inside
        return brentq(lambda x: (5 * x**3 - 3 * x**5) / 2 - cube * self.share, 0, 1, xtol=1e-15)


def _march(bead, start, end, tolerance, first_step):
    """Last step of a bead's march, and the number of steps."""
    steps = 0
    for step in bdf.integrate(
        bead.advance,
        start,
        end,
        order=ORDER,
        tolerance=tolerance,
        first_step=first_step,
        error_norm=bead.displacement_norm,
    ):
        steps += 1
        last = step
    return last, steps


def barenblatt(cells: Sequence[int], tolerance: float, inside: float = INSIDE):
    """Faces r at t = 1 + SPREAD and the exact ones, a pair for each mesh; and how many steps."""
    exact, shells = Barenblatt(inside), lens.Shells(cells)
    bead = CutBead(LinearMobility(), exact.surface, shells, NewtonSweep(sum(cells)), tolerance)
    start, end = (exact.faces(shells.R, t) for t in (1.0, 1.0 + SPREAD))
    last, steps = _march(bead, start**3, SPREAD, tolerance, 0.1 * np.sqrt(tolerance))
    ends = np.cumsum(cells)[:-1]
    found, known = np.split(np.cbrt(last.solution), ends), np.split(end, ends)
    return list(zip(found, known, strict=True)), steps


def relaxation_mode(gel, temperature: float):
    """phi_0, its radius a, D, and the smallest wave number k of the relaxing displacements."""
    phi = gel.equilibrium_polymer_fraction(temperature)
    a, D = phi ** (-1 / 3), float(gel.diffusivity(phi, temperature)) / gel.shear_modulus(1.0)

    def condition(x):  # x = k a
        j0, j1 = _bessel(x)
        return D * x * j0 / a - 4 * j1 / a**2

    return phi, a, D, brentq(condition, 1e-3, np.pi) / a


def _bessel(x):
    """Spherical Bessel functions j_0 and j_1."""
    return np.sin(x) / x, np.sin(x) / x**2 - np.cos(x) / x


def relaxation(gel, temperature: float, cells: Sequence[int], tolerance: float) -> np.ndarray:
    """Relative error, on each mesh, of the rate at which the slowest mode relaxes."""
    phi, a, D, k = relaxation_mode(gel, temperature)
    shells = lens.Shells([*cells, *cells])
    surface = lens.Surface.around(gel, temperature, phi)
    bead = lens.Bead(gel, surface, shells, NewtonSweep(2 * sum(cells)), tolerance)
    r = shells.R * a
    displacement = AMPLITUDE * a * _bessel(k * r)[1] / _bessel(k * a)[1]
    displacement[sum(cells) :] *= -1.0
    lifetime = 1.0 / (D * k**2)
    last, _ = _march(bead, (r + displacement) ** 3, lifetime, tolerance, 1e-3 * lifetime)
    grown, shrunk = np.split(bead.radius(last.solution), 2)
    return np.abs(np.log(2 * AMPLITUDE * a / (grown - shrunk)) - 1.0)


def shell_identities(cells: int) -> list[Study]:
    """Shells fill the dry bead; differences of a quadratic's shell means are its slope in R^2."""
    shells = lens.Shells([cells])
    R = np.append(0.0, shells.R)
    # means over the shells of 2 + 3 R^2, and its value at the surface
    mean = 2.0 + 3.0 * 3.0 / 5.0 * np.diff(R**5) / np.diff(R**3)
    slope = np.diff(mean, append=5.0) / shells.gap
    return [
        one_run("shells", "volume of all shells", abs(shells.volume.sum() - 1.0), 1e-14),
        one_run("shells", "slope of a quadratic", np.abs(slope / 3.0 - 1.0).max(), 1e-10),
    ]


def at_rest(gel, temperature: float) -> Study:
    """A bead in equilibrium at the new temperature does not move."""
    phi = gel.equilibrium_polymer_fraction(temperature)
    bead = lens.solve(gel, temperature, phi, np.array([0.0, 1.0]), 24, tolerance=1e-4)
    change = float(np.abs(bead.polymer_fraction[-1] / phi - 1).max())
    return one_run("bead at rest", "change without a jump", change, 1e-10)


def swelling(gel, temperature: float, phi_initial: float) -> Study:
    """A swelling bead keeps its polymer."""
    times = np.array([0.0, 1e-4, 1e-2])
    bead = lens.solve(gel, temperature, phi_initial, times, 24, tolerance=1e-4)
    polymer = float(np.abs(bead.polymer_volume_error).max())
    return one_run("swelling bead", "polymer of all shells", polymer, 1e-12)


def spreading() -> list[Study]:
    """Orders in space and in time on Barenblatt's solution."""
    name, meshes = "Barenblatt's bead", [20, 40, 80, 160]
    runs, _ = barenblatt(meshes, 1e-8)
    edge, _ = barenblatt(meshes, 1e-5, inside=1.0)
    loose = [barenblatt(meshes[:1], tolerance) for tolerance in (1e-4, 1e-5, 1e-6)]
    radius = [abs(r[-1] / exact[-1] - 1) for r, exact in runs]
    faces = [np.abs(r - exact).max() for r, exact in runs]
    up_to_edge = [np.abs(r - exact).max() for r, exact in edge]
    limit = runs[0][0]  # of the first mesh, with far shorter steps
    steps, late = [count for _, count in loose], [np.abs(r[0][0] - limit).max() for r, _ in loose]
    return [
        space(name, "radius", meshes, radius, 1e-4),
        space(name, "radii of all shells", meshes, faces, 1e-4),
        space(name, "radii of all shells, up to the edge phi = 0", meshes, up_to_edge, 1e-2, 0.9),
        time(name, "radii of all shells", steps, late, 2e-5),
    ]


def studies() -> list[Study]:
    """All studies of the bead."""
    meshes = [20, 40, 80]
    rates = relaxation(GEL, SWOLLEN, meshes, 1e-9)
    return [
        *shell_identities(80),
        *spreading(),
        space("relaxing bead", "rate of the slowest mode", meshes, rates, 2e-4),
        swelling(GEL, SWOLLEN, 2.0),
        at_rest(GEL, SWOLLEN),
    ]
