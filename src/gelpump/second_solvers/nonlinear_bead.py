"""The fully nonlinear bead by spectral elements: a second solution, which shares no solver's code.

With R in [0, 1] the dry radius, r(R, t) where a shell is, l_r = dr/dR, l_t = r/R and the polymer
fraction f = 1/(l_r l_t^2), the force balance of `gelpump.bead.nonlinear` times r^2 l_r is

    r^2 l_r dr/dt = d(r^2 s_r)/dR - 2 r l_r s_t ,

and for every test function w(R), which needs no surface condition but s_r = 0 in what is left out,

    Integral w r^2 l_r dr/dt dR = - Integral ( w' r^2 s_r + 2 w r l_r s_t ) dR .

Polynomials of degree ORDER on elements that are graded as R = sin(pi s/2), with the integrals by
Gauss and Lobatto's rule at the nodes, so that the mass on the left is diagonal (not finite volumes
with a surface state of their own); the implicit Runge-Kutta formula of Radau (not backward
differences). The gel lends Pi(phi, T), phi dPi/dphi and mu_s.

The model ends where E = ds_r/d(ln l_r) = 0 at a node.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import Legendre
from numpy.typing import NDArray

from gelpump.second_solvers.course import Course

if TYPE_CHECKING:
    from gelpump.materials import Gel

ORDER = 3
ABSOLUTE = 0.01  # absolute tolerance over the relative one
MARGIN = 1e-9  # Radau also tries beads that are turned inside out: keeps f within the gel's bounds


def lobatto(order: int) -> tuple[NDArray, NDArray, NDArray]:
    """Nodes on [-1, 1], their weights, and the matrix that differentiates along them."""
    P = Legendre.basis(order)
    x = np.r_[-1.0, np.sort(P.deriv().roots().real), 1.0]
    weights = 2 / (order * (order + 1) * P(x) ** 2)
    apart = x[:, np.newaxis] - x
    np.fill_diagonal(apart, 1.0)
    product = apart.prod(axis=1)
    D = product[:, np.newaxis] / product / apart
    np.fill_diagonal(D, 0.0)
    np.fill_diagonal(D, -D.sum(axis=1))
    return x, weights, D


class Elements:
    """The semi-discrete equations of the radii r at all nodes but the centre."""

    def __init__(self, gel: Gel, T: float, elements: int):
        self.gel, self.T, self.mu = gel, T, gel.shear_modulus(1.0)
        ends = np.sin(np.pi / 2 * np.linspace(0, 1, elements + 1))
        x, weights, D = lobatto(ORDER)
        half = np.diff(ends)[:, np.newaxis] / 2
        self.R = ends[:-1, np.newaxis] + half * (1 + x)  # (element, node), shared nodes twice
        self.slopes, self.weights = D / half[..., np.newaxis], weights * half
        self.node = ORDER * np.arange(elements)[:, np.newaxis] + np.arange(ORDER + 1)
        self.nodes = ORDER * elements + 1
        self.dry = np.append(self.R[:, :-1], 1.0)
        low, high = gel.polymer_fraction_bounds
        self.bounds = low + MARGIN, min(high - MARGIN, 1 / MARGIN)

    def stretches(self, r: NDArray) -> tuple[NDArray, NDArray, NDArray, NDArray]:
        """r, l_r, l_t and f at the nodes of each element."""
        radius = np.append(0.0, r)[self.node]
        l_r = np.einsum("eij,ej->ei", self.slopes, radius)
        l_t = np.divide(radius, self.R, out=l_r.copy(), where=self.R > 0)
        low, high = self.bounds
        f = np.clip(1 / np.maximum(l_r * l_t**2, 1 / high), low, high)
        return radius, l_r, l_t, f

    def rate(self, t: float, r: NDArray) -> NDArray:
        """dr/dt at the nodes."""
        radius, l_r, l_t, f = self.stretches(r)
        s_r = -self.gel.osmotic_pressure(f, self.T) / self.mu + f * l_r**2 - np.cbrt(f)
        s_t = s_r - f * (l_r**2 - l_t**2)
        force = -2 * self.weights * radius * l_r * s_t
        force -= np.einsum("eij,ei->ej", self.slopes, self.weights * radius**2 * s_r)
        mass = self.weights * radius**2 * l_r
        total = (np.bincount(self.node.ravel(), each.ravel()) for each in (force, mass))
        return np.divide(*(each[1:] for each in total))

    def margin(self, t: float, r: NDArray) -> float:
        """Least E over the nodes."""
        _, l_r, _, f = self.stretches(r)
        osmotic = self.gel.osmotic_modulus(f, self.T) / self.mu
        return float((osmotic + np.cbrt(f) / 3 + f * l_r**2).min())

    def sparsity(self) -> NDArray:
        """Which radii each rate depends on: those of the node's own elements."""
        pattern = np.zeros((self.nodes, self.nodes))
        for node in self.node:
            pattern[np.ix_(node, node)] = 1
        return pattern[1:, 1:]


def solve(gel, T, phi_initial, times, elements, *, rtol=1e-8) -> Course:
    """The bead of uniform phi_initial at constant temperature T, at ``times`` (increasing from 0).

    ``elements`` of degree ORDER; ``rtol`` is Radau's relative tolerance.
    """
    from scipy.integrate import solve_ivp

    system = Elements(gel, T, elements)
    start = system.dry[1:] * phi_initial ** (-1 / 3)

    def parabolic(t, r):
        return system.margin(t, r)

    parabolic.terminal = True
    if system.margin(0.0, start) <= 0:
        return Course(np.asarray(times[:1]), np.array([start[-1]]), 0.0)
    found = solve_ivp(
        system.rate,
        (0.0, times[-1]),
        start,
        method="Radau",
        t_eval=times,
        events=parabolic,
        jac_sparsity=system.sparsity(),
        rtol=rtol,
        atol=ABSOLUTE * rtol,
    )
    if not found.success:
        raise RuntimeError(f"Radau at t = {found.t[-1]}: {found.message}")
    stop = float(found.t_events[0][0]) if found.t_events[0].size else None
    return Course(found.t, found.y[-1], stop)
