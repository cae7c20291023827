"""Dataset of the times in which walls resolved in r deswell, against those of the slender tube."""

from collections.abc import Mapping

import xarray as xr

from gelpump.netcdf import variable
from gelpump.tube import wall
from gelpump.tube.deswelling import deswelling_time
from gelpump.tube.tubes import one_by_one
from gelpump.tube.wall_flow import source_coefficient

TIME = "in units of mu_l L^2/(k Pi_00)"
PLACES = ("midline", "mean")


def wall_times(gel, tube: Mapping, settings: Mapping) -> xr.Dataset:
    """tau_99 of each tube: resolved, (surface, place, tube), and by each slender closure."""
    tubes, varied = one_by_one(gel, tube, settings)
    times, error = wall.deswelling_times(tubes)
    dims, text = ("surface", "place", "tube"), "tau_99 of the wall resolved in r"
    data = {
        "tau99": variable(dims, times, text, TIME),
        "tau99_uncertainty": variable(dims, error, f"numerical uncertainty: {text}", TIME),
        "tau99_printed": variable("tube", deswelling_time(tubes), "tau_99 of eqn:tube_model", TIME),
        "first_eigenvalue": variable(
            "tube",
            [wall.first_eigenvalue(ell) for ell in tubes.ell],
            "k^2 of the slowest mode with Phi_s = Phi_0, exp(-k^2 D tau/h^2)",
        ),
        "source_coefficient": variable(
            "tube", source_coefficient(tubes.ell), "kappa, where F has 16"
        ),
    }
    for name in wall.SURFACES:
        data[f"tau99_{name}"] = variable(
            "tube", wall.closure_time(tubes, name), f"tau_99 of the {name} closure", TIME
        )
    for key in ("ell", "M", "Pi_ratio", "Phi_inf"):
        data[key] = variable("tube", getattr(tubes, key), f"{key} of the tube")
    data["eps"] = variable((), float(tube["eps"]), "slenderness a_1/L")
    coords = {
        "surface": ("surface", list(wall.SURFACES), {"long_name": "closure that has this surface"}),
        "place": ("place", list(PLACES), {"long_name": "where Phi is to make its change"}),
        "varied": ("tube", varied, {"long_name": "number that is varied"}),
    }
    return xr.Dataset(data, coords)
