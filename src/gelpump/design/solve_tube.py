"""A tube solved on FiPy, in SI units: sections 3.5 and 3.6 until the front is at Z_C = 1.

By then it has travelled the heated length. Polymer fraction, front and flow are scaled back with L,
a_1 and the poroelastic time. The lumen's flow is given as printed in eqn:lumen and in the form that
conserves water (`gelpump.tube.lumen`); on either side of z = 0 the flow is the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr

from gelpump.design import units
from gelpump.design.description import Design
from gelpump.design.device import lewis_number, scales, tubes
from gelpump.design.refined import levels, variable
from gelpump.design.result import Result
from gelpump.uncertainty import convergence_index

if TYPE_CHECKING:
    from gelpump.tube.wall_flow import Wall

TIMES = 48
FORMS = ("printed", "continuous")


def solve_tube(design: Design, numerics: Mapping) -> tuple[xr.Dataset, list[Result]]:
    """Dims t, cell, face: from t = 0 (excluded) until the front has travelled the heated length."""
    from gelpump.tube.heat import FRONT_CONSTANT, StepHeating
    from gelpump.tube.slender import solve

    Le = lewis_number(design)
    tau = (np.arange(1, TIMES + 1) / TIMES) ** 2 / (FRONT_CONSTANT**2 * Le)
    runs = []
    for cells, tolerance in levels(numerics):
        pulse = solve(
            tubes(design),
            StepHeating(Le),
            tau,
            cells=tuple(cells),
            tolerance=tolerance,
            reach=numerics["reach"],
        )
        runs.append(in_si(design, pulse))
    measured = [_tube_numbers(design, run) for run in runs]
    found = []
    for coarse, here, fine in zip(*measured, strict=True):
        error = float(convergence_index(coarse.value, here.value, fine.value))
        found.append(Result(**{**vars(here), "uncertainty": error}))
    return runs[1].assign_attrs(lumen_note=lumen_note(runs[1])), found


def far_parts(wall: Wall) -> dict[str, tuple[float, float]]:
    """V far ahead, at the last time: what the wall sheds into the lumen behind the front, and what
    its source does ahead of it, in units of `gelpump.tube.lumen`; both forms, without the tube's
    own motion, which only the continuous one has."""
    from gelpump.tube.wall_flow import lumen_share

    ell = float(np.ravel(wall.ell)[0])
    gain = 1 + lumen_share(ell) * (1 - ell**2) / ell**2
    sources = {
        "printed": wall.integral(wall.F * np.cbrt(wall.Phi1)) / 2,
        "continuous": gain * wall.Phi1_face[:, -1:] ** (2 / 3)
        * wall.integral(wall.F * wall.Phi1 ** (-5 / 3)),
    }  # fmt: skip
    front = int(np.argmax(sources["printed"][-1]))
    return {
        form: (float(V[-1, front]), float(V[-1, -1] - V[-1, front])) for form, V in sources.items()
    }


def lumen_note(data: xr.Dataset) -> str:
    """Why the two forms of the lumen's flow differ far ahead, with the numbers of this tube."""
    last, said = data.isel(t=-1), {}
    for form in FORMS:
        behind, ahead = (1e3 * float(last[f"far_{part}_{form}"]) for part in ("behind", "ahead"))
        volume = float(last[f"pumped_volume_{form}"])
        number, unit = units.shown(abs(volume), "m^3")
        said[form] = (
            f"{units.told(behind)} {'−' if ahead < 0 else '+'} {units.told(abs(ahead))} mm/s, and "
            f"{units.told(number)} {units.readable(unit)} go {'out' if volume > 0 else 'in'}"
        )
    printed, continuous = (float(last[f"flow_far_{form}"]) for form in FORMS)
    verdict = (
        "they differ in sign here, so the model does not decide which way water is pumped"
        if printed * continuous < 0
        else "they agree in sign here"
    )
    return (
        "Far ahead, the lumen's flow is what the wall sheds into it behind the front less what the "
        "wall takes up ahead of it. As printed (eqn:lumen; both weighed by Φ₁ to the power 1/3) "
        f"that is {said['printed']} in the pulse; with water conserved at the lumen's moving edge "
        f"(by Φ₁ to the power −5/3) {said['continuous']}. Both are given: {verdict}."
    )


def in_si(design: Design, pulse: xr.Dataset) -> xr.Dataset:
    """A dataset of `gelpump.tube.slender` with one tube, in SI units."""
    from gelpump.tube import lumen
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
    for form, parts in far_parts(wall).items():
        for part, value in zip(("behind", "ahead"), parts, strict=True):
            data[f"far_{part}_{form}"] = variable(
                (),
                L / time * value,
                "m/s",
                f"velocity far ahead at the last time from the wall's water {part} "
                f"{'the' if part == 'behind' else 'of the'} front, {lumen.MEANING[form]}",
            )
    t = time * one.tau.values
    places = {"front": "at the front", "far": "far ahead"}
    for form in FORMS:
        V = L / time * lumen.VELOCITIES[form](wall)
        area = np.pi * (ell * a_1) ** 2 * wall.Phi1_face ** (-2 / 3)
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
        data[f"pumped_volume_{form}"] = variable(
            "t",
            _pumped(t, data[f"flow_far_{form}"][1]),
            "m^3",
            f"water pumped far ahead since t = 0 on one side of z = 0, {said}",
        )
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


def _tube_numbers(design, run):
    """final_*: what is measured when the front has travelled the heated length."""
    last = run.isel(t=-1)
    found = [
        ("front_width", "width of the front, 10 to 90 per cent", "2.20 L/A", "m", "eqn:tanh_fit"),
        ("departed_length", "length out of equilibrium", "", "m", "section 3.3"),
        ("shed_volume", "water shed by the wall, per side", "", "m^3", "eqn:tube_model"),
    ]
    values = {name: float(last[name]) for name, *_ in found}
    for form, said in (("printed", "as printed"), ("continuous", "water conserved")):
        source = "eqn:lumen" if form == "printed" else "continuity at the inner edge"
        texts = {
            "lumen_velocity": ("largest velocity in the lumen", "v_z", "m/s"),
            "flow_front": ("flow in the lumen at the front", "Q", "m^3/s"),
            "flow_far": ("flow far ahead of the front", "Q", "m^3/s"),
            "pumped_volume": ("volume pumped per pulse and side", "", "m^3"),
        }
        for name, (text, symbol, unit) in texts.items():
            key = f"{name}_{form}"
            values[key] = float(np.abs(last[key]).max() if last[key].dims else last[key])
            found.append((key, f"{text}, {said}", symbol, unit, source))
    return [
        Result(f"final_{key}", text, symbol, values[key], unit, source)
        for key, text, symbol, unit, source in found
    ]
