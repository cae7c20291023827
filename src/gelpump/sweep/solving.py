"""Full pulse solves of many designs, each with a result or a stated reason why there is none.

The designs of a chunk are families of at most FAMILY, each on one mesh (`gelpump.tube.slender`);
larger ones would hardly be cheaper (docs/sweeps.md). Should a family fail, it is divided into
halves until the tube that fails is alone; alone it is tried once more, with more cells and other
steps, and flagged if that fails too. A result that breaks its own conservation of water, or leaves
[1, Phi_inf], by more than DOUBTFUL is kept and flagged.
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.tube import lumen, scaling
from gelpump.tube.deswelling import deswelling_time
from gelpump.tube.front import sharpness
from gelpump.tube.heat import StepHeating
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import Wall

NEWTON_SHARE = 0.03  # a tenth stalls some tubes with Phi_inf above 6
FAMILY = 500  # tubes
TRIALS = 3000  # a family takes some hundred steps
DOUBTFUL = 1e-2
SOLVED, REFINED, INACCURATE, FAILED = range(4)
STATUS = ("solved", "solved_alone_and_finer", "doubtful", "failed")

OUTPUTS = {
    "A": ("sharpness of the front", "in units of 1/L"),
    "front_width": ("width 1/A of the front", scaling.AXIAL),
    "Phi1_front": ("polymer fraction in the middle of the wall at Z_C", scaling.POLYMER),
    "V_peak": (
        "largest axial velocity in the lumen, as printed in eqn:lumen",
        scaling.AXIAL_VELOCITY,
    ),
    "pulse_flux": (
        "V of eqn:lumen integrated over the pulse, less V far ahead in front of Z_C",
        "in units of L^2 per poroelastic time mu_l L^2/(k Pi_00)",
    ),
}


def solve_designs(designs: xr.Dataset, tau, numerics: Mapping) -> xr.Dataset:
    """Outputs of the designs (dimension `index`) at the times tau, tau_99, status and reason."""
    count, times = designs.sizes["index"], len(tau)
    found = {name: np.full((count, times), np.nan) for name in OUTPUTS}
    status = np.zeros(count, np.int8)
    reason = np.full(count, "", object)
    pending = [np.arange(start, min(start + FAMILY, count)) for start in range(0, count, FAMILY)]
    while pending:
        these = pending.pop()
        try:
            values, defect = _family(designs.isel(index=these), tau, numerics)
        except (ArithmeticError, RuntimeError) as failure:
            if len(these) > 1:
                middle = len(these) // 2
                pending += [these[middle:], these[:middle]]
                continue
            values, defect = _alone(designs.isel(index=these), tau, numerics)
            status[these] = REFINED
            reason[these] = f"with the family: {failure}"
            if values is None:
                status[these] = FAILED
                reason[these] = f"{failure}; alone, on a finer mesh: {defect}"
                continue
        for name in OUTPUTS:
            found[name][these] = values[name]
        doubtful = defect > DOUBTFUL
        status[these[doubtful]] = INACCURATE
        reason[these[doubtful]] = [
            f"breaks conservation of water, or the bounds of Phi_1, by {each:.1e}"
            for each in defect[doubtful]
        ]
    data = {name: variable(("index", "tau"), found[name], *text) for name, text in OUTPUTS.items()}
    data["tau99"] = variable(
        "index",
        deswelling_time(_tubes(designs)),
        "time until a tube heated everywhere has made 99 per cent of its change",
        "in units of mu_l L^2/(k Pi_00)",
    )
    data["status"] = variable("index", status, "how the design ended")
    data["status"][2].update(
        flag_values=np.arange(len(STATUS), dtype=np.int8), flag_meanings=" ".join(STATUS)
    )
    data["reason"] = ("index", reason.astype(str).astype(object), {"long_name": "why, if not 0"})
    return designs.assign(data).assign_coords(tau=scaling.tau(np.asarray(tau, float)))


def _tubes(designs):
    return Tubes(*(designs[key].values for key in ("ell", "eps", "M", "Pi_ratio", "Phi_inf")))


def _alone(design, tau, numerics):
    behind, ahead = numerics["cells"]
    finer = {
        **numerics,
        "cells": [2 * behind, 2 * ahead],
        "tolerance": numerics["tolerance"] / 3,
    }
    try:
        return _family(design, tau, finer)
    except (ArithmeticError, RuntimeError) as failure:
        return None, failure


def _family(designs, tau, numerics):
    """The outputs, (tube, tau), and each tube's defect, (tube,)."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # looked at below
        pulse = solve(
            _tubes(designs),
            StepHeating(designs.Le.values[:, np.newaxis]),
            tau,
            cells=tuple(numerics["cells"]),
            tolerance=numerics["tolerance"],
            reach=numerics["reach"],
            newton_share=NEWTON_SHARE,
            trials=TRIALS,
        )
        A, _ = sharpness(pulse)
        wall = Wall.of(pulse)
        V = lumen.velocity_printed(wall)
        values = {
            "A": A,
            "front_width": 1 / A,
            "Phi1_front": pulse.Phi1_front.values,
            "V_peak": V.max(axis=-1),
            "pulse_flux": wall.integral(lumen.above_far(V, pulse.hot.values))[..., -1],
        }
    if not all(np.isfinite(each).all() for each in values.values()):
        raise ArithmeticError("an output is not finite")
    outside = np.maximum(1 - pulse.Phi1, pulse.Phi1 - pulse.Phi_inf).max(("tau", "cell"))
    defect = np.maximum(pulse.water_balance_error.max("tau"), outside / (pulse.Phi_inf - 1))
    return values, defect.values
