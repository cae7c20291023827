"""The method of lines: the semi-discrete equations a competent user writes, and the integrators.

Nothing of gelpump's integrators is used, nor of its equations but those of the fully nonlinear
bead, whose rate and Jacobian are the library's own.  Every system has an exact or nearly exact
tridiagonal Jacobian, which every integrator gets in the form it wants: CVODE (SUNDIALS, of
scikit-sundae) and LSODA as a band, SciPy's BDF and Radau as a sparse matrix.
"""

import math
from typing import Protocol

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.sparse import diags
from scipy.special import erfcinv

from benchmarks.problems import Bead, Drop, Tubes
from gelpump.bead import nonlinear

THINNEST_SHARE = 0.01  # as gelpump.bead.nonlinear has it
MOST_STEPS = 20  # of Newton's method at a bead's surface


class System(Protocol):
    """dy/dt = rate(t, y) from y(start) = initial; bands(t, y) are its Jacobian's diagonals."""

    start: float
    initial: np.ndarray

    def rate(self, t: float, y: np.ndarray) -> np.ndarray:
        """dy/dt."""

    def bands(self, t: float, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Lower, middle and upper diagonal of the Jacobian."""


def integrate(system: System, times, method: str, rtol: float, atol: float) -> np.ndarray:
    """y at the ``times``, shape (times, unknowns), by CVODE or a method of ``solve_ivp``."""
    if method == "CVODE":
        return _cvode(system, times, rtol, atol)
    if method == "LSODA":

        def jacobian(t, y):
            lower, middle, upper = system.bands(t, y)
            return np.array([np.append(0.0, upper), middle, np.append(lower, 0.0)])

        options = {"lband": 1, "uband": 1, "jac": jacobian}
    else:
        options = {"jac": lambda t, y: diags(system.bands(t, y), (-1, 0, 1), format="csc")}
    span = system.start, times[-1]
    solution = solve_ivp(
        system.rate,
        span,
        system.initial,
        method=method,
        t_eval=times,
        rtol=rtol,
        atol=atol,
        **options,
    )
    if not solution.success:
        raise RuntimeError(f"{method}: {solution.message}")
    return solution.y.T


def _cvode(system, times, rtol, atol):
    from sksundae.cvode import CVODE

    def rate(t, y, dydt):
        dydt[:] = system.rate(t, y)

    index = np.arange(system.initial.size)

    def jacobian(t, y, dydt, J):
        lower, middle, upper = system.bands(t, y)
        J[index, index] = middle
        J[index[1:], index[:-1]] = lower
        J[index[:-1], index[1:]] = upper

    solver = CVODE(
        rate,
        rtol=rtol,
        atol=atol,
        linsolver="band",
        lband=1,
        uband=1,
        jacfn=jacobian,
        max_num_steps=100_000,
    )
    solver.init_step(system.start, system.initial)
    found = []
    for time in times:
        step = solver.step(time)
        if not step.success:
            raise RuntimeError(f"CVODE at t = {step.t}: {step.message}")
        found.append(np.array(step.y))
    return np.array(found)


class DropLines:
    """Cell means of phi on a uniform mesh of the box, which the drop does not reach the end of."""

    def __init__(self, problem: Drop, cells: int):
        self.problem, self.start = problem, problem.start
        self.faces = np.linspace(0.0, problem.box, cells + 1)
        self.volume = np.diff(self.faces**3)
        self.conductance = 3 * self.faces[1:-1] ** 2 / np.diff(self.faces)[1:]
        self.initial = np.diff(problem.within(self.faces, self.start)) / self.volume

    def rate(self, t, phi):
        flux = self.conductance * np.diff(phi**2) / 2
        return np.diff(flux, prepend=0.0, append=0.0) / self.volume

    def bands(self, t, phi):
        leaving, entering = self.conductance * phi[:-1], self.conductance * phi[1:]
        middle = np.append(-leaving, 0.0) - np.append(0.0, entering)
        return leaving / self.volume[1:], middle / self.volume, entering / self.volume[:-1]

    def solve(self, method, rtol):
        phi = integrate(self, [self.problem.end], method, rtol, 1e-3 * rtol)[-1]
        return self.faces, phi * self.volume


class LensLines:
    """LENS bead in the dry volume: u = r^3 of the faces, R = sin(pi s/2) dry.

    u_t = -(6 r^4/R) dPsi/d(R^2), Psi the integral of Omega D; shells have phi = d(R^3)/du.
    """

    start = 0.0

    def __init__(self, problem: Bead, cells: int):
        self.problem = problem
        gel, T = problem.gel, problem.temperature
        self.Omega, self.a, self.b = gel.Omega, gel.A0 + gel.B0 * T, gel.A1 + gel.B1 * T
        R = np.sin(np.pi / 2 * np.linspace(0, 1, cells + 1))
        self.volume, self.thinnest = np.diff(R**3), np.diff(R).min()
        square = np.append(0.6 * np.diff(R**5) / self.volume, 1.0)
        self.mobility = -6 / (R[1:] * np.diff(square))
        self.initial = R[1:] ** 3 / problem.phi_initial
        # the branch of the surface: D > 0 between the spinodal's fractions
        roots = gel.spinodal_polymer_fractions(T)
        below, above = roots[roots < problem.phi_initial], roots[roots > problem.phi_initial]
        self.branch = float(below.max(initial=1e-9)), float(above.min(initial=1 - 1e-12))
        self.phi_s = float(problem.phi_initial)

    def load(self, phi):
        """Omega Pi + 4 phi^(1/3), which is 4/a at the surface."""
        mixing = -phi - math.log1p(-phi) - phi**2 * (self.a + (2 * phi - 1) * self.b)
        return phi + 3 * math.cbrt(phi) + self.Omega * mixing

    def surface(self, a):
        """phi_s by Newton's method from the last one, h' = D/phi; bracketed where that leaves."""
        phi = self.phi_s
        for _ in range(MOST_STEPS):
            curve = 1 / (1 - phi) - 2 * (self.a - self.b) - 6 * phi * self.b
            slope = 1 + 1 / math.cbrt(phi) ** 2 + self.Omega * phi * curve
            step = (self.load(phi) - 4 / a) / slope
            phi -= step
            if not self.branch[0] < phi < self.branch[1]:
                break
            if abs(step) <= 1e-14 * phi:
                self.phi_s = phi
                return phi
        self.phi_s = brentq(lambda phi: self.load(phi) - 4 / a, *self.branch, xtol=1e-14)
        return self.phi_s

    def potential(self, phi):
        mixing = -np.log1p(-phi) - phi - phi**2 / 2
        mixing -= phi**3 * (2 / 3 * (self.a - self.b) + 1.5 * phi * self.b)
        return phi**2 / 2 + 0.75 * np.cbrt(phi) ** 4 + self.Omega * mixing

    def diffusivity(self, phi):
        mixing = 1 / (1 - phi) - 2 * (self.a - self.b) - 6 * phi * self.b
        return phi + np.cbrt(phi) + self.Omega * phi**2 * mixing

    def state(self, u):
        """phi of the shells and of the surface; a trial step may tangle shells."""
        jump = np.maximum(np.diff(u, prepend=0.0), self.volume * 1.0001)
        a = math.cbrt(max(u[-1], 1.0))
        return np.append(self.volume / jump, self.surface(a))

    def rate(self, t, u):
        return self.mobility * np.cbrt(u) ** 4 * np.diff(self.potential(self.state(u)))

    def bands(self, t, u):
        phi = self.state(u)
        factor = self.mobility * np.cbrt(u) ** 4
        K = self.diffusivity(phi[:-1]) * phi[:-1] ** 2 / self.volume  # -dPsi/du of a shell
        middle = factor * K + 4 / 3 * self.rate(t, u) / u
        middle[:-1] += factor[:-1] * K[1:]
        middle[-1] -= factor[-1] * 4 * phi[-1] / (3 * np.cbrt(u[-1]) ** 4)
        return -factor[1:] * K[:-1], middle, -factor[:-1] * K[1:]

    def solve(self, method, rtol):
        # an error of the faces as large as a shell is thick would tangle them
        rtol = min(rtol, THINNEST_SHARE * self.thinnest)
        u = integrate(self, self.problem.times[1:], method, rtol, 1e-2 * rtol)
        return np.cbrt(u[:, -1])


class NonlinearLines:
    """The fully nonlinear bead, with the rate and the Jacobian of ``gelpump.bead.nonlinear``."""

    start = 0.0

    def __init__(self, problem: Bead, cells: int):
        self.problem = problem
        self.bead = nonlinear.Bead(problem.gel, problem.temperature, problem.phi_initial, cells)
        self.initial = self.bead.R[1:] * problem.phi_initial ** (-1 / 3)
        self.index = np.arange(cells)

    def rate(self, t, r):
        return self.bead.rate(r)

    def bands(self, t, r):
        i = self.index
        J = np.zeros((i.size, i.size))
        self.bead.jacobian(r, J)
        return J[i[1:], i[:-1]], J[i, i], J[i[:-1], i[1:]]

    def solve(self, method, rtol):
        rtol = min(rtol, THINNEST_SHARE * np.diff(self.bead.R).min())
        return integrate(self, self.problem.times[1:], method, rtol, 1e-2 * rtol)[:, -1]


class TubeLines:
    """One tube in the material form of eqn:tube_model, on a uniform mesh of X.

        lambda_t = (K lambda_X)_X - S ,    Phi_1 = lambda^-3 ,    Z = Integral_0^X lambda dX

    The front Z_C lies within a cell; source and conductance there are those of the heated share.
    """

    def __init__(self, problem: Tubes, ell: float, cells: int, reach: float = 10.0):
        p = problem.parameters
        self.problem, self.M = problem, p["M"]
        self.hot, self.cold = (p["Pi_ratio"] / p["Phi_inf"], p["Phi_inf"]), (1.0, 1.0)
        self.w = p["eps"] * (1 - ell) / 4
        self.front = 2 * erfcinv(0.5) * math.sqrt(p["Le"])  # Z_C / sqrt(tau)
        # walls shorten to Phi_inf^(-1/3) where it is hot
        end = self.front * math.sqrt(problem.tau[-1]) * p["Phi_inf"] ** (1 / 3) + reach * self.w
        self.dX = end / cells
        self.start, self.initial = 0.0, np.ones(cells)

    def heated(self, t, stretch):
        """Share of every cell that is behind the front."""
        Z = np.cumsum(stretch) * self.dX
        Z_C = self.front * math.sqrt(t)
        return np.clip(1 - (Z - Z_C) / (stretch * self.dX), 0.0, 1.0)

    def terms(self, t, y):
        """Blended s, source S with its slope, and K with its slope at the faces."""
        share = self.heated(t, y)
        S, slope = 0.0, 0.0
        for part, (s, Phi_0) in ((share, self.hot), (1 - share, self.cold)):
            resistance = s / y + 4 * self.M / 3 * y
            drive = Phi_0 - y**-3
            S = S + part * resistance * drive / 3
            fall = (4 * self.M / 3 - s / y**2) * drive + 3 * resistance / y**4
            slope = slope + part * fall / 3
        s = share * self.hot[0] + (1 - share) * self.cold[0]
        K = s * y**-5 + 4 * self.M / 3 * y**-3
        return S / self.w**2, slope / self.w**2, 2 / (1 / K[1:] + 1 / K[:-1]) / self.dX**2

    def rate(self, t, y):
        S, _, K = self.terms(t, y)
        return np.diff(K * np.diff(y), prepend=0.0, append=0.0) - S

    def bands(self, t, y):
        _, slope, K = self.terms(t, y)
        middle = -slope
        middle[1:] -= K
        middle[:-1] -= K
        return K, middle, K

    def solve(self, method, rtol):
        found = integrate(self, self.problem.tau, method, rtol, rtol)
        Z = (np.cumsum(found, axis=1) - found / 2) * self.dX
        return list(zip(Z, found**-3, strict=True))
