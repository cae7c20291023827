"""The slender tube by the method of lines: a second solution, which shares no code with the first.

One tube, eqn:tube_model in the laboratory frame, finite differences at nodes (not finite volumes in
material coordinates), SUNDIALS in ln(tau) (not backward differences in sqrt(tau)), a boundary value
of one far ahead (not a vanishing gradient).  With F the source and I' = F/Phi, I(0) = 0 (`inflow`),

    Phi_tau + [ (2/3)(D/Phi) Phi_Z - I/3 ] Phi_Z = F + (D Phi_Z)_Z ,

which follows from the printed equation: for G = Integral_0^Z Phi^{-2/3} Phi_tau du it reads
d/dZ(Phi^{-1/3} G) = F/Phi + d/dZ(D Phi_Z/Phi), so that no time derivative is left in the integral.
I is solved for together with Phi: the Jacobian stays banded, and the system becomes one of ordinary
and algebraic equations, which is why this is IDA, CVODE's sibling.  The nodes move with the front,
and one of them is the front, where the condition is continuity of D Phi_Z.

Where water is conserved, the equation has (2/3)(D/Phi) Phi_Z^2 more on its left; the polymer's
velocity then gives

    Phi_tau + [ (4/3)(D/Phi) Phi_Z - I/3 ] Phi_Z = F + (D Phi_Z)_Z ,
    I' = F/Phi - (2/3) D (Phi_Z/Phi)^2 .
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import erfcinv

from gelpump.netcdf import variable

if TYPE_CHECKING:
    import xarray as xr

ORDER = 2  # in space
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


def surface(Phi, side, M, closure: str):
    """Phi on the edges: Phi_0, or the root x^3 of x^3 + p x = q that bears no force."""
    if closure != "balanced" or M == 0:
        return side[1]
    p = 4 * M / side[0]
    q = side[1] + p * np.cbrt(Phi)
    root = 2 * np.sqrt(p / 3) * np.sinh(np.arcsinh(1.5 * q / p * np.sqrt(3 / p)) / 3)
    return root**3


def solve(
    tau,
    ell,
    eps=0.1,
    M=1.0,
    Pi_ratio=1.0,
    Phi_inf=2.0,
    Le=10.0,
    nodes=400,
    rtol=1e-7,
    closure="printed",
):
    """Z and Phi_1 at the `tau`, shape (tau, 2 nodes + 1); the front is in column `nodes`."""
    from sksundae.ida import IDA

    n = nodes
    conserves = closure != "printed"
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
        Phi, inflow = y[0::2], y[1::2]
        dZ = np.diff(Z)
        middle = (Phi[1:] + Phi[:-1]) / 2
        flux = (
            np.r_[diffusivity(middle[:n], hot), diffusivity(middle[n:], cold)] * np.diff(Phi) / dZ
        )
        F_hot, F_cold = source(Phi[: n + 1], hot), source(Phi[n:], cold)
        F = np.r_[F_hot, F_cold[1:]]
        D = np.r_[diffusivity(Phi[: n + 1], hot), diffusivity(Phi[n + 1 :], cold)]

        balance = np.zeros_like(Phi)
        balance[0] = F[0] + 2 * flux[0] / dZ[0]
        slope = (Phi[2:] - Phi[:-2]) / (Z[2:] - Z[:-2])
        speed = (4 if conserves else 2) / 3 * (D / Phi)[1:-1] * slope - inflow[1:-1] / 3
        balance[1:-1] = F[1:-1] + 2 * np.diff(flux) / (Z[2:] - Z[:-2]) - speed * slope
        rate = t * balance
        rate[1:-1] += Z_rate[1:-1] * slope
        rate[-1] = 0.0
        res[0::2] = y_rate[0::2] - rate

        one_sided = np.array([1.0, -4.0, 3.0])
        back = one_sided @ Phi[n - 2 : n + 1] / (one_sided @ Z[n - 2 : n + 1])
        fore = one_sided @ Phi[n + 2 : n - 1 : -1] / (one_sided @ Z[n + 2 : n - 1 : -1])
        res[2 * n] = w * (D[n] * back - diffusivity(Phi[n], cold) * fore)

        g_hot, g_cold = F_hot / Phi[: n + 1], F_cold / Phi[n:]
        gain = np.r_[g_hot[1:] + g_hot[:-1], g_cold[1:] + g_cold[:-1]] / 2 * dZ
        if conserves:
            gain -= 2 / 3 * flux * np.diff(Phi) / middle**2
        res[1] = inflow[0]
        res[3::2] = w * (np.diff(inflow) - gain)

    tau = np.asarray(tau, float)
    start = 1e-6 * w**2
    Z, _ = grid(start)
    y = np.ones(2 * (2 * n + 1))
    y[1::2] = source(1.0, hot) * np.minimum(Z, Z[n])
    algebraic = np.r_[2 * n, np.arange(1, y.size, 2)]
    ida = IDA(
        residual,
        rtol=rtol,
        atol=rtol,
        linsolver="band",
        lband=4,
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
