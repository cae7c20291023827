"""Known solutions for the slender tube, through the code of production runs.

A manufactured solution.  With f = Z_C/w and the length b = w f/sqrt(4 + f^2) of the mesh's layer,

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

Relaxation.  A swollen tube that no front disturbs, with walls lambda = 1 + delta cos(kX), relaxes
as exp(-D (k^2 + 1/w^2) tau), D = s + 4M/3: the linearised source and axial diffusion together.

Thin walls.  For ell -> 1 the front stands still on the length w: (K lambda_X)_X = S, which one
integration on each side turns into an equation for lambda at the front.

A resting front.  Heat that has come to rest leaves (lambda^2 K lambda_X)_X = lambda^2 S of a wall
that conserves water; with j = lambda^2 K lambda_X, j dj = lambda^4 K S dlambda, so that
Q_hot(lambda_f) - Q_hot(Phi_inf^{-1/3}) = Q_cold(lambda_f) - Q_cold(1) where, for Phi_s = Phi_0,

    Q = Integral (s/lambda + m lambda)^2 (Phi_0 - lambda^{-3})/3 dlambda,    m = 4M/3
      = (1/3) [ Phi_0 (m^2 lambda^3/3 + 2 s m lambda - s^2/lambda)
                + s^2/(4 lambda^4) + s m/lambda^2 - m^2 ln lambda ] .

Nothing moves any more, so the wall sheds nothing, whatever it takes in ahead and gives off behind.
"""

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from gelpump.bdf import integrate
from gelpump.known_solutions.study import Study, one_run, space, time
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
AMPLITUDE = 1e-3  # of the linear mode
FIRST_STEP = 1e-3  # of the whole time; its formula is of first order
RESTING = REACH_AT_REST = 40.0  # Z_C/w of a front at rest, and what lies ahead of it
NODES, WEIGHTS = np.polynomial.legendre.leggauss(20)


class Manufactured:
    """The solution of the module's docstring for one tube; lengths in L, tau as in the paper."""

    def __init__(self, tubes: Tubes, heat, closure: Printed = PRINTED):
        self.closure = closure
        self.w, self.M = float(closure.wall_length(tubes)), float(tubes.M)
        self.hot = float(tubes.Pi_ratio / tubes.Phi_inf), float(tubes.Phi_inf)
        self.cold = 1.0, 1.0
        self.heat = heat
        self.end = (END * self.w / heat.front(1.0)) ** 2

    def diffusivity(self, Phi, s):
        """D."""
        return s * Phi + 4 * self.M / 3 * Phi ** (1 / 3)

    def _shape(self, tau):
        """Z_C, b, g B and q; tau may be complex, for derivatives."""
        Z_C = self.heat.front(1.0) * np.sqrt(tau)
        b = Z_C / np.sqrt(4 + (Z_C / self.w) ** 2)
        height = HEIGHT * tau / (tau + GROWTH * self.end)
        D = [self.diffusivity(1 + height, s) for s, _ in (self.hot, self.cold)]
        return Z_C, b, height, D[1] / D[0]

    def Phi(self, Z, tau, hot: bool):
        """Phi, Phi_Z and Phi_ZZ on one side of the front."""
        Z_C, b, height, q = self._shape(tau)
        if hot:
            steep = height * q / (b * Z_C)
            return 1 + height + steep / 2 * (Z_C**2 - Z**2), -steep * Z, -steep + 0 * Z
        y = (Z - Z_C) / b
        bump = height * np.exp(-y - y**2 / 2)
        return 1 + bump, -(1 + y) * bump / b, ((1 + y) ** 2 - 1) * bump / b**2

    def Phi_tau(self, Z, tau, hot: bool):
        """Phi_tau at fixed Z, by a complex step."""
        return self.Phi(Z, tau * (1 + 1e-30j), hot)[0].imag / (1e-30 * tau)

    def _integral(self, function, Z, tau, hot: bool):
        """Integral_0^Z of function(Z, hot); Z on one side of the front."""
        Z_C = float(self.heat.front(tau))

        def from_to(start, ends, side):
            half = (ends - start) / 2
            nodes = start + half[:, None] * (1 + NODES)
            return half * (function(nodes, side) @ WEIGHTS)

        if hot:
            return from_to(0.0, Z, True)
        return from_to(0.0, np.array([Z_C]), True) + from_to(Z_C, Z, False)

    def remainder(self, Z, tau, hot: bool):
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

    def material_point(self, X, guess, tau, hot: bool):
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

    def __init__(self, problem: Manufactured, tubes, cells, tolerance):
        accuracy = slender.NEWTON_SHARE * tolerance
        super().__init__(tubes, problem.heat, cells, REACH, accuracy, problem.closure)
        self.problem, self.forcing = problem, 0.0
        self.sides = (slice(0, self.behind), True), (slice(self.behind, None), False)
        self.shortening = np.ones(self.cells)  # Z/X, of the last time

    def exact(self, X, t):
        """Z and Phi in the middle of the cells between the faces X (in units of w)."""
        middle = (X[0, 1:] + X[0, :-1]) / 2 * self.problem.w
        Z, Phi = np.empty_like(middle), np.empty_like(middle)
        for cells, hot in self.sides:
            X = middle[cells]
            Z[cells] = self.problem.material_point(X, X * self.shortening[cells], t * t, hot)
            Phi[cells] = self.problem.Phi(Z[cells], t * t, hot)[0]
        self.shortening = Z / middle
        return Z, Phi

    def faces(self, t, X_C):
        """Production's faces; what is forced between them is found at once."""
        X = super().faces(t, X_C)
        if t > 0:
            Z, Phi = self.exact(X, t)
            H = [self.problem.remainder(Z[cells], t * t, hot) for cells, hot in self.sides]
            self.forcing = np.concatenate(H) * Phi ** (-4 / 3) / 3
        return X

    def source(self, stretch):
        """w^2 (S + lambda^4 H/3), or what the content loses by it; and its derivative."""
        S, slope = super().source(stretch)
        forcing = self.problem.w**2 * self.forcing * self.closure.content_slope(stretch)
        if self.closure.conserves_water:
            slope = slope + 2 * forcing / stretch
        return S + forcing, slope


