r"""The tube under a temperature programme in the laboratory frame: a second solution.

With Q = lambda^3 K lambda_Z, u the polymer's axial velocity and S the loss through the edges
(`gelpump.tube.closure`, `conservative`), at fixed Z,

    lambda_tau + u lambda_Z = lambda u_Z ,     u_Z = Q_Z/lambda^2 - S/lambda ,     u(0) = 0 .

Finite differences at nodes that do not move (not finite volumes of the material), lambda and u
interleaved as unknowns of one system of differential and algebraic equations for IDA (not backward
differences of our own); heat by its own superposition of error functions; a node is hot by the
share of what lies nearer to it than to its neighbours.  What has gone past a station follows from
the state, since water is conserved: with sigma the lumen's share of what the wall sheds,

    pumped = ell^2 Integral (1 - lambda^2) dZ + sigma (1-ell^2) Integral (1/lambda - lambda^2) dZ .
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from scipy.optimize import brentq
from scipy.special import erfc

from gelpump.second_solvers.tube import coefficient

UNTESTED = (
    1.0  # error of u, over its order of magnitude 1/w, with which IDA does not shorten a step
)


def solve(
    tau, switches, ell, eps=0.1, M=1.0, Pi_ratio=1.0, Phi_inf=2.0, Le=10.0, node=0.25, rtol=1e-6
):
    """What has gone past a station far ahead, over pi a_1^2 L, and Phi_1(Z) at the times ``tau``.

    theta of the end Z = 0 changes its sign, from -1 on, at the times ``switches``, the first of
    them 0; ``node`` is the distance of nodes in w.  Returns pumped (tau,), Z (node,), Phi (tau,
    node).
    """
    from sksundae.ida import IDA

    w = eps * (1 - ell) / np.sqrt(coefficient(ell, "conservative"))
    tau, switches = np.asarray(tau, float), np.asarray(switches, float)
    signs = 2.0 * (-1.0) ** np.arange(switches.size)

    def theta(Z, t):
        total = -1.0
        for begin, jump in zip(switches, signs, strict=True):
            if t > begin:
                total = total + jump * erfc(Z / (2 * np.sqrt(Le * (t - begin))))
        return total

    def fronts(t):
        active = switches[switches < t]
        far = 10 * np.sqrt(Le * t)
        near = 1e-4 * np.sqrt(Le * (t - active[-1]))
        grid = np.r_[0.0, np.geomspace(near, far, 90)]
        warm = theta(grid, t) > 0
        k = np.flatnonzero(warm[1:] != warm[:-1])
        return np.array([brentq(theta, grid[i], grid[i + 1], args=(t,), xtol=1e-13) for i in k])

    furthest = max(fronts(t).max(initial=0.0) for t in np.linspace(tau[-1] / 200, tau[-1], 200))
    n = int(np.ceil((furthest / w + 12) / node))
    Z = np.arange(n + 1) * node * w
    h = node * w
    edges = np.r_[0.0, (Z[1:] + Z[:-1]) / 2, Z[-1]]
    hot, cold = np.array([Pi_ratio / Phi_inf, Phi_inf]), np.array([1.0, 1.0])
    known = {}

    def share(ends, t, key):
        """Hot share of the intervals between ``ends``."""
        if (t, key) not in known:
            if len(known) > 8:
                known.clear()
            begin = switches[switches < t]
            knots = np.r_[0.0, fronts(t), ends[-1] + 10.0] if begin.size else np.r_[0.0, 1e3]
            warm = np.arange(knots.size - 1) % 2 == (0 if begin.size % 2 else 1)
            run = np.r_[0.0, np.cumsum(np.diff(knots) * warm)]
            known[t, key] = np.diff(np.interp(ends, knots, run)) / np.diff(ends)
        return known[t, key]

    def K(stretch, side):
        return side[0] * stretch**-5.0 + 4 * M / 3 * stretch**-3.0

    def loss(stretch, side):
        """S."""
        D = side[0] * stretch**-3.0 + 4 * M / 3 / stretch
        return stretch**2 * D * (side[1] - stretch**-3.0) / (3 * w * w)

    def residual(t, y, rate, res):
        stretch, u = y[0::2], y[1::2]
        at_nodes, between = share(edges, t, "node"), share(Z, t, "face")
        S = at_nodes * loss(stretch, hot) + (1 - at_nodes) * loss(stretch, cold)
        middle = (stretch[1:] + stretch[:-1]) / 2
        conducted = 1 / (between / K(middle, hot) + (1 - between) / K(middle, cold))
        Q = middle**3 * conducted * np.diff(stretch) / h
        Q_Z = np.r_[2 * Q[0], np.diff(Q), 0.0] / h
        u_Z = Q_Z / stretch**2 - S / stretch
        slope = np.r_[0.0, (stretch[2:] - stretch[:-2]) / (2 * h), 0.0]
        res[0::2] = w * w * (rate[0::2] + u * slope - stretch * u_Z)
        res[-2] = stretch[-1] - 1
        res[1] = u[0]
        res[3::2] = w * (np.diff(u) - h * (u_Z[1:] + u_Z[:-1]) / 2)

    y, found = np.ones(2 * (n + 1)), [np.ones(n + 1)] * int(tau[0] == 0)
    y[1::2] = 0.0
    algebraic = np.r_[np.arange(1, y.size, 2), y.size - 2]
    atol = np.full(y.size, rtol)
    atol[1::2] = UNTESTED / w
    marks = np.unique(np.r_[switches[switches < tau[-1]], tau[-1]])
    for begin, end in pairwise(marks):
        asked = tau[(tau > begin) & (tau <= end)]
        first = begin + 1e-4 * w * w
        span = np.unique(np.r_[first, asked, end])
        ida = IDA(
            residual, rtol=rtol, atol=atol, linsolver="band", lband=5, uband=5,
            algebraic_idx=np.sort(algebraic), calc_initcond="yp0", max_num_steps=100_000,
        )  # fmt: skip
        result = ida.solve(span, y, np.zeros_like(y))
        if not result.success:
            raise RuntimeError(f"IDA failed: {result.message}")
        y = result.y[-1].copy()
        found += [row[0::2] for t, row in zip(span, result.y, strict=True) if t in asked]
    stretch = np.array(found)
    sigma = (1 / np.log(1 / ell) - 2 * ell**2 / (1 - ell**2)) / 2
    lumen, wall = 1 - stretch**2, 1 / stretch - stretch**2
    pumped = np.trapezoid(ell**2 * lumen + sigma * (1 - ell**2) * wall, Z, axis=1)
    return pumped, Z, stretch**-3.0
