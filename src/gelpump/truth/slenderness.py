"""How good the slender tube is: each closure against the truth, over ell and eps.

A tube at tau with the slenderness eps is the truth at T = tau/eps^2 (`gelpump.truth.pulse`), so one
axis tells both "late" and "slender". Of each closure of `gelpump.tube.closure`:

tau_99, heated everywhere, Phi_1 from 1 to Phi_inf less a hundredth of the way:  the integral of
    w^2 content'(lambda)/source(lambda) d lambda.
Length of the front, from 10 to 90 % of Phi_1, against the middle of the wall where Phi_1 is that
    (printed, conservative) and against the wall's mean where it is that (balanced); A likewise,
    against the middle.
V far ahead and the volume pumped since the beginning. Printed: eqn:lumen, and its integral. The
    others: what the lumen and the wall cannot keep,

    pumped/(pi a_1^2 L) = ell^2 [ Int (1 - lambda^3) dX - Int (1 - lambda) dX ]
                          + sigma (1-ell^2) Int (1 - lambda^3) dX ,

    the lumen's collapse past a fixed station (the tube is shorter by the second integral) and the
    share of what the wall has lost that goes into the lumen. V is its rate over pi ell^2.
"""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from scipy.integrate import quad

from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.netcdf import variable
from gelpump.truth.observables import LEVELS
from gelpump.tube import lumen
from gelpump.tube.closure import CLOSURES
from gelpump.tube.front import sharpness
from gelpump.tube.heat import StepHeating
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import Wall, lumen_share

EPS = 0.1  # any: at given T results do not depend on it
EARLIER = 1e-3  # of the first T: where the integral of the printed V begins
POINTS = 24  # of that integral between two times
TEXT = {
    "tau99": "time to collapse of a wall heated everywhere",
    "width": "length of the front, 10 to 90 %",
    "A": "sharpness of the front",
    "V_far": "axial velocity in the lumen far ahead",
    "pumped": "volume pumped since the beginning",
}


def collapse_time(closure, ell: float, gel: PiecewiseLinearGel) -> float:
    """tau_99 over the thickness squared."""
    tubes = Tubes(ell, EPS, gel.M, gel.Pi_ratio, gel.Phi_inf)
    s = gel.Pi_ratio / gel.Phi_inf

    def slowness(Phi):
        stretch = Phi ** (-1 / 3)
        loss, _ = closure.source(stretch, s, gel.Phi_inf, gel.M)
        return float(closure.content_slope(stretch) / loss * stretch / (3 * Phi))

    end = gel.Phi_inf - (gel.Phi_inf - 1) / 100
    w = float(closure.wall_length(tubes)) / (EPS * (1 - ell))
    return w**2 * quad(slowness, 1.0, end, epsabs=0, epsrel=1e-10)[0]


def slender(
    name: str,
    gel: PiecewiseLinearGel,
    Le: float,
    ells: Sequence[float],
    T: Sequence[float],
    drawn: float,
) -> dict[str, np.ndarray]:
    """TEXT but for tau_99 of a closure, in the truth's units, (ell, T); profiles at T = `drawn`."""
    ells, T = np.asarray(ells, float), np.asarray(T, float)
    dense = np.sort(
        np.unique(np.r_[T, np.geomspace(EARLIER * T[0], T[-1], POINTS * T.size)])
        if name == "printed"
        else T
    )
    tubes = Tubes(ells, EPS, gel.M, gel.Pi_ratio, gel.Phi_inf)
    tau = EPS**2 * dense
    run = solve(tubes, StepHeating(Le), tau, closure=name)
    at = np.searchsorted(dense, T)
    if name == "printed":
        V = lumen.velocity_printed(Wall.of(run))[..., -1] * EPS  # eps V, per T
        root = np.sqrt(dense)
        flow = 2 * root * V * ells[:, np.newaxis] ** 2
        pieces = (flow[:, 1:] + flow[:, :-1]) / 2 * np.diff(root)
        begun = flow[:, :1] * root[0]
        pumped = np.hstack([begun, begun + np.cumsum(pieces, axis=1)])
        V, pumped = V[:, at], pumped[:, at]
    else:
        area, share = ells[:, np.newaxis] ** 2, lumen_share(ells)[:, np.newaxis]
        gain = area + share * (1 - area)
        loss, loss_rate = run.loss.sum("side").values, run.loss_rate.sum("side").values
        pumped = (gain * loss - area * run.shorter.values) / EPS
        V = (gain * loss_rate - area * run.shorter_rate.values) / area * EPS
    run = run.isel(tau=at)
    A, _ = sharpness(run)
    shown = int(np.abs(T - drawn).argmin())
    profiles = [_profile(run.isel(ell=i, tau=shown)) for i in range(ells.size)]
    widths = [
        [_width(*_profile(run.isel(ell=i, tau=j))) for j in range(T.size)] for i in range(ells.size)
    ]
    return {
        "width": np.array(widths) / EPS,
        "A": A * EPS,
        "V_far": V,
        "pumped": pumped,
        "z": np.array([Z for Z, _ in profiles]) / EPS,
        "Phi": np.array([Phi for _, Phi in profiles]),
    }


