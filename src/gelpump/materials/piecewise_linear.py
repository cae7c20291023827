"""Piecewise-linear gel: the equilibrium polymer fraction jumps at T_C (section 2).

Polymer fractions are scaled by phi_00, pressures by Pi_00, temperature is
theta = (T - T_C)/Delta T:

    Phi_0 = 1 and Pi_0 = 1 for theta <= 0,  Phi_inf and Pi~ above          (eqn:piecewise_phi0)
    Pi = Pi_0 (Phi - Phi_0)/Phi_0                             (eqn:piecewise_osmotic_pressure)
    D  = Pi_0 Phi/Phi_0 + (4 M/3) Phi^{1/3}      in units k Pi_00/mu_l        (eqn:tube_model)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .validation import non_negative, positive


@dataclass(frozen=True)
class PiecewiseLinearGel:
    """Gel of eqn:piecewise_osmotic_pressure, in the scaling of eqn:nondimensionalisation.

    Phi_inf: equilibrium polymer fraction above T_C over the one below, > 0.
    Pi_ratio: Pi~, strength of the osmotic pressure above T_C over the one below, > 0.
    M: shear modulus over Pi_00, >= 0.
    """

    Phi_inf: float
    Pi_ratio: float
    M: float
    name: str = "piecewise-linear"

    polymer_fraction_bounds: ClassVar = (0.0, np.inf)

    def __post_init__(self) -> None:
        for key, check in (("Phi_inf", positive), ("Pi_ratio", positive), ("M", non_negative)):
            object.__setattr__(self, key, check(f"{self.name}.{key}", getattr(self, key)))

    def equilibrium_polymer_fraction(self, theta: ArrayLike) -> NDArray:
        """Phi_0(theta); the transition temperature itself counts as swollen."""
        return np.where(np.asarray(theta) > 0, self.Phi_inf, 1.0)[()]

    def osmotic_strength(self, theta: ArrayLike) -> NDArray:
        """Pi_0(theta), the slope of Pi against Phi/Phi_0."""
        return np.where(np.asarray(theta) > 0, self.Pi_ratio, 1.0)[()]

    def osmotic_pressure(self, Phi: ArrayLike, theta: ArrayLike) -> NDArray:
        """Pi = Pi_0 (Phi/Phi_0 - 1)."""
        Phi_0 = self.equilibrium_polymer_fraction(theta)
        return self.osmotic_strength(theta) * (_fraction(Phi) - Phi_0) / Phi_0

    def osmotic_modulus(self, Phi: ArrayLike, theta: ArrayLike) -> NDArray:
        """Phi dPi/dPhi = Pi_0 Phi/Phi_0."""
        return self._stiffness(theta) * _fraction(Phi)

    def shear_modulus(self, Phi_00: float = 1.0) -> float:
        """M Phi_00^{1/3}: M from the scaling state; other references leave D as it is."""
        return self.M * float(_fraction(Phi_00)) ** (1 / 3)

    def diffusivity(self, Phi: ArrayLike, theta: ArrayLike) -> NDArray:
        """D = Pi_0 Phi/Phi_0 + (4 M/3) Phi^{1/3}."""
        Phi = _fraction(Phi)
        return self._stiffness(theta) * Phi + 4 / 3 * self.M * np.cbrt(Phi)

    def flux_potential(self, Phi: ArrayLike, theta: ArrayLike) -> NDArray:
        """Integral_0^Phi D = Pi_0 Phi^2/(2 Phi_0) + M Phi^{4/3}."""
        Phi = _fraction(Phi)
        return self._stiffness(theta) * Phi**2 / 2 + self.M * np.cbrt(Phi) ** 4

    def spinodal_polymer_fractions(self, theta: float) -> NDArray:
        """Empty: D > 0 for every Phi."""
        return np.empty(0)

    def _stiffness(self, theta: ArrayLike) -> NDArray:
        return self.osmotic_strength(theta) / self.equilibrium_polymer_fraction(theta)


def _fraction(Phi: ArrayLike) -> NDArray:
    """Phi as an array; ValueError unless every value is above zero."""
    Phi = np.asarray(Phi, dtype=float)
    if not np.all(Phi > 0):
        bad = Phi[~(Phi > 0)].flat[0]
        raise ValueError(f"scaled polymer fraction Phi = {bad}: must be greater than 0")
    return Phi
