r"""What the wall of a tube is made of, as the programme's solver asks for it.

A wall gives, for slices of stretch lambda = Phi^{-1/3} between the sections Z (all in units of w),
what a slice's content loses through its edges, w^2 per unit X, and the flux of content along it.
With D the diffusivity in units of k Pi_00/mu_l and Phi_s the edges' polymer fraction
(`gelpump.tube.closure`, whose two linear states these are in general form),

    K = D lambda^-2 ,   S = (lambda^2/3) D (Phi_s - Phi)/w^2 ,

times d content/d lambda.  `TwoStates` is the piecewise-linear gel: hot where T > T_C, cold
elsewhere; a slice through which a front goes is hot in part.  `RealWall` is any gel: D at the
slice's own Phi and T, and Phi_s = Phi_0(T), or, balanced,

    Pi(Phi_s, T) = 4 mu_s [ Phi^{1/3} - Phi_s^{1/3} ] ;

Pi + 4 mu_s Phi^{1/3} rises with Phi where D > 0, so there is one Phi_s.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from gelpump.cycles.programme import Programme

if TYPE_CHECKING:
    from gelpump.materials import Gel
    from gelpump.tube.closure import Conservative
    from gelpump.tube.tubes import Tubes

POLISH = 40  # Newton's steps for an edge
TABLE = 400  # temperatures at which phi_0 is tabulated on each branch
EXACT = 1e-14
JUST = 1e-9  # K inside a fold


class Lost(NamedTuple):
    """Where a gel has D <= 0: the cell, its polymer fraction (in its own scale), temperature."""

    cell: int
    polymer_fraction: float
    temperature: float


class Walls(Protocol):
    """What `gelpump.cycles.tube` asks of a wall; Z holds the faces, from 0, in units of w."""

    def begin(self, tau: float) -> None:
        """The time of what is asked next."""

    def source(self, stretch: NDArray, Z: NDArray) -> NDArray:
        """w^2 times what a slice's content loses through its edges, per X."""

    def conductance(self, stretch: NDArray, Z: NDArray) -> NDArray:
        """Of the faces between slices: flux of content over the difference of lambda per X."""

    def lost(self, stretch: NDArray, Z: NDArray) -> Lost | None:
        """Where the wall cannot go on, if anywhere."""

    def passed(self, Z: NDArray) -> None:
        """A step has ended with these faces."""


class TwoStates:
    """The wall of a piecewise-linear gel in T(Z, tau), T_C = 0."""

    def __init__(self, tube: Tubes, programme: Programme, Le: float, closure: Conservative):
        self.programme, self.Le, self.closure = programme, Le, closure
        self.w, self.M = float(closure.wall_length(tube)), float(tube.M)
        self.hot = float(tube.Pi_ratio / tube.Phi_inf), np.float64(tube.Phi_inf)
        self.cold = 1.0, np.float64(1.0)
        self._tau = -1.0

    def begin(self, tau):
        """Fronts of the time tau."""
        if tau == self._tau:
            return
        self._tau = tau
        fronts = self.programme.fronts(0.0, tau, self.Le) / self.w
        knots = np.concatenate([[0.0], fronts, [np.inf]])
        first = float(self.programme.at(tau)) > 0
        hot = np.where(np.arange(len(knots) - 1) % 2 == 0, first, not first)
        ends = np.concatenate([[0.0], fronts, [(fronts[-1] if fronts.size else 0.0) + 1e6]])
        self._ends = ends
        self._heated = np.append(0.0, np.cumsum(np.diff(ends) * hot))

    def heated(self, Z):
        """Hot share between neighbouring sections."""
        return np.diff(np.interp(Z, self._ends, self._heated)) / np.diff(Z)

    def source(self, stretch, Z):
        """Hot and cold in proportion."""
        share = self.heated(Z)
        hot, cold = (
            self.closure.source(stretch, s, Phi_0, self.M)[0] for s, Phi_0 in (self.hot, self.cold)
        )
        return share * hot + (1 - share) * cold

    def conductance(self, stretch, Z):
        """Resistances of the hot and the cold part from middle to middle, in series."""
        share = self.heated(0.5 * (Z[1:] + Z[:-1]))
        face = 0.5 * (stretch[1:] + stretch[:-1])
        hot, cold = (
            self.closure.conductivity(face, s, self.M) for s in (self.hot[0], self.cold[0])
        )
        return hot * cold / (share * cold + (1 - share) * hot)

    def lost(self, stretch, Z):
        """D > 0 always."""
        return None

    def passed(self, Z):
        """Nothing is remembered."""


class Branch(NamedTuple):
    """phi_0(T) of one stable branch, tabulated; beyond its ends it does not exist."""

    T: NDArray
    phi: NDArray


