"""Derivations that decide a statement: each solves or differentiates what the paper starts from.

Nothing here uses the formula that it is to test: temperatures are solved for, walls are resolved,
moduli come from an energy and radial terms from differences.  Each takes its resolution, so that
three of them tell the numerical uncertainty.
"""

from collections.abc import Callable

import numpy as np

from gelpump.uncertainty import convergence_index

FAR = 12.0  # end of the domain of heat, in diffusion lengths sqrt(Le tau)
NEARLY = 0.99  # of the change, at which a tube counts as deswollen


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


def wall_time(gel, ell: float, cells: int) -> float:
    """Time in which a wall whose thickness is resolved makes 99 % of its change, times 1/eps^2.

    phi_t = Phi_m^{2/3} (1/s) (s D phi_s)_s for ell < s < 1 with phi = Phi_inf on both edges: the
    radial part of eqn:tube_evolution with eqn:b1bc and eqn:b0bc, in the radius s = R Phi_m^{1/3} of
    the swollen tube, Phi_m being phi on the midline as in the paper.
    """
    from scipy.integrate import solve_ivp
    from scipy.interpolate import CubicSpline

    face = np.linspace(ell, 1.0, cells + 1)
    volume, gap = np.diff(face**2) / 2.0, np.full(cells + 1, face[1] - face[0])
    gap[[0, -1]] /= 2.0

    def rate(_, phi):
        whole = np.concatenate([[gel.Phi_inf], phi, [gel.Phi_inf]])
        D = gel.diffusivity((whole[1:] + whole[:-1]) / 2.0, 1.0)
        return np.diff(face * D * np.diff(whole) / gap) / volume

    end = 2.0 * (1.0 - ell) ** 2
    own_time = end * np.linspace(0.0, 1.0, 501) ** 2  # it passes as Phi_m^{2/3} dtau
    solved = solve_ivp(
        rate, (0.0, end), np.ones(cells), "LSODA", own_time, lband=1, uband=1, rtol=1e-7, atol=1e-9
    )
    middle = solved.y[cells // 2 - 1 : cells // 2 + 1].mean(axis=0)
    done = CubicSpline(own_time, (middle - 1.0) / (gel.Phi_inf - 1.0) - NEARLY)
    tau = CubicSpline(own_time, middle ** (-2.0 / 3.0)).antiderivative()
    return float(tau(done.roots(extrapolate=False)[0]))


def modulus(gel, phi: np.ndarray, T: float, phi_00: float, steps: int) -> np.ndarray:
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
