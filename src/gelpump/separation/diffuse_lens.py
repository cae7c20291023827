r"""A LENS bead with an energy of interfaces on FiPy: fourth-order diffusion, a moving surface.

For LENS the flow of ``gelpump.separation.diffuse`` is that of a fluid mixture.  With the exchange
potential w, polymer moves at v = -phi dw/dr; the surface, at r = a, moves with it:

    d(phi)/dt + (1/r^2) d/dr (r^2 phi v) = 0 ,
    w = m(phi) - kappa lap phi ,     m = W + h/phi ,  h = Pi/mu + 4 phi^{1/3} ,
    da/dt = v ,  phi_r = 0 ,  w = W + (4/a)/phi   at r = a ,

the last being h - kappa phi phi_rr = 4/a.  On cells that keep their share x = r/a of the radius, in
the volume x^3/3, FiPy's own term of the fourth order is the whole of the interfaces' Jacobian;
m, the mobility phi^2 and the moving cells give a flux between neighbours.  What depends on a is
a last column: a second block of the mesh is solved for it, and the surface's own equation closes
the two.  One sweep is one Newton step.  p = phi a^3 is what the cells hold: its sum is conserved.

Unlike the shells of ``gelpump.separation.diffuse``, of which nothing but the model is used, these
cells are uniform in the swollen bead, where a front is as wide as in the dry one.
"""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump import bdf, plain_fipy
from gelpump.separation import diffuse, watch
from gelpump.separation.energy import Lens

if TYPE_CHECKING:
    import xarray as xr

NEWTON_LIMIT = 8
NEWTON_SHARE = 0.03  # of the tolerance, which the iteration may leave
DIFFERENCE = 1e-6  # of a derivative, relative
FIRST_STEP = 1e-12
ORDER = 3
TRIALS = 20_000


class Correction:
    """FiPy's equation for Newton's corrections of two blocks of cells of ``volume``."""

    def __init__(self, volume: NDArray):
        fipy = plain_fipy.load()
        mesh = fipy.Grid1D(dx=np.tile(volume, 2))
        self.distance = 0.5 * (volume[1:] + volume[:-1])
        self.delta = fipy.CellVariable(mesh=mesh, hasOld=True)
        self.G, self.c = fipy.CellVariable(mesh=mesh), fipy.CellVariable(mesh=mesh)
        self.K, self.upper, self.inner = (fipy.FaceVariable(mesh=mesh) for _ in range(3))
        self.u = fipy.FaceVariable(mesh=mesh, rank=1)
        self.solver = fipy.LinearLUSolver(tolerance=1e-14)
        self.equation = fipy.TransientTerm(coeff=self.c) == (
            fipy.DiffusionTerm(coeff=self.K)
            + fipy.CentralDifferenceConvectionTerm(coeff=self.u)
            - fipy.DiffusionTerm(coeff=(self.upper, self.inner))
            - self.G
        )

    def solve(self, alpha, right, left, upper, inner, G) -> tuple[NDArray, NDArray]:
        """Of both blocks, from the derivatives of the flux with its two cells, the two
        conductances of the term of the fourth order, and the sides G, shape (2, cells)."""
        K, conductances = 0.5 * (right + left), (upper, inner)
        self.K.setValue(_seamed(K * self.distance))
        self.u.setValue(_seamed(right - left)[np.newaxis])
        for variable, each in zip((self.upper, self.inner), conductances, strict=True):
            variable.setValue(_seamed(each * self.distance))
        self.c.setValue(alpha)
        self.G.setValue(np.concatenate(G) / self.delta.mesh.cellVolumes)
        self.delta.setValue(0.0)
        self.delta.updateOld()
        self.equation.sweep(var=self.delta, dt=1.0, solver=self.solver)
        return tuple(np.split(self.delta.value.copy(), 2))


def _seamed(faces: NDArray) -> NDArray:
    """Values of the inner faces of a block, twice, nothing at ends and seam."""
    block = np.append(0.0, faces)
    return np.concatenate([block, block, [0.0]])


