"""The heat that a gel takes up when it collapses: by its energy, and by calorimetry.

With W the free energy of a dry volume, its internal energy is U = W - T dW/dT. Chains that are
springs of entropy, and ideal ions, have W ~ T and add nothing; of the mixing of appendix A remains

    U = -(k_B T^2/Omega_f) (1 - phi) dchi/dT

(for chi linear in T and phi, dchi/dT = B0 + B1 phi). Here it is taken from any explicit gel's
`osmotic_energy`, less that of the dry polymer, since U = 0 before mixing. Per dry volume, at T,

    latent heat    U(phi_hot) - U(phi_cold),    times phi_00 per volume of the swollen gel;
    U_v = dU/dJ = -phi^2 dU/dphi  stands where eqn:lens_heat_equation has rho c T (docs/heat.md);
    dU/dT          what mixing adds to the heat capacity of a dry volume.

An energy fitted to swelling knows its own slope with T at the transition and no calorimeter: its
latent heat, and its heat capacity, are not to be trusted. Use it at constant temperature.

Calorimetry gives heat per dry mass, or per mole of repeat units: h rho_dry, or h rho_dry/m.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gelpump.materials.explicit import ExplicitGel

BOLTZMANN = 1.380649e-23  # J/K
MOLECULE_VOLUME = 3.0e-29  # m^3, of water
DRY = 1 - 1e-15
STEP = 1e-3  # of T, of differences that are exact where chi is linear in T, to 1e-11 in 1/T


def _slope(function, T):
    """d function/dT to fourth order."""
    h = STEP * T
    near, far = function(T + h) - function(T - h), function(T + 2 * h) - function(T - 2 * h)
    return (8 * near - far) / (12 * h)


def internal_energy(
    gel: ExplicitGel, phi: ArrayLike, T: float, molecule_volume: float = MOLECULE_VOLUME
) -> NDArray:
    """U in J per m^3 of dry polymer at T (K), 0 if unmixed; ValueError unless 0 < phi < 1."""

    def mixing(T):
        return gel.osmotic_energy(phi, T) - gel.osmotic_energy(DRY, T)

    return -(T**2) * _slope(mixing, T) * BOLTZMANN / molecule_volume


def energy_pressure(
    gel: ExplicitGel, phi: ArrayLike, T: float, molecule_volume: float = MOLECULE_VOLUME
) -> NDArray:
    """U_v = dU/dJ in Pa, from Pi = -dW/dJ: T dPi/dT - Pi with pressures k_B T/Omega_f."""
    unit = BOLTZMANN / molecule_volume
    return T**2 * _slope(lambda T: gel.osmotic_pressure(phi, T), T) * unit


def mixing_heat_capacity(
    gel: ExplicitGel, phi: ArrayLike, T: float, molecule_volume: float = MOLECULE_VOLUME
) -> NDArray:
    """dU/dT in J/(m^3 K) of dry polymer."""
    return _slope(lambda T: internal_energy(gel, phi, T, molecule_volume), T)


def latent_heat(
    gel: ExplicitGel,
    phi_cold: float,
    phi_hot: float,
    T: float,
    molecule_volume: float = MOLECULE_VOLUME,
) -> float:
    """Heat in J per m^3 of dry polymer that the collapse from phi_cold to phi_hot takes up at T.

    ValueError unless phi_cold < phi_hot, both within (0, 1).
    """
    if not phi_cold < phi_hot:
        raise ValueError(f"phi_cold = {phi_cold}, phi_hot = {phi_hot}: the first must be less")
    low, high = internal_energy(gel, np.array([phi_cold, phi_hot]), T, molecule_volume)
    return float(high - low)
