"""The wall of a uniformly heated tube resolved in r, on FiPy: what the slender tube's F stands for.

The temperature is changed everywhere at once, so nothing varies along the tube. A point of the wall
keeps the radius s that it had when swollen, ell <= s <= 1, and y = s^2/2; with J = 1/Phi a ring dy
has the volume J dy for each unit of swollen length. All lengths of the tube change alike, by

    lambda = <J>^(1/3) ,  B_0 = ell lambda ,  B_1 = lambda ,  r^2 = B_0^2 + (2/lambda) Int J dy

(`gelpump.tube.closure` derives that xi/r on the edges and eta_z are equal; < > is the mean over y,
and 1/<J> that of Phi over the wall). Water leaves a ring by D Phi_r/Phi through r lambda:

    J_tau = -d/dy [ r^2 lambda^2 dPsi/dy ] ,    Psi = Int D dPhi = s_T Phi^2/2 + M Phi^(4/3) ,

eqn:tube_evolution on its exact annulus, s_T and Phi_0 being those of the temperature. Lengths are
in a_1, tau in mu_l a_1^2/(k Pi_00). On both edges, by the name of the closure that takes it,

    conservative   Phi_s = Phi_0, eqn:b1bc
    balanced       s_T (Phi_s - Phi_0) = 4 M [ 1/lambda - Phi_s^(1/3) ], no force on the surface .

The mean <Phi^(1/3)> of `gelpump.tube.closure` is 1/lambda to the accuracy of its displacements;
1/lambda keeps to the shape of the wall, as a_0/a does for the bead (section 2.1).

Linearised around Phi_0, disturbances relax as exp(-k^2 D tau/h^2), h = (1-ell) Phi_0^(-1/3) the
thickness at rest. With Phi_s = Phi_0, k is the first zero of the annulus' cross product of Bessel
functions (`first_eigenvalue`); for a thin wall whose surface bears no force

    (k/2) cot(k/2) = m Phi_0^(1/3)/D(Phi_0) ,   m = 4M/3       (`thin_wall_eigenvalue`).
"""

from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq
from scipy.special import j0, y0

from gelpump.bdf import MAX_TRIALS, NotConverged, integrate
from gelpump.finite_volume import NewtonSweep
from gelpump.tube.closure import WATER, named
from gelpump.tube.deswelling import deswelling_time
from gelpump.tube.tubes import Tubes

SURFACES = WATER
CELLS = 20  # across the wall, clustered at both edges
TOLERANCE = 2e-4  # of a step, in Phi
LONGEST = 30.0  # roots of that time
FIRST_STEP = 1e-2  # of the root of the time that a tube is expected to take
MAX_SWEEPS = 12
NEWTON_SHARE = 0.03  # of the tolerance, which the iteration may leave
COARSER = 2, 8.0  # fewer cells, looser steps: both errors are then four times as large
DOUBT = 0.25  # of what extrapolation adds: an order between 1.8 and 2.3 where it takes 2
NODES = 64  # of the quadrature of `closure_time`