def _profile(tube):
    """Z less that of the front, and Phi_1; the front has a point of its own."""
    hot = int(tube.hot.sum())
    Z = np.insert(tube.Z.values, hot, float(tube.Z_C)) - float(tube.Z_C)
    return Z, np.insert(tube.Phi1.values, hot, float(tube.Phi1_front))


def _width(Z, Phi):
    high, low = (np.interp(-(1 + x * (Phi[0] - 1)), -Phi, Z) for x in (LEVELS[-1], LEVELS[0]))
    return low - high


def slenderness(pulses: xr.Dataset, walls: xr.Dataset, gel: PiecewiseLinearGel) -> xr.Dataset:
    """Each closure's values and relative errors; dims (closure, ell, T), tau_99 (closure, wall)."""
    ells, T = pulses.ell.values, pulses["T"].values
    names = list(CLOSURES)
    found = [slender(name, gel, float(pulses.Le), ells, T, float(pulses.drawn_T)) for name in names]
    data = {}
    for quantity in ("width", "A", "V_far", "pumped"):
        values = np.array([each[quantity] for each in found])
        against = {"width": "width_Phi"}.get(quantity, quantity)
        truth = np.array([pulses[against].values] * len(names))
        error = np.array([pulses[f"{against}_uncertainty"].values] * len(names))
        if quantity == "width":
            mean = names.index("balanced")
            truth[mean] = pulses.width_mean.values
            error[mean] = pulses.width_mean_uncertainty.values
        data |= _compared(quantity, ("closure", "ell", "T"), values, truth, error)
    for name, text in (("z", "axial position less that of the front"), ("Phi", "Phi_1")):
        values = np.array([each[name] for each in found])
        data[name] = variable(("closure", "ell", "point"), values, f"{text}, slender")
    here = walls.sel(M=gel.M, method="nearest")
    times = np.array(
        [[collapse_time(CLOSURES[n], x, gel) for x in walls.ell.values] for n in names]
    )
    truth = np.array([here.tau99.values] * len(names))
    error = np.array([here.tau99_uncertainty.values] * len(names))
    mean = names.index("balanced")
    truth[mean], error[mean] = here.tau99_mean.values, here.tau99_mean_uncertainty.values
    data |= _compared("tau99", ("closure", "wall_ell"), times, truth, error)
    coords = {
        "closure": ("closure", names, {"long_name": "closure of the slender tube"}),
        "ell": pulses.ell,
        "T": pulses["T"],
        "wall_ell": variable("wall_ell", walls.ell.values, "ell of the walls heated everywhere"),
    }
    return xr.Dataset(data, coords)


def _compared(quantity, dims, values, truth, error):
    text = TEXT[quantity]
    return {
        quantity: variable(dims, values, f"{text}, slender"),
        f"{quantity}_error": variable(dims, values / truth - 1, f"{text}: slender over truth - 1"),
        f"{quantity}_error_uncertainty": variable(
            dims,
            error * np.abs(values) / truth**2,
            f"numerical uncertainty: {text}, slender over truth",
        ),
    }
