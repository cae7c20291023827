r"""Both bead models as gradient flows of an energy, which is what continues them past D < 0.

R in [0, 1] is the dry radius of a material shell and r(R, t) where it is; l_t = r/R, l_r = dr/dR,
J = l_r l_t^2 = 1/phi.  With W(J, l_t) the energy of a dry volume and w(a) that of the surface,

    E / 4 pi = Integral W R^2 dR + w(a) ,     dr/dt|_R = -(1/r^2) dE/dr / 4 pi
             = ds_r/dr + 2 (s_r - s_t)/r ,     s_r = dW/dJ|_(l_t) ,
      s_r - s_t = -(l_t/2J) dW/dl_t|_J

and, at R = 1, s_r = -w'(a)/a^2: Darcy flow is the only dissipation.

    nonlinear   W = (l_r^2 + 2 l_t^2)/2 - ln J + mixing ,   w = 0
    LENS        W' = -h(phi), h = Pi/mu + 4 phi^(1/3) ,     w = 2 a^2

so that LENS (eqn:lens_transport with its stress-free surface h(phi_s) = 4/a) is exactly the flow of
a fluid under surface tension: its s_r = -h and its s_r - s_t = 0 are not stresses of the gel, but
drive it in the same way.  Both are parabolic while E = ds_r/d(ln J) > 0 at fixed l_t.

Lengths are in the dry radius, stresses in mu = mu_s(phi_00 = 1), times in mu_l R_dry^2/(k mu).
"""

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Energy(Protocol):
    """A bead's energy; polymer fraction phi and hoop stretch l_t broadcast."""

    def radial_stress(self, phi: ArrayLike, l_t: ArrayLike) -> NDArray:
        """s_r = dW/dJ at fixed l_t."""

    def stress_difference(self, phi: ArrayLike, l_t: ArrayLike) -> NDArray:
        """s_r - s_t."""

    def stiffness(self, phi: ArrayLike, l_t: ArrayLike) -> NDArray:
        """E = ds_r/d(ln J) at fixed l_t, which is -phi ds_r/dphi."""

    def density(self, phi: ArrayLike, l_t: ArrayLike) -> NDArray:
        """W per dry volume."""

    def traction(self, a: ArrayLike) -> NDArray:
        """s_r at a surface of radius a."""

    def surface_energy(self, a: ArrayLike) -> NDArray:
        """w per 4 pi."""


class Nonlinear:
    """The fully nonlinear bead at one temperature (``gelpump.bead.nonlinear``)."""

    name = "nonlinear"

    def __init__(self, gel, temperature: float):
        self.gel, self.temperature = _with_energy(gel), temperature
        self.mu = gel.shear_modulus(1.0)

    def radial_stress(self, phi, l_t):
        """s_r = -Pi/mu + 1/(phi l_t^4) - phi^(1/3)."""
        osmotic = self.gel.osmotic_pressure(phi, self.temperature) / self.mu
        return -osmotic + 1 / (phi * l_t**4) - np.cbrt(phi)

    def stress_difference(self, phi, l_t):
        """s_r - s_t = phi (l_r^2 - l_t^2)."""
        return 1 / (phi * l_t**4) - phi * l_t**2

    def stiffness(self, phi, l_t):
        """E = phi Pi'/mu + phi^(1/3)/3 + 1/(phi l_t^4)."""
        osmotic = self.gel.osmotic_modulus(phi, self.temperature) / self.mu
        return osmotic + np.cbrt(phi) / 3 + 1 / (phi * l_t**4)

    def density(self, phi, l_t):
        """W, its zero that of the gel's osmotic energy."""
        osmotic = self.gel.osmotic_energy(phi, self.temperature) / self.mu
        l_r = 1 / (phi * l_t**2)
        return osmotic - 1.5 * np.cbrt(phi) ** -2 + (l_r**2 + 2 * l_t**2) / 2

    def traction(self, a):
        """No stress."""
        return 0.0 * a

    def surface_energy(self, a):
        """None."""
        return 0.0 * a


class Lens:
    """The LENS bead at one temperature (``gelpump.bead.lens``)."""

    name = "lens"

    def __init__(self, gel, temperature: float):
        self.gel, self.temperature = _with_energy(gel), temperature
        self.mu = gel.shear_modulus(1.0)

    def radial_stress(self, phi, l_t):
        """s_r = -h = -Pi/mu - 4 phi^(1/3)."""
        osmotic = self.gel.osmotic_pressure(phi, self.temperature) / self.mu
        return -osmotic - 4 * np.cbrt(phi) + 0.0 * l_t

    def stress_difference(self, phi, l_t):
        """Nothing pulls sideways."""
        return 0.0 * phi * l_t

    def stiffness(self, phi, l_t):
        """E = D/mu."""
        return self.gel.diffusivity(phi, self.temperature) / self.mu + 0.0 * l_t

    def density(self, phi, l_t):
        """W, its zero that of the gel's osmotic energy."""
        osmotic = self.gel.osmotic_energy(phi, self.temperature) / self.mu
        return osmotic - 6 * np.cbrt(phi) ** -2 + 0.0 * l_t

    def traction(self, a):
        """Surface tension, -4/a."""
        return -4 / a

    def surface_energy(self, a):
        """2 a^2."""
        return 2 * a**2


ENERGIES = {"nonlinear": Nonlinear, "lens": Lens}


def _with_energy(gel):
    """``gel``; ValueError if it does not give the energy that separation needs."""
    if not hasattr(gel, "osmotic_energy"):
        raise ValueError(f"{gel.name}: no osmotic_energy: beads of such a gel stop where D < 0")
    return gel
