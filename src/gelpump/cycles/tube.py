r"""A slender tube under a temperature programme: fronts that advance, turn back and meet.

The equation is that of `gelpump.tube.slender` for a wall that conserves water, in X, the length
that a slice had when swollen, here on slices that do not move with any front:

    (lambda^3)_tau = (3 lambda^2 K lambda_X)_X - 3 lambda^2 S ,   Z_X = lambda ,   Z(0) = 0 ,

K and S of `gelpump.cycles.walls` at the temperature T(Z, tau) of `gelpump.cycles.programme`.  Since
T is known where a slice is, not which slice it is, the unknowns are the positions Z of the slices'
faces; lambda = dZ/dX, and each balance sees four of them.  Newton's method takes that banded
Jacobian by differences.  From each jump or bend of the programme on, at tau_k, time is stepped in
(tau - tau_k)^{1/2} by `gelpump.bdf`, since fronts start as that.

Beside the content of each slice the solver carries what has left it through its edges; with the
same formula for both, the sum of the two changes by nothing: the books close to rounding.

What is pumped, per pi a_1^2 L and with sigma of `wall_flow.lumen_share`, up to the section X:

    passed(X) = ell^2 Integral_0^X (1 - lambda^3) dX + sigma (1-ell^2) Integral_0^X (edges' loss) dX

past the section itself; past a station that does not move, less ell^2 times its displacement.
A wall that conserves water has Integral_0^X (edges' loss) = Integral_0^X (1 - lambda^3) dX + axial
flow past X.  So once all repeats from cycle to cycle, **what a cycle pumps past X is sigma times
what it has drawn through the wall past X**, which vanishes far ahead: nothing goes past a station
that no front comes near.  What a cycle moves to and fro, its `stroke`, does not vanish.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import solve_banded

from gelpump.bdf import Barrier, NotConverged, integrate
from gelpump.cycles.programme import Programme
from gelpump.cycles.walls import Lost, RealWall, TwoStates, Walls
from gelpump.tube.closure import named
from gelpump.tube.wall_flow import lumen_share

if TYPE_CHECKING:
    from gelpump.materials import Gel
    from gelpump.tube.tubes import Tubes

ORDER = 3
TOLERANCE = 1e-2
CELL = 0.5  # of w
GROWTH = 1.08  # of the slices where no front comes
REACH = 12.0  # in units of w, beyond the furthest front
SMOOTH = 4.0  # in units of w, where T varies continuously: as far as slices are thin
TAIL = 4.0  # heat is felt up to 2 TAIL (Le tau)^{1/2}
MAX_SWEEPS = 12
CONSERVED = 1e-13
DIFFERENCE = 1e-6
LOWER, UPPER = 2, 1  # diagonals of the Jacobian
SLOW = 0.1  # a change over the one before that asks for a new Jacobian
SAME = 1e-12  # of a time


class Account(NamedTuple):
    """A tube at some times: (time, face) for Z, passed, axial; (time, cell) for Phi1; lengths in L,
    volumes in pi a_1^2 L."""

    tau: NDArray
    X: NDArray
    Z: NDArray
    Phi1: NDArray
    passed: NDArray
    """Water that has gone past each section X along the lumen, away from Z = 0."""
    axial: NDArray
    """Water that has gone through the wall past each section X, towards Z = 0."""
    lumen: NDArray
    """Volume that the lumen has lost up to the far end of the solved tube."""
    station: NDArray
    """Water that has gone past a fixed station far ahead."""
    imbalance: float
    """Most of what the books did not account for, over the largest loss of the wall."""
    steps: int
    lost: tuple[float, float, Lost] | None
    """Time, place Z and state where the wall could not go on."""


class Slices:
    """The balances of one tube's slices, and the step that `gelpump.bdf` asks for."""

    def __init__(self, wall: Walls, X: NDArray, tolerance: float):
        self.wall, self.X, self.dX, self.n = wall, X, np.diff(X), len(X) - 1
        self.closure, self.w, self.tolerance = wall.closure, wall.w, tolerance
        self.begin = 0.0
        self.loss: Lost | None = None

    def pack(self, stretch, edges):
        """State: lambda, contents, and what has left through the edges, of each slice."""
        return np.concatenate([stretch, self.closure.content(stretch) * self.dX, edges])

    def faces(self, stretch):
        """Z of all faces."""
        return np.append(0.0, np.cumsum(stretch * self.dX))

    def balance(self, stretch, alpha, history, rate):
        """Residual of each slice, its content and loss per unit of the stepper's time."""
        Z = self.faces(stretch)
        apart = 0.5 * (self.dX[1:] + self.dX[:-1])
        flux = np.pad(self.wall.conductance(stretch, Z) * np.diff(stretch) / apart, 1)
        left = rate * self.wall.source(stretch, Z) * self.dX
        content = alpha * self.closure.content(stretch) * self.dX
        return content + history - rate * np.diff(flux) + left, content, left

    def jacobian(self, stretch, residual, *given):
        """Its bands with respect to the positions of the faces, by differences."""
        bands = np.zeros((LOWER + UPPER + 1, self.n))
        step = DIFFERENCE * np.minimum(self.dX, np.append(self.dX[1:], np.inf))
        for colour in range(LOWER + UPPER + 1):
            j = np.arange(colour, self.n, LOWER + UPPER + 1)
            shift = np.zeros(self.n)
            shift[j] = step[j]
            moved = stretch + np.diff(shift, prepend=0.0) / self.dX
            change = self.balance(moved, *given)[0] - residual
            for offset in range(-UPPER, LOWER + 1):
                column = j[(j + offset >= 0) & (j + offset < self.n)]
                bands[UPPER + offset, column] = change[column + offset] / step[column]
        return bands

    def advance(self, t, guess, alpha, history):
        """One implicit step in t = (tau - tau_k)^{1/2}."""
        self.wall.begin(self.begin + t * t)
        stretch = guess[: self.n].copy()
        given = alpha, history[self.n : 2 * self.n], 2 * t / self.w**2
        bands, before = None, np.inf
        for _ in range(MAX_SWEEPS):
            residual, content, left = self.balance(stretch, *given)
            if np.abs(residual).sum() <= CONSERVED * (np.abs(content) + np.abs(left)).sum():
                break
            if bands is None:
                bands = self.jacobian(stretch, residual, *given)
            moved = solve_banded((LOWER, UPPER), bands, -residual, check_finite=False)
            change = np.diff(moved, prepend=0.0) / self.dX
            size = np.abs(change).max()
            if not size < 2 * before:
                raise NotConverged
            if size > SLOW * before:
                bands = None
            stretch, before = stretch + change, size
            if not stretch.min() > 0:
                raise NotConverged
        else:
            raise NotConverged
        self.loss = self.wall.lost(stretch, self.faces(stretch))
        if self.loss is not None:
            raise Barrier
        return self.pack(stretch, (left - history[2 * self.n :]) / alpha)

    def error_norm(self, state, difference):
        """Of Phi_1: the root of its square's integral over X (in w)."""
        d = 3 * difference[: self.n] / state[: self.n] ** 4
        return float(np.sqrt((d**2 * self.dX).sum()))


