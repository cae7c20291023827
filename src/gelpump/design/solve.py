"""The device solved on FiPy, with its numbers in SI units and their numerical uncertainty.

A tube is told of in `gelpump.design.solve_tube`. A bead is that of section 2.1 until 99 per cent of
its change of radius are made.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.design import units
from gelpump.design.description import Design
from gelpump.design.device import scales
from gelpump.design.front import NO_TUBE, front_of, separates
from gelpump.design.own_gel import own_gel
from gelpump.design.programme import solved
from gelpump.design.refined import levels, variable
from gelpump.design.result import Result
from gelpump.design.solve_tube import solve_tube
from gelpump.uncertainty import convergence_index

BEAD_CHANGE = 0.99


def solve(design: Design, numerics: Mapping) -> tuple[xr.Dataset, list[Result]]:
    """The solved device, and the numbers measured on it; of a gel that separates, its front's."""
    parts = design.kind == "tube" and separates(design)
    if parts:
        data, found = xr.Dataset(attrs={"unsolved": NO_TUBE}), []
    else:
        data, found = (solve_tube if design.kind == "tube" else solve_bead)(design, numerics)
    if design.kind == "tube" and design.material.energy_based:
        own, note = own_gel(design)
        found = found + own
        data = data.assign_attrs({"own_gel_note": note} if note else {})
    if design.programme:
        more, own, note = solved(design)
        data = data.assign(more).assign_attrs({"cycle_note": note} if note else {})
        found = found + own
    if parts or data.attrs.get("stopped"):
        front, note = front_of(design)
        return data.assign_attrs(front_note=note), found + front
    return data, found


def solve_bead(design: Design, numerics: Mapping) -> tuple[xr.Dataset, list[Result]]:
    """Dims t, cell: until 99 per cent of the change of radius are made, or phases separate."""
    from gelpump.bead import lens

    material, scale = design.material, scales(design)
    start = material.own_start

    def run(end, cells, tolerance):
        times = end * np.linspace(0.0, 1.0, 121) ** 2
        return lens.solve(material.gel, material.hot, start, times, cells, tolerance=tolerance)

    end, coarse = _guess(material), 40
    for _ in range(8):
        bead = run(end, coarse, 1e-3)
        if bead.attrs["stopped"] or _change(bead, material)[-1] > 0.995:
            break
        end *= 4.0
    if not bead.attrs["stopped"]:
        reached = _time_of(bead, material, BEAD_CHANGE)
        end = float(1.3 * reached) if reached is not None else end
    runs = [run(end, cells[0], tolerance) for cells, tolerance in levels(numerics)]
    t_unit = units.si(scale["time"], "s")
    found = []
    for share in (0.5, 0.9, BEAD_CHANGE):
        times = [_time_of(bead, material, share) for bead in runs]
        if None in times:
            continue
        seconds = [t_unit * time for time in times]
        found.append(
            Result(
                "response_time" if share == BEAD_CHANGE else f"time_{100 * share:.0f}",
                f"time of {100 * share:.0f} % of the change of radius",
                f"t_{100 * share:.0f}",
                seconds[1],
                "s",
                "section 2.1, eqn:lens_transport",
                float(convergence_index(*seconds)),
            )
        )
    return _bead_in_si(design, runs[1]), found


def _guess(material):
    """Some relaxation times of the collapsed bead, in its own units."""
    a = (material.own_start * material.Phi_inf) ** (-1 / 3)
    D = material.gel.diffusivity(material.own_start * material.Phi_inf, material.hot)
    return 2.0 * a**2 * material.gel.shear_modulus(1.0) / (np.pi**2 * float(D))


def _change(bead, material):
    """The share of the change of radius that is made at each time."""
    start = material.own_start ** (-1 / 3)
    end = (material.own_start * material.Phi_inf) ** (-1 / 3)
    return (start - bead.radius.values) / (start - end)


def _time_of(bead, material, share):
    """When the share is made, by interpolation in sqrt(t); None if it is not."""
    from scipy.interpolate import PchipInterpolator
    from scipy.optimize import brentq

    change, root = _change(bead, material), np.sqrt(bead.t.values)
    after = np.flatnonzero(change >= share)
    if not len(after) or after[0] == 0:
        return None
    curve = PchipInterpolator(root, change)
    return float(brentq(lambda s: curve(s) - share, root[after[0] - 1], root[after[0]])) ** 2


def _bead_in_si(design, bead):
    scale = scales(design)
    time, R_dry = units.si(scale["time"], "s"), units.si(scale["along"], "m")
    material = design.material
    over = material.own_start
    phi = bead.polymer_fraction.values
    data = {
        "radius": variable("t", R_dry * bead.radius.values, "m", "radius of the bead"),
        "r": variable(("t", "cell"), R_dry * bead.r.values, "m", "radial position of the shells"),
        "r_face": variable(("t", "face"), R_dry * bead.r_face.values, "m", "radii of shell faces"),
        "polymer_ratio": variable(
            ("t", "cell"), phi / over, "1", "polymer fraction over that of the swollen bead"
        ),
        "surface_polymer_ratio": variable(
            "t",
            bead.surface_polymer_fraction.values / over,
            "1",
            "polymer fraction at the surface over that of the swollen bead",
        ),
        "shed_volume": variable(
            "t",
            4 / 3 * np.pi * R_dry**3 * (bead.radius.values[0] ** 3 - bead.radius.values**3),
            "m^3",
            "water that the bead has shed",
        ),
    }
    if material.phi_00 is not None:
        data["polymer_fraction"] = variable(
            ("t", "cell"), phi / over * material.phi_00, "1", "polymer volume fraction"
        )
    t = ("t", time * bead.t.values, {"units": "s", "long_name": "elapsed time"})
    keep = {key: bead.attrs[key] for key in ("steps", "sweeps", "stopped")}
    if "stopped_t" in bead.attrs:
        after, where = (
            f"{units.told(number)} {units.readable(unit)}"
            for number, unit in (
                units.shown(time * bead.attrs["stopped_t"], "s"),
                units.shown(R_dry * bead.attrs["stopped_r"], "m"),
            )
        )
        when = f"after {after}" if bead.attrs["stopped_t"] else "at once"
        keep["stopped"] = (
            f"phases separate {when} at r = {where}, φ = "
            f"{units.told(bead.attrs['stopped_polymer_fraction'])}: D < 0"
        )
    return xr.Dataset(data, coords={"t": t}, attrs=keep)
