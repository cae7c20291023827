"""The cells of tubes whose collapse consumes heat: one step in time of wall, heat and front.

The equations are those of `gelpump.tube.heated`. Cells, time steps and Newton's iteration are those
of `gelpump.tube.moving_mesh`, with cells ahead as far as heat gets. A cell's heat, its capacity
and its water are differenced in time by one formula, and the flux M of volume through the moving
faces is summed from what cells lose, so that a uniform temperature stays so and heat is
conserved to rounding. X_C is no longer given: in a step it follows from theta = 0 at its face by
a secant.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gelpump.bdf import NotConverged, Step
from gelpump.tube.closure import CLOSURES
from gelpump.tube.heat import StepHeating
from gelpump.tube.moving_mesh import GRADING_BEHIND, Family, on_faces
from gelpump.tube.wall_flow import lumen_share

if TYPE_CHECKING:
    from gelpump.tube.stefan import Surrounding
    from gelpump.tube.tubes import Tubes

REACH = 4.5  # end of the domain of heat: this far ahead of the front, in 2 sqrt(Le tau)
MAX_SWEEPS = 20


class HeatedFamily(Family):
    """The semi-discrete equations of tubes that differ in shape, gel, Le, L and surrounding.

    Le, N: numbers or columns (tubes, 1).  latent: L (tubes, 1), or None for that of the printed
    equation.
    """

    def __init__(
        self,
        tubes: Tubes,
        Le: ArrayLike,
        latent: NDArray | None,
        N: ArrayLike,
        surrounding: Surrounding,
        cells: tuple[int, int],
        newton_tolerance: float,
    ):
        super().__init__(
            tubes, StepHeating(Le), cells, REACH, newton_tolerance, CLOSURES["conservative"]
        )
        ell = np.reshape(tubes.ell, (-1, 1))
        self.Le, self.latent, self.N = np.broadcast_to(Le, ell.shape), latent, N
        self.insulated = np.reshape(
            np.broadcast_to(surrounding.insulated, tubes.ell.shape), (-1, 1)
        )
        self.section = np.reshape(np.broadcast_to(surrounding.section, tubes.ell.shape), (-1, 1))
        self.wall = 1 - ell**2
        outwards = (1 - lumen_share(ell)) * self.wall
        self.outwards = np.where(self.insulated, outwards, 0.0)
        self._ahead = np.arange(1, cells[1] + 1) / cells[1]
        self._slope = np.full(ell.shape, np.nan)  # d theta(X_C)/dX_C, learned as it goes

    def capacity(self, stretch: NDArray) -> NDArray:
        """C."""
        return np.where(self.insulated, stretch**3, self.section * stretch)

    def conductance(self, stretch: NDArray) -> NDArray:
        """G."""
        return np.where(self.insulated, stretch, self.section / stretch)

    def initial(self) -> NDArray:
        """The state at t = 0: undisturbed, theta that of eqn:temp_field_sol."""
        from scipy.special import erfc

        t = 1e-6 * float(self.w.min())
        X = self.faces(t, self.front(t))
        x = self.w * (X[:, 1:] + X[:, :-1]) / (4 * np.sqrt(self.Le) * t)
        return self.pack(np.ones_like(x), 0.0 * X, 2 * erfc(x) - 1)

    def pack(self, stretch: NDArray, X: NDArray, theta: NDArray) -> NDArray:
        """The state: lambda, the water of the cells, X_f, theta, heat and capacity of the cells."""
        V = np.diff(X)
        held = self.capacity(stretch) * V
        parts = stretch, stretch**3 * V, X, theta, held * theta, held
        return np.concatenate([part.ravel() for part in parts])

    def unpack(self, state: NDArray) -> list[NDArray]:
        """Those of a state, each (tube, ...)."""
        cells, faces = self.tubes * self.cells, self.tubes * (self.cells + 1)
        ends = np.cumsum([cells, cells, faces, cells, cells])
        return [part.reshape(self.tubes, -1) for part in np.split(state, ends)]

    def faces(self, t: float, X_C: NDArray) -> NDArray:
        """Graded to the front over w; as far ahead as heat gets."""
        g, reach = GRADING_BEHIND, 2 * REACH * np.sqrt(self.Le) * t / self.w
        behind = X_C - g * np.sinh(np.arcsinh(X_C / g) * self._back)
        behind[:, 0] = 0.0
        return np.hstack([behind, X_C + g * np.sinh(np.arcsinh(reach / g) * self._ahead)])

    def limit(self, *given: NDArray) -> None:
        """That of `Family`; a trial X_C may lie behind, where nothing is to be limited."""
        with np.errstate(over="ignore"):
            super().limit(*given)

    def advance(self, t: float, guess: NDArray, alpha: float, history: NDArray) -> NDArray:
        """One implicit step in t = sqrt(tau); d/dt is alpha times the new value plus history."""
        stretch, _, X, theta, _, _ = self.unpack(guess)
        past = self.unpack(history)
        X_C = X[:, self.behind, None] if X.any() else self.front(t)
        settled, before = False, None
        for _ in range(MAX_SWEEPS):
            X = self.faces(t, X_C)
            velocity = alpha * X + past[2]
            stretch, correction, conserved = self.wall_step(t, X, velocity, stretch, alpha, past[1])
            if settled and not conserved:
                continue
            theta, change = self.heat_step(t, X, velocity, stretch, theta, alpha, past)
            if settled:
                return self.pack(stretch, X, theta)
            at_front, gradient = self.at_front(X, theta)
            known = np.where(np.isfinite(self._slope), self._slope, gradient)
            if before is not None:
                moved = X_C - before[0]
                with np.errstate(divide="ignore", invalid="ignore"):
                    secant = (at_front - before[1]) / moved
                usable = (np.abs(moved) > 1e-9) & (secant < 0.2 * gradient) & np.isfinite(secant)
                known = np.where(usable, secant, known)
            self._slope = known
            shift = -at_front / known
            before, X_C = (X_C, at_front), X_C + shift
            if not (X_C > 0).all():
                raise NotConverged
            wall = np.abs(3 * correction / stretch**4).max()
            if max(wall, change, np.abs(at_front).max()) < self.newton_tolerance:
                settled, X_C = True, before[0]
        raise NotConverged

    def wall_step(self, t, X, velocity, stretch, alpha, past):
        """lambda after a step of Newton's iteration, the correction, whether water is conserved."""
        rate, V, inner, end = 2 * t / self.w**2, np.diff(X), velocity[:, 1:-1], velocity[:, -1:]
        flux, flux_slope, face, face_slope, carried = self.exchange(stretch, X, inner, rate)
        S, S_slope = self.source(stretch)
        at_faces = rate * flux + inner * face**3
        through = np.hstack([np.zeros_like(end), at_faces, end])
        content = alpha * stretch**3 * V
        residual = content + past - np.diff(through) + rate * V * S
        if self.conserves(residual, content + rate * V * np.abs(S)):
            return stretch, np.zeros_like(stretch), True
        from_left, from_right = (
            rate * f + inner * carried * e for f, e in zip(flux_slope, face_slope, strict=True)
        )
        reaction = V * (3 * alpha * stretch**2 + rate * S_slope)
        correction = self._swept(from_left, from_right, reaction, residual)
        stretch = stretch + correction
        if not (stretch > 0.1 * stretch.max()).all():
            raise NotConverged
        return stretch, correction, False

    def flows(self, t, X, velocity, stretch, rates):
        """What the wall gives the heat: d(water)/dt at the material, M on all faces, o per cell."""
        rate, V = 2 * t / self.w**2, np.diff(X)
        flux = self.exchange(stretch, X, velocity[:, 1:-1], rate)[0]
        lost = rate * V * self.source(stretch)[0]
        shed = self.outwards * lost
        M = np.pad(-np.cumsum(rates + shed, axis=1), ((0, 0), (1, 0)))
        return np.diff(np.pad(rate * flux, ((0, 0), (1, 1)))) - lost, M, shed

    def conduction(self, t, X, stretch):
        """Le G over the distance, on all faces but the last: the first is at theta = 1."""
        half = np.diff(X) / 2
        resistance = half / self.conductance(stretch)
        total = np.hstack([resistance[:, :1], resistance[:, 1:] + resistance[:, :-1]])
        return 2 * t / self.w**2 * self.Le / total

    def heat_step(self, t, X, velocity, stretch, theta, alpha, past):
        """theta of the cells, and its largest change; linear but for L of the printed equation."""
        held = self.capacity(stretch) * np.diff(X)
        water, M, shed = self.flows(t, X, velocity, stretch, alpha * held + past[5])
        k = self.conduction(t, X, stretch)
        first, k = k[:, :1], k[:, 1:]
        half = np.diff(X) / 2
        right = half[:, :-1] / (half[:, 1:] + half[:, :-1])
        left, inner = 1 - right, M[:, 1:-1]
        through = k * np.diff(theta) - inner * (left * theta[:, :-1] + right * theta[:, 1:])
        through = np.hstack([first * (theta[:, :1] - 1), through, M[:, -1:]])
        L, L_slope = (self.latent, 0.0) if self.latent is not None else (-self.N - theta, -1.0)
        residual = alpha * held * theta + past[4] - np.diff(through) + shed * theta
        residual = residual - self.wall * L * water
        reaction = alpha * held + shed - self.wall * L_slope * water
        reaction[:, :1] += first
        correction = self._swept(-k - inner * left, k - inner * right, reaction, residual)
        return theta + correction, np.abs(correction).max()

    def at_front(self, X, theta):
        """theta at X_C and its gradient there."""
        half, b = np.diff(X)[:, self.behind - 1 : self.behind + 1] / 2, self.behind
        distance = half.sum(axis=1, keepdims=True)
        gradient = (theta[:, b, None] - theta[:, b - 1, None]) / distance
        return theta[:, b - 1, None] + gradient * half[:, :1], gradient

    def _swept(self, from_left, from_right, reaction, residual):
        return self.sweep.correction(
            on_faces((from_right - from_left) / 2),
            reaction.ravel(),
            residual.ravel(),
            on_faces(from_right + from_left),
        ).reshape(reaction.shape)

    def error_norm(self, state: NDArray, difference: NDArray) -> float:
        """As a change of Phi_1 or theta."""
        stretch, (d_stretch, _, d_X, d_theta, _, _) = (
            self.unpack(state)[0],
            self.unpack(difference),
        )
        shifted = 0.1 * np.abs(d_X[:, self.behind]).max()
        return max(np.abs(3 * d_stretch / stretch**4).max(), np.abs(d_theta).max(), shifted)

    def profile(self, t: float, step: Step) -> dict[str, NDArray]:
        """What the dataset holds of one time, but for the books."""
        stretch, _, X, theta, _, _ = self.unpack(step.at(t))
        V = np.diff(X)
        Z = self.w * np.pad(np.cumsum(stretch * V, axis=1), ((0, 0), (1, 0)))
        return {
            "Phi1": stretch**-3.0,
            "Z": (Z[:, 1:] + Z[:, :-1]) / 2,
            "theta": theta,
            "Z_C": Z[:, self.behind],
            "front_temperature": self.at_front(X, theta)[0][:, 0],
        }
