r"""What a late pulse has pumped, from its travelling wave and without solving the pulse.

Of a wall that conserves water all that is pumped follows from the stretch lambda(X) at that moment
(`gelpump.tube.pump`): per pi a_1^2 L, with `loss` = Integral (1 - lambda^3) dX and `shorter` =
Integral (1 - lambda) dX of the books,

    collapse   ell^2 (loss - shorter)        inner   sigma (1-ell^2) loss
    pumped     collapse + inner;  out of the tube's own end  ell^2 loss + inner .

Behind the front lambda tends to h = Phi_inf^(-1/3), ahead to 1, and Z_C = Integral_0^{X_C} lambda
dX. So with the wave of `gelpump.tube.wave`, xi = (X - X_C)/w, and on either side

    I_n = Integral |lambda^n - rest^n| dxi:      X_C = (Z_C - w I_1h)/h ,
    loss    = (1 - h^3) X_C - w (I_3h - I_3c) ,
    shorter = (1 - h) X_C - w (I_1h - I_1c) .

What it differs by from the geometry of `pump.per_advance` is thus of order w/Z_C. V far ahead is
its rate over ell^2; V at the front is, with j the wave's flux and the gain
1 + sigma (1-ell^2)/ell^2 of `gelpump.tube.lumen`,

    w V = c (h - lambda) + [gain (3 j + c (lambda^3 - h^3)) - 3 j] / lambda^2 .

As printed, V far ahead (eqn:lumen) is no such function: the lumen has pumped its integral in time,
of waves that lag by DELAY tau_99 as in `wave.late_pulse`.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray

from gelpump.tube import wave
from gelpump.tube.deswelling import deswelling_time
from gelpump.tube.heat import StepHeating
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import lumen_share, source_coefficient
from gelpump.tube.wave_branch import meeting

NODES, FEWER_NODES = 12, 8  # of the printed volume, in the root of time
STEP = 0.01  # of time, for the rate at which is pumped
VOLUME = (2e-5, 0.4, 0.5)
STATED = {  # relative errors: numerical, delayed, confined, as `gelpump.tube.wave` has them
    "pumped_station": VOLUME,
    "pumped_end": VOLUME,
    "collapse_station": VOLUME,
    "inner": VOLUME,
    "Phi1_front": wave.STATED["Phi1_front"],
    "V_front": (2e-3, 0.6, 0.5),
    "V_far": (1e-4, 0.6, 0.5),
}


def late_pump(tubes: Tubes, Le: ArrayLike, tau: ArrayLike) -> wave.LatePulse:
    """Volumes (pi a_1^2 L) and velocities (L per poroelastic time) at the times tau, broadcast.

    Keys: those of `conserved`, and printed_station of the printed wall.
    """
    late = conserved(tubes, Le, tau)
    volume, doubt = _printed(tubes, Le, tau)
    return wave.LatePulse(
        late.values | {"printed_station": volume}, late.uncertainty | {"printed_station": doubt}
    )


def conserved(tubes: Tubes, Le: ArrayLike, tau: ArrayLike) -> wave.LatePulse:
    """Of the wall that conserves water, through blocks, so that a million need no memory.

    Keys: pumped_station, pumped_end, collapse_station, inner, Phi1_front, V_front and V_far.
    Uncertainties are relative, and infinite before the pulse is a wave, and where no front is
    found.
    """
    tau_99 = relaxation(tubes)
    w = tubes.wall_length * np.sqrt(tau_99 / deswelling_time(tubes))
    values = _state(tubes, Le, tau, w, tau_99)
    before, after = (
        _state(tubes, Le, (1 + way * STEP) * tau, w, tau_99)["pumped_station"] for way in (-1, 1)
    )
    values["V_far"] = (after - before) / (2 * STEP * tau) / tubes.ell**2
    delayed = (tau_99 / tau) ** 2
    confined = np.exp(-np.cbrt(tubes.Phi_inf) * StepHeating(Le).front(tau) / w)
    _, is_wave = _then(tau, tau_99)
    is_wave = is_wave & (values.pop("mismatch") < wave.MISMATCH)
    uncertainty = {
        name: np.where(is_wave, floor + a * delayed + b * confined, np.inf)
        for name, (floor, a, b) in STATED.items()
    }
    return wave.LatePulse(values, uncertainty)


def relaxation(tubes: Tubes) -> NDArray:
    """tau_99 of the wall that conserves water, which has kappa where the printed one has 16."""
    return deswelling_time(tubes) * 16 / source_coefficient(tubes.ell)


def _then(tau, tau_99) -> tuple[NDArray, NDArray]:
    """When the front had the speed that its wave has now, and whether there is a wave yet."""
    then = np.asarray(tau - wave.DELAY * tau_99)
    return np.where(then > 0, then, tau), then > 0


def _state(tubes, Le, tau, w, tau_99) -> dict[str, NDArray]:
    """What follows from lambda at one moment: all volumes, and the velocity at the front."""
    ell, h, sigma = tubes.ell, np.cbrt(1 / tubes.Phi_inf), lumen_share(tubes.ell)
    heat, section = StepHeating(Le), 1 - ell**2
    c = wave.speed(tubes.Phi_inf, w, heat.front_speed(_then(tau, tau_99)[0]))
    stretch, flux, mismatch, behind, ahead = shape(tubes.M, tubes.Pi_ratio, tubes.Phi_inf, c)
    X_C = (heat.front(tau) - w * behind[0]) / h
    loss = (1 - h**3) * X_C - w * (behind[1] - ahead[1])
    shorter = (1 - h) * X_C - w * (behind[0] - ahead[0])
    collapse, inner = ell**2 * (loss - shorter), sigma * section * loss
    gain = 1 + sigma * section / ell**2
    through = gain * (3 * flux + c * (stretch**3 - h**3)) - 3 * flux
    return {
        "pumped_station": collapse + inner,
        "pumped_end": ell**2 * loss + inner,
        "collapse_station": collapse,
        "inner": inner,
        "mismatch": mismatch,
        "Phi1_front": stretch**-3.0,
        "V_front": (c * (h - stretch) + through / stretch**2) / w,
    }


def _printed(tubes, Le, tau):
    """ell^2 Integral V dtau far ahead, as printed, and its relative uncertainty."""
    tau_99 = deswelling_time(tubes)
    then, is_wave = _then(tau, tau_99)
    found = []
    for nodes in (NODES, FEWER_NODES):
        point, weight = (each.reshape(-1, *[1] * then.ndim) for each in leggauss(nodes))
        root = np.sqrt(then) * (1 + point) / 2
        with np.errstate(all="ignore"):  # early, a wave so fast has no A that could be told
            late = wave.late_pulse(tubes, Le, root**2 + wave.DELAY * tau_99, "printed")
        part = np.sqrt(then) * weight * root * late.values["V_far"]
        volume = part.sum(axis=0)
        doubt = (part * np.minimum(late.uncertainty["V_far"], 1)).sum(axis=0) / volume
        found.append((tubes.ell**2 * volume, doubt))
    (fine, doubt), (coarse, _) = found
    return fine, np.where(is_wave, doubt + np.abs(coarse / fine - 1), np.inf)


def shape(
    M: ArrayLike, Pi_ratio: ArrayLike, Phi_inf: ArrayLike, c: ArrayLike
) -> tuple[NDArray, NDArray, NDArray, NDArray, NDArray]:
    """Stretch and flux at the front of conserving waves, and by how much the fluxes of its two
    sides disagree there; I_1 and I_3 behind it, and ahead."""
    front, flux, mismatch, *found = wave.by_blocks(_shape, 7, M, Pi_ratio, Phi_inf, c)
    return front, flux, mismatch, np.array(found[:2]), np.array(found[2:])


def _shape(*given):
    sides = wave.branches(*given, "conservative")
    front = meeting(*sides)
    fine, coarse = (
        np.array([_amounts(each, front, n) for each in sides])
        for n in (wave.INTERVALS, wave.INTERVALS // 2)
    )
    flux, other = (each.end(front, wave.INTERVALS)[0] for each in sides)
    found = fine + (fine - coarse) / 3
    return np.vstack([front, flux, np.abs(flux - other) / np.abs(flux), *found])


def _amounts(branch, front, intervals):
    """I_1 and I_3 of one side on one mesh; dxi = lambda^2 K dlambda/j."""
    stretch, flux = branch.solve(front, intervals)
    distance, step = np.abs(stretch - branch.rest), np.abs(np.diff(stretch, axis=0))
    slope = np.empty_like(flux)
    slope[1:] = flux[1:] / distance[1:]
    slope[0] = branch.slope_at_rest(np.sign(front - branch.rest))
    first = branch.rho(stretch) / (stretch**2 * slope)
    third = first * (stretch**2 + stretch * branch.rest + branch.rest**2)
    return [((each[1:] + each[:-1]) / 2 * step).sum(axis=0) for each in (first, third)]