def branches(gel: Gel, low: float, high: float) -> tuple[Branch, Branch]:
    """The swollen and the dry branch of phi_0 between two temperatures; one twice if there is one.

    Points crowd at both ends, where a branch may fold.  ValueError from the gel.
    """
    folds = np.sort(gel.folds().temperature) if hasattr(gel, "folds") else np.empty(0)

    def along(first, last, name):
        s = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0, 1, TABLE))
        T = first + (last - first) * s
        take = {"branch": name} if folds.size else {}
        return Branch(T, np.array([gel.equilibrium_polymer_fraction(each, **take) for each in T]))

    if not folds.size:
        only = along(low, high, "swollen")
        return only, only
    if folds.size != 2:
        raise ValueError(f"{gel.name}: has {folds.size} folds: must be none or two")
    down, up = np.add(folds, (JUST, -JUST))
    # of which branch a temperature can be: up to the warmer fold, or down to the colder one
    names = ("swollen", "dry") if gel.collapses_when_heated else ("dry", "swollen")
    found = {
        name: along(*span, name)
        for name, span in zip(names, ((low, min(high, up)), (max(low, down), high)), strict=True)
        if span[0] < span[1]
    }
    # no slice leaves a branch that is there at every temperature
    whole = [each for each in found.values() if each.T[0] == low and each.T[-1] == high]
    first = found.get("swollen", found.get("dry"))
    if whole and (len(found) == 1 or first is whole[0]):
        return first, first
    return found["swollen"], found["dry"]


class RealWall:
    """The wall of any gel in T(Z, tau), in K; swollen is its equilibrium at ``programme.start``.

    The gel's pressures are in k_B T over a volume. ValueError for a programme outside its
    temperatures.
    """

    def __init__(
        self,
        tube: Tubes,
        programme: Programme,
        Le: float,
        closure: Conservative,
        gel: Gel,
    ):
        self.programme, self.Le, self.closure, self.gel = programme, Le, closure, gel
        self.w = float(closure.wall_length(tube))
        self.swollen, self.dry = branches(gel, *programme.extremes)
        T = programme.start
        self.phi_00 = float(gel.equilibrium_polymer_fraction(T))
        self.T_00 = T
        self.unit = float(gel.osmotic_modulus(self.phi_00, T))
        self.mu = gel.shear_modulus(self.phi_00) / self.unit
        self.is_dry = None

    def begin(self, tau):
        """The time of what is asked next."""
        self.tau = tau

    def temperature(self, Z):
        """T at Z (in units of w)."""
        return self.programme.along(self.w * Z, self.tau, self.Le)

    def pressure(self, T):
        """Unit of the gel's pressures over Pi_00."""
        return T / self.T_00 / self.unit

    def equilibrium(self, T):
        """Phi_0(T) of the branch that each slice is on, polished from the table by Newton."""
        found = np.interp(T, *self.swollen)
        if self.dry is not self.swollen and self.is_dry is not None:
            found = np.where(self.is_dry, np.interp(T, *self.dry), found)
        phi = found
        for _ in range(POLISH):
            change = self.gel.osmotic_pressure(phi, T) / self.gel.osmotic_modulus(phi, T) * phi
            change = np.clip(change, -0.02 * phi, 0.02 * phi)
            phi = phi - change
            if np.abs(change / phi).max() < EXACT * 100:
                break
        return phi / self.phi_00

    def edge(self, Phi, T):
        """Phi_s."""
        if self.closure.name != "balanced":
            return self.equilibrium(T)
        mu = self.mu * self.unit
        drive = 4 * mu * np.cbrt(Phi)
        x = Phi
        for _ in range(POLISH):
            phi = np.clip(self.phi_00 * x, 1e-9, 1 - 1e-9)
            excess = self.gel.osmotic_pressure(phi, T) + 4 * mu * np.cbrt(x) - drive
            slope = (self.gel.osmotic_modulus(phi, T) + 4 / 3 * mu * np.cbrt(x)) / x
            change = np.clip(excess / np.abs(slope), -0.2 * x, 0.2 * x)
            x = x - change
            if np.abs(change / x).max() < EXACT * 100:
                break
        return x

    def diffusivity(self, Phi, T):
        """D in k Pi_00/mu_l."""
        phi = np.clip(self.phi_00 * Phi, 1e-9, 1 - 1e-9)
        return self.gel.diffusivity(phi, T) * self.pressure(T)

    def source(self, stretch, Z):
        """At the middles' temperature."""
        T, Phi = self.temperature(0.5 * (Z[1:] + Z[:-1])), stretch**-3
        D = self.diffusivity(Phi, T)
        S = stretch**2 / 3 * D * (self.edge(Phi, T) - Phi)
        return self.closure.content_slope(stretch) * S

    def conductance(self, stretch, Z):
        """At the faces' temperature and mean stretch."""
        face = 0.5 * (stretch[1:] + stretch[:-1])
        D = self.diffusivity(face**-3, self.temperature(Z[1:-1]))
        return self.closure.content_slope(face) * D / face**2

    def lost(self, stretch, Z):
        """Where D <= 0."""
        T, Phi = self.temperature(0.5 * (Z[1:] + Z[:-1])), stretch**-3
        D = self.diffusivity(Phi, T)
        i = int(np.argmin(D))
        return None if D[i] > 0 else Lost(i, float(self.phi_00 * Phi[i]), float(T[i]))

    def passed(self, Z):
        """Slices beyond the end of their branch go over to the other."""
        if self.dry is self.swollen:
            return
        T = self.temperature(0.5 * (Z[1:] + Z[:-1]))
        if self.is_dry is None:
            self.is_dry = np.zeros(T.shape, bool)
        beyond = (self.swollen.T[-1] < T) | (self.swollen.T[0] > T)
        inside = (self.dry.T[0] <= T) & (self.dry.T[-1] >= T)
        self.is_dry = (self.is_dry | beyond) & inside
