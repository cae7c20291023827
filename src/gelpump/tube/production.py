"""Production and refinement runs of the family of tubes behind a pulse of heat."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.tube import lumen, scaling
from gelpump.tube.deswelling import Tubes
from gelpump.tube.flow import Wall
from gelpump.tube.front import WINDOW, around_front, sharpness
from gelpump.tube.heat import StepHeating
from gelpump.tube.slender import solve
from gelpump.uncertainty import convergence_index

TOLERANCE_FACTOR = 4.0
REACH_FACTOR = 2
COMMON_GRID = np.linspace(-WINDOW, WINDOW, 321)  # Z - Z_C in units of w


def family_ell(settings: Mapping) -> np.ndarray:
    """The tubes that figures name, and those of the power law, spaced evenly in ln(1-ell)."""
    return np.unique(np.concatenate([settings["ell"], law_ell(settings["law"])]))


def law_ell(law: Mapping) -> np.ndarray:
    """ell of the power law, rounded so that no two of the family differ by rounding alone."""
    return np.round(1 - np.geomspace(*law["one_minus_ell"], law["tubes"]), 12)


def family_tau(settings: Mapping) -> np.ndarray:
    """The published times and others, spaced evenly in ln(tau)."""
    first, last = settings["tau_range"]
    return np.unique(
        np.concatenate([settings["tau"], np.geomspace(first, last, settings["tau_count"])])
    )


def pulse(gel, tube: Mapping, ell, tau, numerics: Mapping) -> xr.Dataset:
    """The solved tubes, with the Lewis number."""
    return solve(
        Tubes(ell, tube["eps"], gel.M, gel.Pi_ratio, gel.Phi_inf),
        StepHeating(tube["Le"]),
        tau,
        cells=tuple(numerics["cells"]),
        tolerance=numerics["tolerance"],
        reach=numerics["reach"],
    ).assign(Le=variable((), float(tube["Le"]), "Lewis number, kappa/D"))


def refinement(gel, tube: Mapping, numerics: Mapping, production: xr.Dataset) -> xr.Dataset:
    """Some tubes of `production` on other meshes, with looser time steps, on a longer domain.

    Dims (level, ell, tau), level 0 being production. Time steps are compared with looser ones only,
    since these cost less: the uncertainty is that of tolerances four times production's.
    """
    ell, tau = numerics["refined_ell"], numerics["refined_tau"]
    behind, ahead = numerics["cells"]
    changes = [
        {},
        {"cells": [behind // 2, ahead // 2]},
        {"cells": [2 * behind, 2 * ahead]},
        {"tolerance": TOLERANCE_FACTOR * numerics["tolerance"]},
        {"tolerance": TOLERANCE_FACTOR**2 * numerics["tolerance"]},
        {"cells": [behind, REACH_FACTOR * ahead], "reach": REACH_FACTOR * numerics["reach"]},
    ]
    levels = [{**numerics, **change} for change in changes]
    here = production.sel(ell=ell, tau=tau, method="nearest")
    runs = [here, *(pulse(gel, tube, ell, tau, level) for level in levels[1:])]
    return compared(levels, runs)


def compared(levels: list[Mapping], runs: list[xr.Dataset]) -> xr.Dataset:
    """What is measured of each run, with its numerical uncertainty."""
    data = {}
    for name, (long_name, comment, measure) in MEASURED.items():
        values = np.array([measure(run) for run in runs])
        base, coarse, fine, loose, loosest, far = values
        uncertainty = (
            convergence_index(coarse, base, fine)
            + convergence_index(loosest, loose, base)
            + np.abs(far - base)
        )
        data[name] = variable(("level", "ell", "tau"), values, long_name, comment)
        data[f"{name}_uncertainty"] = variable(
            ("ell", "tau"), uncertainty, f"numerical uncertainty: {long_name}", comment
        )
    profiles = [around_front(run, COMMON_GRID) for run in runs]
    data["Phi1_difference"] = variable(
        ("level", "ell", "tau"),
        np.array([np.abs(profile - profiles[0]).max(axis=-1) for profile in profiles]),
        f"largest difference of Phi1 from production at the same Z, up to {WINDOW:g} w from Z_C",
        scaling.POLYMER,
    )
    columns = {
        "cells_behind": ("cells behind the front", [level["cells"][0] for level in levels]),
        "cells_ahead": ("cells ahead of the front", [level["cells"][1] for level in levels]),
        "tolerance": ("tolerance of the time steps", [level["tolerance"] for level in levels]),
        "reach": ("length ahead of the front over w", [float(level["reach"]) for level in levels]),
    }
    return xr.Dataset(
        data,
        coords={
            "ell": scaling.ell(runs[0].ell.values),
            "tau": scaling.tau(runs[0].tau.values),
            **{name: variable("level", values, text) for name, (text, values) in columns.items()},
        },
    )


def _front_velocity(form):
    return lambda run: form(Wall.of(run))[..., int(run.hot.sum())]


def _far_velocity(form):
    return lambda run: form(Wall.of(run))[..., -1]


MEASURED = {
    "A": ("sharpness of the front", "in units of 1/L", lambda run: sharpness(run)[0]),
    "Phi1_front": (
        "polymer fraction in the middle of the wall at Z_C",
        scaling.POLYMER,
        lambda run: run.Phi1_front.values,
    ),
}
for _name, _form in lumen.VELOCITIES.items():
    MEASURED[f"V_front_{_name}"] = (
        f"axial velocity in the lumen at Z_C, {lumen.MEANING[_name]}",
        scaling.AXIAL_VELOCITY,
        _front_velocity(_form),
    )
    MEASURED[f"V_far_{_name}"] = (
        f"axial velocity in the lumen far ahead, {lumen.MEANING[_name]}",
        scaling.AXIAL_VELOCITY,
        _far_velocity(_form),
    )
