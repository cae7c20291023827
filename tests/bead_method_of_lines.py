"""LENS bead by the method of lines: a reference that shares no code with `gelpump`.

With m = R^3 the dry volume inside a material shell (R its dry radius) and J = 1/phi, section 2's
equations become, in units of R_dry, t_BMJ and k_B T/Omega_p,

    dJ/dt = d/dm [ 9 r^4 Omega D phi^2 dJ/dm ] ,   r^3 = Integral_0^m J dm ,
    Omega Pi(phi_s, T) = 4 (1/a - phi_s^{1/3})  at m = 1 ,

where D is in (k/mu_l) k_B T/Omega_f: t_BMJ holds Omega_p = Omega Omega_f, hence the factor Omega.
Midpoint finite volumes in s, R = sin(pi s/2), where J is smooth and even at the centre and at the
surface; CVODE with a dense Jacobian, because r depends on all shells inside.
The gel only lends its parameters A0, A1, B0, B1 and Omega.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq


class NoStressFreeSurface(Exception):
    """No stress-free surface on the initial side of the spinodal at this radius."""

    def __init__(self, t: float, radius: float, phi: float) -> None:
        super().__init__(f"D reaches 0 at t = {t:.6g}, r = a = {radius:.6g}, phi = {phi:.6g}")
        self.t, self.radius, self.phi = t, radius, phi


def diffusivity(gel, T, phi):
    """Omega D of the LENS bead, arrays or floats."""
    a, b = gel.A0 + gel.B0 * T, gel.A1 + gel.B1 * T
    mixing = phi**2 / (1 - phi) - 2 * phi**2 * (a - b) - 6 * phi**3 * b
    return phi + phi ** (1 / 3) + gel.Omega * mixing


def surface_load(gel, T, phi):
    """Omega Pi + 4 phi^{1/3}, equal to 4/a at a stress-free surface; its slope is Omega D/phi."""
    a, b = gel.A0 + gel.B0 * T, gel.A1 + gel.B1 * T
    mixing = -phi - math.log1p(-phi) - phi**2 * (a + (2 * phi - 1) * b)
    return phi + 3 * phi ** (1 / 3) + gel.Omega * mixing


def stable_interval(gel, T, phi):
    """The interval around phi within which D > 0."""
    grid = np.concatenate([np.geomspace(1e-6, 0.1, 2001), np.linspace(0.1, 1 - 1e-9, 20001)[1:]])
    unstable = grid[diffusivity(gel, T, grid) <= 0]
    below, above = unstable[unstable < phi], unstable[unstable > phi]
    return (below[-1] if below.size else grid[0]), (above[0] if above.size else grid[-1])


def lens_bead_radius(gel, T, phi_initial, times, cells, rtol=1e-9, atol=1e-11):
    """Radius a(t), shape of `times` (increasing from 0), and the profiles (r, phi) of each time.

    r and phi have shape (times, cells). Raises NoStressFreeSurface when the surface leaves the
    interval of D > 0 that holds phi_initial.
    """
    from sksundae.cvode import CVODE

    s = np.linspace(0, 1, cells + 1)
    R, middle = np.sin(np.pi / 2 * s), np.sin(np.pi / 2 * (s[1:] + s[:-1]) / 2)
    volume = np.diff(R**3)
    # dJ/dm = (dJ/ds)/(dm/ds) inside; at the surface both vanish, and dJ/dm = (dJ/dR)/3
    inside = np.diff((s[1:] + s[:-1]) / 2) * 3 * R[1:-1] ** 2 * np.pi / 2
    inside = inside * np.cos(np.pi / 2 * s[1:-1])
    spacing = np.append(inside, 3 * (1 - middle[-1]))
    low, high = stable_interval(gel, T, phi_initial)
    loads = surface_load(gel, T, low), surface_load(gel, T, high)

    def surface(t, a):
        if not loads[0] < 4 / a < loads[1]:
            raise NoStressFreeSurface(t, a, low if 4 / a <= loads[0] else high)
        return brentq(lambda phi: surface_load(gel, T, phi) - 4 / a, low, high, xtol=1e-15)

    def rate(t, J, dJdt):
        cube = np.cumsum(J * volume)
        states = np.append(J, 1 / surface(t, cube[-1] ** (1 / 3)))
        mobility = diffusivity(gel, T, 1 / states) / states**2
        flux = 9 * cube ** (4 / 3) * np.diff(states) / spacing * (mobility[1:] + mobility[:-1]) / 2
        dJdt[:] = np.diff(flux, prepend=0.0) / volume

    solver = CVODE(rate, rtol=rtol, atol=atol, linsolver="dense", max_num_steps=10**6)
    solver.init_step(0.0, np.full(cells, 1 / phi_initial))
    J = np.array([np.full(cells, 1 / phi_initial)] + [solver.step(t).y.copy() for t in times[1:]])
    cube = np.cumsum(J * volume, axis=1)
    return np.cbrt(cube[:, -1]), (np.cbrt(cube - J * volume / 2), 1 / J)
