"""A manufactured solution for the slender tube, through the code of production runs.

With f = Z_C/w and the length b = w f/sqrt(4 + f^2) of the mesh's layer,

    Phi = 1 + g B [ 1 + (q/2) (Z_C/b) (1 - Z^2/Z_C^2) ]       for Z < Z_C
    Phi = 1 + g B exp(-y - y^2/2) ,   y = (Z - Z_C)/b         for Z > Z_C

grows as g = tau/(tau + tau_0).  Phi_Z = 0 at Z = 0, Phi = 1 far ahead, Phi and D Phi_Z are
continuous at Z_C if q = D_cold/D_hot there: the slope jumps, as the coefficients do.  Put into
eqn:tube_model *as printed*, with its integral by Gauss-Legendre quadrature of Phi^{-2/3} Phi_tau,
Phi leaves a remainder H,

    H = Phi_tau + (D/Phi) Phi_Z^2 - (1/3) Phi^{-1/3} Phi_Z Integral_0^Z Phi^{-2/3} Phi_tau du
        - F - (D Phi_Z)_Z ,

which the production solver (``family.Family``: its mesh, fluxes, Jacobian, front and time steps)
gets as a source beside its own: S + lambda^4 H/3.  That it then returns Phi verifies the passage
from the printed equation to the material one as well, integral and jump included.  For the closures
that conserve water (`gelpump.tube.closure`) the left side has (2/3)(D/Phi) Phi_Z^2 more, F the w
and the Phi_s of the closure.
"""

from collections.abc import Callable

import numpy as np

from gelpump.bdf import Step, integrate
from gelpump.known_solutions.study import Study, space, time
from gelpump.tube import slender
from gelpump.tube.closure import Printed, named
from gelpump.tube.heat import StepHeating
from gelpump.tube.moving_mesh import PRINTED
from gelpump.tube.tubes import Tubes

TUBE = Tubes(0.5, 0.1, M=0.3, Pi_ratio=0.5, Phi_inf=4.0)  # q = 2.5: the slope jumps strongly
HEAT = StepHeating(10.0)
REACH = 12.0
ORDER = 3  # of the time steps, as in production
END = 2.0  # Z_C/w in the end
HEIGHT = 0.4  # B
GROWTH = 0.5  # tau_0, in units of the end
FIRST_STEP = 1e-3  # of the whole time; its formula is of first order
NODES, WEIGHTS = np.polynomial.legendre.leggauss(20)


class Manufactured:
    """The solution of the module's docstring for one tube; lengths in L, tau as in the paper."""

    def __init__(self, tubes: Tubes, heat: StepHeating, closure: Printed = PRINTED):
        self.closure = closure
        self.w, self.M = float(closure.wall_length(tubes)), float(tubes.M)
        self.hot = float(tubes.Pi_ratio / tubes.Phi_inf), float(tubes.Phi_inf)
        self.cold = 1.0, 1.0
        self.heat = heat
        self.end = (END * self.w / heat.front(1.0)) ** 2

    def diffusivity(self, Phi: np.ndarray, s: float) -> np.ndarray:
        """D."""
        return s * Phi + 4 * self.M / 3 * Phi ** (1 / 3)

    def _shape(self, tau: complex) -> tuple:
        """Z_C, b, g B and q; tau may be complex, for derivatives."""
        Z_C = self.heat.front(1.0) * np.sqrt(tau)
        b = Z_C / np.sqrt(4 + (Z_C / self.w) ** 2)
        height = HEIGHT * tau / (tau + GROWTH * self.end)
        D = [self.diffusivity(1 + height, s) for s, _ in (self.hot, self.cold)]
        return Z_C, b, height, D[1] / D[0]

    def Phi(self, Z: np.ndarray, tau: complex, hot: bool) -> tuple[np.ndarray, ...]:
        """Phi, Phi_Z and Phi_ZZ on one side of the front."""
        Z_C, b, height, q = self._shape(tau)
        if hot:
            steep = height * q / (b * Z_C)
            return 1 + height + steep / 2 * (Z_C**2 - Z**2), -steep * Z, -steep + 0 * Z
        y = (Z - Z_C) / b
        bump = height * np.exp(-y - y**2 / 2)
        return 1 + bump, -(1 + y) * bump / b, ((1 + y) ** 2 - 1) * bump / b**2

    def Phi_tau(self, Z: np.ndarray, tau: float, hot: bool) -> np.ndarray:
        """Phi_tau at fixed Z, by a complex step."""
        return self.Phi(Z, tau * (1 + 1e-30j), hot)[0].imag / (1e-30 * tau)

    def _integral(self, function: Callable, Z: np.ndarray, tau: float, hot: bool) -> np.ndarray:
        """Integral_0^Z of function(Z, hot); Z on one side of the front."""
        Z_C = float(self.heat.front(tau))

        def from_to(start, ends, side):
            half = (ends - start) / 2
            nodes = start + half[:, None] * (1 + NODES)
            return half * (function(nodes, side) @ WEIGHTS)

        if hot:
            return from_to(0.0, Z, True)
        return from_to(0.0, np.array([Z_C]), True) + from_to(Z_C, Z, False)

    def remainder(self, Z: np.ndarray, tau: float, hot: bool) -> np.ndarray:
        """H, from eqn:tube_model as printed, or with what the closure puts in its place."""
        s, Phi_0 = self.hot if hot else self.cold

        def integrand(Z, side):
            return self.Phi(Z, tau, side)[0] ** (-2 / 3) * self.Phi_tau(Z, tau, side)

        Phi, Phi_Z, Phi_ZZ = self.Phi(Z, tau, hot)
        D = self.diffusivity(Phi, s)
        D_slope = s + 4 * self.M / 9 * Phi ** (-2 / 3)
        advected = 1.0
        if self.closure.conserves_water:
            advected = 5 / 3
            Phi_0, _ = self.closure.surface(Phi ** (-1 / 3), s, Phi_0, self.M)
        F = Phi ** (2 / 3) * D * (Phi_0 - Phi) / self.w**2
        G = self._integral(integrand, Z, tau, hot)
        left = self.Phi_tau(Z, tau, hot) + advected * D / Phi * Phi_Z**2
        left -= Phi ** (-1 / 3) * Phi_Z * G / 3
        return left - F - (D_slope * Phi_Z**2 + D * Phi_ZZ)

    def material_point(self, X: np.ndarray, guess: np.ndarray, tau: float, hot: bool) -> np.ndarray:
        """Z of the material points X = Integral_0^Z Phi^{1/3}, by Newton from a guess."""

        def stretch(Z, side):
            return self.Phi(Z, tau, side)[0] ** (1 / 3)

        Z = guess
        for _ in range(30):
            step = (self._integral(stretch, Z, tau, hot) - X) / stretch(Z, hot)
            Z = Z - step
            if np.abs(step).max() < 1e-9 * self.w:  # quadratically convergent
                return Z
        raise RuntimeError("Newton's iteration for the material points does not converge")


