"""Known solutions for the slender tube, through the code of production runs.

The manufactured one is that of `gelpump.known_solutions.manufactured`.

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

from gelpump.known_solutions.manufactured import HEAT, TUBE, march, spreading_front
from gelpump.known_solutions.study import Study, one_run, space
from gelpump.tube import slender
from gelpump.tube.closure import named
from gelpump.tube.tubes import Tubes

AMPLITUDE = 1e-3  # of the linear mode
RESTING = REACH_AT_REST = 40.0  # Z_C/w of a front at rest, and what lies ahead of it


class Standing:
    """A front that stands still at Z_C."""

    def __init__(self, Z_C: float):
        self.Z_C = Z_C

    def front(self, tau: np.ndarray) -> np.ndarray:
        """Z_C, whatever tau is."""
        return np.full_like(np.asarray(tau, float), self.Z_C)


def relaxation(cells: tuple[int, int], tolerance: float) -> float:
    """Relative error of the rate at which walls lambda = 1 + delta cos(kX) relax, k X_end = pi.

    Half the difference of two tubes, disturbed either way, is free of terms in delta^2.
    """
    tubes = Tubes([0.5, 0.5], 0.1, M=0.3, Pi_ratio=1.0, Phi_inf=1.0)
    w, D = tubes.wall_length[0], 1.0 + 4 * 0.3 / 3
    family = slender.Family(tubes, Standing(1.5 * w), cells, 3.0, slender.NEWTON_SHARE * tolerance)
    X = family.faces(0.0, family.front(0.0) * np.ones((2, 1)))
    k = np.pi / X[0, -1]
    rate = D * (k**2 + 1) / w**2

    def mode(X):  # its mean over each cell
        return np.diff(np.sin(k * X)) / np.diff(k * X)

    start = family.pack(1 + AMPLITUDE * np.array([[1.0], [-1.0]]) * mode(X), X)
    with np.errstate(over="ignore"):  # `limit` divides by the drift of the faces, here none
        last, _ = march(family, start, np.sqrt(1 / rate), tolerance)
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


def at_rest(tubes: Tubes, cells: tuple[int, int]) -> tuple[slender.Family, np.ndarray, np.ndarray]:
    """A family of one tube that conserves water, its lambda and its faces, once all is at rest."""
    closure = named("conservative")
    w = float(closure.wall_length(tubes))
    family = slender.Family(tubes, Standing(RESTING * w), cells, REACH_AT_REST, 1e-5, closure)
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
