"""Dataset of the pulse of water in the lumen (figure 12): from the tanh form, and as solved."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from gelpump.coordinates import merged
from gelpump.netcdf import variable
from gelpump.tube import lumen, scaling
from gelpump.tube.front import PowerLaw
from gelpump.tube.wall_flow import Wall
from gelpump.uncertainty import quadrature_error

if TYPE_CHECKING:
    from gelpump.materials import PiecewiseLinearGel

FAR = 1e9  # beyond any pulse


def lumen_pulse(
    gel: PiecewiseLinearGel,
    tube: Mapping,
    settings: Mapping,
    pulse: xr.Dataset,
    fit: xr.Dataset,
) -> xr.Dataset:
    """V of the tanh form without its prefactor (`plotted`) and with it, and of the solved tubes.

    The prefactor needs an ell: it is that of the tube which the fitted power law gives the A.
    Below A = prefactor of the law there is none (`one_minus_ell` > 1).
    """
    tau, sharp = np.array(settings["tau"]), np.geomspace(*settings["A"], settings["A_count"])
    A = merged(settings["drawn_A"], sharp)
    law = PowerLaw(*(float(fit[key]) for key in ("exponent", "exponent_uncertainty", "prefactor")))
    here = pulse.sel(tau=tau, method="nearest")
    Z_C = here.Z_C.values
    Z = merged(Z_C, np.linspace(*settings["Z"], settings["Z_count"]))
    plotted = lumen.velocity_tanh(gel, settings["drawn_A"], Z, Z_C[:, np.newaxis])

    def at(Z):
        return partial(lumen.velocity_tanh, gel, A, Z, Z_C[-1])

    highest, far = at(Z_C[-1])(), at(FAR)()
    errors = {
        name: quadrature_error(at(Z), lumen.NODES, lumen.FEWER_NODES)
        for name, Z in (("V_max_plotted", Z_C[-1]), ("V_far_plotted", FAR))
    }
    thickness = law.one_minus_ell(A)
    before = lumen.prefactor(tube["eps"], thickness)
    drawn = lumen.prefactor(tube["eps"], law.one_minus_ell(settings["drawn_A"]))
    no_prefactor = "without the prefactor 8/(eps^2 (1-ell)^2)"
    law_text = "1-ell in the prefactor from the power law of A; tanh form of Phi1"
    data = {
        "V": variable(
            ("tau", "Z"), drawn * plotted, "axial velocity in the lumen, eqn:lumen", law_text
        ),
        "V_max": variable("A", before * highest, "axial velocity in the lumen at Z_C", law_text),
        "V_far": variable("A", before * far, "axial velocity in the lumen far ahead", law_text),
        "V_plotted": variable(
            ("tau", "Z"),
            plotted,
            f"axial velocity in the lumen {no_prefactor}",
            "tanh form of Phi1",
        ),
        "V_max_plotted": variable(
            "A", highest, f"axial velocity in the lumen at Z_C {no_prefactor}", "tanh form of Phi1"
        ),
        "V_far_plotted": variable(
            "A", far, f"axial velocity in the lumen far ahead {no_prefactor}", "tanh form of Phi1"
        ),
        "one_minus_ell": variable(
            "A", thickness, "1-ell of the tube with this A, by the power law"
        ),
        "drawn_A": variable((), float(settings["drawn_A"]), "A of V(tau, Z)", "in units of 1/L"),
        "Z_C": variable("tau", Z_C, "position of the front", scaling.AXIAL),
    }
    data |= {
        f"{name}_uncertainty": variable(
            "A", error, f"numerical uncertainty: {data[name][2]['long_name']}"
        )
        for name, error in errors.items()
    }
    data |= _solved(gel, tube, here, fit)
    return xr.Dataset(
        data,
        coords={
            "tau": scaling.tau(here.tau.values),
            "Z": variable("Z", Z, "axial position", scaling.AXIAL),
            "A": variable("A", A, "sharpness of the front", "in units of 1/L"),
            "ell": scaling.ell(here.ell.values),
        },
    )


def _solved(gel, tube, here, fit):
    """V at the front and far ahead for each form, and what the printed pulse carries."""
    wall, front = Wall.of(here), here.attrs["cells_behind"]
    dims = ("ell", "tau")
    data = {}
    for name, form in lumen.VELOCITIES.items():
        V, text = form(wall), f"axial velocity in the lumen{{}}, {lumen.MEANING[name]}"
        values = {
            "front": (V[..., front], " at Z_C"),
            "far": (V[..., -1], " far ahead"),
            "highest": (V.max(axis=-1), ", highest"),
        }
        for where, (value, place) in values.items():
            data[f"V_{where}_{name}"] = variable(
                dims, value, text.format(place), scaling.AXIAL_VELOCITY
            )
        top = np.take_along_axis(wall.Z_face, V.argmax(axis=-1)[..., np.newaxis], -1)[..., 0]
        data[f"Z_highest_{name}"] = variable(
            dims, top - here.Z_C.values, f"where that is, from Z_C, {lumen.MEANING[name]}",
            scaling.AXIAL,
        )  # fmt: skip
    ell = here.ell.values[:, np.newaxis]
    A = fit.A_tau.sel(tau=here.tau, method="nearest").values
    before = lumen.prefactor(tube["eps"], 1 - ell)
    for where, Z in (("front", here.Z_C.values), ("far", FAR)):
        data[f"V_{where}_tanh"] = variable(
            dims,
            before * lumen.velocity_tanh(gel, A, Z, here.Z_C.values),
            f"axial velocity in the lumen {'at Z_C' if where == 'front' else 'far ahead'}, "
            "eqn:lumen with the tanh form of the tube's own A",
            scaling.AXIAL_VELOCITY,
        )
    above = lumen.above_far(lumen.velocity_printed(wall), here.hot.values)
    area = np.pi * ell[..., np.newaxis] ** 2 * wall.Phi1 ** (-2 / 3)
    data["pulse_flux"] = variable(
        dims,
        lumen.pulse_flux(wall, here.hot.values),
        "V of eqn:lumen integrated over the pulse, less V far ahead in front of Z_C",
        "in units of L^2 per poroelastic time mu_l L^2/(k Pi_00)",
    )
    data["pulse_volume_flux"] = variable(
        dims,
        wall.integral(above * area)[..., -1],
        "the same times the cross-section of the lumen",
        "in units of a_1^2 L^2 per poroelastic time mu_l L^2/(k Pi_00)",
    )
    data["pulse_flux_plotted"] = variable(
        dims,
        wall.integral(above)[..., -1] / before,
        "the integral of V over the pulse without the prefactor 8/(eps^2 (1-ell)^2)",
        "in units of L^2 per poroelastic time mu_l L^2/(k Pi_00)",
    )
    return data
