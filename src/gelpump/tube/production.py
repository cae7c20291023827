"""Production and refinement runs of the family of tubes behind a pulse of heat."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from gelpump.coordinates import ROUNDED, merged
from gelpump.netcdf import variable
from gelpump.tube import lumen, scaling
from gelpump.tube.front import largest_difference, sharpness
from gelpump.tube.heat import StepHeating
from gelpump.tube.slender import solve
from gelpump.tube.tubes import Tubes
from gelpump.tube.wall_flow import Wall
from gelpump.uncertainty import convergence_index

if TYPE_CHECKING:
    from gelpump.materials import PiecewiseLinearGel

TOLERANCE_FACTOR = 4.0
REACH_FACTOR = 2


def family_ell(settings: Mapping) -> tuple[np.ndarray, np.ndarray]:
    """The tubes that figures name and those of the power law, evenly spaced in ln(1-ell); and
    whether each belongs to the latter.
    """
    law = np.round(1 - np.geomspace(*settings["law_range"], settings["law_count"]), 12)
    ell = merged(settings["ell"], law)
    return ell, np.isclose(ell[:, np.newaxis], law, rtol=ROUNDED, atol=0.0).any(axis=1)


def family_tau(settings: Mapping) -> np.ndarray:
    """The published times and others, spaced evenly in ln(tau)."""
    first, last = settings["tau_range"]
    return merged(settings["tau"], np.geomspace(first, last, settings["tau_count"]))


def family(
    gel: "PiecewiseLinearGel",
    tube: Mapping[str, Any],
    settings: Mapping[str, Any],
    numerics: Mapping[str, Any],
) -> xr.Dataset:
    """All tubes at all times: figures 8 to 13, as `solve` gives them.

    tube, settings, numerics: the configuration's ``tube``, ``tube_pulse`` and
    ``numerics.tube_pulse``.
    """
    ell, in_law = family_ell(settings)
    return pulse(gel, tube, ell, family_tau(settings), numerics).assign(
        in_power_law=variable("ell", in_law, "whether the power law is fitted to this tube")
    )


def pulse(
    gel: "PiecewiseLinearGel",
    tube: Mapping[str, Any],
    ell: ArrayLike,
    tau: ArrayLike,
    numerics: Mapping[str, Any],
) -> xr.Dataset:
    """The solved tubes, with the Lewis number."""
    return solve(
        Tubes(ell, tube["eps"], gel.M, gel.Pi_ratio, gel.Phi_inf),
        StepHeating(tube["Le"]),
        tau,
        cells=tuple(numerics["cells"]),
        tolerance=numerics["tolerance"],
        reach=numerics["reach"],
    ).assign(Le=variable((), float(tube["Le"]), "Lewis number, kappa/D"))


def refinement(
    gel: "PiecewiseLinearGel",
    tube: Mapping[str, Any],
    numerics: Mapping[str, Any],
    subset: Mapping[str, Any],
    production: xr.Dataset,
) -> xr.Dataset:
    """Some tubes of `production` with looser time steps, and those on other meshes and domains.

    Dims (level, ell, tau), level 0 being production. Looser steps cost less, and the errors of
    space and time hardly depend on each other: meshes are compared at four times production's
    tolerance, and the uncertainty of time is that of this tolerance. `subset` is the
    configuration's ``numerics.refine_tube_pulse``.
    """
    ell, tau = subset["ell"], subset["tau"]
    behind, ahead = numerics["cells"]
    loose = {**numerics, "tolerance": TOLERANCE_FACTOR * numerics["tolerance"]}
    levels = [
        numerics,
        loose,
        {**numerics, "tolerance": TOLERANCE_FACTOR**2 * numerics["tolerance"]},
        {**loose, "cells": [behind // 2, ahead // 2]},
        {**loose, "cells": [2 * behind, 2 * ahead]},
        {**loose, "cells": [behind, REACH_FACTOR * ahead], "reach": REACH_FACTOR * loose["reach"]},
    ]
    here = production.sel(ell=ell, tau=tau, method="nearest")
    return compared(levels, [here, *(pulse(gel, tube, ell, tau, level) for level in levels[1:])])


def compared(levels: list[Mapping], runs: list[xr.Dataset]) -> xr.Dataset:
    """What is measured of each run, with its numerical uncertainty."""
    data = {}
    for name, (long_name, comment, measure) in MEASURED.items():
        values = np.array([measure(run) for run in runs])
        base, loose, loosest, coarse, fine, far = values
        uncertainty = (
            convergence_index(coarse, loose, fine)
            + convergence_index(loosest, loose, base)
            + np.abs(far - loose)
        )
        data[name] = variable(("level", "ell", "tau"), values, long_name, comment)
        data[f"{name}_uncertainty"] = variable(
            ("ell", "tau"), uncertainty, f"numerical uncertainty: {long_name}", comment
        )
    data["Phi1_difference"] = variable(
        ("level", "ell", "tau"),
        np.array([largest_difference(run, runs[0]) for run in runs]),
        "largest difference of Phi1 from production at the same Z",
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


def _in_wall(name):
    return lambda run: getattr(Wall.of(run), name)


def _pulse_flux(run):
    return lumen.pulse_flux(Wall.of(run), run.hot.values)


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
    "axial_velocity": (
        "largest axial interstitial velocity in the wall",
        scaling.AXIAL_VELOCITY,
        _in_wall("largest_axial_velocity"),
    ),
    "radial_velocity": (
        "largest radial interstitial velocity in the wall, eqn:ug with eqn:phi2",
        scaling.RADIAL_VELOCITY,
        _in_wall("largest_radial_velocity"),
    ),
    "radial_to_axial_velocity": (
        "largest radial over largest axial interstitial velocity, both in the same units",
        "U_g of eqn:ug with eqn:phi2 at the outer edge of the wall",
        _in_wall("radial_to_axial_velocity"),
    ),
    "pulse_flux": (
        "V of eqn:lumen integrated over the pulse, less V far ahead in front of Z_C",
        "in units of L^2 per poroelastic time mu_l L^2/(k Pi_00)",
        _pulse_flux,
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
