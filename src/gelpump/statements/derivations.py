"""Derivations that decide a statement: each solves or differentiates what the paper starts from.

Nothing here uses the formula that it is to test: temperatures are solved for, moduli come from an
energy and radial terms from differences.  Each takes its resolution, so that three of them tell the
numerical uncertainty.
"""

from collections.abc import Callable

import numpy as np

from gelpump.materials import EnergyBasedGel
from gelpump.uncertainty import convergence_index

FAR = 12.0  # end of the domain of heat, in diffusion lengths sqrt(Le tau)


def refined(solve: Callable[[int], float], coarse: int) -> tuple[np.ndarray, np.ndarray]:
    """``solve`` at twice the coarse resolution, and its uncertainty from half and double that."""
    low, value, high = (np.asarray(solve(coarse * factor)) for factor in (1, 2, 4))
    return value, convergence_index(low, value, high)


def heat_front(intervals: int) -> float:
    """Where theta = 0, over sqrt(Le tau), in eqn:temp_field solved by differences in space.

    With x = Z/sqrt(Le tau) it is u_t = u_xx from 0 to 1, u(0) = 1, u(x > 0) = -1 at first; the
    modes of the difference operator are exact in time.
    """
    from scipy.interpolate import CubicSpline
    from scipy.linalg import eigh_tridiagonal

    x = np.linspace(0.0, FAR, intervals + 1)
    inner = np.ones(intervals - 1) / x[1] ** 2
    rate, mode = eigh_tridiagonal(-2.0 * inner, inner[1:])
    steady = 1.0 - 2.0 * x / FAR
    departure = mode @ (np.exp(rate) * (mode.T @ (-1.0 - steady[1:-1])))
    theta = steady + np.concatenate([[0.0], departure, [0.0]])
    return float(CubicSpline(x, theta).roots(extrapolate=False)[0])


def modulus(
    gel: EnergyBasedGel, phi: np.ndarray, T: float, phi_00: float, steps: int
) -> np.ndarray:
    """mu_s = sigma_xy / (2 epsilon_xy) in k_B/Omega_f, from the free energy of an element in shear.

    F = (1 + gamma e_x e_y) phi^{-1/3} from the dry state; the stress is phi dW/dgamma for the
    energy W per dry volume of chains and mixing, and the Cauchy strain of the current state
    epsilon_xy = (phi/phi_00)^{1/3} gamma/2.
    """
    gamma = 1.0 / steps

    def energy(shear):
        F = np.array([[1.0, shear, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        F = F / np.cbrt(phi)[:, np.newaxis, np.newaxis]
        J = np.linalg.det(F)
        chains = (F**2).sum(axis=(-2, -1)) / 2.0 - np.log(J)
        mixing = (J - 1.0) * (np.log(1.0 - 1.0 / J) + gel.chi(1.0 / J, T) / J)
        return T * (chains / gel.Omega + mixing)

    stress = phi * (energy(1.5 * gamma) - energy(0.5 * gamma)) / gamma
    return stress / (np.cbrt(phi / phi_00) * gamma)


def edge_coefficient(ell: float) -> tuple[float, float]:
    """f (1-ell)^2 / (D drive) of (f/4D) R^2 + g ln R + h that is ``drive`` on the edges of a
    swollen wall and nothing on its midline, and its rounding: the coefficient that F of
    eqn:tube_model has as 16."""
    R = np.array([ell, (1.0 + ell) / 2.0, 1.0])
    conditions = np.stack([R**2 / 4.0, np.log(R), np.ones(3)], axis=1)
    value = float(np.linalg.solve(conditions, [1.0, 0.0, 1.0])[0]) * (1.0 - ell) ** 2
    return value, float(np.linalg.cond(conditions)) * np.finfo(float).eps * abs(value)


def radial_term(D: float, phi_2: Callable, R: np.ndarray, steps: int) -> np.ndarray:
    """(1/R) (R D phi_2')' by differences, the radial term of eqn:tube_evolution at order eps^2."""
    h = 1.0 / steps

    def flux(R):
        return R * D * (phi_2(R + h / 2.0) - phi_2(R - h / 2.0)) / h

    return (flux(R + h / 2.0) - flux(R - h / 2.0)) / h / R
