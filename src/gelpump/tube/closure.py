"""What the wall of a slender tube keeps, and what its surfaces do: three closures, by name.

All are written for lambda(X, tau) = Phi_1^{-1/3}, the stretch of a slice dX of the swollen wall,
dZ = lambda dX (`gelpump.tube.slender`). With s = Pi_ratio/Phi_inf, Phi_0 = Phi_inf where it is hot
and s = Phi_0 = 1 where it is cold, D = s Phi + (4M/3) Phi^{1/3}, V_g = (D/Phi) Phi_Z and

    K = s lambda^{-5} + (4M/3) lambda^{-3} ,    V_g = -3 K lambda_X ,
    S = lambda^4 F/3 ,    F = Phi^{2/3} D (Phi_s - Phi)/w^2 ,    w = eps (1-ell)/kappa^{1/2} :

`printed`, eqn:tube_model.  The midline's own balance, with kappa = 16 and Phi_s = Phi_0,

    lambda_tau = (K lambda_X)_X - S .

`conservative`.  A slice of the wall has the volume pi (1-ell^2) lambda^3 dX, all of whose change is
water. The flow V_g crosses its sections, of area pi (1-ell^2) lambda^2, and the radial flow U_g of
Phi_2 its edges. On the edges p = 0, so nothing drives a flow along them: what crosses a sloping
edge is U_g, but for the slope squared. Hence, with kappa from the paper's three conditions
on Phi_2 (`wall_flow.source_coefficient`, 8 for thin walls) and Phi_s = Phi_0,

    (lambda^3)_tau = -(lambda^2 V_g)_X - 3 lambda^2 S = 3 (lambda^2 K lambda_X)_X - 3 lambda^2 S .

The printed equation has lambda^2 (V_g)_X in place of (lambda^2 V_g)_X. Their difference, in the
equation for Phi_1 a term (2/3)(D/Phi) Phi_Z^2, is water that would cross the sloping edges.

`balanced`.  The same, with the surface from the balance of forces, which local isotropy
(eps_rr = 0, so Phi_s = Phi_0) leaves out. With the deviatoric strain of LENS, eps = e - (div xi)/3,
e the gradient of the displacement (xi, eta), eta_z uniform in r and div xi = 3 (1 - Phi^{1/3}):

    d(sigma_rr)/dr + (sigma_rr - sigma_tt)/r = 0   gives   p + Pi + 4 mu_s Phi^{1/3} = C ,

the same C on both edges, where p = 0, so one Phi_s for both; the gradient of 2 mu_s (div eps)_r
is (4/3) mu_s d(div xi)/dr. sigma_rr = 0 there, C - 4 mu_s Phi_s^{1/3} = 2 mu_s eps_rr, makes xi/r
the same on both edges, and integrated over the section 2 xi/r + eta_z = 3 (1 - <Phi^{1/3}>).
No net axial force, <sigma_zz> = 0, gives xi/r + 2 eta_z = 3 (1 - <Phi^{1/3}>). So both are
1 - <Phi^{1/3}>, < > the mean over the section, and

    Pi(Phi_s) = 4 mu_s [ <Phi^{1/3}> - Phi_s^{1/3} ] ,

for every ell: the bead's condition (section 2.1) with the mean in place of a_0/a. In this closure
Phi_1 is the mean over the section, to the accuracy of (R^2, ln R, 1): kappa is that of the mean
(`wall_flow.mean_source_coefficient`, 12 for thin walls) and, Pi being linear, Phi_s = x^3 with

    s x^3 + 4 M x = s Phi_0 + 4 M Phi_1^{1/3} .
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump.tube.wall_flow import mean_source_coefficient, source_coefficient

if TYPE_CHECKING:
    from gelpump.tube.tubes import Tubes


class Printed:
    """eqn:tube_model as printed: what the solver conserves is length, lambda."""

    name = "printed"
    conserves_water = False

    def wall_length(self, tubes: Tubes) -> NDArray:
        """w of each tube, in units of L."""
        return tubes.wall_length

    def content(self, stretch: NDArray) -> NDArray:
        """What a slice keeps unless it flows or is a source: lambda."""
        return stretch

    def content_slope(self, stretch: NDArray) -> NDArray:
        """d content/d lambda."""
        return 1.0

    def potential(self, stretch: NDArray, s: NDArray, M: NDArray) -> NDArray:
        """k with k_X the flux of the content."""
        return -s / 4 * stretch**-4.0 - 2 * M / 3 * stretch**-2.0

    def conductivity(self, stretch: NDArray, s: NDArray, M: NDArray) -> NDArray:
        """dk/d lambda."""
        return s * stretch**-5.0 + 4 * M / 3 * stretch**-3.0

    def source(
        self, stretch: NDArray, s: NDArray, Phi_0: NDArray, M: NDArray
    ) -> tuple[NDArray, NDArray]:
        """w^2 times the loss of content through the edges, and its derivative in lambda."""
        resistance = s / stretch + 4 * M / 3 * stretch
        drive = Phi_0 - stretch**-3.0
        slope = (4 * M / 3 - s / stretch**2) * drive + 3 * resistance / stretch**4
        return resistance * drive / 3, slope / 3


class Conservative(Printed):
    """Water is conserved: what a slice keeps is its volume, lambda^3."""

    name = "conservative"
    conserves_water = True

    def wall_length(self, tubes: Tubes) -> NDArray:
        """w of each tube, in units of L."""
        return tubes.eps * (1 - tubes.ell) / np.sqrt(source_coefficient(tubes.ell))

    def content(self, stretch: NDArray) -> NDArray:
        """lambda^3."""
        return stretch**3

    def content_slope(self, stretch: NDArray) -> NDArray:
        """3 lambda^2."""
        return 3 * stretch**2

    def potential(self, stretch: NDArray, s: NDArray, M: NDArray) -> NDArray:
        """k with k_X = 3 lambda^2 K lambda_X."""
        return -1.5 * s / stretch**2 + 4 * M * np.log(stretch)

    def conductivity(self, stretch: NDArray, s: NDArray, M: NDArray) -> NDArray:
        """3 lambda^2 K."""
        return 3 * s / stretch**3 + 4 * M / stretch

    def surface(
        self, stretch: NDArray, s: NDArray, Phi_0: NDArray, M: NDArray
    ) -> tuple[NDArray, NDArray | float]:
        """Phi_s, and its derivative in lambda."""
        return Phi_0, 0.0

    def source(
        self, stretch: NDArray, s: NDArray, Phi_0: NDArray, M: NDArray
    ) -> tuple[NDArray, NDArray]:
        """3 lambda^2 w^2 S = lambda^6 w^2 F, and its derivative in lambda."""
        resistance = s * stretch + 4 * M / 3 * stretch**3
        Phi_s, Phi_s_slope = self.surface(stretch, s, Phi_0, M)
        drive = Phi_s - stretch**-3.0
        slope = (s + 4 * M * stretch**2) * drive + resistance * (Phi_s_slope + 3 / stretch**4)
        return resistance * drive, slope


class Balanced(Conservative):
    """Water is conserved and the surface bears no force."""

    name = "balanced"

    def wall_length(self, tubes: Tubes) -> NDArray:
        """w of each tube, in units of L."""
        return tubes.eps * (1 - tubes.ell) / np.sqrt(mean_source_coefficient(tubes.ell))

    def surface(
        self, stretch: NDArray, s: NDArray, Phi_0: NDArray, M: NDArray
    ) -> tuple[NDArray, NDArray | float]:
        """Phi_s from s x^3 + 4 M x = s Phi_0 + 4 M/lambda by Newton's method from above."""
        x = np.maximum(Phi_0 ** (1 / 3), 1 / stretch)  # convex and rising: no step goes below
        for _ in range(60):
            step = (s * (x**3 - Phi_0) + 4 * M * (x - 1 / stretch)) / (3 * s * x**2 + 4 * M)
            x = x - step
            if np.abs(step).max() < 1e-14:
                break
        return x**3, -3 * x**2 * 4 * M / stretch**2 / (3 * s * x**2 + 4 * M)