def manufactured(cells: tuple[int, int], tolerance: float, closure: str = "printed"):
    """Phi in the cells and at the front, the errors of both, and the number of steps."""
    problem = Manufactured(TUBE, HEAT, named(closure))
    family = ForcedFamily(problem, TUBE, cells, tolerance)
    last, steps = _march(family, family.initial(), np.sqrt(problem.end), tolerance)
    stretch, _, X = family.unpack(last.solution)
    front = family.inner_faces(stretch, X)[2][0, family.behind - 1] ** -3.0
    Phi = np.append(stretch[0] ** -3.0, front)
    exact = np.append(family.exact(X, last.time)[1], 1 + problem._shape(problem.end)[2])
    return Phi, Phi - exact, steps


def _march(family, start, end, tolerance):
    """Last step of a family's march, and the number of steps."""
    steps = 0
    for step in integrate(
        family.advance,
        start,
        end,
        order=ORDER,
        tolerance=tolerance,
        first_step=FIRST_STEP * end,
        error_norm=family.error_norm,
    ):
        steps += 1
        last = step
    return last, steps


class Resting:
    """A front that has come to rest at Z = RESTING w."""

    def __init__(self, w: float):
        self.Z_C = RESTING * w

    def front(self, tau):
        """Z_C."""
        return self.Z_C


class Standing:
    """A front that stands at Z = 1.5 w; nothing is hot for a gel that does not change there."""

    def __init__(self, w: float):
        self.Z_C = 1.5 * w

    def front(self, tau):
        """Z_C."""
        return np.full_like(np.asarray(tau, float), self.Z_C)


def relaxation(cells: tuple[int, int], tolerance: float) -> float:
    """Relative error of the rate at which walls lambda = 1 + delta cos(kX) relax, k X_end = pi.

    Half the difference of two tubes, disturbed either way, is free of terms in delta^2.
    """
    tubes = Tubes([0.5, 0.5], 0.1, M=0.3, Pi_ratio=1.0, Phi_inf=1.0)
    w, D = tubes.wall_length[0], 1.0 + 4 * 0.3 / 3
    family = slender.Family(tubes, Standing(w), cells, 3.0, slender.NEWTON_SHARE * tolerance)
    X = family.faces(0.0, family.front(0.0) * np.ones((2, 1)))
    k = np.pi / X[0, -1]
    rate = D * (k**2 + 1) / w**2

    def mode(X):  # its mean over each cell
        return np.diff(np.sin(k * X)) / np.diff(k * X)

    start = family.pack(1 + AMPLITUDE * np.array([[1.0], [-1.0]]) * mode(X), X)
    with np.errstate(over="ignore"):  # `limit` divides by the drift of the faces, here none
        last, _ = _march(family, start, np.sqrt(1 / rate), tolerance)
    stretch, _, X = family.unpack(last.solution)
    V = np.diff(X)
    left = ((stretch - 1) * mode(X) * V).sum(axis=1) / (mode(X) ** 2 * V).sum(axis=1)
    return abs(-np.log((left[0] - left[1]) / (2 * AMPLITUDE)) - 1.0)