class Bead:
    """Newton's method for y = (p of the cells, a)."""

    def __init__(self, energy, kappa: float, cells: int, tolerance: float):
        self.energy, self.kappa, self.tolerance = energy, kappa, tolerance
        self.x = np.linspace(0.0, 1.0, cells + 1)
        self.volume = np.diff(self.x**3) / 3
        self.correction = Correction(self.volume)

    def start(self, phi: float) -> NDArray:
        """The uniform bead."""
        a = phi ** (-1 / 3)
        return np.append(np.full(self.volume.size, phi * a**3), a)

    def faces(self, y: NDArray) -> tuple[NDArray, NDArray]:
        """R and r of all faces."""
        return np.cbrt(np.append(0.0, np.cumsum(3 * self.volume * y[:-1]))), y[-1] * self.x

    def state(self, y):
        """phi, the conductance r^2/dr of the inner faces, and w."""
        a = y[-1]
        phi = y[:-1] / a**3
        T = a * self.x[1:-1] ** 2 / self.x[1]
        pull = np.append(0.0, np.append(T * np.diff(phi), 0.0))
        w = self.energy.density(phi, 1.0) - self.energy.radial_stress(phi, 1.0) / phi
        return phi, T, w - self.kappa * np.diff(pull) / (self.volume * a**3)

    def energy_of(self, y: NDArray) -> float:
        """E / 4 pi."""
        phi, T, _ = self.state(y)
        bulk = self.energy.density(phi, 1.0) * y[:-1] * self.volume
        gradients = 0.5 * self.kappa * T * np.diff(phi) ** 2
        return float(bulk.sum() + gradients.sum() + self.energy.surface_energy(y[-1]))

    def residual(self, y: NDArray, rate: NDArray) -> NDArray:
        """Of the cells' balances and of the surface's motion."""
        a, a_t = y[-1], rate[-1]
        phi, T, w = self.state(y)
        between = 0.5 * (phi[1:] + phi[:-1])
        moving = between * a**2 * self.x[1:-1] ** 3 * a_t
        flux = np.append(0.0, np.append(-(between**2) * T * np.diff(w) - moving, 0.0))
        at_surface = phi[-1] + (phi[-1] - phi[-2]) / 8  # phi_r = 0 there
        w_s = self.energy.density(at_surface, 1.0) - self.energy.traction(a) / at_surface
        slope = (8 * w_s - 9 * w[-1] + w[-2]) / (3 * a * self.x[1])
        return np.append(self.volume * rate[:-1] + np.diff(flux), a_t + at_surface * slope)

    def newton(self, y: NDArray, alpha: float, history: NDArray) -> NDArray:
        """The correction of y."""

        def residual(z):
            return self.residual(z, alpha * z + history)

        def along(i):
            z = y.copy()
            z[i] *= 1 + DIFFERENCE
            return (residual(z) - G) / (z[i] - y[i])

        G, a = residual(y), y[-1]
        a_t = alpha * a + history[-1]
        phi, T, w = self.state(y)
        between, slope = 0.5 * (phi[1:] + phi[:-1]), self.energy.stiffness(phi, 1.0) / phi**2
        mobility = between**2 * T
        drift = between * T * np.diff(w) + 0.5 * a**2 * self.x[1:-1] ** 3 * a_t
        right, left = mobility * slope[1:] + drift, mobility * slope[:-1] - drift
        with_a = along(-1)
        found, column = self.correction.solve(
            alpha,
            right / a**3,
            left / a**3,
            mobility / a**3,
            self.kappa * T / a**3,
            (G[:-1], with_a[:-1]),
        )
        surface = np.array([along(i)[-1] for i in (-4, -3, -2)])
        moved = -(G[-1] + surface @ found[-3:]) / (with_a[-1] + surface @ column[-3:])
        return np.append(found + moved * column, moved)

    def advance(self, t: float, guess: NDArray, alpha: float, history: NDArray) -> NDArray:
        """Solve the backward-difference equations, or raise bdf.NotConverged."""
        y = guess
        for _ in range(NEWTON_LIMIT):
            phi = y[:-1] / y[-1] ** 3
            if not (phi.min() > 0 and phi.max() < 1 and y[-1] > 1):
                break
            change = self.newton(y, alpha, history)
            if not np.all(np.isfinite(change)):
                break
            y = y + change
            if self.norm(y, change) <= NEWTON_SHARE * self.tolerance:
                return y
        raise bdf.NotConverged

    def norm(self, y: NDArray, change: NDArray) -> float:
        """Largest change of a polymer fraction at fixed r/a, or of the radius, relative."""
        a = y[-1]
        return float(max(np.abs(change[:-1]).max() / a**3, abs(change[-1]) / a))

    def steps(self, start: NDArray, end: float) -> Iterator[bdf.Step]:
        """The state ``start`` and the accepted steps from there up to the time ``end``."""
        yield bdf.Step(np.zeros(1), start[np.newaxis])
        yield from bdf.integrate(
            self.advance,
            start,
            end,
            order=ORDER,
            tolerance=self.tolerance,
            first_step=FIRST_STEP,
            error_norm=self.norm,
            trials=TRIALS,
        )


def solve(
    gel,
    temperature: float,
    phi_initial: float,
    times: Sequence[float],
    cells: int,
    *,
    width: float,
    tolerance: float,
) -> "xr.Dataset":
    """The LENS bead from uniform ``phi_initial``, interfaces as wide as ``width``.

    As ``gelpump.separation.diffuse.solve``; tolerance: of a step, in polymer fractions and in the
    radius, relative.
    """
    times, energy = np.asarray(times, dtype=float), Lens(gel, temperature)
    kappa = diffuse.kappa_of(energy, width)
    diffuse.require_resolved(width, float(phi_initial) ** (-1 / 3) / cells, cells)
    bead = Bead(energy, kappa, cells, tolerance)
    return watch.course(
        energy,
        bead,
        bead.steps(bead.start(float(phi_initial)), float(times[-1])),
        times,
        layers=False,
        phi_initial=phi_initial,
        width=width,
        kappa=kappa,
    )
