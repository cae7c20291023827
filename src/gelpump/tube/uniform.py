"""Datasets of uniform deswelling (section 3.4, figure 7), from `gelpump.tube.deswelling`."""

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.tube import scaling
from gelpump.tube.deswelling import Tubes, deswelling_curve, deswelling_time

TAU99 = "time until the polymer fraction has made 99 per cent of its change"
TIME = "in units of mu_l L^2/(k Pi_00)"


def deswelling_map(gel, eps, settings):
    """tau_99 over M and Pi_ratio, and over Phi_inf and M; and of the gel itself for a few ell."""
    M, Pi_ratio = (np.geomspace(*settings[key], settings["points"]) for key in ("M", "Pi_ratio"))
    ell, Phi_inf = (np.array(settings[key]) for key in ("compared_ell", "Phi_inf"))
    column = M[:, np.newaxis]
    grid = Tubes(settings["ell"], eps, column, Pi_ratio, gel.Phi_inf)
    contrast = Tubes(settings["ell"], eps, column, gel.Pi_ratio, Phi_inf)
    here = Tubes(ell, eps, gel.M, gel.Pi_ratio, gel.Phi_inf)
    return xr.Dataset(
        {
            "tau99": variable(("M", "Pi_ratio"), deswelling_time(grid), TAU99, TIME),
            "tau99_contrast": variable(
                ("M", "Phi_inf"), deswelling_time(contrast), f"{TAU99}, for other Phi_inf", TIME
            ),
            "tau99_compared": variable(
                "ell", deswelling_time(here), f"{TAU99}, for other tubes", TIME
            ),
            "map_ell": variable((), settings["ell"], "ell of the maps"),
            "eps": variable((), eps, "slenderness a_1/L"),
        },
        coords={
            "M": variable("M", M, "shear modulus over the osmotic pressure scale when cold"),
            "Pi_ratio": variable(
                "Pi_ratio", Pi_ratio, "osmotic pressure scale when hot over that when cold"
            ),
            "Phi_inf": variable(
                "Phi_inf", Phi_inf, "equilibrium polymer fraction when hot over that when cold"
            ),
            "ell": scaling.ell(ell),
        },
    )


def deswelling_curves(gel, eps, settings):
    """Phi_1(tau) of tubes heated everywhere at once, and of tubes cooled again."""
    ell = np.array(settings["ell"])
    tau = np.linspace(0.0, settings["end"], settings["points"])
    tau = np.unique(np.concatenate([tau, settings["published_times"]]))
    tubes = Tubes(ell, eps, gel.M, gel.Pi_ratio, gel.Phi_inf)
    data = {}
    for suffix, process, reswelling in (
        ("", "deswelling", False),
        ("_reswelling", "reswelling", True),
    ):
        Phi1 = deswelling_curve(tau[:, np.newaxis], tubes, reswelling).T
        data[f"Phi1{suffix}"] = variable(
            ("ell", "tau"), Phi1, f"polymer fraction in the middle of the wall, {process}",
            scaling.POLYMER,
        )  # fmt: skip
        data[f"tau99{suffix}"] = variable(
            "ell", deswelling_time(tubes, reswelling=reswelling), f"{TAU99}, {process}", TIME
        )
    return xr.Dataset(data, coords={"ell": scaling.ell(ell), "tau": scaling.tau(tau)})
