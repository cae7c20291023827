"""Datasets of uniform deswelling (section 3.4, figure 7), from `gelpump.tube.deswelling`."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from gelpump.coordinates import merged
from gelpump.netcdf import variable
from gelpump.tube import scaling
from gelpump.tube.deswelling import (
    FEWER_NODES,
    NODES,
    Tubes,
    deswelling_curve,
    deswelling_time,
)
from gelpump.uncertainty import quadrature_error

if TYPE_CHECKING:
    from gelpump.materials import PiecewiseLinearGel

TAU99 = "time until the polymer fraction has made 99 per cent of its change"
TIME = "in units of mu_l L^2/(k Pi_00)"


def deswelling_map(
    gel: "PiecewiseLinearGel", eps: float, settings: Mapping[str, Any]
) -> xr.Dataset:
    """tau_99 over M and Pi_ratio, and over Phi_inf and M; and of the gel itself for a few ell.

    settings: the configuration's ``deswelling_map``.  Times in mu_l L^2/(k Pi_00), dims (M,
    Pi_ratio), (M, Phi_inf) and (ell,), each with its uncertainty (section 3.4, figure 7).
    ValueError if a tube is none (`Tubes`).
    """
    M, Pi_ratio = (np.geomspace(*settings[key], settings["points"]) for key in ("M", "Pi_ratio"))
    ell, Phi_inf = (np.array(settings[key]) for key in ("compared_ell", "Phi_inf"))
    column = M[:, np.newaxis]
    grid = Tubes(settings["ell"], eps, column, Pi_ratio, gel.Phi_inf)
    contrast = Tubes(settings["ell"], eps, column, gel.Pi_ratio, Phi_inf)
    here = Tubes(ell, eps, gel.M, gel.Pi_ratio, gel.Phi_inf)
    return xr.Dataset(
        {
            **_time("tau99", ("M", "Pi_ratio"), grid, TAU99),
            **_time("tau99_contrast", ("M", "Phi_inf"), contrast, f"{TAU99}, for other Phi_inf"),
            **_time("tau99_compared", "ell", here, f"{TAU99}, for other tubes"),
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


def deswelling_curves(
    gel: "PiecewiseLinearGel", eps: float, settings: Mapping[str, Any]
) -> xr.Dataset:
    """Phi_1(tau) of tubes heated everywhere at once, and of tubes cooled again.

    settings: the configuration's ``deswelling_curves``.  Dims (ell, tau), times in
    mu_l L^2/(k Pi_00), each with its uncertainty (section 3.4, figure 7).  ValueError if a tube is
    none (`Tubes`), or a time negative.
    """
    ell = np.array(settings["ell"])
    tau = merged(settings["published_times"], np.linspace(0.0, settings["end"], settings["points"]))
    tubes = Tubes(ell, eps, gel.M, gel.Pi_ratio, gel.Phi_inf)
    data = {}
    for suffix, process, reswelling in (
        ("", "deswelling", False),
        ("_reswelling", "reswelling", True),
    ):

        def course(nodes, reswelling=reswelling):
            return deswelling_curve(tau[:, np.newaxis], tubes, reswelling, nodes).T

        text = f"polymer fraction in the middle of the wall, {process}"
        data |= _with_uncertainty(f"Phi1{suffix}", ("ell", "tau"), course, text, scaling.POLYMER)
        data |= _time(f"tau99{suffix}", "ell", tubes, f"{TAU99}, {process}", reswelling)
    return xr.Dataset(data, coords={"ell": scaling.ell(ell), "tau": scaling.tau(tau)})


def _time(name, dims, tubes, text, reswelling=False):
    """tau_99 of the tubes, with its uncertainty."""

    def time(nodes):
        return deswelling_time(tubes, reswelling=reswelling, nodes=nodes)

    return _with_uncertainty(name, dims, time, text, TIME)


def _with_uncertainty(name, dims, formula, text, comment):
    error = quadrature_error(formula, NODES, FEWER_NODES)
    return {
        name: variable(dims, formula(NODES), text, comment),
        f"{name}_uncertainty": variable(dims, error, f"numerical uncertainty: {text}", comment),
    }
