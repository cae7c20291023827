"""How good the slender tube is: each closure against the truth, over ell and eps.

A tube at tau with the slenderness eps is the truth at T = tau/eps^2 (`gelpump.truth.pulse`), so one
axis tells both "late" and "slender". Of each closure of `gelpump.tube.closure`:

tau_99, heated everywhere, by quadrature (`gelpump.tube.wall.closure_time`), and by the wall that
    is resolved in the radius with the closure's surface (`gelpump.tube.wall`);
length of the front, from 10 to 90 % of Phi_1, and its sharpness A;
V far ahead and the volume pumped past a fixed station (`gelpump.tube.pump`): printed, eqn:lumen.

Phi_1 is the middle of the wall but in the balanced closure, where it is the wall's mean: lengths
and times are compared with the one or the other, A with the middle.
"""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.netcdf import variable
from gelpump.truth.observables import LEVELS
from gelpump.tube import wall
from gelpump.tube.closure import CLOSURES
from gelpump.tube.front import sharpness
from gelpump.tube.heat import StepHeating
from gelpump.tube.pump import volumes
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes

EPS = 0.1  # any: at given T results do not depend on it
OF_MEAN = "balanced"  # the closure whose Phi_1 is the mean over the wall
TEXT = {
    "tau99": "time to collapse of a wall heated everywhere",
    "tau99_resolved": "the same, resolved in the radius with the closure's surface",
    "width": "length of the front, 10 to 90 %",
    "A": "sharpness of the front",
    "V_far": "axial velocity in the lumen far ahead",
    "pumped": "volume pumped since the beginning",
}


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
    tubes = Tubes(ells, EPS, gel.M, gel.Pi_ratio, gel.Phi_inf)
    run = solve(tubes, StepHeating(Le), EPS**2 * T, closure=name, books=True)
    A, _ = sharpness(run)
    shown = int(np.abs(T - drawn).argmin())
    tubes_now = [
        [_profile(run.isel(ell=i, tau=j)) for j in range(T.size)] for i in range(ells.size)
    ]
    lumen = np.pi * ells[:, np.newaxis] ** 2
    return {
        "width": np.array([[_width(*each) for each in row] for row in tubes_now]) / EPS,
        "A": A * EPS,
        "V_far": volumes(run, rate=True)["pumped_station"] / lumen * EPS,
        "pumped": volumes(run)["pumped_station"] / np.pi / EPS,
        "z": np.array([row[shown][0] for row in tubes_now]) / EPS,
        "Phi": np.array([row[shown][1] for row in tubes_now]),
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
            mean = names.index(OF_MEAN)
            truth[mean] = pulses.width_mean.values
            error[mean] = pulses.width_mean_uncertainty.values
        data |= _compared(quantity, ("closure", "ell", "T"), values, truth, error)
    for name, text in (("z", "axial position less that of the front"), ("Phi", "Phi_1")):
        values = np.array([each[name] for each in found])
        data[name] = variable(("closure", "ell", "point"), values, f"{text}, slender")
    here = walls.sel(M=gel.M, method="nearest")
    tubes = Tubes(walls.ell.values, EPS, gel.M, gel.Pi_ratio, gel.Phi_inf)
    unit = (EPS * (1 - tubes.ell)) ** 2
    places = ["tau99_mean" if name == OF_MEAN else "tau99" for name in names]
    truth = np.array([here[place].values for place in places])
    error = np.array([here[f"{place}_uncertainty"].values for place in places])
    times = np.array([wall.closure_time(tubes, name) / unit for name in names])
    data |= _compared("tau99", ("closure", "wall_ell"), times, truth, error)
    resolved, own = wall.deswelling_times(tubes)
    both = np.array([here.tau99.values, here.tau99_mean.values])
    doubt = np.array([here.tau99_uncertainty.values, here.tau99_mean_uncertainty.values])
    doubt = np.broadcast_to(doubt, own.shape) + own / unit
    dims = ("surface", "place", "wall_ell")
    data |= _compared("tau99_resolved", dims, resolved / unit, np.stack([both, both]), doubt)
    coords = {
        "closure": ("closure", names, {"long_name": "closure of the slender tube"}),
        "ell": pulses.ell,
        "T": pulses["T"],
        "surface": ("surface", list(wall.SURFACES), {"long_name": "closure that has this surface"}),
        "place": ("place", ["midline", "mean"], {"long_name": "where Phi is to make its change"}),
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
