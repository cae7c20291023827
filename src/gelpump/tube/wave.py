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
the w of its own source coefficient).  One side of a wave is solved by `gelpump.tube.wave_branch`;
results are extrapolated from two meshes, to fourth order.  The profile and what it carries are

    dZ/w = lambda dxi = lambda K dlambda / j ,    w V = (3/2) Integral S lambda^-4 dxi  (eqn:lumen).

A front at rest, c = 0, has a closed form (`resting_polymer_fraction`), the test of all this.

A pulse lags behind its wave: what stands around the front now is what the front left while the
wall relaxed, in about tau_99 of a tube heated everywhere.  `late_pulse` therefore takes the speed
that the front had DELAY tau_99 ago.  What then remains was measured on solved pulses: with
Q = tau/tau_99, the relative errors of nearly all tubes are below

    numerical + delayed / Q^2 + confined exp(-Phi_inf^(1/3) Z_C/w) ,

the last since the wave behind the front has no end and the tube has one, at Z = 0.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gelpump.tube.closure import named
from gelpump.tube.deswelling import deswelling_time
from gelpump.tube.front import WINDOW
from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.tubes import Tubes
from gelpump.tube.wave_branch import Branch, meeting

CLOSURES = ("printed", "conservative")
INTERVALS = 24  # of each side; a multiple of four
FIT = 1e-4  # relative change of A at which its fit ends, by an iteration of second order
BLOCK = 2**10  # waves whose intermediate results stay in the processor's cache
DEPARTED = 0.1  # of Phi_inf - 1: nearer to Phi_0 than this counts as relaxed
DELAY = 0.4  # of tau_99
MISMATCH = 1e-3  # of the fluxes at the front, relative: more, and no front was found
STATED = {  # the three parts of the uncertainty, of relative errors
    "A": (1.0e-3, 0.5, 3.0),
    "Phi1_front": (6.0e-4, 0.15, 0.5),
    "departed_length": (1.5e-3, 0.5, 3.0),  # pulses interpolate it, within 1e-3
    "V_peak": (1.3e-3, 0.5, 1.5),
    "V_far": (1.3e-3, 0.5, 1.5),
    "pulse_flux": (1.0e-3, 1.2, 4.0),
}


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
    mismatch."""
    mismatch: NDArray
    """Relative disagreement of the two fluxes at the front; above MISMATCH no front was found."""


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
    return Wave(*by_blocks(partial(_waves, closure=closure), len(Wave._fields), *given))


def by_blocks(function: Callable[..., NDArray], rows: int, *given: ArrayLike) -> NDArray:
    """`function` of broadcast parameters (n,), which gives (rows, n), through blocks of them."""
    given = np.broadcast_arrays(*(np.asarray(each, float) for each in given))
    found = np.empty((rows, given[0].size))
    for start in range(0, given[0].size, BLOCK):
        block = slice(start, start + BLOCK)
        found[:, block] = function(*(value.flat[block] for value in given))
    return found.reshape(-1, *given[0].shape)


class LatePulse(NamedTuple):
    """A pulse by its wave, in the units of `gelpump.tube.slender`, and relative uncertainties."""

    values: dict[str, NDArray]
    uncertainty: dict[str, NDArray]


def late_pulse(tubes: Tubes, Le: ArrayLike, tau: ArrayLike, closure: str = "printed") -> LatePulse:
    """Tubes behind the front of `StepHeating(Le)` at the times tau; everything is broadcast.

    The uncertainty is infinite while tau < DELAY tau_99, when the pulse is not a wave yet, and
    where no front is found.
    """
    w = named(closure).wall_length(tubes)
    tau_99 = deswelling_time(tubes) * (w / tubes.wall_length) ** 2
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
    found = is_wave & (wave.mismatch < MISMATCH)
    delayed = (tau_99 / tau) ** 2
    confined = np.exp(-p * FRONT_CONSTANT * np.sqrt(Le * tau) / w)
    uncertainty = {
        name: np.where(found, numerical + a * delayed + b * confined, np.inf)
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


def _waves(M, Pi_ratio, Phi_inf, c, closure):
    hot, cold = branches(M, Pi_ratio, Phi_inf, c, closure)
    front = meeting(hot, cold)
    coarse = _results(hot, cold, front, Phi_inf, INTERVALS // 2)
    fine = _results(hot, cold, front, Phi_inf, INTERVALS, A=coarse[Wave._fields.index("A")])
    change = (fine - coarse) / 3
    scale = fine.copy()
    scale[Wave._fields.index("fit_rms")] = Phi_inf - 1
    mismatch = np.abs(fine[-1] + change[-1])
    errors = [*np.abs(change / scale)[:-1], mismatch]
    return np.vstack([(fine + change)[:-1], np.max(errors, axis=0), mismatch])


def branches(
    M: NDArray, Pi_ratio: NDArray, Phi_inf: NDArray, c: NDArray, closure: str
) -> tuple[Branch, Branch]:
    """The hot and the cold side of waves (n,)."""
    conservative, one = closure == "conservative", np.ones_like(Phi_inf)
    m = 4 * M / 3
    hot = Branch(np.cbrt(1 / Phi_inf), Pi_ratio / Phi_inf, m, c, conservative)
    return hot, Branch(one, one, m, c, conservative)


def _results(hot, cold, front, Phi_inf, intervals, A=None):
    """On one mesh, (8, n), all of `Wave` but its errors, and by how much the fluxes disagree."""
    sides, at_front = [], []
    for branch in (hot, cold):
        stretch, flux = branch.solve(front, intervals)
        sides.append((1 / (stretch * stretch * stretch), *branch.carried(stretch, flux)))
        at_front.append(flux[-1])
    (Phi_hot, Z_hot, V_peak, behind), (Phi_cold, Z_cold, lost, ahead) = sides
    # from far behind to far ahead, without the states of rest, which are infinitely far away
    near = DEPARTED * (Phi_inf - 1)
    Z = np.vstack([-Z_hot[1:].sum(axis=0), Z_hot[1:], Z_cold[:0:-1]])
    np.cumsum(Z, axis=0, out=Z)
    Phi = np.vstack([Phi_hot[1:], Phi_cold[-2:0:-1]])
    departed = _distance(Z_hot, Phi_inf - Phi_hot, near) + _distance(Z_cold, Phi_cold - 1, near)
    A, rms = _tanh_fit(Z, Phi, Phi_inf, 2.25 / departed if A is None else A)
    disagreement = (at_front[0] - at_front[1]) / (at_front[0] + at_front[1])
    flows = V_peak, V_peak - lost, behind + ahead
    return np.array([1 / front**3, A, rms, departed, *flows, disagreement])


def _tanh_fit(Z, Phi, Phi_inf, A):
    """A w and the misfit, by Newton's iteration for ln A, as `gelpump.tube.front`."""
    ends = np.minimum(Z[:1], -WINDOW), np.maximum(Z[-1:], WINDOW)  # at rest
    Z = np.clip(np.vstack([ends[0], Z, ends[1]]), -WINDOW, WINDOW)
    half = (Phi_inf - 1) / 2
    above = np.vstack([Phi_inf, Phi, np.ones_like(Phi_inf)]) / half - (1 + Phi_inf) / 2 / half
    weight = np.zeros_like(Z)
    weight[1:] = np.diff(Z, axis=0) / 2
    weight[:-1] += weight[1:]
    for _ in range(40):
        AZ = A * Z
        tanh = np.tanh(AZ)
        slope = AZ * (tanh * tanh - 1)  # of the misfit, by ln A
        misfit = above + tanh
        moment = weight * slope
        gradient = np.einsum("ij,ij->j", moment, misfit)
        square = np.einsum("ij,ij->j", moment, slope)
        bent = 2 * np.einsum("ij,ij->j", moment, misfit * AZ * tanh) - gradient
        step = gradient / np.maximum(square + bent, square / 2)
        A = A * np.exp(np.clip(step, -1.0, 1.0))
        if np.abs(step).max() < FIT:
            break
    return A, half * np.sqrt((weight * misfit**2).sum(axis=0) / weight.sum(axis=0))


def _distance(Z, departure, near):
    """From the front to where the departure from rest, rising along the nodes, is `near`."""
    waves = np.arange(Z.shape[1])
    last = np.maximum((departure < near).sum(axis=0) - 1, 0)
    beyond = np.minimum(last, len(Z) - 1)  # the interval that holds it
    covered = np.cumsum(Z[::-1], axis=0)[::-1]  # from its lower node to the front
    low, high = departure[beyond, waves], departure[beyond + 1, waves]
    with np.errstate(divide="ignore"):
        share = np.log(near / low) / np.log(high / low)
    found = covered[beyond, waves] - np.clip(share, 0, 1) * Z[beyond, waves]
    return np.where(departure[-1] > near, found, 0.0)
