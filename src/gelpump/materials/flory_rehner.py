"""Gels as the literature writes them: Flory-Huggins mixing, Gaussian chains, fixed charges.

Pressures in k_B T/v (v the volume of a solvent molecule), diffusivities in (k/mu_l) k_B T/v:

    Pi = (kappa phi - phi^{1/3})/Omega - ln(1-phi) - phi - phi^2 (c_1 + c_2 phi + c_3 phi^2) + Pi_i
    mu_s = phi_00^{1/3}/Omega
    D = phi dPi/dphi + (4/3) mu_s (phi/phi_00)^{1/3}
      = (kappa phi + phi^{1/3})/Omega + phi^2 [1/(1-phi) - 2 c_1 - 3 c_2 phi - 4 c_3 phi^2]
        + phi dPi_i/dphi

Interaction. Flory's chi stands in ln(1-phi) + phi + chi phi^2, the chemical potential, so c_k are
the chi_k of chi_1 + chi_2 phi + chi_3 phi^2. Others write the energy phi (1-phi) g of mixing, with
g = g_1 + g_2 phi + g_3 phi^2 (appendix A does, and calls it chi); then chi = g - (1-phi) dg/dphi,

    c_1 = g_1 - g_2 ,   c_2 = 2 g_2 - 2 g_3 ,   c_3 = 3 g_3 .

Each coefficient is p + q s(T), where all have s = T (chi_k = constant + slope T) or all s = 1/T:
1/2 - A (1 - Theta/T), or enthalpy/(R T) - entropy/R. So T stays explicit (`explicit`).

Chains. n chains (per v) in a state of polymer fraction phi_ref in which they are relaxed give

    Pi_chains = -n [ (phi/phi_ref)^{1/3} - b phi/phi_ref ] ,

    b = 1  neo-Hookean, W = (n/2)(sum lambda^2 - 3 - 2 ln J)     (appendix A; Treloar)
    b = 1/2  affine, W = (n/2)(sum lambda^2 - 3 - ln J)          (Flory)
    b = 0  phantom, W = (n/2)(1 - 2/f)(sum lambda^2 - 3)         (James and Guth; n (1-2/f) for n)

so that 1/Omega = n phi_ref^{-1/3}, kappa = b phi_ref^{-2/3}: every reference state is a dry one
with another kappa. What fixes n: N solvent volumes a chain, n = phi_ref/N; chains, or junctions
with f/2 chains each, in mol per volume, times the molar volume; or the shear modulus G of that
state, G v/(k_B T).

Ions. With i charges per v of polymer, q = i phi, and salt of concentration c (pairs per v) in the
bath, all ideal (Donnan): Pi_i = sqrt(q^2 + 4 c^2) - 2 c, which is q without salt.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.polynomial import polyval
from numpy.typing import ArrayLike, NDArray

from .explicit import ExplicitGel, fraction, log_tail
from .validation import non_negative, positive, real_number

GAS_CONSTANT = 8.31446261815324  # J/(mol K)
AVOGADRO = 6.02214076e23  # 1/mol
WATER = 1.8e-5  # m^3/mol
LOGARITHM = {"neo-Hookean": 1.0, "affine": 0.5, "phantom": 0.0}


@dataclass(frozen=True)
class FloryRehnerGel(ExplicitGel):
    """Gel of the equations above; phi in (0, 1) and T in K broadcast.

    constant, slope: p and q of c_1, c_2, c_3.  inverse: whether s = 1/T.  Omega, kappa: of the
    chains.  charge, salt: i and c.  solvent_molar_volume: of v, m^3/mol.  ValueError for a
    polymer fraction outside (0, 1).
    """

    name: str
    constant: tuple[float, float, float]
    slope: tuple[float, float, float]
    inverse: bool
    Omega: float
    kappa: float = 1.0
    charge: float = 0.0
    salt: float = 0.0
    solvent_molar_volume: float = WATER
    temperature_range: tuple[float, float] = (273.15, 373.15)

    def __post_init__(self) -> None:
        for key in ("constant", "slope"):
            given = getattr(self, key)
            values = tuple(real_number(f"{self.name}.chi", each) for each in given)
            object.__setattr__(self, key, values)
        positive(f"{self.name}.Omega", self.Omega)
        non_negative(f"{self.name}.kappa", self.kappa)
        if not any(self.slope):
            raise ValueError(f"{self.name}.chi: no coefficient depends on temperature: one must")
        self._require_range()

    @property
    def parameters(self) -> dict[str, tuple[float, str]]:
        """Constants and slopes of chi_1, chi_2, chi_3, and Omega, kappa and charges if any."""
        unit = "K" if self.inverse else "K-1"
        found = {}
        for k, (p, q) in enumerate(zip(self.constant, self.slope, strict=True), 1):
            found |= {f"chi_{k}": (p, "1")} if p or k < 2 else {}
            found |= {f"chi_{k}_slope": (q, unit)} if q else {}
        found |= {"Omega": (self.Omega, "1"), "kappa": (self.kappa, "1")}
        found |= {"charge": (self.charge, "1"), "salt": (self.salt, "1")} if self.charge else {}
        return found

    @property
    def molecule_volume(self) -> float:
        """v in m^3."""
        return self.solvent_molar_volume / AVOGADRO

    def chi(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """chi of the osmotic pressure, c_1 + c_2 phi + c_3 phi^2."""
        return polyval(fraction(phi), self._coefficients(T), tensor=False)

    def osmotic_pressure(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Pi."""
        phi = fraction(phi)
        return self._athermal_pressure(phi) - phi**2 * self.chi(phi, T)

    def osmotic_modulus(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """phi dPi/dphi, the bulk modulus at constant fluid pressure."""
        phi = fraction(phi)
        elastic = (self.kappa * phi - np.cbrt(phi) / 3) / self.Omega
        return elastic + self._ionic_modulus(phi) + phi**2 * self._mixing(phi, T)

    def shear_modulus(self, phi_00: float) -> float:
        """mu_s = phi_00^{1/3}/Omega; in pascal it grows with T as k_B T."""
        if not 0 < phi_00 <= 1:
            raise ValueError(f"phi_00 = {phi_00}: must be greater than 0 and at most 1 (dry)")
        return float(np.cbrt(phi_00)) / self.Omega

    def diffusivity(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """(mu_l/k) D; the reference phi_00 cancels."""
        phi = fraction(phi)
        elastic = (self.kappa * phi + np.cbrt(phi)) / self.Omega
        return elastic + self._ionic_modulus(phi) + phi**2 * self._mixing(phi, T)

    def flux_potential(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Integral of (mu_l/k) D from 0 to phi."""
        phi = fraction(phi)
        c_1, c_2, c_3 = self._coefficients(T)
        elastic = (self.kappa * phi**2 / 2 + 0.75 * np.cbrt(phi) ** 4) / self.Omega
        mixing = log_tail(phi, 3) - phi**3 * (2 / 3 * c_1 + 0.75 * c_2 * phi + 0.8 * c_3 * phi**2)
        return elastic + self._ionic_potential(phi) + mixing

    def osmotic_energy(self, phi: ArrayLike, T: ArrayLike) -> NDArray:
        """Integral of Pi/phi^2 over phi: energy of a dry volume, -Pi its slope with J = 1/phi."""
        phi = fraction(phi)
        c_1, c_2, c_3 = self._coefficients(T)
        elastic = (self.kappa * np.log(phi) + 1.5 * np.cbrt(phi) ** -2) / self.Omega
        mixing = (1 / phi - 1) * np.log1p(-phi)
        interaction = phi * (c_1 + phi * (c_2 / 2 + phi * c_3 / 3))
        return elastic + mixing - interaction + self._ionic_energy(phi)

    def asymptotic_polymer_fraction(self, T: ArrayLike) -> NDArray:
        """phi_0 ~ [Omega (1/2 - c_1)]^{-3/5} for phi_0 << 1; nan past its end, or with charges."""
        excess = self.Omega * (0.5 - self._coefficients(T)[0])
        known = (excess > 0) & (not self.charge)
        return np.where(known, np.abs(excess) ** -0.6, np.nan)[()]

    @property
    def singular_temperature(self) -> float:
        """T at which c_1 = 1/2 (the theta temperature); infinite when there is none."""
        p, q = self.constant[0], self.slope[0]
        T = float(self._temperature(np.float64(0.5 - p), np.float64(q))) if q else np.inf
        return T if T > 0 else np.inf

    def _temperature(self, N: NDArray, Q: NDArray) -> NDArray:
        with np.errstate(divide="ignore"):
            return Q / N if self.inverse else N / Q

    def _coefficients(self, T: ArrayLike) -> list[NDArray]:
        T = np.asarray(T, dtype=float)
        s = 1 / T if self.inverse else T
        return [p + q * s for p, q in zip(self.constant, self.slope, strict=True)]

    def _mixing(self, phi: NDArray, T: ArrayLike) -> NDArray:
        c_1, c_2, c_3 = self._coefficients(T)
        return 1 / (1 - phi) - 2 * c_1 - 3 * c_2 * phi - 4 * c_3 * phi**2

    def _athermal_pressure(self, phi: NDArray) -> NDArray:
        elastic = (self.kappa * phi - np.cbrt(phi)) / self.Omega
        q = self.charge * phi
        ionic = q * (q / (self._ionic_strength(phi) + 2 * self.salt)) if self.charge else 0.0
        return elastic + ionic + log_tail(phi, 2)

    def _ionic_strength(self, phi: NDArray) -> NDArray:
        """sqrt(q^2 + 4 c^2), the concentration of all ions in the gel."""
        return np.hypot(self.charge * phi, 2 * self.salt)

    def _ionic_modulus(self, phi: NDArray) -> NDArray | float:
        """phi dPi_i/dphi = q^2/sqrt(q^2 + 4 c^2)."""
        return (self.charge * phi) ** 2 / self._ionic_strength(phi) if self.charge else 0.0

    def _ionic_energy(self, phi: NDArray) -> NDArray | float:
        """Integral of Pi_i/phi^2."""
        if not self.charge:
            return 0.0
        if not self.salt:
            return self.charge * np.log(phi)
        q = self.charge * phi
        shared = q / (self._ionic_strength(phi) + 2 * self.salt)
        return self.charge * (np.arcsinh(q / (2 * self.salt)) - shared)

    def _ionic_potential(self, phi: NDArray) -> NDArray | float:
        """Integral of the ionic modulus, by its series where salt outweighs the charges."""
        if not self.charge:
            return 0.0
        if not self.salt:
            return self.charge * phi**2 / 2
        x = self.charge * phi / (2 * self.salt)
        whole = (x * np.hypot(x, 1) - np.arcsinh(x)) / 2
        term, series = x**3, np.zeros_like(x)
        for k in range(10):
            series = series + term / (2 * k + 3)
            term = -term * x**2 * (2 * k + 1) / (2 * k + 2)
        return 4 * self.salt**2 / self.charge * np.where(x < 0.1, series, whole)[()]

    def _equilibrium_terms(self, phi: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        athermal = self._athermal_pressure(phi)
        slope = (self.kappa - np.cbrt(phi) ** -2 / 3) / self.Omega + phi / (1 - phi)
        slope = slope + self._ionic_modulus(phi) / phi
        P, dP = _polynomial(self.constant, phi)
        Q, dQ = _polynomial(self.slope, phi)
        N, dN = athermal / phi**2 - P, (slope - 2 * athermal / phi) / phi**2 - dP
        return N, Q, dN * Q - N * dQ

    def _spinodal_terms(self, phi: NDArray) -> tuple[NDArray, NDArray, NDArray]:
        root, S = np.cbrt(phi), self._ionic_strength(phi)
        P, dP = _polynomial(np.multiply(self.constant, (2, 3, 4)), phi)
        Q, dQ = _polynomial(np.multiply(self.slope, (2, 3, 4)), phi)
        N = (self.kappa / phi + root**-5) / self.Omega + 1 / (1 - phi) - P
        dN = -(self.kappa + 5 / 3 / root**2) / phi**2 / self.Omega + (1 - phi) ** -2.0 - dP
        if self.charge:
            N, dN = N + self.charge**2 / S, dN - self.charge**4 * phi / S**3
        return N, Q, dN * Q - N * dQ

    @property
    def _equilibrium_poles(self) -> NDArray:
        return _inner_roots(np.asarray(self.slope))

    @property
    def _spinodal_poles(self) -> NDArray:
        return _inner_roots(np.multiply(self.slope, (2, 3, 4)))


def _polynomial(c, phi):
    """c_1 + c_2 phi + c_3 phi^2 and its slope."""
    return c[0] + phi * (c[1] + phi * c[2]), c[1] + 2 * c[2] * phi


def _inner_roots(c) -> NDArray:
    """Roots within (0, 1) at which c_1 + c_2 phi + c_3 phi^2 changes sign."""
    c = np.trim_zeros(np.asarray(c, float), "b")
    roots = np.roots(c[::-1]) if c.size > 1 else np.array([])
    real = np.sort(roots[np.isreal(roots)].real)
    return real[(real > 0) & (real < 1)]