class ForcedFamily(slender.Family):
    """One tube of production, with the remainder of a manufactured solution as a further source."""

    def __init__(
        self, problem: Manufactured, tubes: Tubes, cells: tuple[int, int], tolerance: float
    ):
        accuracy = slender.NEWTON_SHARE * tolerance
        super().__init__(tubes, problem.heat, cells, REACH, accuracy, problem.closure)
        self.problem, self.forcing = problem, 0.0
        self.sides = (slice(0, self.behind), True), (slice(self.behind, None), False)
        self.shortening = np.ones(self.cells)  # Z/X, of the last time

    def exact(self, X: np.ndarray, t: float) -> tuple[np.ndarray, np.ndarray]:
        """Z and Phi in the middle of the cells between the faces X (in units of w)."""
        middle = (X[0, 1:] + X[0, :-1]) / 2 * self.problem.w
        Z, Phi = np.empty_like(middle), np.empty_like(middle)
        for cells, hot in self.sides:
            X = middle[cells]
            Z[cells] = self.problem.material_point(X, X * self.shortening[cells], t * t, hot)
            Phi[cells] = self.problem.Phi(Z[cells], t * t, hot)[0]
        self.shortening = Z / middle
        return Z, Phi

    def faces(self, t: float, X_C: np.ndarray) -> np.ndarray:
        """Production's faces; what is forced between them is found at once."""
        X = super().faces(t, X_C)
        if t > 0:
            Z, Phi = self.exact(X, t)
            H = [self.problem.remainder(Z[cells], t * t, hot) for cells, hot in self.sides]
            self.forcing = np.concatenate(H) * Phi ** (-4 / 3) / 3
        return X

    def source(self, stretch: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """w^2 (S + lambda^4 H/3), or what the content loses by it; and its derivative."""
        S, slope = super().source(stretch)
        forcing = self.problem.w**2 * self.forcing * self.closure.content_slope(stretch)
        if self.closure.conserves_water:
            slope = slope + 2 * forcing / stretch
        return S + forcing, slope


def manufactured(
    cells: tuple[int, int], tolerance: float, closure: str = "printed"
) -> tuple[np.ndarray, np.ndarray, int]:
    """Phi in the cells and at the front, the errors of both, and the number of steps."""
    problem = Manufactured(TUBE, HEAT, named(closure))
    family = ForcedFamily(problem, TUBE, cells, tolerance)
    last, steps = march(family, family.initial(), np.sqrt(problem.end), tolerance)
    stretch, _, X = family.unpack(last.solution)
    front = family.inner_faces(stretch, X)[2][0, family.behind - 1] ** -3.0
    Phi = np.append(stretch[0] ** -3.0, front)
    exact = np.append(family.exact(X, last.time)[1], 1 + problem._shape(problem.end)[2])
    return Phi, Phi - exact, steps


def march(
    family: slender.Family, start: np.ndarray, end: float, tolerance: float
) -> tuple[Step, int]:
    """Last step of a family's march, and the number of steps."""
    steps = 0
    accuracy = {"order": ORDER, "tolerance": tolerance, "first_step": FIRST_STEP * end}
    for step in integrate(family.advance, start, end, error_norm=family.error_norm, **accuracy):
        steps += 1
        last = step
    return last, steps


def spreading_front(closure: str = "printed") -> list[Study]:
    """Orders in space and in time on the manufactured solution."""
    meshes, tolerances = [(16, 16), (32, 32), (64, 64)], [1e-4, 1e-5]
    name = "manufactured tube" + ("" if closure == "printed" else f", {closure}")
    counts = [sum(mesh) for mesh in meshes]
    fine = [manufactured(mesh, 3e-7, closure) for mesh in meshes]
    loose = [manufactured(meshes[0], tolerance, closure) for tolerance in tolerances]
    cells = [np.abs(error[:-1]).max() for _, error, _ in fine]
    front = [abs(error[-1]) for _, error, _ in fine]
    steps = [count for _, _, count in loose]
    late = [np.abs(Phi - fine[0][0]).max() for Phi, _, _ in loose]
    return [
        space(name, "Phi_1", counts, cells, 3e-4),
        space(name, "Phi_1 at Z_C", counts, front, 1e-4),
        time(name, "Phi_1", steps, late, 3e-4),
    ]
