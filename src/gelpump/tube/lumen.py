"""Flow in the lumen (section 3.6.2): U = C(Z) R and V = -2 Integral_0^Z C dZ.

Radial velocities are in a_1, axial ones in L per poroelastic time, as in `gelpump.tube.wall_flow`.
Since F holds 16 D (Phi_0 - Phi_1) Phi_1^{2/3} / (eps^2 (1-ell)^2), all forms are integrals of F.

As printed (eqn:lumen):

    C = -4 Phi_1 D (Phi_0 - Phi_1) / (eps^2 (1-ell)^2) = -F Phi_1^{1/3} / 4

Matched: the interstitial U_g of eqn:ug and eqn:phi2 at the inner edge B_0, over B_0. That is what
the text above eqn:lumen says:

    C = -4 (1-ell)/ell D (Phi_0 - Phi_1) Phi_1^{-1/3} / (eps^2 (1-ell)^2) = -(1-ell)/ell F/(4 Phi_1)

Moving: what is continuous across the moving edge is q = u_g + u_p, the flux of water and polymer
together, not u_g alone. With W the flow of water into the lumen per length, pi B_0^2 =
pi ell^2 Phi_1^{-2/3} and sigma of `wall_flow.lumen_share`,

    (pi B_0^2)_tau + (pi B_0^2 V)_Z = W = pi (1-ell^2) sigma F Phi_1^{-5/3} .

The lumen deforms with the wall: a material slice dX of it has the volume pi ell^2 dX/Phi_1, so with
u_p the polymer's axial velocity

    (pi B_0^2)_tau + (pi B_0^2 u_p)_Z = -pi ell^2 Phi_1^{-5/3} DPhi_1/Dtau .

Conserving: of a wall that conserves water (`gelpump.tube.closure`), where the right side is
-pi ell^2 [ F Phi_1^{-5/3} + (Phi_1^{-2/3} V_g)_Z ], the difference integrates to

    V = u_p + V_g + Phi_1^{2/3} Integral_0^Z F Phi_1^{-5/3} [ 1 + sigma (1-ell^2)/ell^2 ] dZ .

As printed the wall has DPhi_1/Dtau = F + Phi_1 V_g,Z instead, and V_g above becomes
Phi_1^{2/3} Integral_0^Z Phi_1^{-2/3} dV_g (`moving`): the edge moves, but the wall that sheds the
water does not conserve it, so this V says nothing of what the tube pumps.

The tanh form (eqn:tanh_fit) gives V without its prefactor 8/(eps^2 (1-ell)^2), which is what figure
12 plots, as Integral_0^Z Phi_1 D (Phi_0 - Phi_1) dZ. With Phi_1 itself as the variable,
dPhi_1/dZ = -2A (Phi_inf - Phi_1)(Phi_1 - 1)/(Phi_inf - 1), no tail and no small difference is left:

    behind:  (Phi_inf - 1)/(2A) Integral_{Phi_1(Z)}^{Phi_1(0)} Phi D/(Phi - 1) dPhi
    ahead:   less (Phi_inf - 1)/(2A) Integral_{Phi_1(Z)}^{Phi_1(Z_C)} Phi D/(Phi_inf - Phi) dPhi
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump.tube.front import tanh_profile
from gelpump.tube.wall_flow import Wall, lumen_share

if TYPE_CHECKING:
    from gelpump.materials import PiecewiseLinearGel

NODES, FEWER_NODES = 40, 30  # of the quadrature; the fewer tell how far it may be off
HOT, COLD = 1.0, -1.0  # temperatures theta of either side


def velocity_printed(wall: Wall) -> NDArray:
    """V of eqn:lumen on the faces."""
    return wall.integral(wall.F * np.cbrt(wall.Phi1)) / 2


def velocity_matched(wall: Wall) -> NDArray:
    """V with C from U_g at the inner edge, on the faces."""
    return (1 - wall.ell) / wall.ell * wall.integral(wall.F / wall.Phi1) / 2


def velocity_conserving(wall: Wall) -> NDArray:
    """V in a tube that conserves water, on the faces; ValueError if the wall does not."""
    if not wall.conserves_water:
        raise ValueError("the wall of the printed equation does not conserve water")
    return _deforming(wall) + wall.axial_velocity_face


def velocity_moving(wall: Wall) -> NDArray:
    """V of the printed wall with the motion of the edge, on the faces."""
    along = wall.Phi1 ** (-2 / 3) * np.diff(wall.axial_velocity_face) / wall.cell_length
    return _deforming(wall) + wall.Phi1_face ** (2 / 3) * wall.integral(along)


def _deforming(wall):
    gain = 1 + lumen_share(wall.ell) * (1 - wall.ell**2) / wall.ell**2
    source = wall.integral(wall.F * wall.Phi1 ** (-5 / 3))
    return wall.polymer_velocity_face + gain * wall.Phi1_face ** (2 / 3) * source


VELOCITIES = {
    "printed": velocity_printed,
    "matched": velocity_matched,
    "moving": velocity_moving,
}
MEANING = {
    "printed": "as printed in eqn:lumen",
    "matched": "C from U_g of eqn:ug and eqn:phi2 at the inner edge",
    "moving": "with the motion of the inner edge, of the printed wall",
    "conserving": "of a wall that conserves water",
}


def radial_rate(wall: Wall, V: NDArray) -> NDArray:
    """C = -V_Z/2 in the cells, so that U = C R."""
    return -np.diff(V) / wall.cell_length / 2


def above_far(V: NDArray, hot: NDArray) -> NDArray:
    """What the pulse adds, in the cells: V behind the front, V less that far ahead before it."""
    middle = (V[..., 1:] + V[..., :-1]) / 2
    return np.where(hot, middle, middle - V[..., -1:])


def pulse_flux(wall: Wall, hot: NDArray) -> NDArray:
    """What the printed pulse carries: V of eqn:lumen over it, less V far ahead before the front."""
    return wall.integral(above_far(velocity_printed(wall), hot))[..., -1]


def prefactor(eps: float | NDArray, one_minus_ell: float | NDArray) -> NDArray:
    """What eqn:lumen has before its integral, and figure 12 has not."""
    return 8 / (eps * one_minus_ell) ** 2


def velocity_tanh(
    gel: PiecewiseLinearGel,
    A: float | NDArray,
    Z: NDArray,
    Z_C: float | NDArray,
    nodes: int = NODES,
) -> NDArray:
    """Integral_0^Z Phi_1 D (Phi_0 - Phi_1) dZ of the tanh form; arguments are broadcast."""
    A, Z, Z_C = np.broadcast_arrays(*(np.asarray(value, float) for value in (A, Z, Z_C)))
    start = tanh_profile(-A * Z_C, gel.Phi_inf)
    middle = (1 + gel.Phi_inf) / 2
    here = tanh_profile(A * (Z - Z_C), gel.Phi_inf)
    behind = _integral(
        lambda Phi: Phi * gel.diffusivity(Phi, HOT) / (Phi - 1),
        np.maximum(here, middle),
        start,
        nodes,
    )
    ahead = _integral(
        lambda Phi: Phi * gel.diffusivity(Phi, COLD) / (gel.Phi_inf - Phi),
        np.minimum(here, middle),
        middle,
        nodes,
    )
    return (gel.Phi_inf - 1) / (2 * A) * (behind - ahead)


_rule = cache(np.polynomial.legendre.leggauss)


def _integral(integrand, low, high, nodes):
    """Gauss-Legendre; the integrands' poles are half the jump away from the ends."""
    node, weight = _rule(nodes)
    half = (high - low)[..., np.newaxis] / 2
    return (weight * half * integrand(low[..., np.newaxis] + half * (1 + node))).sum(axis=-1)