def faces(wall_length: float, front: float | None, far: float, cell: float) -> NDArray:
    """X of the slices' faces, in units of w: thin up to ``front`` (in w; None: SMOOTH), then
    growing until ``far``."""
    thin = SMOOTH if front is None else front
    X = list(np.arange(0.0, thin + cell, cell))
    # refined alike: a mesh of half the cell has twice the slices at every place
    growth = GROWTH ** (cell / CELL)
    step = cell
    while X[-1] < far:
        step *= growth
        X.append(X[-1] + step)
    return np.array(X)


def solve(
    tube: Tubes,
    programme: Programme,
    Le: float,
    tau: ArrayLike,
    *,
    gel: Gel | None = None,
    closure: str = "conservative",
    cell: float = CELL,
    tolerance: float = TOLERANCE,
) -> Account:
    """The tube (one of `Tubes`) at 0 and the times ``tau``; its end Z = 0 follows the programme.

    Without ``gel`` the piecewise-linear one of `Tubes`, the programme in theta = (T - T_C)/Delta T;
    with it, that gel, in K.  ``closure`` is one that conserves water.  It ends early, and says
    where, if D <= 0 is met.  ValueError for what is not so.
    """
    tau = np.unique(np.append(0.0, np.asarray(tau, float)))
    if not (tau[0] == 0 and tau.size > 1 and np.isfinite(tau).all()):
        raise ValueError(f"tau = {tau} is not allowed: from 0 on")
    law = named(closure)
    if not law.conserves_water:
        raise ValueError(f"closure = {closure!r} is not allowed: it must conserve water")
    if np.size(tube.ell) != 1:
        raise ValueError(f"tubes: {np.size(tube.ell)} are given: must be one")
    ell, eps = float(np.ravel(tube.ell)[0]), float(np.ravel(tube.eps)[0])
    one = type(tube)(ell, eps, *(float(np.ravel(getattr(tube, k))[0])
                                 for k in ("M", "Pi_ratio", "Phi_inf")))  # fmt: skip
    if gel is None:
        wall = TwoStates(one, programme, Le, law)
        hottest = [t for t in np.append(programme.breaks, tau) if t > 0]
        dense = np.unique(np.concatenate([np.linspace(0, tau[-1], 201)[1:], hottest]))
        found = [programme.fronts(0.0, t, Le) for t in dense]
        front = max((each.max() for each in found if each.size), default=0.0) / wall.w
        # a length of hot tube was longer when swollen
        front *= float(np.cbrt(one.Phi_inf))
        far = front + REACH
    else:
        wall = RealWall(one, programme, Le, law, gel)
        front = None
        # the tube has been drawn in: what is at Z was further away when swollen
        densest = max(each.phi.max() for each in (wall.swollen, wall.dry)) / wall.phi_00
        far = 2 * TAIL * np.sqrt(Le * tau[-1]) / wall.w * np.cbrt(densest) + REACH
    slices = Slices(wall, faces(wall.w, front, far, cell), tolerance)
    return _march(slices, programme, tau, ell)


