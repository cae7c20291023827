"""The family of slender tubes on cells that follow the front: one step in time by Newton's method.

The equations, with the material coordinate X, the stretch lambda = Phi^{-1/3} and the front's X_C,
are those of `gelpump.tube.slender`.

Finite volumes between faces X_f(tau) that follow the front: X_C is always a face, cells are graded
from it to both sides over the length w (or Z_C, while that is shorter), and the last face is far
enough ahead for Phi = 1. With V the size of a cell,

    d(lambda V)/dtau = [K lambda_X + X_f' lambda] - V S,     [ ] the difference of the two faces.

The flux is taken in Kirchhoff's form: K lambda_X is the gradient of
k = -(s/4) lambda^{-4} - (2M/3) lambda^{-2}. At the front k jumps and lambda does not; the lambda of
this face is the one for which the fluxes of the two sides agree. That makes the scheme second order
at the front too.

All quantities start as powers of sqrt(tau), since Z_C does, so sqrt(tau) is the time of the
variable-step formula (`gelpump.bdf`); at tau = 0 all cells have the size zero and lambda = 1, which
is exact. Face velocities come from the same formula as d(lambda V)/dtau, so a uniform state stays
uniform. Each step is a Newton iteration: FiPy solves for the correction of lambda in all tubes at
once with the exact Jacobian at fixed X_C, and X_C follows from Z(X_C) = Z_C, which makes the
remaining error about ten times smaller with each sweep. Extrapolation of all unknowns from the
steps before is good enough that one or two sweeps suffice.

Closures that conserve the water of the wall are solved in the same way, with lambda^3 V in place of
lambda V and the potential of 3 lambda^2 K in place of k. They go on sweeping at a fixed X_C, where
the Jacobian is exact, until the sum over the cells, and with it the water, is conserved to
rounding; what crosses front, edges and sections is kept in books (`gelpump.tube.ledger`).

It is one class, the residual with its Jacobian and what is read off them, hence its length.

Longer than 300 lines: residual, Jacobian and mesh of one step are read side by side.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump.bdf import NotConverged, Step
from gelpump.finite_volume import NewtonSweep
from gelpump.tube.closure import Printed

if TYPE_CHECKING:
    from gelpump.tube.heat import Heat
    from gelpump.tube.tubes import Tubes

GRADING_BEHIND = 0.5  # in units of w: where the cells behind the front begin to grow
GRADING_AHEAD = 4.0  # last cell ahead is about cosh(4) = 27 times the first
MAX_SWEEPS = 8
CONSERVED = 1e-13  # of the content that a step may leave unaccounted for
PRINTED = Printed()
DEPARTED = 0.1  # of Phi_inf - 1: nearer to Phi_0 than this counts as relaxed


class Family:
    """The semi-discrete equations; arrays are (tube, cell) or (tube, face), X in units of w.

    Public for the studies of known solutions, which give it sources and starts of their own.
    """

    def __init__(
        self,
        tubes: Tubes,
        heat: Heat,
        cells: tuple[int, int],
        reach: float,
        newton_tolerance: float,
        closure: Printed = PRINTED,
    ):
        self.behind, ahead = cells
        self.cells = self.behind + ahead
        self.closure = closure
        columns = (closure.wall_length(tubes), tubes.M, tubes.Pi_ratio, tubes.Phi_inf)
        self.w, self.M, Pi_ratio, Phi_inf = (np.reshape(c, (-1, 1)) for c in columns)
        self.tubes = len(self.w)
        self.heat, self.reach, self.newton_tolerance = heat, reach, newton_tolerance
        self.contraction = 0.3  # of the Newton iteration, measured as it goes
        self.hot = np.arange(self.cells) < self.behind
        self.s = np.where(self.hot, Pi_ratio / Phi_inf, 1.0)
        self.Phi_0 = np.where(self.hot, Phi_inf, 1.0)
        self._back = 1 - np.arange(self.behind + 1) / self.behind
        self._fore = np.sinh(GRADING_AHEAD * np.arange(1, ahead + 1) / ahead) / np.sinh(
            GRADING_AHEAD
        )
        self.sweep = NewtonSweep(self.tubes * self.cells, drifts=True)

    # The state of bdf: lambda (for its prediction and its error), and the two quantities whose
    # rates of change enter, the content, lambda V or lambda^3 V, and the faces X_f.

    def initial(self) -> NDArray:
        """The state at t = 0, undisturbed."""
        shape = (self.tubes, self.cells)
        return self.pack(np.ones(shape), np.zeros((self.tubes, self.cells + 1)))

    def pack(self, stretch: NDArray, X: NDArray) -> NDArray:
        """The state: lambda, the content of the cells and X_f in one row."""
        content = self.closure.content(stretch) * np.diff(X)
        return np.concatenate([a.ravel() for a in (stretch, content, X)])

    def unpack(self, state: NDArray) -> list[NDArray]:
        """Lambda, the content and X_f of a state, each (tube, ...)."""
        parts = np.split(state, [self.tubes * self.cells, 2 * self.tubes * self.cells])
        return [part.reshape(self.tubes, -1) for part in parts]

    def front(self, t: float) -> NDArray:
        """Z_C in units of w."""
        return self.heat.front(t * t) / self.w

    def faces(self, t: float, X_C: NDArray) -> NDArray:
        """Graded to the front; both layers are as thin as Z_C allows while that is below w."""
        X_behind = X_C - GRADING_BEHIND * np.sinh(np.arcsinh(X_C / GRADING_BEHIND) * self._back)
        X_behind[:, 0] = 0.0
        layer = self.front(t) / np.sqrt(4 + self.front(t) ** 2)
        return np.hstack([X_behind, X_C + self.reach * layer * self._fore])

    def source(self, stretch: NDArray) -> tuple[NDArray, NDArray]:
        """w^2 times what the content loses through the edges (printed: S), and its derivative."""
        return self.closure.source(stretch, self.s, self.Phi_0, self.M)

    def _k(self, stretch, s):
        return self.closure.potential(stretch, s, self.M)

    def _K(self, stretch, s):
        return self.closure.conductivity(stretch, s, self.M)

    def inner_faces(
        self, stretch: NDArray, X: NDArray
    ) -> tuple[NDArray, tuple[NDArray, NDArray], NDArray, tuple[NDArray, NDArray]]:
        """Flux of the content (printed: K lambda_X) and lambda at the faces within a tube, each
        with its two derivatives.

        Returns flux, (d flux/d left, d flux/d right), lambda, (d lambda/d left, d lambda/d right).
        """
        half = np.diff(X) / 2
        left, right = stretch[:, :-1], stretch[:, 1:]
        h_left, h_right = half[:, :-1], half[:, 1:]
        distance = h_left + h_right
        k, K = self._k(stretch, self.s), self._K(stretch, self.s)
        flux = np.diff(k) / distance
        flux_left, flux_right = -K[:, :-1] / distance, K[:, 1:] / distance
        face_left, face_right = h_right / distance, h_left / distance
        face = face_left * left + face_right * right

        c = slice(self.behind - 1, self.behind)  # the front
        s = self.s[:, c], self.s[:, self.behind, None]
        h = h_left[:, c], h_right[:, c]
        k_side = k[:, c], k[:, self.behind, None]
        g = K[:, c] / h[0], K[:, self.behind, None] / h[1]
        at_front = face[:, c]
        for _ in range(20):
            G = self._K(at_front, s[0]) / h[0], self._K(at_front, s[1]) / h[1]
            excess = (self._k(at_front, s[0]) - k_side[0]) / h[0]
            excess += (self._k(at_front, s[1]) - k_side[1]) / h[1]
            at_front = at_front - excess / (G[0] + G[1])
            if np.abs(excess / (G[0] + G[1])).max() < 1e-13:
                break
        flux[:, c] = (self._k(at_front, s[0]) - k_side[0]) / h[0]
        face[:, c] = at_front
        face_left[:, c], face_right[:, c] = g[0] / (G[0] + G[1]), g[1] / (G[0] + G[1])
        flux_left[:, c] = -g[0] * G[1] / (G[0] + G[1])
        flux_right[:, c] = g[1] * G[0] / (G[0] + G[1])
        return flux, (flux_left, flux_right), face, (face_left, face_right)

    def exchange(
        self, stretch: NDArray, X: NDArray, velocity: NDArray, rate: NDArray
    ) -> tuple[NDArray, tuple[NDArray, NDArray], NDArray, tuple[NDArray, NDArray], NDArray]:
        """`inner_faces` with lambda as it is carried by the faces' velocity, and d content/d lambda
        there."""
        flux, flux_slope, face, face_slope = self.inner_faces(stretch, X)
        carried = velocity * self.closure.content_slope(face)
        self.limit(stretch, carried, rate, flux_slope, face, face_slope)
        return flux, flux_slope, face, face_slope, self.closure.content_slope(face)

    def limit(
        self,
        stretch: NDArray,
        velocity: NDArray,
        rate: NDArray,
        flux_slope: NDArray,
        face: NDArray,
        face_slope: NDArray,
    ) -> None:
        """Take no more of lambda from the downwind cell than diffusion brings back.

        At the very start, and if heat is much faster than the gel, coarse cells are swept over
        faster than they diffuse. For Le = 10 the limit bites only far ahead, where lambda = 1.
        """
        left, right = face_slope
        allowed = -rate * flux_slope[0] / np.maximum(velocity, np.finfo(float).tiny)
        excess = np.maximum(left - allowed, 0.0)
        left -= excess
        right += excess
        face += excess * np.diff(stretch)

    def advance(self, t: float, guess: NDArray, alpha: float, history: NDArray) -> NDArray:
        """One implicit step in t = sqrt(tau); d/dt is alpha times the new value plus history."""
        stretch, _, X = self.unpack(guess)
        _, content_history, X_history = self.unpack(history)
        Z_C = self.front(t)
        X_C = X[:, self.behind, None] if X.any() else Z_C  # nothing to extrapolate at first
        rate = 2 * t / self.w**2  # dtau/dt in units of w^2
        previous, settled = None, False
        for _ in range(MAX_SWEEPS):
            X = self.faces(t, X_C)
            V = np.diff(X)
            velocity = alpha * X + X_history
            inner, end = velocity[:, 1:-1], velocity[:, -1:]
            flux, flux_slope, face, face_slope, carried = self.exchange(stretch, X, inner, rate)
            S, S_slope = self.source(stretch)
            # what the last face sweeps in is undisturbed: lambda = 1
            at_faces = rate * flux + inner * self.closure.content(face)
            through = np.hstack([np.zeros_like(end), at_faces, end])
            content = alpha * self.closure.content(stretch) * V
            residual = content + content_history - np.diff(through) + rate * V * S
            if settled and self.conserves(residual, content + rate * V * np.abs(S)):
                return self.pack(stretch, X)
            from_left, from_right = (
                rate * f + inner * carried * e for f, e in zip(flux_slope, face_slope, strict=True)
            )
            reaction = V * (alpha * self.closure.content_slope(stretch) + rate * S_slope)
            correction = self.sweep.correction(
                on_faces((from_right - from_left) / 2),
                reaction.ravel(),
                residual.ravel(),
                on_faces(from_right + from_left),
            ).reshape(stretch.shape)
            stretch = stretch + correction
            if not (stretch > 0.1 * stretch.max()).all():
                raise NotConverged
            if settled:
                continue
            shift = (Z_C - (stretch * V)[:, self.hot].sum(axis=1, keepdims=True)) / face[
                :, self.behind - 1, None
            ]
            X_C = X_C + shift
            change = max(np.abs(3 * correction / stretch**4).max(), np.abs(shift).max())
            if previous is not None:
                self.contraction = np.clip(change / previous, 0.05, 1.0)
            if change * self.contraction < self.newton_tolerance:
                if not self.closure.conserves_water:
                    return self.pack(stretch, self.faces(t, X_C))
                settled = True
            elif previous is not None and change > 2 * previous:
                break
            previous = change
        raise NotConverged

    def conserves(self, residual: NDArray, turnover: NDArray) -> bool:
        """Whether the sums over the cells behind and ahead of the front vanish to rounding."""
        sums = [residual[:, side].sum(axis=1) for side in (self.hot, ~self.hot)]
        return (np.abs(sums) <= CONSERVED * turnover.sum(axis=1)).all()

    def error_norm(self, state: NDArray, difference: NDArray) -> float:
        """As a change of Phi_1; a shift of X_C by w changes it by a tenth at fixed Z."""
        stretch, _, _ = self.unpack(state)
        d_stretch, _, d_X = self.unpack(difference)
        return max(
            np.abs(3 * d_stretch / stretch**4).max(), 0.1 * np.abs(d_X[:, self.behind]).max()
        )

    def profile(self, t: float, step: Step) -> dict[str, NDArray]:
        """What the dataset holds of one time, but for the account of what was lost."""
        stretch, content, X = self.unpack(step.at(t))
        if self.closure.conserves_water:
            stretch = np.cbrt(content / np.diff(X))
        V, Phi = np.diff(X), stretch**-3.0
        flux, _, face, _ = self.inner_faces(stretch, X)
        Z_face = self.w * np.hstack([np.zeros_like(V[:, :1]), np.cumsum(stretch * V, axis=1)])
        Z, front = (Z_face[:, 1:] + Z_face[:, :-1]) / 2, Z_face[:, self.behind, None]
        Phi_front = face[:, self.behind - 1, None] ** -3.0
        per_stretch, at_faces = (self.closure.content_slope(each) for each in (stretch, face))
        return {
            "Phi1": Phi,
            "Z": Z,
            "F": 3 * self.source(stretch)[0] / per_stretch / stretch**4 / self.w**2,
            "Z_face": Z_face,
            "flux": np.pad(-3 * flux / at_faces * face**-3.0 / self.w, ((0, 0), (1, 1))),
            "Phi1_front": Phi_front[:, 0],
            "front_error": np.abs(front - self.w * self.front(t))[:, 0],
            "departed_length": self.departed_length(Z, Phi, front, Phi_front),
        }

    def departed_length(
        self, Z: NDArray, Phi: NDArray, front: NDArray, Phi_front: NDArray
    ) -> NDArray:
        """Length where Phi differs from Phi_0, which jumps at the front, by more than DEPARTED.

        Phi is linear between the middles of cells, and from them to the front.
        """
        excess = np.abs(self.Phi_0 - Phi) - DEPARTED * (self.Phi_0[:, :1] - 1)
        at_front = np.abs(self.Phi_0 - Phi_front) - DEPARTED * (self.Phi_0[:, :1] - 1)
        b = self.behind
        length = np.zeros(self.tubes)
        for position, value in (
            (np.hstack([Z[:, :b], front]), np.hstack([excess[:, :b], at_front[:, :1]])),
            (np.hstack([front, Z[:, b:]]), np.hstack([at_front[:, -1:], excess[:, b:]])),
        ):
            above = np.maximum(value, 0.0)
            share = (above[:, 1:] + above[:, :-1]) / np.maximum(
                np.abs(value[:, 1:]) + np.abs(value[:, :-1]), np.finfo(float).tiny
            )
            length += (np.diff(position) * share).sum(axis=1)
        return length + Z[:, 0] * (excess[:, 0] > 0)  # from the closed end to the first middle


def on_faces(inner):
    """A family's face values on FiPy's mesh, where a tube's last face is the next one's first."""
    return np.append(np.pad(inner, ((0, 0), (1, 0))).ravel(), 0.0)
