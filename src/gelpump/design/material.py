"""A gel in pascal: the four numbers of the tube from moduli, or from a free energy.

The tube knows a gel by eqn:piecewise_osmotic_pressure and eqn:nondimensionalisation,

    Pi = Pi_0 (phi - phi_0)/phi_0,
    M = mu_s/Pi_00,  Pi~ = Pi_0inf/Pi_00,  Phi_inf = phi_0inf/phi_00

An energy-based gel (appendix A) gets these from its tangents at the two equilibria: since
Pi_0 = phi dPi/dphi at phi_0,

    Pi_00 = (k_B T/Omega_f) phi dPi/dphi  at phi_0(T_C - Delta T), T_C - Delta T;  Pi_0inf when hot
    mu_s  = k_B T phi_00^{1/3}/(Omega Omega_f)  when cold                        (eqn:shear_modulus)

The tangents give D as eqn:lens_transport has it at both equilibria (up to the factor T_hot/T_cold
in mu_s, which the tube takes as constant); in between D is that of the gel only roughly, which
`gelpump.design.validity` measures. Heating follows the swollen branch: within a hysteresis the gel
stays swollen.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

BOLTZMANN = 1.380649e-23  # J/K


@dataclass(frozen=True)
class Material:
    """Pi_00 and mu_s in Pa; M, Pi_ratio, Phi_inf; fractions where known; the gel and its state.

    ``pressure_unit`` is that of the gel's own pressures when hot, in Pa; ``hot`` is the temperature
    its methods take for that (theta = 1 of a piecewise-linear gel).
    """

    name: str
    Pi_00: float
    M: float
    Pi_ratio: float
    Phi_inf: float
    phi_00: float | None
    gel: object
    pressure_unit: float
    hot: float
    derived: str

    @property
    def mu_s(self) -> float:
        """Shear modulus in Pa."""
        return self.M * self.Pi_00

    @property
    def energy_based(self) -> bool:
        """Whether the gel has a free energy, so that D may vanish on the way."""
        return hasattr(self.gel, "spinodal_tip")

    @property
    def own_start(self) -> float:
        """The swollen polymer fraction in the gel's own scale."""
        return self.phi_00 if self.energy_based else 1.0

    @property
    def numbers(self) -> dict[str, float]:
        """What `Tubes` takes beside ell and eps."""
        return {"M": self.M, "Pi_ratio": self.Pi_ratio, "Phi_inf": self.Phi_inf}


def from_moduli(
    name: str, Pi_00: float, Pi_hot: float, mu_s: float, phi_00: float, phi_hot: float
) -> Material:
    """The gel of eqn:piecewise_osmotic_pressure with these moduli (Pa) and polymer fractions."""
    from gelpump.materials import PiecewiseLinearGel

    gel = PiecewiseLinearGel(phi_hot / phi_00, Pi_hot / Pi_00, mu_s / Pi_00, name)
    return from_ratios(gel, Pi_00, phi_00)


def from_ratios(gel: Any, Pi_00: float, phi_00: float | None = None) -> Material:
    """A piecewise-linear gel whose pressures are in units of ``Pi_00``."""
    text = "as given (eqn:piecewise_osmotic_pressure)"
    return Material(
        gel.name, Pi_00, gel.M, gel.Pi_ratio, gel.Phi_inf, phi_00, gel, Pi_00, 1.0, text
    )  # fmt: skip


def from_energy(gel: Any, T_cold: float, T_hot: float, molecule_volume: float) -> Material:
    """An energy-based gel heated from ``T_cold`` to ``T_hot`` (K).

    ValueError, from the gel, for a temperature outside its range or without a stable state.
    """
    phi_00, phi_hot = (gel.equilibrium_polymer_fraction(T) for T in (T_cold, T_hot))
    cold, hot = (BOLTZMANN * T / molecule_volume for T in (T_cold, T_hot))
    Pi_00 = cold * float(gel.osmotic_modulus(phi_00, T_cold))
    Pi_hot = hot * float(gel.osmotic_modulus(phi_hot, T_hot))
    M = cold * gel.shear_modulus(phi_00) / Pi_00
    text = (
        f"tangents of the osmotic pressure at the equilibria phi = {phi_00:.4g} at {T_cold:g} K "
        f"and {phi_hot:.4g} at {T_hot:g} K (appendix A)"
    )
    return Material(
        gel.name, Pi_00, M, Pi_hot / Pi_00, phi_hot / phi_00, phi_00, gel, hot, T_hot, text
    )  # fmt: skip
