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

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .explicit import ExplicitGel, fraction, log_tail
from .validation import positive, real_number


@dataclass(frozen=True)
class EnergyBasedGel(ExplicitGel):
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

    def __post_init__(self) -> None:
        for key in ("A0", "A1", "B0", "B1"):
            object.__setattr__(self, key, real_number(f"{self.name}.{key}", getattr(self, key)))
        object.__setattr__(self, "Omega", positive(f"{self.name}.Omega", self.Omega))
        if self.B0 == self.B1 == 0:
            raise ValueError(f"{self.name}: B0 = B1 = 0: one must differ from 0, chi depends on T")
        self._require_range()

    @property
    def parameters(self) -> dict[str, tuple[float, str]]:
        """A0, A1, B0, B1 and Omega with their units."""
        units = {"A0": "1", "A1": "1", "B0": "K-1", "B1": "K-1", "Omega": "1"}
        return {key: (getattr(self, key), unit) for key, unit in units.items()}

    def chi(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Flory interaction parameter chi = A0 + B0 T + (A1 + B1 T) phi."""
        a, b = self._interaction(T)
        return a + b * fraction(phi)

    def osmotic_pressure(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Pi, eqn:osmotic_pressure."""
        phi = fraction(phi)
        a, b = self._interaction(T)
        return self._athermal_pressure(phi) - phi**2 * (a - b + 2 * phi * b)

    def osmotic_modulus(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """phi dPi/dphi, the bulk modulus of the gel at constant fluid pressure."""
        phi = fraction(phi)
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
        phi = fraction(phi)
        a, b = self._interaction(T)
        elastic = (phi + np.cbrt(phi)) / self.Omega
        return elastic + phi**2 * (1 / (1 - phi) - 2 * (a - b) - 6 * phi * b)

    def flux_potential(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Integral of (mu_l/k) D from 0 to phi, so that D grad(phi) = grad(flux potential)."""
        phi = fraction(phi)
        a, b = self._interaction(T)
        elastic = (phi**2 / 2 + 0.75 * np.cbrt(phi) ** 4) / self.Omega
        return elastic + log_tail(phi, 3) - phi**3 * (2 / 3 * (a - b) + 1.5 * phi * b)

    def osmotic_energy(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Integral of Pi/phi^2 over phi: energy of a dry volume, -Pi its slope with J = 1/phi."""
        phi = fraction(phi)
        a, b = self._interaction(T)
        elastic = (np.log(phi) + 1.5 * np.cbrt(phi) ** -2) / self.Omega
        return elastic + (1 / phi - 1) * np.log1p(-phi) - phi * (a - b + phi * b)

    @property
    def equilibrium_pole(self) -> float | None:
        """Polymer fraction at which Pi does not depend on T, or None when there is none."""
        return _inside(self.B1 - self.B0, 2 * self.B1)

    @property
    def spinodal_pole(self) -> float | None:
        """Polymer fraction at which D does not depend on T, or None when there is none."""
        return _inside(self.B1 - self.B0, 3 * self.B1)

    @property
    def _equilibrium_poles(self) -> NDArray:
        return _listed(self.equilibrium_pole)

    @property
    def _spinodal_poles(self) -> NDArray:
        return _listed(self.spinodal_pole)

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
        return (phi - np.cbrt(phi)) / self.Omega + log_tail(phi, 2)

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


def _inside(numerator: float, denominator: float) -> float | None:
    """The quotient when it lies within (0, 1)."""
    if denominator == 0 or not 0 < numerator / denominator < 1:
        return None
    return numerator / denominator


def _listed(pole: float | None) -> NDArray:
    return np.array([] if pole is None else [pole])
