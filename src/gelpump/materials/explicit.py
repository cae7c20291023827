"""What follows for a gel whose T(phi) is explicit: all equilibria, folds, the whole spinodal.

Where Pi and D depend on T through one function s(T) only, and linearly, the equilibrium curve
(Pi = 0) and the spinodal (D = 0) are explicit,

    Pi = phi^2 [N(phi) - Q(phi) s] ,   s_eq = N/Q ;      D = phi^2 [N_D - Q_D s] ,   s_sp = N_D/Q_D

with s = T or 1/T. Every curve at fixed T is found from these: between the extrema and poles of
s(phi) each temperature is met at most once, so no root is missed and none is guessed.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from functools import cached_property
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .validation import positive

# Where roots are sought: dense at both ends, whose neighbourhoods hold swollen and dry states.
_SEARCH = np.concatenate(
    [
        np.geomspace(1e-9, 0.05, 801),
        np.linspace(0.05, 0.95, 1802)[1:-1],
        1 - np.geomspace(0.05, 1e-15, 801),
    ]
)


class Equilibria(NamedTuple):
    """Equilibrium polymer fractions of one temperature, sorted, and whether each is stable."""

    polymer_fraction: NDArray
    stable: NDArray


class Folds(NamedTuple):
    """Folds of the equilibrium curve, sorted by polymer fraction."""

    temperature: NDArray
    polymer_fraction: NDArray


class SpinodalTip(NamedTuple):
    """Lowest temperature at which the polymer diffusivity vanishes, and where."""

    temperature: float
    polymer_fraction: float


class ExplicitGel:
    """Curves of a gel whose formulae a subclass gives.

    temperature_range: lowest and highest T, in K, at which phi_0 is asked for.
    """

    name: str
    temperature_range: tuple[float, float]

    polymer_fraction_bounds: ClassVar = (0.0, 1.0)

    @abstractmethod
    def osmotic_pressure(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Pi(phi, T)."""

    @abstractmethod
    def osmotic_modulus(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """phi dPi/dphi."""

    @abstractmethod
    def diffusivity(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """(mu_l/k) D."""

    @property
    @abstractmethod
    def parameters(self) -> dict[str, tuple[float, str]]:
        """The numbers of the gel with their units, by name."""

    @abstractmethod
    def _equilibrium_terms(self, phi: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        """N, Q and N' Q - N Q' of s_eq = N/Q."""

    @abstractmethod
    def _spinodal_terms(self, phi: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        """N, Q and N' Q - N Q' of s_sp = N/Q."""

    @property
    @abstractmethod
    def _equilibrium_poles(self) -> NDArray:
        """Polymer fractions at which Pi does not depend on T."""

    @property
    @abstractmethod
    def _spinodal_poles(self) -> NDArray:
        """Polymer fractions at which D does not depend on T."""

    @staticmethod
    def _temperature(N: NDArray, Q: NDArray) -> NDArray:
        """T of s = N/Q."""
        with np.errstate(divide="ignore"):
            return N / Q

    def _require_range(self) -> None:
        key, given = f"{self.name}.temperature_range", self.temperature_range
        if isinstance(given, str) or not hasattr(given, "__len__") or len(given) != 2:
            raise ValueError(f"{key} = {given!r}: must be two temperatures in K, [lowest, highest]")
        lowest, highest = (positive(key, value) for value in given)
        if lowest >= highest:
            raise ValueError(f"{key} = {given!r}: the first must be lower than the second")
        object.__setattr__(self, "temperature_range", (lowest, highest))

    def equilibrium_temperature(self, phi: ArrayLike) -> NDArray:
        """T_eq(phi) at which Pi = 0; infinite at a pole, where Pi does not depend on T."""
        return self._temperature(*self._equilibrium_terms(fraction(phi))[:2])

    def spinodal_temperature(self, phi: ArrayLike) -> NDArray:
        """T_sp(phi) at which D = 0; infinite at a pole."""
        return self._temperature(*self._spinodal_terms(fraction(phi))[:2])

    def equilibrium_polymer_fractions(self, T: float) -> Equilibria:
        """All phi with Pi(phi, T) = 0; stable where dPi/dphi > 0."""
        pieces = _pieces(self._equilibrium_extrema, self._equilibrium_poles)
        phi = _roots(lambda phi: self.osmotic_pressure(phi, T), pieces)
        return Equilibria(phi, self.osmotic_modulus(phi, T) > 0)

    def equilibrium_polymer_fraction(self, T: float, branch: str = "swollen") -> float:
        """phi_0(T): of several stable states the least ('swollen') or most ('dry') concentrated.

        Where only one state is stable both branches give it. Raises ValueError for a T outside
        `temperature_range`, another branch, or a temperature without a stable state.
        """
        lowest, highest = self.temperature_range
        if not lowest <= T <= highest:
            raise ValueError(f"{self.name}: T = {T} K: must be within {lowest} to {highest} K")
        if branch not in ("swollen", "dry"):
            raise ValueError(f"{self.name}: branch = {branch!r}: must be 'swollen' or 'dry'")
        phi, stable = self.equilibrium_polymer_fractions(T)
        if not stable.any():
            raise ValueError(f"{self.name}: T = {T} K: no stable equilibrium polymer fraction")
        return float(phi[stable][0 if branch == "swollen" else -1])

    def spinodal_polymer_fractions(self, T: float) -> NDArray:
        """All phi with D(phi, T) = 0, sorted; empty below the spinodal tip."""
        pieces = _pieces(self._spinodal_extrema, self._spinodal_poles)
        return _roots(lambda phi: self.diffusivity(phi, T), pieces)

    def folds(self) -> Folds:
        """Extrema of T_eq(phi) within `temperature_range`, between which states are unstable."""
        phi = self._equilibrium_extrema
        T = self.equilibrium_temperature(phi)
        within = self._in_range(T)
        return Folds(T[within], phi[within])

    @property
    def collapses_when_heated(self) -> bool:
        """Whether the swollen branch ends at the warmer fold; True where there is no hysteresis."""
        T, phi = self.folds()
        return len(T) < 2 or bool(T[phi.argmin()] > T[phi.argmax()])

    def spinodal_tip(self) -> SpinodalTip:
        """Lowest minimum of T_sp(phi); ValueError when none lies within `temperature_range`."""
        phi = self._spinodal_extrema
        T = self.spinodal_temperature(phi)
        step = 1e-3 * phi * (1 - phi)
        minimum = (self.spinodal_temperature(phi - step) > T) & (
            self.spinodal_temperature(phi + step) > T
        )
        candidates = minimum & self._in_range(T)
        if not candidates.any():
            raise ValueError(f"{self.name}: no spinodal tip within {self.temperature_range} K")
        tip = np.argmin(np.where(candidates, T, np.inf))
        return SpinodalTip(float(T[tip]), float(phi[tip]))

    def _in_range(self, T: NDArray) -> NDArray:
        return np.clip(T, *self.temperature_range) == T

    @cached_property
    def _equilibrium_extrema(self) -> NDArray:
        return _roots(lambda phi: self._equilibrium_terms(phi)[2], _SEARCH)

    @cached_property
    def _spinodal_extrema(self) -> NDArray:
        return _roots(lambda phi: self._spinodal_terms(phi)[2], _SEARCH)


def fraction(phi: ArrayLike) -> NDArray:
    """phi as an array; ValueError unless every value is within (0, 1)."""
    phi = np.asarray(phi, dtype=float)
    if not np.all((phi > 0) & (phi < 1)):
        bad = phi[~((phi > 0) & (phi < 1))].flat[0]
        raise ValueError(f"polymer fraction phi = {bad}: must be greater than 0 and less than 1")
    return phi


_LOG_SERIES = {k: np.append(np.zeros(k), 1 / np.arange(k, 20)) for k in (2, 3)}


def log_tail(phi: NDArray, first: int) -> NDArray:
    """-ln(1-phi) without its terms below phi^first: the sum of phi^k/k over k >= first.

    Subtracting the leading terms loses all digits at small phi, hence the series there.
    """
    whole = -np.log1p(-phi) - sum(phi**k / k for k in range(1, first))
    small = phi < 0.1
    if not np.any(small):
        return whole
    series = np.polynomial.polynomial.polyval(np.minimum(phi, 0.1), _LOG_SERIES[first])
    return np.where(small, series, whole)[()]


def _pieces(extrema: NDArray, poles: NDArray) -> NDArray:
    """Ends of the intervals within which an explicit T(phi) is monotone."""
    return np.sort(np.concatenate([[_SEARCH[0], _SEARCH[-1]], extrema, poles]))


def _roots(function: Callable[[NDArray], NDArray], ends: NDArray) -> NDArray:
    """The root of `function` in every interval between neighbouring `ends` with a sign change."""
    from scipy.optimize import brentq

    positive_at = function(ends) > 0
    return np.array(
        [
            brentq(function, ends[i], ends[i + 1], xtol=1e-300, rtol=4 * np.finfo(float).eps)
            for i in np.flatnonzero(positive_at[1:] != positive_at[:-1])
        ]
    )
