"""A tube solved on FiPy, in SI units: sections 3.5 and 3.6 until the front is at Z_C = 1.

By then it has travelled the heated length. Polymer fraction, front and flow are scaled back with L,
a_1 and the poroelastic time. What the tube pumps is that of the one that conserves water
(`gelpump.tube.closure`, `gelpump.tube.pump`), and beside it V of eqn:lumen as printed; on either
side of z = 0 the flow is the same. To the numerical uncertainty of what is pumped comes how much it
changes if the wall's surface bears no force. The response is also that of the wall resolved in r
(`gelpump.tube.wall`).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.design import units
from gelpump.design.description import Design
from gelpump.design.device import lewis_number, scales, tubes
from gelpump.design.refined import levels, variable
from gelpump.design.result import Result
from gelpump.uncertainty import convergence_index

TIMES = 48
FORMS = ("printed", "conserving")
PUMPED_LINES = {  # what is pumped, by its name in `gelpump.tube.pump`
    "pumped_volume_conserving": "pumped_station",
    "pumped_end_volume": "pumped_end",
    "collapse_volume": "collapse_station",
    "from_wall_volume": "inner",
}
PUMPED = [f"final_{name}" for name in PUMPED_LINES]


def solve_tube(design: Design, numerics: Mapping) -> tuple[xr.Dataset, list[Result]]:
    """Dims t, cell, face: from t = 0 (excluded) until the front has travelled the heated length."""
    from gelpump.tube.heat import FRONT_CONSTANT, StepHeating
    from gelpump.tube.slender import solve

    Le = lewis_number(design)
    tau = (np.arange(1, TIMES + 1) / TIMES) ** 2 / (FRONT_CONSTANT**2 * Le)

    def run(cells, tolerance, closure):
        given = {"cells": tuple(cells), "tolerance": tolerance, "reach": numerics["reach"]}
        return solve(tubes(design), StepHeating(Le), tau, closure=closure, **given)

    def device(cells, tolerance, conserving="conservative"):
        printed = run(cells, tolerance, "printed")
        return in_si(design, printed, run(cells, tolerance, conserving))

    runs = [device(*level) for level in levels(numerics)]
    measured = [_tube_numbers(run) for run in runs]
    middle = list(levels(numerics))[1]
    forceless = {each.key: each.value for each in _tube_numbers(device(*middle, "balanced"))}
    found = []
    for coarse, here, fine in zip(*measured, strict=True):
        error = float(convergence_index(coarse.value, here.value, fine.value))
        if here.key in PUMPED:
            error += abs(forceless[here.key] - here.value)
        found.append(Result(**{**vars(here), "uncertainty": error}))
    found += wall_results(design)
    return runs[1].assign_attrs(pump_note=pump_note(design, found)), found


def wall_results(design: Design) -> list[Result]:
    """t_99 of the wall resolved in r, on its midline."""
    from gelpump.tube.wall import deswelling_times

    second = units.si(scales(design)["time"], "s")
    times, errors = deswelling_times(tubes(design))
    texts = {
        "response_time_resolved": "response time, wall resolved in r, Φ = Φ₀ on its surfaces",
        "response_time_forceless": "response time, wall resolved in r, no force on its surfaces",
    }
    sources = "section 3.4, eqn:b1bc", "gelpump.tube.wall"
    return [
        Result(key, text, "t_99", second * float(time), "s", source, second * float(error))
        for (key, text), source, time, error in zip(
            texts.items(), sources, times[:, 0, 0], errors[:, 0, 0], strict=True
        )
    ]


def pump_note(design: Design, found: list[Result]) -> str:
    """Which way water is pumped and how much, where it comes from, and what eqn:lumen says."""
    from gelpump.tube.pump import per_advance

    numbers = {each.key.removeprefix("final_"): each for each in found}
    pumped = numbers["pumped_volume_conserving"]

    def said(volume):
        number, unit = units.shown(abs(volume), "m^3")
        return f"{units.told(number)} {units.readable(unit)}"

    tube = tubes(design)
    a_1, L = (units.si(scales(design)[key], "m") for key in ("across", "along"))
    geometry = per_advance(float(tube.ell), float(tube.Phi_inf))["pumped_station"]
    away = pumped.value > 0
    return (
        f"Water is pumped {'away from' if away else 'towards'} the heated end: "
        f"{said(pumped.value)} (± {said(pumped.uncertainty)}) go "
        f"{'out' if away else 'in'} past a fixed station, "
        f"{said(numbers['collapse_volume'].value)} by the lumen’s collapse and "
        f"{said(numbers['from_wall_volume'].value)} out of the wall; by geometry alone "
        f"{said(np.pi * a_1**2 * L * geometry)}. ± holds what a surface without force would "
        "change. As printed (eqn:lumen; water is not conserved) "
        f"{said(numbers['pumped_volume_printed'].value)} would go "
        f"{'out' if numbers['pumped_volume_printed'].value > 0 else 'in'}."
    )


def in_si(design: Design, pulse: xr.Dataset, conserving: xr.Dataset) -> xr.Dataset:
    """A dataset of `gelpump.tube.slender` with one tube, in SI units; the same tube, conserving
    water, for what it pumps."""
    from gelpump.tube import lumen, pump
    from gelpump.tube.budget import water_budget
    from gelpump.tube.front import sharpness
    from gelpump.tube.wall_flow import Wall

    scale = scales(design)
    time, L, a_1 = (units.si(scale[key], unit) for key, unit in
                    (("time", "s"), ("along", "m"), ("across", "m")))  # fmt: skip
    one = pulse.isel(ell=0)
    wall = Wall.of(one)
    Phi, ell = one.Phi1.values, float(one.ell)
    front = pulse.attrs["cells_behind"]
    A, misfit = (each[0] for each in sharpness(pulse))
    data = {
        "z": variable(("t", "cell"), L * one.Z.values, "m", "axial position of the cells"),
        "z_face": variable(
            ("t", "face"), L * one.Z_face.values, "m", "axial position of the faces"
        ),
        "polymer_ratio": variable(
            ("t", "cell"), Phi, "1", "polymer fraction over that of the swollen tube"
        ),
        "inner_radius": variable(("t", "cell"), ell * a_1 * Phi ** (-1 / 3), "m", "inner radius"),
        "outer_radius": variable(("t", "cell"), a_1 * Phi ** (-1 / 3), "m", "outer radius"),
        "front_position": variable("t", L * one.Z_C.values, "m", "position where T = T_C"),
        "front_polymer_ratio": variable(
            "t", one.Phi1_front.values, "1", "polymer fraction at the front over the swollen one"
        ),
        "front_width": variable(
            "t",
            2 * np.arctanh(0.8) * L / A,
            "m",
            "length over which the fitted front makes the middle 80 per cent of its change",
        ),
        "front_fit_rms": variable("t", misfit, "1", "misfit of the fitted front"),
        "departed_length": variable(
            "t",
            L * one.departed_length.values,
            "m",
            "length of tube that is more than a tenth of the jump away from equilibrium",
        ),
        "shed_volume": variable(
            "t",
            a_1**2 * L * water_budget(pulse).shed_volume.values[0],
            "m^3",
            "water that the wall has shed on one side of z = 0",
        ),
    }
    if design.material.phi_00 is not None:
        data["polymer_fraction"] = variable(
            ("t", "cell"), design.material.phi_00 * Phi, "1", "polymer volume fraction"
        )
    t = time * one.tau.values
    places = {"front": "at the front", "far": "far ahead"}
    walls = {"printed": wall, "conserving": Wall.of(conserving.isel(ell=0))}
    velocities = {"printed": lumen.velocity_printed, "conserving": lumen.velocity_conserving}
    for form in FORMS:
        V = L / time * velocities[form](walls[form])
        area = np.pi * (ell * a_1) ** 2 * walls[form].Phi1_face ** (-2 / 3)
        said = lumen.MEANING[form]
        data[f"lumen_velocity_{form}"] = variable(
            ("t", "face"), V, "m/s", f"axial velocity in the lumen, {said}"
        )
        for where, index in (("front", front), ("far", -1)):
            data[f"flow_{where}_{form}"] = variable(
                "t",
                (V * area)[:, index],
                "m^3/s",
                f"flow of water along the lumen {places[where]}, {said}",
            )
    data["z_face_conserving"] = variable(
        ("t", "face"),
        L * conserving.Z_face.values[0],
        "m",
        f"axial position of the faces {lumen.MEANING['conserving']}",
    )
    data["pumped_volume_printed"] = variable(
        "t",
        _pumped(t, data["flow_far_printed"][1]),
        "m^3",
        f"water pumped far ahead since t = 0 on one side of z = 0, {lumen.MEANING['printed']}",
    )
    volumes = pump.volumes(conserving)
    for name, key in PUMPED_LINES.items():
        text = pump.LINES[key]
        data[name] = variable("t", a_1**2 * L * volumes[key][0], "m^3", f"{text}, on one side")
    return xr.Dataset(
        data,
        coords={"t": ("t", t, {"units": "s", "long_name": "elapsed time"})},
        attrs={key: pulse.attrs[key] for key in ("steps", "sweeps", "cells_behind", "cells_ahead")},
    )


def _pumped(t, flow):
    """Integral of the flow from t = 0, where there is none; smooth in sqrt(t), as the front is."""
    from scipy.interpolate import CubicSpline

    root = np.sqrt(t)
    spline = CubicSpline(np.append(0.0, root), np.append(0.0, flow * 2 * root))
    return spline.antiderivative()(root)


def _tube_numbers(run):
    """final_*: what is measured when the front has travelled the heated length."""
    last = run.isel(t=-1)
    conserved, printed = "water conserved", "as printed"
    balance = "gelpump.tube.pump"
    found = [
        ("front_width", "width of the front, 10 to 90 per cent", "2.20 L/A", "m", "eqn:tanh_fit"),
        ("departed_length", "length out of equilibrium", "", "m", "section 3.3"),
        ("pumped_volume_conserving", f"volume pumped per pulse and side, {conserved}", "", "m^3",
         balance),
        ("pumped_end_volume", "the same, out of the tube’s own end", "", "m^3", balance),
        ("collapse_volume", "of it by the lumen’s collapse, past a station", "", "m^3", balance),
        ("from_wall_volume", "of it out of the wall", "", "m^3", balance),
        ("pumped_volume_printed", f"volume pumped per pulse and side, {printed}", "", "m^3",
         "eqn:lumen"),
        ("shed_volume", f"water shed by the wall, per side, {printed}", "", "m^3",
         "eqn:tube_model"),
    ]  # fmt: skip
    texts = {
        "lumen_velocity": ("largest velocity in the lumen", "v_z", "m/s"),
        "flow_front": ("flow in the lumen at the front", "Q", "m^3/s"),
        "flow_far": ("flow far ahead of the front", "Q", "m^3/s"),
    }
    for form, said, source in (
        ("conserving", conserved, balance),
        ("printed", printed, "eqn:lumen"),
    ):
        for name, (text, symbol, unit) in texts.items():
            found.append((f"{name}_{form}", f"{text}, {said}", symbol, unit, source))
    return [
        Result(
            f"final_{key}",
            text,
            symbol,
            float(np.abs(last[key]).max() if last[key].dims else last[key]),
            unit,
            source,
        )
        for key, text, symbol, unit, source in found
    ]
