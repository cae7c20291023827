"""Uniform deswelling and re-swelling of a tube (section 3.4), without time stepping.

If the temperature changes everywhere at once, eqn:tube_model has no axial gradient and leaves

    dPhi/dtau = F = 16 Phi^{2/3} D (Phi_0 - Phi) / (eps^2 (1-ell)^2),   D = s Phi + (4M/3) Phi^{1/3}

with Phi_0 = Phi_inf, s = Pi_ratio/Phi_inf in a hot tube and Phi_0 = s = 1 in a cold one. Lengths
and times are scaled by L and mu_l L^2/(k Pi_00), polymer fractions by phi_00
(eqn:nondimensionalisation).

Since 16/(eps^2 (1-ell)^2) = 1/w^2 with w = eps (1-ell)/4, the equation separates:

    tau = w^2 Integral dPhi / [ Phi (Phi_0 - Phi) (s Phi^{2/3} + 4M/3) ]

The end point is a logarithmic singularity. It is taken away by y = ln[Phi/(Phi_0 - Phi)] while
drying and y = ln(Phi - Phi_0) while swelling. In y the integrand is analytic for |Im y| < pi
whatever the parameters, so Gauss-Legendre converges geometrically.
"""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gelpump.tube.tubes import Tubes

NODES, FEWER_NODES = 64, 48  # of the quadrature; the fewer tell how far it may be off
LARGEST_Y = 40.0  # exp(-40): at rest to double precision
BLOCK = 2**14  # designs whose intermediate results stay in the processor's cache
EPS = 0.1  # any: t_99 does not depend on it


def deswelling_time(
    tubes: Tubes, percent_left: float = 1.0, reswelling: bool = False, nodes: int = NODES
) -> NDArray:
    """Time until `percent_left` per cent of the change is still to come: tau_99 by default.

    From Phi = 1 to Phi_inf in a tube heated everywhere, or back if `reswelling` (section 3.4). In
    units of mu_l L^2/(k Pi_00), shape of the tubes. ValueError for a `percent_left` that is none,
    and for Phi_inf = 1, where nothing changes.
    """
    if not 0 < percent_left < 100:
        raise ValueError(f"percent_left = {percent_left!r} is not allowed: 0 < percent_left < 100")
    if (tubes.Phi_inf == 1).any():
        raise ValueError(
            "Phi_inf = 1 is not allowed here: without a change there is no time for it"
        )
    start, end, _ = _path(tubes, reswelling)
    y0 = _y(start, end, reswelling)
    y1 = _y(end - (end - start) * percent_left / 100, end, reswelling)
    return _time(y0, y1, tubes, reswelling, nodes)


def response_time(
    a_0: ArrayLike,
    a_1: ArrayLike,
    permeability: ArrayLike,
    viscosity: ArrayLike,
    osmotic_modulus: ArrayLike,
    *,
    M: ArrayLike,
    Pi_ratio: ArrayLike,
    Phi_inf: ArrayLike,
    **which: Any,
) -> NDArray:
    """t_99 in seconds of tubes that are heated everywhere, all arguments in SI units.

    `a_0` and `a_1` (m) are the radii of the swollen tube, `osmotic_modulus` (Pa) is Pi_00; the
    others are those of `Tubes`; `which` is passed to `deswelling_time`. Everything is broadcast.
    With L = a_1/eps the time mu_l L^2/(k Pi_00) tau_99 does not depend on eps: only the thickness
    of the wall enters, t_99 = mu_l (a_1 - a_0)^2/(16 k Pi_00) times the quadrature (section 3.4).
    ValueError for what is no tube, or no positive number.

    Works through blocks of designs, so that beside the result the memory is the same for any number
    of them; a million take some two seconds.
    """
    given = (a_0, a_1, permeability, viscosity, osmotic_modulus, M, Pi_ratio, Phi_inf)
    columns = np.broadcast_arrays(*given)
    names = ("a_1", "permeability", "viscosity", "osmotic_modulus")
    for key, column in zip(names, columns[1:5], strict=True):
        if not ((column > 0) & np.isfinite(column)).all():
            bad = column[~((column > 0) & np.isfinite(column))].flat[0]
            raise ValueError(f"{key} = {bad:g} is not allowed: {key} > 0, finite")
    time = np.empty(columns[0].shape)
    for start in range(0, time.size, BLOCK):
        block = slice(start, start + BLOCK)
        inner, outer, k, mu_l, Pi_00, *material = (column.flat[block] for column in columns)
        tubes = Tubes(inner / outer, EPS, *material)
        time.flat[block] = mu_l * (outer / EPS) ** 2 / (k * Pi_00) * deswelling_time(tubes, **which)
    return time[()]


def deswelling_curve(
    tau: ArrayLike, tubes: Tubes, reswelling: bool = False, nodes: int = NODES
) -> NDArray:
    """Phi_1(tau) of a uniformly heated (or cooled) tube; `tau` and the tubes are broadcast.

    `tau` is in units of mu_l L^2/(k Pi_00) (section 3.4). ValueError if it is negative or nothing
    changes, RuntimeError if the iteration does not converge.

    tau(y) is monotone and nearly linear, so Newton's iteration inverts it in a few steps.
    """
    tau = np.asarray(tau, float)
    if (tau < 0).any():
        raise ValueError(f"tau = {tau.min():g} is not allowed: tau >= 0")
    start, end, _ = _path(tubes, reswelling)
    if (start == end).any():
        raise ValueError("Phi_inf = 1 is not allowed here: nothing changes")
    y0 = _y(start, end, reswelling)
    low, high = (y0 - LARGEST_Y, y0) if reswelling else (y0, y0 + LARGEST_Y)
    y = y0 + np.zeros(np.broadcast_shapes(tau.shape, np.shape(y0)))
    for _ in range(60):
        late = tau - _time(y0, y, tubes, reswelling, nodes)
        step = late / _time_per_y(y, tubes, reswelling)
        new = np.clip(y + step, low, high)
        change = np.abs(new - y).max()
        y = new
        if change < 1e-13 * LARGEST_Y:
            return _Phi(y, end, reswelling)
    raise RuntimeError(f"Newton's iteration for Phi_1 still moves by {change:.1e}")


def _path(tubes, reswelling):
    """Phi at the start and the end, and the osmotic coefficient s on the way."""
    one = np.ones_like(tubes.Phi_inf)
    if reswelling:
        return tubes.Phi_inf, one, one
    return one, tubes.Phi_inf, tubes.Pi_ratio / tubes.Phi_inf


def _y(Phi, end, reswelling):
    return np.log(Phi - end) if reswelling else np.log(Phi / (end - Phi))


def _Phi(y, end, reswelling):
    return end + np.exp(y) if reswelling else end / (1 + np.exp(-y))


def _time_per_y(y, tubes, reswelling):
    _, end, s = _path(tubes, reswelling)
    Phi = _Phi(y, end, reswelling)
    stiffness = s * Phi ** (2 / 3) + 4 * tubes.M / 3
    return tubes.wall_length**2 / (stiffness * (-Phi if reswelling else end))


_rule = cache(np.polynomial.legendre.leggauss)


def _time(y0, y1, tubes, reswelling, nodes):
    """Gauss-Legendre, one node at a time so that a million parameter sets fit in memory."""
    half = (y1 - y0) / 2
    return half * sum(
        weight * _time_per_y(y0 + half * (1 + node), tubes, reswelling)
        for node, weight in zip(*_rule(nodes), strict=True)
    )
