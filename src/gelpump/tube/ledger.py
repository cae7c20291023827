"""Books of the wall's water: what it has lost since tau = 0, and by which way.

A slice dX of the swollen wall has lost 1 - lambda^3 of its volume pi (1-ell^2) dX. In units of that
section, lengths in L, and with X_C the material point where the front is,

    loss     Integral (1 - lambda^3) dX                       behind and ahead of the front
    source   Integral Integral 3 lambda^2 S dX dtau           through the edges, on either side
    axial    Integral 3 lambda^2 K lambda_X dtau              through the front's section, hotwards
    swept    Integral (1 - lambda^3) dX_C                     handed over as the front passes
    shorter  Integral (1 - lambda) dX                         by how much the tube is shorter
    printed  Integral Integral (3/2) S lambda^-4 dX dtau      V of eqn:lumen far ahead, in time

    behind:  loss = source - axial + swept        ahead:  loss = source + axial - swept

for a wall that conserves water; for the printed one what is left over measures how much it does
not. The rates are entered with the formula of the time steps (`gelpump.bdf`), so that a sum that
holds in each step holds ever after, to rounding.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gelpump.bdf import Step, derivative_weights, interpolation_weights

if TYPE_CHECKING:
    from gelpump.tube.moving_mesh import Family

SIDES = ("behind", "ahead")
AMOUNT = "in units of L and of the section pi (1-ell^2) a_1^2 of the swollen wall"
AMOUNT_RATE = f"{AMOUNT}, per poroelastic time mu_l L^2/(k Pi_00)"
ENTRIES = {
    "loss": ("side", "water that the wall has lost"),
    "source": ("side", "water that has left through the edges of the wall"),
    "axial": (None, "water that has flowed through the wall past the front, to its hot side"),
    "swept": (None, "loss that the front has taken over in passing"),
    "shorter": (None, "length by which the tube is shorter"),
    "printed": (None, "way that water far ahead in the lumen has gone by V of eqn:lumen"),
}


class Length:
    """What the printed equation conserves: the length that the source has taken is missing."""

    def __init__(self, family: Family, order: int):
        self.family, self.order = family, order
        self._before = self._now = np.zeros(family.tubes)
        self._rates = [self._now]  # of losing length in t = sqrt(tau), in units of w; newest first

    def enter(self, step: Step) -> None:
        """Enter a step that `gelpump.bdf.integrate` has accepted."""
        family, (stretch, _, X) = self.family, self.family.unpack(step.solution)
        rate = 2 * step.time / family.w**2 * family.source(stretch)[0] * np.diff(X)
        self._rates = [rate.sum(axis=1), *self._rates[: self.order]]
        self._before, self._now = self._now, self._now + self._integral(step, step.time)

    def at(self, t: float, step: Step) -> dict[str, np.ndarray]:
        """The balance at a time within the step entered last, over Z_C."""
        stretch, _, X = self.family.unpack(step.at(t))
        shortening = ((1 - stretch) * np.diff(X)).sum(axis=1)
        lost = self._before + self._integral(step, t)
        return {"water_balance_error": np.abs(shortening - lost) / self.family.front(t)[:, 0]}

    def _integral(self, step, end):
        """From the start of the step to `end`, of the polynomial through the rates."""
        nodes, weights = np.polynomial.legendre.leggauss(3)
        half = (end - step.start) / 2
        at_nodes = [
            interpolation_weights(step.times, step.start + half * (1 + node))
            @ np.array(self._rates)
            for node in nodes
        ]
        return half * weights @ at_nodes


class Ledger:
    """The books of a `gelpump.tube.moving_mesh.Family`, step by step."""

    def __init__(self, family: Family, order: int):
        self.family = family
        self.worst = 0.0  # most that a step leaves unaccounted for on a side, over Z_C
        # newest first: source behind and ahead, axial, swept, printed
        self._entries = [np.zeros((5, family.tubes))]

    def enter(self, step: Step) -> None:
        """Enter a step that `gelpump.bdf.integrate` has accepted."""
        weights = derivative_weights(step.times)
        rates = self._rates(step, weights)
        before = self._entries[: len(weights) - 1]
        entry = (rates - np.tensordot(weights[1:], before, 1)) / weights[0]
        self._entries = [entry, *before]
        loss = np.array([self._state(state)[:2] for state in step.solutions])
        behind, ahead = np.tensordot(weights, loss, 1)
        source_behind, source_ahead, axial, swept, _ = rates
        missing = [behind - source_behind + axial - swept, ahead - source_ahead - axial + swept]
        amount = np.abs(missing) / weights[0] / self.family.front(step.time)[:, 0]
        self.worst = max(self.worst, float(amount.max()))

    def at(self, t: float, step: Step) -> dict[str, np.ndarray]:
        """All entries at a time within the step entered last, and their rates in tau."""
        states = np.array([self._state(state) for state in step.solutions])
        columns = np.concatenate([states, np.array(self._entries)], axis=1)
        amounts = np.tensordot(interpolation_weights(step.times, t), columns, 1)
        slope = interpolation_weights(step.times, t + 1e-30j).imag / 1e-30
        rates = np.tensordot(slope, columns, 1) / (2 * t)
        named = {}
        w = self.family.w[:, 0]
        for suffix, values in (("", w * amounts), ("_rate", w * rates)):
            loss, shorter, source = values[:2], values[2], values[3:5]
            found = loss.T, source.T, values[5], values[6], shorter, values[7]
            named |= {f"{name}{suffix}": each for name, each in zip(ENTRIES, found, strict=True)}
        missing = np.abs((named["loss"] - named["source"]).sum(axis=1))
        return named | {"water_balance_error": missing / (w * self.family.front(t)[:, 0])}

    def _state(self, state):
        """Loss behind and ahead, and shortening, of each tube."""
        stretch, content, X = self.family.unpack(state)
        V, hot = np.diff(X), self.family.hot
        water = content if self.family.closure.conserves_water else stretch**3 * V
        lost = V - water
        return np.array([lost[:, hot].sum(1), lost[:, ~hot].sum(1), ((1 - stretch) * V).sum(1)])

    def _rates(self, step, weights):
        """Rates in t = sqrt(tau) of the entries, as the step has them."""
        family, t = self.family, step.time
        faces = np.array([family.unpack(state)[2] for state in step.solutions])
        stretch, _, X = family.unpack(step.solution)
        velocity = np.tensordot(weights, faces, 1)
        rate = 2 * t / family.w**2
        flux, _, face, *_ = family.exchange(stretch, X, velocity[:, 1:-1], rate)
        per_content = 3 * stretch**2 / family.closure.content_slope(stretch)
        source = (rate * per_content * family.source(stretch)[0] * np.diff(X)).T
        front = family.behind - 1
        at_front = face[:, front]
        to_water = 3 * at_front**2 / family.closure.content_slope(at_front)
        return np.array(
            [
                source[family.hot].sum(0),
                source[~family.hot].sum(0),
                rate[:, 0] * to_water * flux[:, front],
                velocity[:, family.behind] * (1 - at_front**3),
                (source / stretch.T**6).sum(0) / 2,
            ]
        )
