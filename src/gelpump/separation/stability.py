r"""Linear theory of a uniform state: which wavelengths of polymer fraction grow, and how fast.

About a uniform, isotropic state of polymer fraction phi both models are the same, dr/dt = (D/mu)
grad(div u) - kappa phi^2 grad(lap(div u)) for small displacements u, so that a mode of wave number
k grows at

    omega = -(D/mu) k^2 - kappa phi^2 k^4 .

Where D < 0, those of k^2 < -D/(mu kappa phi^2) grow, that of half this k^2 fastest.
"""

import numpy as np


def growth_rate(gel, temperature: float, phi: float, kappa: float, k):
    """omega, in 1/t_BMJ, of the wave number k, in 1/R_dry."""
    D = gel.diffusivity(phi, temperature) / gel.shear_modulus(1.0)
    return -D * k**2 - kappa * phi**2 * k**4


def fastest_wavelength(gel, temperature: float, phi: float, kappa: float) -> float:
    """Wavelength that grows fastest, in R_dry; inf where none grows, D >= 0."""
    D = float(gel.diffusivity(phi, temperature) / gel.shear_modulus(1.0))
    return 2 * np.pi * phi * np.sqrt(2 * kappa / -D) if D < 0 else np.inf
