r"""The late pulse as a travelling wave: one ordinary differential equation for millions of tubes.

Long after the start, tau >> w^2, the front of eqn:tube_model moves through less than w while the
wall relaxes, and what stands around it is a wave of constant shape.  In the material coordinate of
`gelpump.tube.slender`, X in units of w = eps (1-ell)/4, and with the stretch
lambda = Phi_1^(-1/3), a wave at rest in xi = X - X_C obeys

    printed        -c lambda_xi = (K lambda_xi)_xi - S
    conservative   -c lambda_xi = lambda^-2 (lambda^2 K lambda_xi)_xi - S

    K = rho / lambda^4 ,   S = rho (Phi_0 - lambda^-3) / 3 ,   rho = s / lambda + (4M/3) lambda

    hot,  xi < 0:   s = Pi_ratio/Phi_inf,  Phi_0 = Phi_inf,  lambda -> Phi_inf^(-1/3) far behind
    cold, xi > 0:   s = 1,                 Phi_0 = 1,        lambda -> 1 far ahead

with lambda and the flux continuous at xi = 0.  Four numbers, M, Pi_ratio, Phi_inf and
c = w dX_C/dtau = Phi_inf^(1/3) w dZ_C/dtau, span all late pulses (the conservative closure takes
the w of its own source coefficient).  With lambda as the variable, the flux j = K lambda_xi obeys

    j dj/dlambda = K S - c j ,    and  j dj/dlambda = lambda^4 K S - lambda^2 c j

with the conservative j = lambda^2 K lambda_xi, from j = 0 at either state of rest; the front is
where the two branches meet.  The term in c is taken by the trapezoidal rule and K S by Gauss's, so
that each step is the root of a quadratic,

    (j_1^2 - j_0^2)/2 = Integral K S dlambda - c (j_0 + j_1)(lambda_1 - lambda_0)/2 ,

exact for a front at rest and stable for any c; nodes cluster at the states of rest, and results are
extrapolated from two meshes, to fourth order.  The profile and what it carries are quadratures:

    dZ/w = lambda dxi = lambda K dlambda / j ,    w V = (3/2) Integral S lambda^-4 dxi  (eqn:lumen).

A front at rest, c = 0, has a closed form (`resting_polymer_fraction`), the test of all this.

A pulse lags behind its wave: what stands around the front now is what the front left while the
wall relaxed, in about tau_99 of a tube heated everywhere.  `late_pulse` therefore takes the speed
that the front had DELAY tau_99 ago.  What then remains was measured on solved pulses: with
Q = tau/tau_99, the relative errors of nearly all tubes are below

    numerical + delayed / Q^2 + confined exp(-Phi_inf^(1/3) Z_C/w) ,

the last since the wave behind the front has no end and the tube has one, at Z = 0.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gelpump.tube.deswelling import deswelling_time
from gelpump.tube.front import WINDOW
from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.tubes import Tubes

CLOSURES = ("printed", "conservative")
INTERVALS = 24  # of each side; a multiple of four
SEARCH = (4, 4, 8, 24)  # intervals in the search for the front
FIT = 1e-6  # relative change of A at which its fit ends
BLOCK = 2**11  # waves whose intermediate results stay in the processor's cache
GRADING = 3  # nodes at (i/n)^3 of the way from rest to the front
DEPARTED = 0.1  # of Phi_inf - 1: nearer to Phi_0 than this counts as relaxed
DELAY = 0.4  # of tau_99
STATED = {  # the three parts of the uncertainty, of relative errors
    "A": (1.0e-3, 0.5, 3.0),
    "Phi1_front": (6.0e-4, 0.15, 0.5),
    "departed_length": (1.5e-3, 0.5, 3.0),  # pulses interpolate it, within 1e-3
    "V_peak": (1.3e-3, 0.5, 1.5),
    "V_far": (1.3e-3, 0.5, 1.5),
    "pulse_flux": (1.0e-3, 1.2, 4.0),
}
POINT, WEIGHT = np.polynomial.legendre.leggauss(3)


class Wave(NamedTuple):
    """Waves, each an array of one shape; lengths are in w, velocities in L over the time unit w."""

    Phi1_front: NDArray
    """Phi_1 in the middle of the wall at Z_C."""
    A: NDArray
    """A w, of the tanh fitted to Phi_1 over |Z - Z_C| <= 8 w as in `gelpump.tube.front`."""
    fit_rms: NDArray
    """Root-mean-square misfit of that fit."""
    departed_length: NDArray
    """Length over which Phi_1 is further than a tenth of Phi_inf - 1 from Phi_0, over w."""
    V_peak: NDArray
    """w V of eqn:lumen at the front, its largest."""
    V_far: NDArray
    """w V of eqn:lumen far ahead."""
    pulse_flux: NDArray
    """V of eqn:lumen integrated over Z, less V far ahead in front of Z_C."""
    error: NDArray
    """Largest relative change by extrapolation of any of these (of fit_rms, over Phi_inf - 1), or
    disagreement of the two fluxes at the front."""


def speed(Phi_inf: ArrayLike, wall_length: ArrayLike, front_speed: ArrayLike) -> NDArray:
    """c = Phi_inf^(1/3) w dZ_C/dtau: behind the front a length dX is dZ = Phi_inf^(-1/3) dX."""
    return np.cbrt(Phi_inf) * wall_length * front_speed


def travelling_wave(
    M: ArrayLike, Pi_ratio: ArrayLike, Phi_inf: ArrayLike, c: ArrayLike, closure: str = "printed"
) -> Wave:
    """The waves of broadcast parameters, through blocks, so that a million need no memory.

    Raises ValueError, naming the parameter, the value and what is allowed, unless M >= 0,
    Pi_ratio > 0, Phi_inf > 1, c >= 0 and all are finite, or if there is no such closure.
    """
    if closure not in CLOSURES:
        raise ValueError(f"closure = {closure!r} is not allowed: one of {CLOSURES}")
    allowed = {"M": (M, "M >= 0"), "Pi_ratio": (Pi_ratio, "Pi_ratio > 0")}
    allowed |= {"Phi_inf": (Phi_inf, "Phi_inf > 1"), "c": (c, "c >= 0")}
    given = np.broadcast_arrays(*(np.asarray(value, float) for value, _ in allowed.values()))
    for (key, (_, text)), value in zip(allowed.items(), given, strict=True):
        least = float(text.split()[-1])
        inside = (value >= least if ">=" in text else value > least) & np.isfinite(value)
        if not inside.all():
            raise ValueError(f"{key} = {value[~inside].flat[0]:g} is not allowed: {text}, finite")
    found = np.empty((len(Wave._fields), given[0].size))
    for start in range(0, given[0].size, BLOCK):
        block = slice(start, start + BLOCK)
        found[:, block] = _waves(*(value.flat[block] for value in given), closure)
    return Wave(*found.reshape(-1, *given[0].shape))


class LatePulse(NamedTuple):
    """A pulse by its wave, in the units of `gelpump.tube.slender`, and relative uncertainties."""

    values: dict[str, NDArray]
    uncertainty: dict[str, NDArray]


def late_pulse(tubes: Tubes, Le: ArrayLike, tau: ArrayLike, closure: str = "printed") -> LatePulse:
    """Tubes behind the front of `StepHeating(Le)` at the times tau; everything is broadcast.

    The uncertainty is infinite while tau < DELAY tau_99: such a pulse is not a wave yet.
    """
    w, tau_99 = tubes.wall_length, deswelling_time(tubes)
    p = np.cbrt(tubes.Phi_inf)
    then = np.asarray(tau - DELAY * tau_99)
    is_wave = then > 0
    then = np.where(is_wave, then, tau)
    c = p * w * FRONT_CONSTANT / 2 * np.sqrt(Le / then)
    wave = travelling_wave(tubes.M, tubes.Pi_ratio, tubes.Phi_inf, c, closure)
    values = {
        "A": wave.A / w,
        "Phi1_front": wave.Phi1_front,
        "departed_length": wave.departed_length * w,
        "V_peak": wave.V_peak / w,
        "V_far": wave.V_far / w,
        "pulse_flux": wave.pulse_flux,
    }
    delayed = (tau_99 / tau) ** 2
    confined = np.exp(-p * FRONT_CONSTANT * np.sqrt(Le * tau) / w)
    uncertainty = {
        name: np.where(is_wave, numerical + a * delayed + b * confined, np.inf)
        for name, (numerical, a, b) in STATED.items()
    }
    return LatePulse(values, uncertainty)


def resting_polymer_fraction(M: float, Pi_ratio: float, Phi_inf: float, closure: str) -> float:
    """Phi_1 at a front at rest, where j^2/2 = Q(lambda) - Q(rest) on either side, dQ = K S dlambda.

    printed        Q = (Phi_0 [-s^2/(5 l^5) - 2 s m/(3 l^3) - m^2/l]
                        + s^2/(8 l^8) + s m/(3 l^6) + m^2/(4 l^4)) / 3
    conservative   Q = (Phi_0 [-s^2/l + 2 s m l + m^2 l^3/3] + s^2/(4 l^4) + s m/l^2 - m^2 ln l)/3
    """
    from scipy.optimize import brentq

    m, behind = 4 * M / 3, Phi_inf ** (-1 / 3)

    def Q(stretch, s, Phi_0):
        x = stretch
        if closure == "printed":
            drive = -(s**2) / (5 * x**5) - 2 * s * m / (3 * x**3) - m**2 / x
            rest = s**2 / (8 * x**8) + s * m / (3 * x**6) + m**2 / (4 * x**4)
        else:
            drive = -(s**2) / x + 2 * s * m * x + m**2 * x**3 / 3
            rest = s**2 / (4 * x**4) + s * m / x**2 - m**2 * np.log(x)
        return (Phi_0 * drive + rest) / 3

    def mismatch(x):
        hot = Q(x, Pi_ratio / Phi_inf, Phi_inf) - Q(behind, Pi_ratio / Phi_inf, Phi_inf)
        return hot - Q(x, 1.0, 1.0) + Q(1.0, 1.0, 1.0)

    return brentq(mismatch, behind, 1.0, xtol=1e-15) ** -3


class _Branch:
    """One side of waves (n,): nodes from rest to the front and the flux there, (n, nodes)."""

    def __init__(self, rest, s, m, c, conservative):
        self.rest, self.s, self.m, self.c = (np.reshape(a, (-1, 1)) for a in (rest, s, m, c))
        self.conservative = conservative

    def rho(self, stretch):
        """(s/lambda + 4M/3 lambda)."""
        return self.s / stretch + self.m * stretch

    def source_over_distance(self, stretch):
        """S/(lambda - rest), which does not vanish at rest; Phi_0 = rest^-3."""
        squares = stretch * stretch + stretch * self.rest + self.rest**2
        return self.rho(stretch) * squares / (3 * (stretch * self.rest) ** 3)

    def drive(self, stretch):
        """d(j^2/2)/dlambda at c = 0: K S, or lambda^4 K S."""
        square = stretch * stretch
        rho_lambda = self.s + self.m * square
        cubes = (stretch - self.rest) * (square + stretch * self.rest + self.rest**2)
        power = square * square * stretch
        if not self.conservative:
            power *= square * square
        return rho_lambda * rho_lambda * cubes / (3 * self.rest**3 * power)

    def solve(self, front, intervals):
        """Nodes and flux from rest to lambda = front (n,)."""
        share = (np.arange(intervals + 1) / intervals) ** GRADING
        stretch = self.rest + (front[:, np.newaxis] - self.rest) * share
        step = np.diff(stretch)
        drive = sum(
            weight / 2 * self.drive(stretch[:, :-1] + (1 + point) / 2 * step)
            for point, weight in zip(POINT, WEIGHT, strict=True)
        )
        drive *= 2 * step
        drag = self.c * (np.diff(stretch**3) / 3 if self.conservative else step)
        flux = np.zeros_like(stretch)
        for i in range(intervals):
            half, here = drag[:, i] / 2, flux[:, i]
            flux[:, i + 1] = np.sqrt(half**2 + here**2 + drive[:, i] - 2 * half * here) - half
        return stretch, flux

    def end(self, front, intervals):
        """Extrapolated flux at the front, and its slope dj/dlambda there."""
        fine, coarse = (self.solve(front, n)[1][:, -1] for n in (intervals, intervals // 2))
        flux = fine + (fine - coarse) / 3
        column = front[:, np.newaxis]
        drag = self.c * column**2 if self.conservative else self.c
        return flux, self.drive(column)[:, 0] / flux - drag[:, 0]

    def carried(self, stretch, flux):
        """Along the branch, from rest: Z - Z_C over w, w V, and the integral of V dZ.

        V here is what this branch adds from rest on, so that all integrands stay finite at rest.
        """
        rest, sign = self.rest, np.sign(stretch[:, -1:] - self.rest)
        distance = np.abs(stretch - rest)
        # dxi = K dlambda/j, with lambda^2 K instead where j is lambda^2 K lambda_xi
        K = self.rho(stretch) / (stretch**2 if self.conservative else stretch**4)
        slope = np.empty_like(flux)  # j/distance, which tends to a root of its own at rest
        slope[:, 1:] = flux[:, 1:] / distance[:, 1:]
        slope[:, :1] = self.slope_at_rest(sign)
        source = self.source_over_distance(stretch)
        step = np.abs(np.diff(stretch))

        gain = 1.5 * source * K / (slope * stretch**4)
        V = _running(gain, step)
        V_over_distance = np.empty_like(V)
        V_over_distance[:, 1:] = V[:, 1:] / distance[:, 1:]
        V_over_distance[:, 0] = gain[:, 0]
        volume = _running(V_over_distance * stretch * K / slope, step)
        # nearly exponential from node to node; infinite to the state of rest
        with np.errstate(divide="ignore"):
            ratio = np.diff(np.log(flux)) / np.diff(flux)
        length = stretch * K
        Z = (length[:, 1:] + length[:, :-1]) / 2 * step * ratio
        return Z, V[:, -1], volume[:, -1]

    def slope_at_rest(self, sign):
        """j/|lambda - rest|: g^2 + sign c g = drive', of hot (sign 1) and cold (-1) branches."""
        scale = self.rest**2 if self.conservative else 1.0
        curvature = self.rho(self.rest) * self.source_over_distance(self.rest)
        curvature = curvature if self.conservative else curvature / self.rest**4
        b = sign * self.c * scale
        return np.sqrt(b**2 / 4 + curvature) - b / 2


