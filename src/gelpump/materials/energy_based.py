"""Energy-based gel: Flory-Huggins mixing, neo-Hookean chains (appendix A).

With the interaction parameter chi = a + b phi, a = A0 + B0 T and b = A1 + B1 T, pressures in
k_B T/Omega_f and diffusivities in (k/mu_l) k_B T/Omega_f,

    Pi   = (phi - phi^{1/3})/Omega - phi - ln(1-phi) - phi^2 [a + (2 phi - 1) b]
    mu_s = phi_00^{1/3}/Omega                          (eqn:osmotic_pressure, eqn:shear_modulus)
    D    = phi dPi/dphi + (4/3) mu_s (phi/phi_00)^{1/3}
         = (phi + phi^{1/3})/Omega + phi^2/(1-phi) - 2 phi^2 (a - b) - 6 phi^3 b

Pi and D are linear in T at fixed phi, so that the equilibrium curve (Pi = 0) and the spinodal
(D = 0) are explicit as T_eq(phi) = N/Q and T_sp(phi). Every curve at fixed T is found from these:
between the extrema and poles of T_eq each temperature is met at most once.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .validation import positive, real_number

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


@dataclass(frozen=True)
class EnergyBasedGel:
    """Gel of eqn:osmotic_pressure; phi in (0, 1) and T in K broadcast, results have their shape.

    A0, A1: interaction parameters; B0, B1: their slopes with temperature, 1/K.
    Omega: volume of a polymer molecule over that of a water molecule, > 0.
    temperature_range: lowest and highest T, in K, at which phi_0 is asked for.

    Every method raises ValueError for a polymer fraction outside (0, 1).
    """

    name: str
    A0: float
    A1: float
    B0: float
    B1: float
    Omega: float
    temperature_range: tuple[float, float] = (273.15, 373.15)

    polymer_fraction_bounds: ClassVar = (0.0, 1.0)

    def __post_init__(self) -> None:
        for key in ("A0", "A1", "B0", "B1"):
            object.__setattr__(self, key, real_number(f"{self.name}.{key}", getattr(self, key)))
        object.__setattr__(self, "Omega", positive(f"{self.name}.Omega", self.Omega))
        if self.B0 == self.B1 == 0:
            raise ValueError(f"{self.name}: B0 = B1 = 0: one must differ from 0, chi depends on T")
        key, given = f"{self.name}.temperature_range", self.temperature_range
        if isinstance(given, str) or not hasattr(given, "__len__") or len(given) != 2:
            raise ValueError(f"{key} = {given!r}: must be two temperatures in K, [lowest, highest]")
        lowest, highest = (positive(key, value) for value in given)
        if lowest >= highest:
            raise ValueError(f"{key} = {given!r}: the first must be lower than the second")
        object.__setattr__(self, "temperature_range", (lowest, highest))

    def chi(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Flory interaction parameter chi = A0 + B0 T + (A1 + B1 T) phi."""
        a, b = self._interaction(T)
        return a + b * _fraction(phi)

    def osmotic_pressure(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Pi, eqn:osmotic_pressure."""
        phi = _fraction(phi)
        a, b = self._interaction(T)
        return self._athermal_pressure(phi) - phi**2 * (a - b + 2 * phi * b)

    def osmotic_modulus(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """phi dPi/dphi, the bulk modulus of the gel at constant fluid pressure."""
        phi = _fraction(phi)
        a, b = self._interaction(T)
        elastic = (phi - np.cbrt(phi) / 3) / self.Omega
        return elastic + phi**2 * (1 / (1 - phi) - 2 * (a - b) - 6 * phi * b)

    def shear_modulus(self, phi_00: float) -> float:
        """mu_s = phi_00^{1/3}/Omega, eqn:shear_modulus; in pascal it grows with T as k_B T."""
        if not 0 < phi_00 <= 1:
            raise ValueError(f"phi_00 = {phi_00}: must be greater than 0 and at most 1 (dry)")
        return float(np.cbrt(phi_00)) / self.Omega

    def diffusivity(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """(mu_l/k) D of eqn:lens_transport; the reference phi_00 cancels."""
        phi = _fraction(phi)
        a, b = self._interaction(T)
        elastic = (phi + np.cbrt(phi)) / self.Omega
        return elastic + phi**2 * (1 / (1 - phi) - 2 * (a - b) - 6 * phi * b)

    def diffusivity_slope(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """(mu_l/k) dD/dphi."""
        phi = _fraction(phi)
        a, b = self._interaction(T)
        elastic = (1 + np.cbrt(phi) ** -2 / 3) / self.Omega
        return elastic + phi * ((2 - phi) / (1 - phi) ** 2 - 4 * (a - b) - 18 * phi * b)

    def flux_potential(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Integral of (mu_l/k) D from 0 to phi, so that D grad(phi) = grad(flux potential)."""
        phi = _fraction(phi)
        a, b = self._interaction(T)
        elastic = (phi**2 / 2 + 0.75 * np.cbrt(phi) ** 4) / self.Omega
        return elastic + _log_tail(phi, 3) - phi**3 * (2 / 3 * (a - b) + 1.5 * phi * b)

    def equilibrium_temperature(self, phi: ArrayLike) -> NDArray:
        """T_eq(phi) at which Pi = 0, eqn:phi_0_full solved for T; infinite at its pole."""
        return _ratio(*self._equilibrium_terms(_fraction(phi))[:2])

    def spinodal_temperature(self, phi: ArrayLike) -> NDArray:
        """T_sp(phi) at which D = 0; infinite at its pole."""
        return _ratio(*self._spinodal_terms(_fraction(phi))[:2])

    @property
    def equilibrium_pole(self) -> float | None:
        """Polymer fraction at which Pi does not depend on T, or None when there is none."""
        return _inside(self.B1 - self.B0, 2 * self.B1)

    @property
    def spinodal_pole(self) -> float | None:
        """Polymer fraction at which D does not depend on T, or None when there is none."""
        return _inside(self.B1 - self.B0, 3 * self.B1)

    def equilibrium_polymer_fractions(self, T: float) -> Equilibria:
        """All phi with Pi(phi, T) = 0; stable where dPi/dphi > 0."""
        pieces = _pieces(self._equilibrium_extrema, self.equilibrium_pole)
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
        pieces = _pieces(self._spinodal_extrema, self.spinodal_pole)
        return _roots(lambda phi: self.diffusivity(phi, T), pieces)

    def folds(self) -> Folds:
        """Extrema of T_eq(phi) within `temperature_range`, between which states are unstable."""
        phi = self._equilibrium_extrema
        T = self.equilibrium_temperature(phi)
        within = self._in_range(T)
        return Folds(T[within], phi[within])

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

    def asymptotic_polymer_fraction(self, T: ArrayLike) -> NDArray:
        """phi_0 ~ [Omega (1/2 - (A0-A1) - (B0-B1) T)]^{-3/5} for phi_0 << 1; nan past its end."""
        a, b = self._interaction(T)
        excess = self.Omega * (0.5 - (a - b))
        return np.where(excess > 0, np.abs(excess) ** -0.6, np.nan)[()]

    @property
    def singular_temperature(self) -> float:
        """T at which the low-temperature asymptote diverges; infinite when B0 = B1."""
        a_minus_b, slope = self.A0 - self.A1, self.B0 - self.B1
        return (1 - 2 * a_minus_b) / (2 * slope) if slope else np.inf

    def _interaction(self, T: ArrayLike) -> tuple[NDArray, NDArray]:
        T = np.asarray(T, dtype=float)
        return self.A0 + self.B0 * T, self.A1 + self.B1 * T

    def _athermal_pressure(self, phi: NDArray) -> NDArray:
        return (phi - np.cbrt(phi)) / self.Omega + _log_tail(phi, 2)

    def _in_range(self, T: NDArray) -> NDArray:
        return np.clip(T, *self.temperature_range) == T

    def _equilibrium_terms(self, phi: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        """N, Q and N' Q - N Q' of T_eq = N/Q, Pi = phi^2 (N - Q T)."""
        athermal = self._athermal_pressure(phi)
        slope = (1 - np.cbrt(phi) ** -2 / 3) / self.Omega + phi / (1 - phi)
        N = athermal / phi**2 - (self.A0 - self.A1) - 2 * phi * self.A1
        dN = (slope - 2 * athermal / phi) / phi**2 - 2 * self.A1
        Q = self.B0 - self.B1 + 2 * phi * self.B1
        return N, Q, dN * Q - N * 2 * self.B1

    def _spinodal_terms(self, phi: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        """N, Q and N' Q - N Q' of T_sp = N/Q, D = phi^2 (N - Q T)."""
        root = np.cbrt(phi)
        elastic = (1 / phi + root**-5) / self.Omega
        N = elastic + 1 / (1 - phi) - 2 * (self.A0 - self.A1) - 6 * phi * self.A1
        dN = -(1 + 5 / 3 / root**2) / phi**2 / self.Omega + (1 - phi) ** -2.0 - 6 * self.A1
        Q = 2 * (self.B0 - self.B1) + 6 * phi * self.B1
        return N, Q, dN * Q - N * 6 * self.B1

    @cached_property
    def _equilibrium_extrema(self) -> NDArray:
        return _roots(lambda phi: self._equilibrium_terms(phi)[2], _SEARCH)

    @cached_property
    def _spinodal_extrema(self) -> NDArray:
        return _roots(lambda phi: self._spinodal_terms(phi)[2], _SEARCH)


def _fraction(phi: ArrayLike) -> NDArray:
    """phi as an array; ValueError unless every value is within (0, 1)."""
    phi = np.asarray(phi, dtype=float)
    if not np.all((phi > 0) & (phi < 1)):
        bad = phi[~((phi > 0) & (phi < 1))].flat[0]
        raise ValueError(f"polymer fraction phi = {bad}: must be greater than 0 and less than 1")
    return phi


_LOG_SERIES = {k: np.append(np.zeros(k), 1 / np.arange(k, 20)) for k in (2, 3)}


def _log_tail(phi: NDArray, first: int) -> NDArray:
    """-ln(1-phi) without its terms below phi^first: the sum of phi^k/k over k >= first.

    Subtracting the leading terms loses all digits at small phi, hence the series there.
    """
    whole = -np.log1p(-phi) - sum(phi**k / k for k in range(1, first))
    small = phi < 0.1
    if not np.any(small):
        return whole
    series = np.polynomial.polynomial.polyval(np.minimum(phi, 0.1), _LOG_SERIES[first])
    return np.where(small, series, whole)[()]


def _ratio(numerator: NDArray, denominator: NDArray) -> NDArray:
    with np.errstate(divide="ignore"):
        return numerator / denominator


def _inside(numerator: float, denominator: float) -> float | None:
    """The quotient when it lies within (0, 1)."""
    if denominator == 0 or not 0 < numerator / denominator < 1:
        return None
    return numerator / denominator


def _pieces(extrema: NDArray, pole: float | None) -> NDArray:
    """Ends of the intervals within which an explicit T(phi) is monotone."""
    poles = [] if pole is None else [pole]
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