class Walls:
    """The semi-discrete walls of a family of tubes, arrays (tube, cell) or (tube, face).

    Each has its own unit of time, so that all relax alike, and its own surface, of SURFACES.
    """

    def __init__(self, tubes: Tubes, surface: ArrayLike, cells: int, tolerance: float):
        columns = (tubes.ell, tubes.M, tubes.Pi_ratio, tubes.Phi_inf)
        self.ell, self.M, Pi_ratio, self.Phi_0 = (np.reshape(c, (-1, 1)) for c in columns)
        self.s = Pi_ratio / self.Phi_0
        self.closure = named(np.full(len(self.ell), surface).tolist())
        self.accuracy = NEWTON_SHARE * tolerance
        share = (1 - np.cos(np.pi * np.arange(cells + 1) / cells)) / 2
        y = (self.ell + (1 - self.ell) * share) ** 2 / 2
        self.dy, self.y = np.diff(y), y
        middle = (y[:, 1:] + y[:, :-1]) / 2
        self.gap = np.diff(np.hstack([y[:, :1], middle, y[:, -1:]]))
        forceless = thin_wall_eigenvalue(self.M, self.s, self.Phi_0)
        k = np.where(self.closure.forceless, forceless, np.pi)
        h = (1 - self.ell) * self.Phi_0 ** (-1 / 3)
        self.unit = np.log(100) * h**2 / (k**2 * self.diffusivity(self.Phi_0))
        self.sweep = NewtonSweep(self.dy.size)

    def diffusivity(self, Phi):
        """D."""
        return self.s * Phi + 4 * self.M / 3 * np.cbrt(Phi)

    def potential(self, Phi):
        """Psi."""
        return self.s * Phi**2 / 2 + self.M * Phi ** (4 / 3)

    def stretch(self, J):
        """lambda, (tube, 1)."""
        return np.cbrt((J * self.dy).sum(axis=1, keepdims=True) / self.dy.sum(axis=1)[:, None])

    def radius(self, J):
        """r of the faces."""
        stretch = self.stretch(J)
        inside = np.pad(np.cumsum(J * self.dy, axis=1), ((0, 0), (1, 0)))
        return np.sqrt((self.ell * stretch) ** 2 + 2 / stretch * inside)

    def advance(self, t, guess, alpha, history):
        """One implicit step in t = tau^(1/2); geometry follows Newton's iteration by one sweep."""
        J, history = guess.reshape(self.dy.shape), history.reshape(self.dy.shape)
        for _ in range(MAX_SWEEPS):
            if not (J > 0).all():
                raise NotConverged
            Phi = 1 / J
            edge, _ = self.closure.surface(self.stretch(J), self.s, self.Phi_0, self.M)
            conductance = 2 * t * self.unit * (self.radius(J) * self.stretch(J)) ** 2 / self.gap
            flux = conductance * np.diff(self.potential(np.hstack([edge, Phi, edge])), axis=1)
            residual = self.dy * (alpha * J + history) + np.diff(flux, axis=1)
            # Psi_J = -D Phi^2 differs from cell to cell: scaled by it, the operator is symmetric
            slope = self.diffusivity(Phi) * Phi**2
            reaction = alpha * self.dy / slope
            reaction[:, 0] += conductance[:, 0]
            reaction[:, -1] += conductance[:, -1]
            inner = conductance.copy()
            inner[:, [0, -1]] = 0.0
            faces = np.append(inner[:, :-1].ravel(), 0.0)
            change = self.sweep.correction(faces, reaction.ravel(), residual.ravel())
            change = change.reshape(J.shape) / slope
            J = J + change
            if np.abs(change * Phi**2).max() < self.accuracy:
                return J.ravel()
        raise NotConverged

    def error_norm(self, state, difference):
        """As a change of Phi, its root mean square over the wall."""
        change = (difference / state**2).reshape(self.dy.shape)
        return float(np.sqrt((change**2 * self.dy).sum(axis=1) / self.dy.sum(axis=1)).max())

    def observed(self, state):
        """Phi on the midline R = (B_0 + B_1)/2, and in the mean over the wall: (2, tube)."""
        J = state.reshape(self.dy.shape)
        r = self.radius(J)
        middle, centre = (r[:, 1:] + r[:, :-1]) / 2, (r[:, :1] + r[:, -1:]) / 2
        nearest = (middle < centre).sum(axis=1, keepdims=True) + np.arange(-2, 2)
        away = np.take_along_axis(middle, nearest, 1) - centre  # a cubic through four cells
        gaps = away[:, None, :] - away[:, :, None] + np.eye(4)
        others = np.where(np.eye(4, dtype=bool), 1.0, away[:, None, :])
        at_centre = (others / gaps).prod(axis=2) / np.take_along_axis(J, nearest, 1)
        return np.array([at_centre.sum(axis=1), 1 / self.stretch(J)[:, 0] ** 3])


def relax(
    tubes: Tubes, surface: ArrayLike, cells: int = CELLS, tolerance: float = TOLERANCE
) -> NDArray:
    """tau_99 on the midline and of the mean, shape (2, tube), in units of mu_l L^2/(k Pi_00)."""
    walls = Walls(tubes, surface, cells, tolerance)
    wanted = (walls.Phi_0 - (walls.Phi_0 - 1) / 100)[:, 0]
    found = np.full((2, len(wanted)), np.nan)
    for step in integrate(
        walls.advance,
        np.ones(walls.dy.size),
        LONGEST,
        order=3,
        tolerance=tolerance,
        first_step=FIRST_STEP,
        error_norm=walls.error_norm,
        trials=MAX_TRIALS,
    ):
        now = walls.observed(step.solution)
        for which, tube in np.argwhere((now >= wanted) & np.isnan(found)):
            here = partial(_excess, walls, step, which, tube, wanted[tube])
            found[which, tube] = brentq(here, step.start, step.time, rtol=1e-12) ** 2
        if not np.isnan(found).any():
            break
    return found * walls.unit[:, 0] * tubes.eps.ravel() ** 2


