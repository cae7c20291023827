r"""Energy of the gel whose small deviatoric strains about any isotropic state are those of LENS.

Deformations F are measured from the swollen state, so J = det F = 1/Phi. Energies are per swollen
volume and stresses in units of Pi_00, B = F F^T, I1 = tr B, I2 = (I1^2 - tr B^2)/2:

    W = U(J, T) + W_dev,    U_J = -Pi(1/J, T)
    W_dev = (M/2) J^{2/3} [ (1-c)(I1 J^{-2/3} - 3) + c (I2 J^{-4/3} - 3) ]

W_dev and its first derivative vanish in every isotropic state, so Pi is the whole isotropic stress,
and the gel that is free to swell has Pi(Phi) = 0: the gel of eqn:piecewise_osmotic_pressure.
The stress J^{-1} W_F F^T of the polymer and the pervadic pressure p make up

    sigma = -(p + Pi) I + (M/J) { (1-c) [B - J^{2/3} I]
                                  + c [J^{-2/3} (I1 B - B^2 - I2 I/3) - J^{2/3} I] } .

About F = J^{1/3} (I + d) with d small, both brackets are 2 J^{2/3} dev(sym d). LENS measures strain
as I - F^{-1}, so that its deviatoric strain is eps = J^{-1/3} dev(sym d): then

    sigma = -(p + Pi) I + 2 M eps    (eqn:cst), with the same M whatever the swelling.

That modulus is what the Gaussian chains of the paper's appendix A have, and for c = 0, W is exactly
the energy of that appendix (its -log J belongs to Pi). c only matters at finite deviatoric strain,
where LENS says nothing. The trace of the bracket of c = 0 is I1 - 3 J^{2/3} >= 0, a tension of the
second order in the deviatoric strain; the one of c = 1 has the trace J^{-2/3} I2 - 3 J^{2/3} >= 0.
What is measured with c = 0 and c = 1 and differs is not decided by LENS.
"""

from typing import NamedTuple

import numpy as np


class Gradient(NamedTuple):
    """Deformation gradient of an axisymmetric map (R, Z) -> (r, z); arrays of one shape."""

    rR: np.ndarray
    rZ: np.ndarray
    zR: np.ndarray
    zZ: np.ndarray
    hoop: np.ndarray

    @property
    def J(self):
        """Volume over the swollen volume, 1/Phi."""
        return (self.rR * self.zZ - self.rZ * self.zR) * self.hoop


class Stress(NamedTuple):
    """Axisymmetric stress."""

    rr: np.ndarray
    rz: np.ndarray
    zz: np.ndarray
    hoop: np.ndarray


def polymer_stress(F: Gradient, osmotic_pressure, M, c: float = 0.0) -> Stress:
    """sigma + p I, for arrays that may be complex (for derivatives)."""
    J = F.J
    rr, hoop = F.rR**2 + F.rZ**2, F.hoop**2
    rz, zz = F.rR * F.zR + F.rZ * F.zZ, F.zR**2 + F.zZ**2
    square = J ** (2 / 3)
    if c:
        I1 = rr + zz + hoop
        I2 = rr * zz - rz**2 + hoop * (rr + zz)

        def mixed(b, b_squared, identity):
            second = (I1 * b - b_squared - I2 / 3 * identity) / square
            return (1 - c) * b + c * second

        rr, rz, zz, hoop = (
            mixed(rr, rr**2 + rz**2, 1),
            mixed(rz, rz * (rr + zz), 0),
            mixed(zz, rz**2 + zz**2, 1),
            mixed(hoop, hoop**2, 1),
        )
    G = M / J
    isotropic = -osmotic_pressure - G * square
    return Stress(isotropic + G * rr, G * rz, isotropic + G * zz, isotropic + G * hoop)
