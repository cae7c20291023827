"""A tube that collapses behind a front of heat which its own collapse holds back.

The wall is that of `gelpump.tube.slender`, closure conservative, in material coordinates; the heat
of a slice dX of what conducts (`gelpump.tube.stefan` has C, G and o) is C theta dX, and

    C theta_tau + Q theta_X = Le (G theta_X)_X + a L (lambda^3)_tau ,   a = 1 - ell^2 ,
    Q_X = -C_tau - 3 o lambda^2 S ,    Q = 0 at X = 0 ,

    theta = 1 at X = 0,   theta -> -1 far ahead,   theta = 0 at X_C, which is where the wall's
    coefficients jump.

Q is the volume that flows past the material, in the wall, the lumen and the pipe together: what a
slice loses of its volume (C in units of pi a_1^2) and does not send out leaves along the tube. L is

    enthalpy   L = St/(1 - 1/Phi_inf):   each volume of water that the wall sheds takes the same
               heat, St rho c Delta T of a volume of swollen gel in all;
    printed    L = -(N + theta), N = T_C/Delta T: eqn:lens_heat_equation with its (T/phi) Dphi/Dt,
               which has rho c T where the other has -U_v (docs/heat.md).

The pressures' share, P Pi/Pi_00 (Dphi/Dt)/phi and the work of Darcy's flow, is left out: no force
from outside does work on a tube whose surfaces have p = 0, so that it moves heat within the wall.

Numerics. Cells, time steps and Newton's iteration are those of `gelpump.tube.moving_mesh`, with
cells ahead as far as heat gets. The heat of a cell, its capacity and its water are differenced in
time by one formula, and the flux M of volume through the moving faces is summed from what cells
lose, so that a uniform temperature stays uniform and heat is conserved to rounding. X_C is no
longer given: within a step it follows from theta = 0 at its face by a secant.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from gelpump.bdf import (
    MAX_TRIALS,
    NotConverged,
    Step,
    derivative_weights,
    integrate,
    interpolation_weights,
)
from gelpump.netcdf import variable
from gelpump.tube import scaling
from gelpump.tube.closure import CLOSURES
from gelpump.tube.heat import StepHeating
from gelpump.tube.moving_mesh import GRADING_BEHIND, Family, on_faces
from gelpump.tube.slender import NEWTON_SHARE, PARAMETERS
from gelpump.tube.stefan import Surrounding, stefan_numbers
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import lumen_share

EQUATIONS = ("enthalpy", "printed")
REACH = 4.5  # end of the domain of heat: this far ahead of the front, in 2 sqrt(Le tau)
MAX_SWEEPS = 20
HEAT = "in units of rho c Delta T pi a_1^2 L"
ENTRIES = {
    "heat_conducted": "heat that has been conducted in at Z = 0",
    "heat_drawn_in": "heat of the volume that has come in from far ahead",
    "heat_shed": "heat that shed water has carried out of the section",
    "heat_latent": "heat that the collapse has given off (taken up, where negative)",
    "heat_content": "gain of heat of what conducts",
}


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


class HeatBooks:
    """ENTRIES since tau = 0 by the formula of the time steps, and what they leave unaccounted."""

    def __init__(self, family: HeatedFamily):
        self.family, self._entries = family, [np.zeros((4, family.tubes))]
        self.worst = 0.0  # of what a step leaves, over all that has passed through

    def enter(self, step: Step) -> None:
        """Enter a step that `gelpump.bdf.integrate` has accepted."""
        family, t, weights = self.family, step.time, derivative_weights(step.times)
        states = [family.unpack(state) for state in step.solutions]
        velocity, rates = (
            np.tensordot(weights, np.array([state[i] for state in states]), 1) for i in (2, 5)
        )
        stretch, _, X, theta, heat, _ = states[0]
        water, M, shed = family.flows(t, X, velocity, stretch, rates)
        first = family.conduction(t, X, stretch)[:, 0]
        L = family.latent if family.latent is not None else -family.N - theta
        now = [first * (1 - theta[:, 0]), M[:, -1], -(shed * theta).sum(axis=1)]
        now.append((family.wall * L * water).sum(axis=1))
        before = self._entries[: len(weights) - 1]
        entry = (np.array(now) - np.tensordot(weights[1:], before, 1)) / weights[0]
        self._entries = [entry, *before]
        self._scale = np.abs(entry).sum(axis=0)
        missing = np.abs(heat.sum(axis=1) - entry.sum(axis=0)) / self._scale
        self.worst = max(self.worst, float(missing.max()))

    def at(self, t: float, step: Step) -> dict[str, NDArray]:
        """All entries at a time within the step entered last; heat from theta = -1."""
        weights = interpolation_weights(step.times, t)
        entry = self.family.w[:, 0] * np.tensordot(weights, np.array(self._entries), 1)
        heat = self.family.w[:, 0] * self.family.unpack(step.at(t))[4].sum(axis=1)
        error = np.abs(heat - entry.sum(axis=0)) / np.abs(entry).sum(axis=0)
        return dict(zip(ENTRIES, [*entry, heat], strict=True)) | {"energy_balance_error": error}


VARIABLES = {
    "Phi1": ("cell", "polymer fraction in the middle of the wall", scaling.POLYMER),
    "Z": ("cell", "axial position of the cells", scaling.AXIAL),
    "theta": ("cell", "temperature", "(T - T_C)/Delta T"),
    "Z_C": (None, "position of the front", scaling.AXIAL),
    "front_temperature": (None, "temperature at the front's face, which should be 0", ""),
    "energy_balance_error": (None, "heat unaccounted for, over all that has passed", ""),
} | {name: (None, text, HEAT) for name, text in ENTRIES.items()}


def solve(
    tubes: Tubes,
    Le: float,
    tau: ArrayLike,
    surrounding: Surrounding,
    *,
    St: ArrayLike = 0.0,
    N: ArrayLike | None = None,
    cells: tuple[int, int] = (64, 64),
    tolerance: float = 1e-4,
    order: int = 3,
    trials: int = MAX_TRIALS,
) -> xr.Dataset:
    """Phi_1, theta and the front of all `tubes` at the times `tau`, dims tube, tau, cell.

    St: latent heat over rho c Delta T, of each tube.  N = T_C/Delta T instead, for the printed heat
    equation, which has no St.  ValueError for what is not allowed, RuntimeError if it does not go
    on.  A bath feels nothing of its tube, so that St has no effect in it.
    """
    tau = np.atleast_1d(np.asarray(tau, float))
    if not (tau[0] > 0 and (np.diff(tau) > 0).all() and np.isfinite(tau).all()):
        raise ValueError(f"tau = {tau} is not allowed: positive and increasing")
    bath = surrounding.kind == "bath"
    if N is not None and bath.any():
        raise ValueError("N is not allowed in a bath, which feels nothing of its tube")
    shape = np.broadcast_shapes(tubes.ell.shape, bath.shape, np.shape(St))
    tubes = Tubes(**{
        key: np.broadcast_to(getattr(tubes, key), shape) for key in ("ell", *PARAMETERS)
    })  # fmt: skip
    per_water = np.where(bath, 0.0, stefan_numbers(St)) / (1 - 1 / tubes.Phi_inf)
    latent = None if N is not None else np.reshape(per_water, (-1, 1))
    family = HeatedFamily(tubes, Le, latent, N, surrounding, cells, NEWTON_SHARE * tolerance)
    books, times, found, steps = HeatBooks(family), np.sqrt(tau), [], 0
    for step in integrate(
        family.advance,
        family.initial(),
        times[-1],
        order=order,
        tolerance=tolerance,
        first_step=0.01 * family.w.min(),
        error_norm=family.error_norm,
        trials=trials,
    ):
        steps += 1
        books.enter(step)
        while len(found) < len(times) and times[len(found)] <= step.time:
            t = times[len(found)]
            found.append(family.profile(t, step) | books.at(t, step))
    data = {
        name: variable(
            ("tube", "tau", *filter(None, [dim])),
            np.stack([each[name] for each in found], axis=1),
            *text,
        )
        for name, (dim, *text) in VARIABLES.items()
    }
    data["front_over_diffusion"] = variable(
        ("tube", "tau"), data["Z_C"][1] / np.sqrt(Le * tau), "Z_C over sqrt(Le tau)"
    )
    data["wall_length"] = variable(
        "tube", family.w[:, 0], "length over which radial flow heals a disturbance", scaling.AXIAL
    )
    return xr.Dataset(data, coords={"tau": scaling.tau(tau)}).assign_attrs(
        steps=steps, sweeps=family.sweep.sweeps, energy_balance_step=books.worst
    )
