"""A tube whose collapse holds its front of heat back, by the method of lines: a second solution.

As in `gelpump.second_solvers.tube`: the laboratory frame, finite differences, IDA in ln(tau), the
integral G kept as an unknown. Beside Phi and G the nodes have the temperature theta, the flow Q of
volume through the section A that conducts, and the front Z_C, which is where theta = 0:

    A theta_tau + Q theta_Z = Le (A theta_Z)_Z - (1-ell^2) St/(1 - 1/Phi_inf) Phi^{-5/3} DPhi/Dtau ,
    Q_Z = -A_tau - o F Phi^{-5/3} ,    DPhi/Dtau = Phi_tau - (1/3) Phi^{-1/3} G Phi_Z ,

A = s, Q = 0 in a pipe of section s (over pi a_1^2), A = Phi^{-2/3} and o = (1-sigma)(1-ell^2) for a
tube that is insulated. Every node has its own Z_C, equal to its neighbour's, so that the system
keeps its band.
"""

import numpy as np
from scipy.special import erfc, erfcinv

from gelpump.second_solvers.tube import UNTESTED, beyond, coefficient

REACH = 9.0  # in sqrt(Le tau), of the nodes ahead of the front
UNKNOWNS = 5


def lumen_share(ell: float) -> float:
    """sigma, from the slope of Phi_2 = alpha s^2 + gamma ln s + c at the two edges."""
    s = np.array([ell, (1 + ell) / 2, 1.0])
    alpha, gamma, _ = np.linalg.solve(
        np.stack([s**2, np.log(s), np.ones(3)], axis=1), [1.0, 0.0, 1.0]
    )
    inner, outer = (-(2 * alpha * ell**2 + gamma), 2 * alpha + gamma)
    return inner / (inner + outer)