def _waves(M, Pi_ratio, Phi_inf, c, closure):
    conservative = closure == "conservative"
    rest = np.cbrt(1 / Phi_inf)
    hot = _Branch(rest, Pi_ratio / Phi_inf, 4 * M / 3, c, conservative)
    cold = _Branch(np.ones_like(rest), np.ones_like(rest), 4 * M / 3, c, conservative)
    front = _front(hot, cold)
    fine = _results(hot, cold, front, Phi_inf, INTERVALS)
    coarse = _results(hot, cold, front, Phi_inf, INTERVALS // 2)
    change = (fine - coarse) / 3
    scale = fine.copy()
    scale[Wave._fields.index("fit_rms")] = Phi_inf - 1
    scale[-1] = 1.0
    errors = [*np.abs(change / scale)[:-1], np.abs(fine[-1] + change[-1])]
    return np.vstack([(fine + change)[:-1], np.max(errors, axis=0)])


def _front(hot, cold):
    """lambda at the front, where the branches' fluxes agree, by Newton's method.

    It starts where the chord of the hot branch meets the tangent of the cold one.
    """
    low, high = hot.rest[:, 0], cold.rest[:, 0]
    chord = hot.solve(high, 4)[1][:, -1] / (high - low)
    tangent = cold.slope_at_rest(-1.0)[:, 0]
    front = (tangent * high + chord * low) / (tangent + chord)
    for intervals in SEARCH:
        (flux_hot, slope_hot), (flux_cold, slope_cold) = (
            branch.end(front, intervals) for branch in (hot, cold)
        )
        new = front - (flux_hot - flux_cold) / (slope_hot - slope_cold)
        front = np.clip(new, front + 0.8 * (low - front), front + 0.8 * (high - front))
    return front


def _results(hot, cold, front, Phi_inf, intervals):
    """On one mesh, (8, n), all of `Wave` but its error, and by how much the fluxes disagree."""
    sides, at_front = [], []
    for branch in (hot, cold):
        stretch, flux = branch.solve(front, intervals)
        sides.append((stretch**-3.0, *branch.carried(stretch, flux)))
        at_front.append(flux[:, -1])
    (Phi_hot, Z_hot, V_peak, behind), (Phi_cold, Z_cold, lost, ahead) = sides
    # from far behind to far ahead, without the states of rest, which are infinitely far away
    near = DEPARTED * (Phi_inf - 1)
    steps = np.hstack([Z_hot[:, 1:], Z_cold[:, :0:-1]])
    Z = np.cumsum(np.hstack([-Z_hot[:, 1:].sum(axis=1, keepdims=True), steps]), axis=1)
    Phi = np.hstack([Phi_hot[:, 1:], Phi_cold[:, -2:0:-1]])
    departed = _distance(Z_hot, Phi_inf[:, np.newaxis] - Phi_hot, near) + _distance(
        Z_cold, Phi_cold - 1, near
    )
    A, rms = _tanh_fit(Z, Phi, Phi_inf[:, np.newaxis], 2.25 / departed)
    disagreement = (at_front[0] - at_front[1]) / (at_front[0] + at_front[1])
    flows = V_peak, V_peak - lost, behind + ahead
    return np.array([front**-3.0, A, rms, departed, *flows, disagreement])


def _tanh_fit(Z, Phi, Phi_inf, start):
    """A w and the misfit, by Gauss-Newton's iteration for ln A, as `gelpump.tube.front`."""
    ends = np.minimum(Z[:, :1], -WINDOW), np.maximum(Z[:, -1:], WINDOW)  # at rest
    Z = np.clip(np.hstack([ends[0], Z, ends[1]]), -WINDOW, WINDOW)
    Phi = np.hstack([Phi_inf, Phi, np.ones_like(Phi_inf)])
    weight = np.zeros_like(Z)
    weight[:, 1:] = np.diff(Z, axis=1) / 2
    weight[:, :-1] += weight[:, 1:]
    half = (Phi_inf - 1) / 2
    above = Phi - Phi_inf + half
    A = start[:, np.newaxis].copy()
    for _ in range(40):
        tanh = np.tanh(A * Z)
        slope = A * Z * (tanh * tanh - 1) * half
        misfit = above + half * tanh
        moment = weight * slope
        step = np.einsum("ij,ij->i", moment, misfit) / np.einsum("ij,ij->i", moment, slope)
        A *= np.exp(np.clip(step, -1.0, 1.0))[:, np.newaxis]
        if np.abs(step).max() < FIT:
            break
    return A[:, 0], np.sqrt((weight * misfit**2).sum(axis=1) / weight.sum(axis=1))


def _distance(Z, departure, near):
    """From the front to where the departure from rest, rising along the nodes, is `near`."""
    rows = np.arange(len(Z))
    last = np.maximum((departure < near[:, np.newaxis]).sum(axis=1) - 1, 0)
    beyond = np.minimum(last, Z.shape[1] - 1)  # the interval that holds it
    covered = np.cumsum(Z[:, ::-1], axis=1)[:, ::-1]  # from its lower node to the front
    low, high = departure[rows, beyond], departure[rows, beyond + 1]
    with np.errstate(divide="ignore"):
        share = np.log(near / low) / np.log(high / low)
    found = covered[rows, beyond] - np.clip(share, 0, 1) * Z[rows, beyond]
    return np.where(departure[:, -1] > near, found, 0.0)


def _running(values, step):
    """Trapezoidal integral from rest to each node."""
    total = np.zeros_like(values)
    np.cumsum((values[:, 1:] + values[:, :-1]) / 2 * step, axis=1, out=total[:, 1:])
    return total