def _excess(walls, step, which, tube, wanted, t):
    return walls.observed(step.at(t))[which, tube] - wanted


def deswelling_times(tubes: Tubes) -> tuple[np.ndarray, np.ndarray]:
    """tau_99 by SURFACES, on the midline and of the mean, (2, 2, tube), and its uncertainty.

    Extrapolated from CELLS and half as many, both of second order in space.
    """
    columns = (tubes.ell, tubes.eps, tubes.M, tubes.Pi_ratio, tubes.Phi_inf)
    both = Tubes(*(np.tile(np.ravel(column), len(SURFACES)) for column in columns))
    surfaces = np.repeat(SURFACES, tubes.ell.size)
    fine, coarse = (
        relax(both, surfaces, CELLS // fewer, TOLERANCE * looser)
        .reshape(2, len(SURFACES), -1)
        .swapaxes(0, 1)
        for fewer, looser in ((1, 1.0), COARSER)
    )
    added = (fine - coarse) / (COARSER[0] ** 2 - 1)
    return fine + added, DOUBT * np.abs(added)


def slower(tubes: Tubes) -> np.ndarray:
    """How many times as long as by eqn:tube_model a wall resolved in r takes on its midline.

    The longer of the times of SURFACES.
    """
    return deswelling_times(tubes)[0][:, 0].max(axis=0) / deswelling_time(tubes)


def closure_time(tubes: Tubes, closure: str) -> np.ndarray:
    """tau_99 of the slender closure, w^2 Int dPhi/[Phi^(2/3) D (Phi_s - Phi)], by quadrature.

    With y = ln[Phi/(Phi_0 - Phi)] for Phi, as in `gelpump.tube.deswelling`.
    """
    closure = named(closure)
    Phi_0, M = tubes.Phi_inf[..., None], tubes.M[..., None]
    s, last = tubes.Pi_ratio[..., None] / Phi_0, Phi_0 - (Phi_0 - 1) / 100
    start, end = (np.log(Phi / (Phi_0 - Phi)) for Phi in (np.ones_like(Phi_0), last))
    node, weight = np.polynomial.legendre.leggauss(NODES)
    Phi = Phi_0 / (1 + np.exp(-(start + (end - start) * (1 + node) / 2)))
    content, _ = closure.source(Phi ** (-1 / 3), s, Phi_0, M)
    loss = content / closure.content_slope(Phi ** (-1 / 3))  # -lambda_tau w^2
    per_y = Phi ** (-4 / 3) / 3 * Phi * (Phi_0 - Phi) / Phi_0 / loss
    return closure.wall_length(tubes) ** 2 * (per_y * weight).sum(-1) * (end - start)[..., 0] / 2


def first_eigenvalue(ell: float) -> float:
    """k^2 of the slowest mode with Phi_s = Phi_0 on both edges: exp(-k^2 D tau/h^2), h = 1-ell.

    J_0(x ell) Y_0(x) = J_0(x) Y_0(x ell), k = x (1-ell): pi^2 for thin walls.
    """

    def cross(k):
        x = k / (1 - ell)
        return j0(x * ell) * y0(x) - j0(x) * y0(x * ell)

    return brentq(cross, 2.0, 3.5, xtol=1e-15, rtol=1e-15) ** 2


def thin_wall_eigenvalue(M, s, Phi_0):
    """k of the slowest mode of a thin wall whose surface bears no force; 0 < k < pi."""
    m = 4 * M / 3 * np.cbrt(Phi_0)
    r = m / (s * Phi_0 + m)
    low, high = np.zeros_like(r), np.full_like(r, np.pi / 2)
    for _ in range(60):  # x cot x falls from 1 to 0
        x = (low + high) / 2
        above = x / np.tan(x) > r
        low, high = np.where(above, x, low), np.where(above, high, x)
    return low + high
