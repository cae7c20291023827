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
               which has rho c T where the other has U_v = -rho c Delta T L.

The pressures' share, P Pi/Pi_00 (Dphi/Dt)/phi and the work of Darcy's flow, is left out: no force
from outside does work on a tube whose surfaces have p = 0, so that it moves heat within the wall.

How it is solved is told in `gelpump.tube.heated_family`.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from gelpump.bdf import (
    MAX_TRIALS,
    Step,
    derivative_weights,
    integrate,
    interpolation_weights,
)
from gelpump.netcdf import variable
from gelpump.tube import scaling
from gelpump.tube.heated_family import HeatedFamily
from gelpump.tube.slender import NEWTON_SHARE, PARAMETERS
from gelpump.tube.stefan import Surrounding, stefan_numbers
from gelpump.tube.tubes import Tubes

HEAT = "in units of rho c Delta T pi a_1^2 L"
ENTRIES = {
    "heat_conducted": "heat that has been conducted in at Z = 0",
    "heat_drawn_in": "heat of the volume that has come in from far ahead",
    "heat_shed": "heat that shed water has carried out of the section",
    "heat_latent": "heat that the collapse has given off (taken up, where negative)",
    "heat_content": "gain of heat of what conducts",
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
