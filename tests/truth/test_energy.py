import numpy as np
import pytest

from gelpump.truth.energy import Gradient, polymer_stress

M = 0.7


def osmotic(J):
    return 1.3 * (1 / J - 2.0)


def energy(F, c):
    """W with U = -Int Pi dJ, from the invariants of F^T F."""
    C = F.T @ F
    J = np.linalg.det(F)
    I1, I2 = np.trace(C), (np.trace(C) ** 2 - np.trace(C @ C)) / 2
    U = -1.3 * (np.log(J) - 2.0 * J)
    bracket = (1 - c) * (I1 / J ** (2 / 3) - 3) + c * (I2 / J ** (4 / 3) - 3)
    return U + M / 2 * J ** (2 / 3) * bracket


def matrix(F):
    return np.array([[F.rR, 0, F.rZ], [0, F.hoop, 0], [F.zR, 0, F.zZ]])


def stress(F, c):
    s = polymer_stress(F, osmotic(F.J), M, c)
    return np.array([[s.rr, 0, s.rz], [0, s.hoop, 0], [s.rz, 0, s.zz]])


@pytest.mark.parametrize("c", [0.0, 0.4, 1.0])
def test_the_stress_is_the_derivative_of_the_energy(c):
    F = Gradient(0.9, 0.2, -0.1, 0.8, 1.15)
    at, h = matrix(F), 1e-6
    slope = np.zeros((3, 3))
    for i, j in np.ndindex(3, 3):
        d = np.zeros((3, 3))
        d[i, j] = h
        slope[i, j] = (energy(at + d, c) - energy(at - d, c)) / (2 * h)
    assert stress(F, c) == pytest.approx(slope @ at.T / F.J, abs=1e-8)


@pytest.mark.parametrize("c", [0.0, 1.0])
@pytest.mark.parametrize("Phi", [0.5, 1.0, 3.0])
def test_about_any_swelling_the_stress_is_that_of_lens(c, Phi):
    """sigma = -Pi I + 2 mu_s eps, where eps is the deviator of I - F^{-1} (eqn:cst)."""
    small = 1e-5
    d = small * np.array([[0.3, 0, 0.5], [0, -0.4, 0], [-0.2, 0, 0.6]])
    at = Phi ** (-1 / 3) * (np.eye(3) + d)
    F = Gradient(at[0, 0], at[0, 2], at[2, 0], at[2, 2], at[1, 1])
    strain = np.eye(3) - np.linalg.inv(at)
    strain = (strain + strain.T) / 2
    deviator = strain - np.trace(strain) / 3 * np.eye(3)
    lens = -osmotic(F.J) * np.eye(3) + 2 * M * deviator
    assert stress(F, c) == pytest.approx(lens, abs=30 * small**2)
    assert np.abs(2 * M * deviator).max() > 1e3 * small**2  # what is compared is not nothing