def thin_wall(cells: tuple[int, int]) -> tuple[float, float]:
    """Errors at the front of a tube with ell = 0.9995: of Phi_1, and of its flux relatively."""
    M, Pi_ratio, Phi_inf = 0.3, 3.0, 4.0

    def work(stretch, s, Phi_0):
        def integrand(y):
            K = s * y**-5 + 4 * M / 3 * y**-3
            return K * (s / y + 4 * M / 3 * y) * (Phi_0 - y**-3) / 3

        return quad(integrand, Phi_0 ** (-1 / 3), stretch)[0]

    def imbalance(y):
        return work(y, Pi_ratio / Phi_inf, Phi_inf) - work(y, 1.0, 1.0)

    stretch = brentq(imbalance, Phi_inf ** (-1 / 3) + 1e-9, 1)
    tubes = Tubes(0.9995, 0.1, M, Pi_ratio, Phi_inf)
    slope = np.sqrt(2 * work(stretch, 1.0, 1.0)) / tubes.wall_length
    tube = slender.solve(tubes, HEAT, [0.01], cells=cells, tolerance=1e-3)
    flux = tube.flux.isel(face=cells[0]).item() / (-3 * stretch**-3 * slope)
    return abs(tube.Phi1_front.item() - stretch**-3), float(abs(flux - 1))


def at_rest(tubes: Tubes, cells: tuple[int, int]):
    """A family of one tube that conserves water, its lambda and its faces, once all is at rest."""
    closure = named("conservative")
    w = float(closure.wall_length(tubes))
    family = slender.Family(tubes, Resting(w), cells, REACH_AT_REST, 1e-5, closure)
    dry = tubes.Phi_inf ** (-1 / 3)
    X = family.faces(1.0, np.array([[RESTING / dry]]))
    middle = (X[:, 1:] + X[:, :-1]) / 2 - X[:, family.behind, None]
    state = family.pack(dry + (1 - dry) * (1 + np.tanh(middle)) / 2, X)
    with np.errstate(over="ignore"):  # `limit` divides by the drift of the faces, here none
        for step in np.geomspace(1e-2, 1e12, 15):  # of tau, in units of w^2
            alpha = 2 / (step * w**2)
            state = family.advance(1.0, state, alpha, -alpha * state)
    stretch, _, X = family.unpack(state)
    return family, stretch, X


def resting_front(cells: tuple[int, int], tubes: Tubes = TUBE) -> tuple[float, float]:
    """Error of Phi_1 at a front that has come to rest, and what its wall sheds all the same.

    The latter as a share of what goes round, out behind the front and in ahead of it.
    """
    family, stretch, X = at_rest(tubes, cells)
    source = family.source(stretch)[0] * np.diff(X)
    shed = abs(source.sum()) / np.abs(source).sum() * 2
    Phi = family.inner_faces(stretch, X)[2][0, family.behind - 1] ** -3.0
    s, M, Phi_inf = float(tubes.Pi_ratio / tubes.Phi_inf), float(tubes.M), float(tubes.Phi_inf)

    def work(y, s, Phi_0):
        m = 4 * M / 3
        polynomial = m**2 * y**3 / 3 + 2 * s * m * y - s**2 / y
        return Phi_0 * polynomial + s**2 / (4 * y**4) + s * m / y**2 - m**2 * np.log(y)

    def imbalance(y):
        hot = work(y, s, Phi_inf) - work(Phi_inf ** (-1 / 3), s, Phi_inf)
        return hot - work(y, 1.0, 1.0) + work(1.0, 1.0, 1.0)

    exact = brentq(imbalance, Phi_inf ** (-1 / 3) + 1e-9, 1 - 1e-9) ** -3.0
    return abs(Phi - exact), shed


def without_jump() -> Study:
    """A gel that heat does not change stays as it is."""
    tube = slender.solve(
        Tubes(0.5, Phi_inf=1.0, Pi_ratio=3.0), HEAT, [1e-3, 0.1], cells=(16, 10), tolerance=1e-3
    )
    change = float(np.abs(tube.Phi1 - 1).max())
    return one_run("tube without a jump", "change of Phi_1", change, 1e-9)


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


def studies() -> list[Study]:
    """All studies of the tube."""
    meshes = [(16, 16), (32, 32), (64, 64)]
    in_front, flux = thin_wall((128, 80))
    rates = [relaxation(mesh, 1e-8) for mesh in meshes]
    at_rest = np.array([resting_front(mesh) for mesh in meshes])
    counts = [sum(mesh) for mesh in meshes]
    return [
        *spreading_front(),
        *spreading_front("conservative"),
        space("resting front, conservative", "Phi_1 at Z_C", counts, at_rest[:, 0], 2e-3),
        one_run("resting front, conservative", "water shed", at_rest[:, 1].max(), 1e-8),
        space("relaxing tube", "rate of the mode", counts, rates, 4e-4),
        one_run("thin wall, ell = 0.9995", "Phi_1 at Z_C", in_front, 1e-3),
        one_run("thin wall, ell = 0.9995", "flux at Z_C", flux, 1e-3),
        without_jump(),
    ]