class EachItsOwn(Conservative):
    """Water is conserved, and each tube of a family has its surface: one mesh, one iteration."""

    def __init__(self, names: Sequence[str]):
        self.name = list(names)
        self.forceless = np.array([name == Balanced.name for name in names])[:, np.newaxis]

    def wall_length(self, tubes: Tubes) -> NDArray:
        """w of each tube, in units of L."""
        held, free = (CLOSURES[name].wall_length(tubes) for name in WATER)
        return np.where(self.forceless[:, 0], free, held)

    def surface(
        self, stretch: NDArray, s: NDArray, Phi_0: NDArray, M: NDArray
    ) -> tuple[NDArray, NDArray]:
        """Phi_s, and its derivative in lambda."""
        held, free = (CLOSURES[name].surface(stretch, s, Phi_0, M) for name in WATER)
        return tuple(np.where(self.forceless, *pair) for pair in zip(free, held, strict=True))


CLOSURES = {each.name: each for each in (Printed(), Conservative(), Balanced())}
WATER = tuple(name for name, each in CLOSURES.items() if each.conserves_water)


def named(name: str | Sequence[str]) -> Printed:
    """The closure of that name, or of one of WATER for each tube; ValueError if there is none."""
    known, several = (CLOSURES, False) if isinstance(name, str) else (WATER, True)
    for each in name if several else [name]:
        if each not in known:
            raise ValueError(f"closure = {each!r} is not allowed: one of {', '.join(known)}")
    return EachItsOwn(name) if several else CLOSURES[name]
