"""The slender tube by the method of lines: a second solution, which shares no code with the first.

One tube, eqn:tube_model as it is printed, in the laboratory frame and with its integral G,

    Phi_tau + k (D/Phi) Phi_Z^2 - (1/3) Phi^{-1/3} Phi_Z G = F + (D Phi_Z)_Z ,
    G_Z = Phi^{-2/3} Phi_tau ,    G(0) = 0 ,

k = 1, and 5/3 where water is conserved.  The time derivative stays within the integral: G is an
unknown beside Phi, and its equation, which holds Phi_tau, makes the system one of differential and
algebraic equations; hence IDA, CVODE's sibling.

Finite differences at nodes (not finite volumes in material coordinates), SUNDIALS in ln(tau) (not
backward differences in sqrt(tau)), a boundary value of one far ahead (not a vanishing gradient).
The nodes move with the front, and one of them is the front, where the condition is continuity of
D Phi_Z.  Phi_tau jumps there: on either side it is extrapolated from the next two nodes.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erfcinv

from gelpump.netcdf import variable

if TYPE_CHECKING:
    import xarray as xr

ORDER = 2  # in space
UNTESTED = 1e-3  # error of G, of its order of magnitude, with which IDA does not shorten a step
SAFETY = 1.25  # of the grid-convergence index
COARSER = 10.0  # times looser are the tolerances of the coarse run


def coefficient(ell: float, closure: str) -> float:
    """The coefficient of F: 16 as printed, else from Phi_2 = alpha s^2 + gamma ln s + c.

    That is one on both edges, and zero on the midline or in the mean over the section.
    """
    if closure == "printed":
        return 16.0
    s, weight = np.array([(1 + ell) / 2]), np.ones(1)
    if closure == "balanced":
        s, weight = np.polynomial.legendre.leggauss(60)
        s = (1 + ell + (1 - ell) * s) / 2
        weight = weight * s / (1 + ell)  # of Integral s ds, over (1 - ell^2)/2
    columns = np.array([s**2, np.log(s), np.ones_like(s)]) @ weight
    edges = [[ell**2, np.log(ell), 1.0], [1.0, 0.0, 1.0]]
    alpha = np.linalg.solve([*edges, columns], [1.0, 1.0, 0.0])[0]
    return 4 * (1 - ell) ** 2 * alpha


def surface(Phi: NDArray, side: tuple[float, float], M: float, closure: str) -> ArrayLike:
    """Phi on the edges: Phi_0, or the root x^3 of x^3 + p x = q that bears no force."""
    if closure != "balanced" or M == 0:
        return side[1]
    p = 4 * M / side[0]
    q = side[1] + p * np.cbrt(Phi)
    root = 2 * np.sqrt(p / 3) * np.sinh(np.arcsinh(1.5 * q / p * np.sqrt(3 / p)) / 3)
    return root**3


def beyond(Z: float, two: NDArray, values: NDArray) -> float:
    """At Z the line through the values at two positions."""
    return values[0] + (values[1] - values[0]) * (Z - two[0]) / (two[1] - two[0])


def solve(
    tau: ArrayLike,
    ell: float,
    eps: float = 0.1,
    M: float = 1.0,
    Pi_ratio: float = 1.0,
    Phi_inf: float = 2.0,
    Le: float = 10.0,
    nodes: int = 400,
    rtol: float = 1e-7,
    closure: str = "printed",
) -> tuple[NDArray, NDArray]:
    """Z and Phi_1 at the `tau`, shape (tau, 2 nodes + 1); the front is in column `nodes`."""
    from sksundae.ida import IDA

    n = nodes
    k = 1 if closure == "printed" else 5 / 3
    w = eps * (1 - ell) / np.sqrt(coefficient(ell, closure))
    s = np.arange(n + 1) / n
    hot = np.array([Pi_ratio / Phi_inf, Phi_inf])
    cold = np.array([1.0, 1.0])
    c = 2 * erfcinv(0.5) * np.sqrt(Le)

    def grid(t):
        """Node positions and tau dZ/dtau at fixed node."""
        front = c * np.sqrt(t)
        scale, reach = 2 * w, 16 * w
        b = np.arcsinh(front / scale)
        behind = front - scale * np.sinh(b * (1 - s))
        behind_rate = 1 - np.cosh(b * (1 - s)) * (1 - s) / np.sqrt(1 + (front / scale) ** 2)
        stretch = np.sinh(3 * s[1:]) / np.sinh(3)
        ahead = front + stretch * reach * front / (front + scale)
        ahead_rate = 1 + stretch * reach * scale / (front + scale) ** 2
        behind[0] = behind_rate[0] = 0.0
        return np.r_[behind, ahead], 0.5 * front * np.r_[behind_rate, ahead_rate]

    def diffusivity(Phi, side):
        return side[0] * Phi + 4 * M / 3 * np.cbrt(Phi)

    def source(Phi, side):
        drive = surface(Phi, side, M, closure) - Phi
        return Phi ** (2 / 3) * diffusivity(Phi, side) * drive / w**2

    def residual(log_tau, y, y_rate, res):
        t = np.exp(log_tau)
        Z, Z_rate = grid(t)
        Phi, G = y[0::2], y[1::2]
        dZ = np.diff(Z)
        middle = (Phi[1:] + Phi[:-1]) / 2
        flux = (
            np.r_[diffusivity(middle[:n], hot), diffusivity(middle[n:], cold)] * np.diff(Phi) / dZ
        )
        F = np.r_[source(Phi[:n], hot), source(Phi[n:], cold)]
        D = np.r_[diffusivity(Phi[: n + 1], hot), diffusivity(Phi[n + 1 :], cold)]
        slope = np.zeros_like(Phi)
        slope[1:-1] = (Phi[2:] - Phi[:-2]) / (Z[2:] - Z[:-2])
        rise = y_rate[0::2] - Z_rate * slope  # tau Phi_tau

        spread = np.zeros_like(Phi)  # (D Phi_Z)_Z
        spread[0] = 2 * flux[0] / dZ[0]
        spread[1:-1] = 2 * np.diff(flux) / (Z[2:] - Z[:-2])
        left = k * D / Phi * slope**2 - slope * G / (3 * np.cbrt(Phi))
        res[0::2] = rise - t * (F + spread - left)
        res[-2] = Phi[-1] - 1

        one_sided = np.array([1.0, -4.0, 3.0])
        back = one_sided @ Phi[n - 2 : n + 1] / (one_sided @ Z[n - 2 : n + 1])
        fore = one_sided @ Phi[n + 2 : n - 1 : -1] / (one_sided @ Z[n + 2 : n - 1 : -1])
        res[2 * n] = w * (D[n] * back - diffusivity(Phi[n], cold) * fore)

        gain = Phi ** (-2 / 3) * rise / t
        behind, ahead = gain[: n + 1].copy(), gain[n:]
        behind[n] = beyond(Z[n], Z[n - 2 : n], gain[n - 2 : n])
        ahead[0] = beyond(Z[n], Z[n + 1 : n + 3], gain[n + 1 : n + 3])
        share = np.r_[behind[1:] + behind[:-1], ahead[1:] + ahead[:-1]] / 2 * dZ
        res[1] = G[0]
        res[3::2] = w * (np.diff(G) - share)

    tau = np.asarray(tau, float)
    start = 1e-6 * w**2
    Z, _ = grid(start)
    y = np.ones(2 * (2 * n + 1))
    y[1::2] = source(1.0, hot) * np.minimum(Z, Z[n])
    algebraic = np.r_[2 * n, y.size - 2, np.arange(1, y.size, 2)]
    atol = np.full(y.size, rtol)
    atol[1::2] = UNTESTED / w  # G is of order 1/w, and as rough in time as the rate it sums
    ida = IDA(
        residual,
        rtol=rtol,
        atol=atol,
        linsolver="band",
        lband=7,
        uband=4,
        algebraic_idx=np.sort(algebraic),
        calc_initcond="yp0",
        max_num_steps=20000,
    )
    span = np.log(np.r_[start, tau])
    if len(span) == 2:
        span = np.r_[span[0], span.mean(), span[1]]
    result = ida.solve(span, y, np.zeros_like(y))
    if not result.success:
        raise RuntimeError(f"IDA failed: {result.message}")
    Phi = result.y[-len(tau) :, 0::2]
    return np.array([grid(t)[0] for t in tau]), Phi


def observed(
    gel, tube: Mapping, ell, tau, nodes: int, rtol: float, closure: str = "printed"
) -> "xr.Dataset":
    """Phi_1 of the tubes ``ell`` at the times ``tau``, with its uncertainty.

    There are ``nodes`` intervals on either side of the front, an even number.  The uncertainty
    comes from a run with half as many and looser tolerances: the difference of the two holds the
    error of time as well.
    The gel lends its parameters M, Pi_ratio and Phi_inf, ``tube`` eps and Le.
    """
    import xarray as xr

    parameters = {
        "eps": tube["eps"],
        "Le": tube["Le"],
        "M": gel.M,
        "Pi_ratio": gel.Pi_ratio,
        "Phi_inf": gel.Phi_inf,
        "closure": closure,
    }
    if nodes % 2:
        raise ValueError(f"nodes = {nodes}: must be even")
    Z, Phi, change = [], [], []
    for each in ell:
        positions, values = solve(tau, each, **parameters, nodes=nodes, rtol=rtol)
        _, fewer = solve(tau, each, **parameters, nodes=nodes // 2, rtol=COARSER * rtol)
        Z.append(positions)
        Phi.append(values)
        change.append(np.abs(values[:, ::2] - fewer))  # every other node is one of the coarse mesh
    error = SAFETY / (2**ORDER - 1) * np.array(change)
    Phi = np.array(Phi)
    long_name = "polymer fraction in the middle of the wall"
    return xr.Dataset(
        {
            "Phi1": variable(("ell", "tau", "node"), Phi, long_name),
            "Z": variable(("ell", "tau", "node"), np.array(Z), "axial position of the nodes"),
            "Phi1_uncertainty": variable(
                ("ell", "tau"), error.max(axis=2), f"numerical uncertainty: {long_name}"
            ),
            "Phi1_front": variable(("ell", "tau"), Phi[..., nodes], f"{long_name} at Z_C"),
            "Phi1_front_uncertainty": variable(
                ("ell", "tau"), error[..., nodes // 2], f"numerical uncertainty: {long_name} at Z_C"
            ),
        },
        coords={
            "ell": variable("ell", np.asarray(ell), "ratio of inner to outer radius, a_0/a_1"),
            "tau": variable("tau", np.asarray(tau), "elapsed time"),
        },
    )