def solve(
    tau,
    ell,
    St=0.0,
    section=None,
    eps=0.1,
    M=1.0,
    Pi_ratio=1.0,
    Phi_inf=2.0,
    Le=10.0,
    nodes=200,
    rtol=1e-6,
):
    """Z, Phi_1 and theta at the `tau`, shape (tau, 2 nodes + 1), and Z_C (tau,).

    section is that of a pipe; without it the tube is insulated.
    """
    from sksundae.ida import IDA

    n, insulated = nodes, section is None
    w = eps * (1 - ell) / np.sqrt(coefficient(ell, "conservative"))
    s = np.arange(n + 1) / n
    hot, cold = (Pi_ratio / Phi_inf, Phi_inf), (1.0, 1.0)
    wall = 1 - ell**2
    outwards = (1 - lumen_share(ell)) * wall if insulated else 0.0
    per_water = wall * St / (1 - 1 / Phi_inf)
    g = 0.5 * w

    def grid(t, c):
        """Nodes, and the parts of tau dZ/dtau that go with dZ_C and with sqrt(tau)."""
        b = np.arcsinh(c[: n + 1] / g)
        behind = c[: n + 1] - g * np.sinh(b * (1 - s))
        with_c = 1 - np.cosh(b * (1 - s)) * (1 - s) / np.sqrt(1 + (c[: n + 1] / g) ** 2)
        behind[0] = with_c[0] = 0.0
        R = REACH * np.sqrt(Le * t)
        B = np.arcsinh(R / g)
        ahead = g * np.sinh(B * s[1:])
        spread = np.cosh(B * s[1:]) * s[1:] / np.sqrt(1 + (R / g) ** 2) * R / 2
        return (
            np.r_[behind, c[n + 1 :] + ahead],
            np.r_[with_c, np.ones(n)],
            np.r_[np.zeros(n + 1), spread],
        )

    def diffusivity(Phi, side):
        return side[0] * Phi + 4 * M / 3 * np.cbrt(Phi)

    def source(Phi, side):
        return Phi ** (2 / 3) * diffusivity(Phi, side) * (side[1] - Phi) / w**2

    def one_sided(values, Z):
        """Slope at the last of three points, to second order."""
        a, b = Z[2] - Z[1], Z[1] - Z[0]
        near, far = (values[2] - values[1]) / a, (values[1] - values[0]) / b
        return near + a * (near - far) / (a + b)

    def residual(log_tau, y, y_rate, res):
        t = np.exp(log_tau)
        Phi, G, theta, Q, c = (y[i::UNKNOWNS] for i in range(UNKNOWNS))
        rates = [y_rate[i::UNKNOWNS] for i in range(UNKNOWNS)]
        Z, with_c, spread = grid(t, c)
        Z_rate = with_c * rates[4] + spread
        dZ, wide = np.diff(Z), Z[2:] - Z[:-2]
        middle = (Phi[1:] + Phi[:-1]) / 2
        D_face = np.r_[diffusivity(middle[:n], hot), diffusivity(middle[n:], cold)]
        flux = D_face * np.diff(Phi) / dZ
        F = np.r_[source(Phi[:n], hot), source(Phi[n:], cold)]
        D = np.r_[diffusivity(Phi[: n + 1], hot), diffusivity(Phi[n + 1 :], cold)]

        def slope(values):
            found = np.zeros_like(values)
            d = np.diff(values) / dZ
            found[1:-1] = (dZ[:-1] * d[1:] + dZ[1:] * d[:-1]) / wide
            return found

        Phi_Z = slope(Phi)
        rise = rates[0] - Z_rate * Phi_Z  # tau Phi_tau
        out = np.zeros_like(Phi)
        out[0] = 2 * flux[0] / dZ[0]
        out[1:-1] = 2 * np.diff(flux) / wide
        left = 5 / 3 * D / Phi * Phi_Z**2 - Phi_Z * G / (3 * np.cbrt(Phi))
        eq = [np.empty_like(Phi) for _ in range(UNKNOWNS)]
        eq[0] = rise - t * (F + out - left)
        eq[0][-1] = Phi[-1] - 1
        back = one_sided(Phi[n - 2 : n + 1], Z[n - 2 : n + 1])
        fore = one_sided(Phi[n + 2 : n - 1 : -1], Z[n + 2 : n - 1 : -1])
        eq[0][n] = w * (D[n] * back - diffusivity(Phi[n], cold) * fore)

        def by_sides(values):
            """Values on either side of the front, where Phi_tau and F jump."""
            behind, ahead = values[: n + 1].copy(), values[n:].copy()
            behind[n] = beyond(Z[n], Z[n - 2 : n], values[n - 2 : n])
            ahead[0] = beyond(Z[n], Z[n + 1 : n + 3], values[n + 1 : n + 3])
            return behind, ahead

        def integrated(values):
            behind, ahead = by_sides(values)
            return np.r_[behind[1:] + behind[:-1], ahead[1:] + ahead[:-1]] / 2 * dZ

        eq[1][0] = G[0]
        eq[1][1:] = w * (np.diff(G) - integrated(Phi ** (-2 / 3) * rise / t))
        loss = Phi ** (-5 / 3) * (rise / t - Phi_Z * G / (3 * np.cbrt(Phi)))
        loss_sides = by_sides(loss)
        loss[n] = (
            loss_sides[0][n] * dZ[n - 1] + loss_sides[1][0] * dZ[n]
        ) / (dZ[n - 1] + dZ[n])  # fmt: skip
        A = Phi ** (-2 / 3) if insulated else np.full_like(Phi, section)
        conducted = Le * (A[1:] + A[:-1]) / 2 * np.diff(theta) / dZ
        theta_Z = slope(theta)
        warmed = A * (rates[2] - Z_rate * theta_Z) / t + Q * theta_Z + per_water * loss
        warmed[1:-1] -= 2 * np.diff(conducted) / wide
        eq[2] = t * warmed
        eq[2][0], eq[2][-1], eq[2][n] = theta[0] - 1, theta[-1] + 1, theta[n]
        eq[3][0] = Q[0]
        gain = -2 / 3 * Phi ** (-5 / 3) * rise / t + outwards * np.r_[F[:n], F[n:]] * Phi ** (
            -5 / 3
        )
        eq[3][1:] = w * (np.diff(Q) + integrated(gain) * insulated)
        eq[4][:n], eq[4][n + 1 :] = c[:n] - c[1 : n + 1], c[n + 1 :] - c[n:-1]
        eq[4][n] = t * warmed[n]
        for i in range(UNKNOWNS):
            res[i::UNKNOWNS] = eq[i]

    tau, start = np.asarray(tau, float), 1e-6 * w**2
    count = 2 * n + 1
    c = np.full(count, 2 * erfcinv(0.5) * np.sqrt(Le * start))
    Z = grid(start, c)[0]
    y = np.zeros(UNKNOWNS * count)
    y[0::UNKNOWNS], y[1::UNKNOWNS] = 1.0, source(1.0, hot) * np.minimum(Z, Z[n])
    y[2::UNKNOWNS] = 2 * erfc(Z / (2 * np.sqrt(Le * start))) - 1
    y[4::UNKNOWNS] = c
    y[UNKNOWNS * n + 2] = 0.0
    y[-UNKNOWNS + 2] = -1.0
    node = UNKNOWNS * np.arange(count)
    algebraic = np.r_[
        node[n], node[-1], node + 1, node[[0, n, -1]] + 2, node + 3, np.delete(node, n) + 4
    ]
    atol = np.full(y.size, rtol)
    atol[1::UNKNOWNS] = atol[3::UNKNOWNS] = UNTESTED / w
    atol[4::UNKNOWNS] = rtol * c[0]
    band = 3 * UNKNOWNS - 1
    ida = IDA(
        residual,
        rtol=rtol,
        atol=atol,
        linsolver="band",
        lband=band,
        uband=band,
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
    Phi, _, theta, _, c = (result.y[-len(tau) :, i::UNKNOWNS] for i in range(UNKNOWNS))
    Z = np.array([grid(t, each)[0] for t, each in zip(tau, c, strict=True)])
    return Z, Phi, theta, c[:, n]