def _march(slices, programme, tau, ell):
    n, w = slices.n, slices.w
    state = slices.pack(np.ones(n), np.zeros(n))
    slices.wall.begin(0.0)
    slices.wall.passed(slices.X)
    marks = programme.breaks
    begins = np.unique(np.append(0.0, marks[marks < tau[-1]]))
    found, steps, worst, lost = [state], 0, 0.0, None
    for begin, end in zip(begins, np.append(begins[1:], tau[-1]), strict=True):
        slices.begin, last = begin, np.sqrt(end - begin)
        times = np.sqrt(np.maximum(tau[len(found) :] - begin, 0.0))
        times = times[times <= last * (1 + SAME)]
        made = 0
        try:
            for step in integrate(
                slices.advance, state, last, order=ORDER, tolerance=slices.tolerance,
                first_step=min(0.01 * w, 0.1 * last), error_norm=slices.error_norm,
            ):  # fmt: skip
                steps += 1
                while made < len(times) and times[made] <= step.time * (1 + SAME):
                    found.append(step.at(min(times[made], step.time)))
                    made += 1
                state = step.solution
                worst = max(worst, abs((state[n : 2 * n] + state[2 * n :] - slices.dX).sum()))
                slices.wall.passed(slices.faces(state[:n]))
        except Barrier:
            where = 0.5 * sum(slices.faces(state[:n])[slices.loss.cell :][:2])
            lost = float(slices.wall.tau), float(w * where), slices.loss
            break
    stretch, content, edges = np.split(np.array(found), [n, 2 * n], axis=1)
    Z = np.cumsum(stretch * slices.dX, axis=1)
    sigma, section = float(lumen_share(ell)), 1 - ell**2
    loss, through = (w * np.cumsum(each, axis=1) for each in (slices.dX - content, edges))
    passed = ell**2 * loss + sigma * section * through
    return Account(
        tau[: len(found)], w * slices.X[1:], w * Z, stretch**-3.0, passed,
        section * (through - loss), ell**2 * loss[:, -1],
        passed[:, -1] - ell**2 * w * (slices.X[-1] - Z[:, -1]),
        w * worst / max(np.abs(loss).max(), w), steps, lost,
    )  # fmt: skip
