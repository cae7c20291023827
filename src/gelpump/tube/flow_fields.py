"""Dataset of the flow in one tube at one time (figures 10 and 11)."""

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.tube import lumen, scaling, wall_flow
from gelpump.tube.wall_flow import Wall

ACROSS_WALL, ACROSS_LUMEN = 41, 11


def tube_flow(pulse: xr.Dataset, ell: float, tau: float) -> xr.Dataset:
    """Polymer fraction and velocities in the wall and the lumen; as printed unless named otherwise.

    Radii follow the material: R is the one that a point of the wall had in the swollen tube, and
    `radius` where it is now.
    """
    here = pulse.sel(ell=ell, tau=tau, method="nearest")
    wall = Wall.of(here)
    s = np.linspace(ell, 1.0, ACROSS_WALL)
    inside = np.linspace(0.0, ell, ACROSS_LUMEN)
    shrunk = wall.Phi1[:, np.newaxis] ** (-1 / 3)
    column = wall.Phi1[:, np.newaxis], wall.drive[:, np.newaxis] * wall.eps**2
    section = ("Z", "R")
    fractions = {
        "": (wall_flow.Phi2_printed, "eqn:phi2"),
        "_consistent": (wall_flow.Phi2_consistent, "the conditions above eqn:phi2"),
    }
    U_g = {
        "": (wall.radial_velocity_printed(s), "eqn:ug with eqn:phi2"),
        "_without_Phi1": (
            wall.radial_velocity_printed(s) * column[0],
            "as printed for the lumen, without the factor 1/Phi1 of eqn:ug",
        ),
        "_consistent": (
            wall.radial_velocity_consistent(s),
            "eqn:ug with the conditions above eqn:phi2",
        ),
    }
    data = {
        f"polymer_fraction{suffix}": variable(
            section,
            column[0] + form(s, column[1], wall.ell),
            f"polymer fraction Phi1 + eps^2 Phi2, Phi2 of {source}",
            scaling.POLYMER,
        )
        for suffix, (form, source) in fractions.items()
    } | {
        f"u_r{suffix}": variable(
            section,
            values,
            f"radial interstitial velocity relative to the polymer, {source}",
            scaling.RADIAL_VELOCITY,
        )
        for suffix, (values, source) in U_g.items()
    }
    data["u_z"] = variable(
        section,
        np.repeat(wall.axial_velocity[:, np.newaxis], ACROSS_WALL, axis=1),
        "axial interstitial velocity relative to the polymer, eqn:ug",
        scaling.AXIAL_VELOCITY,
    )
    for name, form in lumen.VELOCITIES.items():
        suffix = "" if name == "printed" else f"_{name}"
        V = form(wall)
        C = lumen.radial_rate(wall, V)
        data[f"lumen_u_z{suffix}"] = variable(
            "Z",
            (V[1:] + V[:-1]) / 2,
            f"axial velocity in the lumen, {lumen.MEANING[name]}",
            scaling.AXIAL_VELOCITY,
        )
        data[f"lumen_u_r{suffix}"] = variable(
            ("Z", "R_lumen"),
            C[:, np.newaxis] * inside * shrunk,
            f"radial velocity in the lumen, {lumen.MEANING[name]}",
            scaling.RADIAL_VELOCITY,
        )
    u_p = wall.polymer_velocity_face
    data |= {
        "wall_u_r": variable(
            "Z",
            -wall.ell / 3 * wall.Phi1 ** (-4 / 3) * wall.shrinkage,
            "radial velocity of the polymer at the inner edge",
            scaling.RADIAL_VELOCITY,
        ),
        "wall_u_z": variable(
            "Z", (u_p[1:] + u_p[:-1]) / 2, "axial velocity of the polymer", scaling.AXIAL_VELOCITY
        ),
        "radius": variable(section, s * shrunk, "radial position in the wall", scaling.RADIAL),
        "lumen_radius": variable(
            ("Z", "R_lumen"), inside * shrunk, "radial position in the lumen", scaling.RADIAL
        ),
        "B_0": variable("Z", ell * shrunk[:, 0], "inner radius of the wall", scaling.RADIAL),
        "B_1": variable("Z", shrunk[:, 0], "outer radius of the wall", scaling.RADIAL),
        "Phi1": variable(
            "Z", wall.Phi1, "polymer fraction in the middle of the wall", scaling.POLYMER
        ),
        "Z_C": variable((), float(here.Z_C), "position of the front", scaling.AXIAL),
        "eps": variable((), float(here.eps), "slenderness a_1/L"),
        "ell": variable((), float(here.ell), "ratio of inner to outer radius, a_0/a_1"),
        "tau": variable((), float(here.tau), "elapsed time", "in units of mu_l L^2/(k Pi_00)"),
    }
    coords = {
        "Z": variable(
            "Z", here.Z.values, "axial position", f"{scaling.AXIAL}; nothing varies further ahead"
        ),
        "R": variable("R", s, "radius that the point had in the swollen tube", scaling.RADIAL),
        "R_lumen": variable(
            "R_lumen", inside, "radius, over that of the lumen, times ell", "0 on the axis"
        ),
    }
    return xr.Dataset(data, coords)
