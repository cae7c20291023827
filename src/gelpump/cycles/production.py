"""Cycles of heating as datasets: loops a(T) of beads, and what tubes pump, with error bars."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.cycles import bead, tube
from gelpump.cycles.programme import Programme
from gelpump.netcdf import variable
from gelpump.second_solvers import tube_cycles
from gelpump.tube.tubes import Tubes

SAFETY = 1.25  # of the grid-convergence index
VOLUME = "in units of pi a_1^2 L"
COLD, HOT = -1.0, 1.0
CLOSURE = "conservative"


def bead_programme(case: Mapping) -> Programme:
    """That of a block with cold, hot, period, cycles and ramp (K and t_BMJ)."""
    return Programme.cycles(
        *(case[key] for key in ("cold", "hot", "period", "cycles")), ramp=case["ramp"]
    )


def loops(gels: Mapping, cases: Mapping[str, Mapping], outputs: int) -> xr.Dataset:
    """T and radius of the beads of ``cases`` along their programmes, dims (loop, moment).

    Each is solved with half the shells and four times the tolerance too, for its uncertainty.
    RuntimeError, saying which, when and where, for a bead whose phases separate.
    """
    found = []
    for name, case in cases.items():
        programme = bead_programme(case)
        times = np.linspace(0.0, programme.end, outputs)
        runs = []
        for coarser in (1, 2):
            width = case.get("width")
            run = bead.solve(
                gels[case["gel"]],
                programme,
                times,
                case["shells"] // coarser,
                tolerance=case["tolerance"] * coarser**2,
                model=case["model"],
                width=width,
            )
            if run.lost:
                raise RuntimeError(f"{name}: phases separate at {run.lost}")
            runs.append(run)
        found.append((*runs, case))
    fine = [each[0] for each in found]
    error = [SAFETY / 3 * np.abs(a.radius - b.radius) for a, b, _ in found]
    dims = ("loop", "moment")
    scale = "lengths in the dry radius R_dry of the bead"
    kelvin = {"units": "K", "long_name": "temperature of the bead"}
    periods = [case["period"] for *_, case in found]
    return xr.Dataset(
        {
            "elapsed": variable(dims, [each.t for each in fine], "elapsed time", "in t_BMJ"),
            "temperature": (dims, [each.T for each in fine], kelvin),
            "radius": variable(dims, [each.radius for each in fine], "radius of the bead", scale),
            "radius_uncertainty": variable(
                dims, error, "numerical uncertainty: radius of the bead", scale
            ),
            "period": variable("loop", periods, "period of the programme", "in t_BMJ"),
            "area": variable("loop", [_area(each, case) for each, _, case in found],
                             "area of the last loop over T and a, over that of its box"),
        },
        coords={"loop": ("loop", list(cases), {"long_name": "bead and its programme"})},
    )  # fmt: skip


def _area(run, case):
    """Of the last cycle: -Integral a dT over (hot - cold) times the span of a."""
    last = run.t >= run.t[-1] - case["period"] * (1 + 1e-9)
    T, a = run.T[last], run.radius[last]
    enclosed = abs((0.5 * (a[1:] + a[:-1]) * np.diff(T)).sum())
    return enclosed / (np.ptp(T) * np.ptp(a))


def per_cycle(run: tube.Account, period: float, cycles: int) -> dict[str, np.ndarray]:
    """Of each cycle: the most that has gone past the station, what a cycle leaves there, and the
    most that it leaves past any section."""
    found = {"stroke": [], "net": [], "net_within": []}
    for k in range(cycles):
        inside = (run.tau >= k * period * (1 - 1e-9)) & (run.tau <= (k + 1) * period * (1 + 1e-9))
        station, passed = run.station[inside], run.passed[inside]
        found["stroke"].append(np.ptp(station))
        found["net"].append(station[-1] - station[0])
        found["net_within"].append((passed[-1] - passed[0]).max())
    return {key: np.array(value) for key, value in found.items()}


def tubes(gel, shape: Mapping, settings: Mapping, numerics: Mapping) -> xr.Dataset:
    """A tube (ell and the cycles of ``settings``, eps and Le of ``shape``) whose end is heated and
    cooled, for each of the periods: dims (period, moment) and (period, cycle).

    Uncertainties are those of half the slices and four times the tolerance; ``station_second`` is
    the solution of `gelpump.second_solvers.tube_cycles`.
    """
    one = Tubes(settings["ell"], shape["eps"], gel.M, gel.Pi_ratio, gel.Phi_inf)
    cycles, outputs, Le = settings["cycles"], settings["outputs"], shape["Le"]
    columns: dict[str, list] = {}
    for period in settings["periods"]:
        programme = Programme.cycles(COLD, HOT, period, cycles)
        tau = np.linspace(0.0, period * cycles, outputs * cycles + 1)
        fine, coarse = (
            tube.solve(
                one, programme, Le, tau, closure=CLOSURE,
                cell=numerics["cell"] * coarser, tolerance=numerics["tolerance"] * coarser**2,
            )
            for coarser in (1, 2)
        )  # fmt: skip
        second, *_ = tube_cycles.solve(
            tau, programme.breaks, settings["ell"], shape["eps"], gel.M, gel.Pi_ratio,
            gel.Phi_inf, Le, node=numerics["node"], rtol=numerics["rtol"],
        )  # fmt: skip
        here = {
            "elapsed": tau,
            "station": fine.station,
            "station_uncertainty": SAFETY / 3 * np.abs(fine.station - coarse.station),
            "station_second": second,
            "lumen": fine.lumen,
            "water_balance_error": fine.imbalance,
        }
        numbers, others = (per_cycle(run, period, cycles) for run in (fine, coarse))
        for key, value in numbers.items():
            here |= {key: value, f"{key}_uncertainty": SAFETY / 3 * np.abs(value - others[key])}
        here["stroke_second"] = [
            np.ptp(second[k * outputs : (k + 1) * outputs + 1]) for k in range(cycles)
        ]
        for key, value in here.items():
            columns.setdefault(key, []).append(value)
    texts = {
        "elapsed": ("moment", "elapsed time", "in units of mu_l L^2/(k Pi_00)"),
        "station": ("moment", "water that has gone past a fixed station far ahead", VOLUME),
        "station_second": ("moment", "the same by the second solver", VOLUME),
        "lumen": ("moment", "volume that the lumen has lost", VOLUME),
        "water_balance_error": (None, "water that the books do not account for, over the loss", ""),
        "stroke": ("cycle", "water that a cycle moves to and fro past the station", VOLUME),
        "stroke_second": ("cycle", "the same by the second solver", VOLUME),
        "net": ("cycle", "water that a cycle leaves past the station", VOLUME),
        "net_within": ("cycle", "most that a cycle leaves past any section of the wall", VOLUME),
    }
    data = {}
    for key, (dim, text, comment) in texts.items():
        dims = ("period", *filter(None, [dim]))
        data[key] = variable(dims, np.array(columns[key]), text, comment)
        if f"{key}_uncertainty" in columns:
            data[f"{key}_uncertainty"] = variable(
                dims, np.array(columns[f"{key}_uncertainty"]), f"numerical uncertainty: {text}",
                comment,
            )  # fmt: skip
    return xr.Dataset(
        data,
        coords={
            "period": variable("period", settings["periods"], "period of the heating",
                               "in units of mu_l L^2/(k Pi_00)"),
            "cycle": variable("cycle", np.arange(1, cycles + 1), "number of the cycle"),
        },
    )  # fmt: skip
