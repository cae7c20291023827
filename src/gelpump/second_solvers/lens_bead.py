"""The LENS bead by the method of lines: a second solution, which shares no code with the first.

With m = R^3 the dry volume inside a material shell (R its dry radius) and J = 1/phi, the equations
of section 2 (eqn:lens_transport, q = 0) become, in units of R_dry, t_BMJ and k_B T/Omega_p,

    dJ/dt = d/dm [ 9 r^4 Omega D phi^2 dJ/dm ] ,   r^3 = Integral_0^m J dm ,
    Omega Pi(phi_s, T) = 4 (1/a - phi_s^{1/3})  at m = 1 ,

where D is in (k/mu_l) k_B T/Omega_f: t_BMJ holds Omega_p = Omega Omega_f, hence the factor Omega.
Midpoint finite volumes in s, R = sin(pi s/2), where J is smooth and even at the centre and at the
surface; CVODE with a dense Jacobian, because r depends on all shells inside.  The gel only lends
its parameters A0, A1, B0, B1 and Omega.

The surface stays within the interval of D > 0 that it starts from.  The model ends, and CVODE finds
when, as soon as that interval holds no stress-free surface or a shell leaves it.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from gelpump.materials import Gel
from gelpump.second_solvers.course import Course

ABSOLUTE = 0.01  # absolute tolerance over the relative one


def diffusivity(gel: Gel, T: float, phi: ArrayLike) -> NDArray:
    """Omega D of the LENS bead, arrays or floats."""
    if not hasattr(gel, "A0"):
        c_1, c_2, c_3 = literature_chi(gel, T)
        mixing = phi**2 * (1 / (1 - phi) - 2 * c_1 - 3 * c_2 * phi - 4 * c_3 * phi**2)
        ions = (gel.charge * phi) ** 2 / np.hypot(gel.charge * phi, 2 * gel.salt + 1e-300)
        return gel.kappa * phi + phi ** (1 / 3) + gel.Omega * (mixing + ions)
    a, b = gel.A0 + gel.B0 * T, gel.A1 + gel.B1 * T
    mixing = phi**2 / (1 - phi) - 2 * phi**2 * (a - b) - 6 * phi**3 * b
    return phi + phi ** (1 / 3) + gel.Omega * mixing


def surface_load(gel: Gel, T: float, phi: float) -> float:
    """Omega Pi + 4 phi^{1/3}, equal to 4/a at a stress-free surface; its slope is Omega D/phi."""
    if not hasattr(gel, "A0"):
        c_1, c_2, c_3 = literature_chi(gel, T)
        mixing = -phi - math.log1p(-phi) - phi**2 * (c_1 + c_2 * phi + c_3 * phi**2)
        ions = math.hypot(gel.charge * phi, 2 * gel.salt) - 2 * gel.salt
        return gel.kappa * phi + 3 * phi ** (1 / 3) + gel.Omega * (mixing + ions)
    a, b = gel.A0 + gel.B0 * T, gel.A1 + gel.B1 * T
    mixing = -phi - math.log1p(-phi) - phi**2 * (a + (2 * phi - 1) * b)
    return phi + 3 * phi ** (1 / 3) + gel.Omega * mixing


def literature_chi(gel: Gel, T: float) -> list[float]:
    """c_1, c_2, c_3 of a gel of `gelpump.materials.flory_rehner`."""
    s = 1 / T if gel.inverse else T
    return [p + q * s for p, q in zip(gel.constant, gel.slope, strict=True)]


def stable_interval(gel: Gel, T: float, phi: float) -> tuple[float, float]:
    """The interval around phi within which D > 0, of no length if there is none."""
    if diffusivity(gel, T, phi) <= 0:
        return phi, phi
    grid = np.concatenate([np.geomspace(1e-6, 0.1, 201), np.linspace(0.1, 1 - 1e-9, 2001)[1:]])
    stable = diffusivity(gel, T, grid) > 0

    def end(inside, outside):
        return brentq(lambda p: diffusivity(gel, T, p), grid[inside], grid[outside], xtol=1e-15)

    below = np.flatnonzero(~stable & (grid < phi))
    above = np.flatnonzero(~stable & (grid > phi))
    low = end(below[-1] + 1, below[-1]) if below.size else grid[0]
    high = end(above[0] - 1, above[0]) if above.size else grid[-1]
    return low, high


class Shells:
    """The semi-discrete equations of one bead."""

    def __init__(self, gel: Gel, T: float, phi: float, cells: int):
        self.gel, self.T = gel, T
        s = np.linspace(0, 1, cells + 1)
        R, middle = np.sin(np.pi / 2 * s), np.sin(np.pi / 2 * (s[1:] + s[:-1]) / 2)
        self.volume = np.diff(R**3)
        # dJ/dm = (dJ/ds)/(dm/ds) inside; at the surface both vanish, and dJ/dm = (dJ/dR)/3
        inside = np.diff((s[1:] + s[:-1]) / 2) * 3 * R[1:-1] ** 2 * np.pi / 2
        inside = inside * np.cos(np.pi / 2 * s[1:-1])
        self.spacing = np.append(inside, 3 * (1 - middle[-1]))
        self.interval = stable_interval(gel, T, phi)
        self.loads = [surface_load(gel, T, end) for end in self.interval]
        self.within = np.tril(np.ones((cells, cells)))  # face i encloses the shells up to i

    def surface(self, a: float) -> float:
        """phi_s of a bead of radius a, kept at the end of the interval beyond it."""
        if not self.loads[0] < 4 / a < self.loads[1]:
            return self.interval[0] if 4 / a <= self.loads[0] else self.interval[1]
        return brentq(lambda phi: surface_load(self.gel, self.T, phi) - 4 / a, *self.interval)

    def mobility(self, J: NDArray) -> NDArray:
        """Omega D phi^2."""
        return diffusivity(self.gel, self.T, 1 / J) / J**2

    def fluxes(self, J: NDArray):
        """Flux through each outer face, r^3 there, and J of all shells and the surface."""
        cube = np.cumsum(J * self.volume)
        states = np.append(J, 1 / self.surface(cube[-1] ** (1 / 3)))
        mean = self.mobility(states)
        mean = (mean[1:] + mean[:-1]) / 2
        return 9 * cube ** (4 / 3) * np.diff(states) / self.spacing * mean, cube, states, mean

    def rate(self, J: NDArray) -> NDArray:
        """dJ/dt."""
        return np.diff(self.fluxes(J)[0], prepend=0.0) / self.volume

    def jacobian(self, J: NDArray) -> NDArray:
        """d(rate)/dJ, dense."""
        flux, cube, states, mean = self.fluxes(J)
        step = 1e-6 * states
        slope = (self.mobility(states + step) - self.mobility(states - step)) / (4 * step)
        conductance, rise = 9 * cube ** (4 / 3) / self.spacing, np.diff(states)
        inner = conductance * (rise * slope[:-1] - mean)
        outer = conductance * (rise * slope[1:] + mean)
        slopes = (4 / 3 * flux / cube)[:, None] * self.within * self.volume
        i = np.arange(J.size)
        slopes[i, i] += inner
        slopes[i[:-1], i[1:]] += outer[:-1]
        # J_s follows the radius: 4/a = load(phi_s) with the slope Omega D/phi_s
        stiffness = diffusivity(self.gel, self.T, 1 / states[-1]) * states[-1]
        if stiffness > 1e-6:
            slopes[-1] += (
                outer[-1]
                * 4
                / 3
                * cube[-1] ** (-4 / 3)
                * (states[-1] ** 2 / stiffness)
                * self.volume
            )
        return np.diff(slopes, axis=0, prepend=0.0) / self.volume[:, None]

    def course(self, times, states, stop: float | None) -> Course:
        """The radii of the states J, at the first of the times."""
        radius = np.cbrt(np.array(states) @ self.volume)
        return Course(np.asarray(times)[: radius.size], radius, stop)

    def margin(self, J: NDArray) -> float:
        """Positive while the surface is free of stress and all shells are stable."""
        load = 4 / np.cbrt(J @ self.volume)
        low, high = self.interval
        return min(
            load - self.loads[0], self.loads[1] - load, 1 / J.max() - low, high - 1 / J.min()
        )


def solve(gel, T, phi_initial, times, cells, *, rtol=1e-8) -> Course:
    """The bead of uniform phi_initial at constant temperature T, at ``times`` (increasing from 0).

    ``cells`` shells; ``rtol`` is CVODE's relative tolerance.
    """
    from sksundae.cvode import CVODE

    shells = Shells(gel, T, phi_initial, cells)

    def rate(t, J, dJdt):
        dJdt[:] = shells.rate(J)

    def jacobian(t, J, dJdt, slopes):
        slopes[:] = shells.jacobian(J)

    def margin(t, J, events):
        events[0] = shells.margin(J)

    states, stop = [np.full(cells, 1 / phi_initial)], None
    if shells.margin(states[0]) <= 0:
        return shells.course(times, states, 0.0)
    solver = CVODE(
        rate,
        jacfn=jacobian,
        rtol=rtol,
        atol=ABSOLUTE * rtol,
        linsolver="dense",
        max_num_steps=10**5,
        eventsfn=margin,
        num_events=1,
    )
    solver.init_step(0.0, states[0])
    for time in times[1:]:
        step = solver.step(time)
        if not step.success:
            raise RuntimeError(f"CVODE at t = {step.t}: {step.message}")
        if step.i_events is not None:
            stop = float(step.t)
            break
        states.append(np.array(step.y))
    return shells.course(times, states, stop)
