"""A design's temperature programme: read from its file, solved, and told in SI units.

`programme` holds `steps`, each `{to: temperature, at: time}`, and `within`, a time, for a ramp;
with `period` and `cycles` they repeat. Before the first step a device is at T_C - Delta T. A bead
has the programme's temperature throughout (LENS), a tube at its heated end (`gelpump.cycles`): with
the gel's own D and phi_0(T) where it has an energy, else the two states either side of T_C.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gelpump.design import units
from gelpump.design.refined import variable
from gelpump.design.result import Result
from gelpump.uncertainty import convergence_index

if TYPE_CHECKING:
    from gelpump.cycles.programme import Programme
    from gelpump.design.description import Design

OUTPUTS = 60  # times a period
LEVELS = ((1.0, 4e-2), (0.5, 1e-2), (0.25, 2.5e-3))  # slices in w and tolerances of tubes
SHELLS = ((24, 4e-5), (48, 1e-5), (96, 2.5e-6))  # and of beads
SOURCE = "gelpump.cycles"


@dataclass(frozen=True)
class Cycles:
    """T(t) in K and s, its period and how often it repeats (one cycle if it does not)."""

    temperature: Programme
    period: float
    count: int


def read(block: Mapping[str, Any], T_start: float) -> tuple[Cycles | None, list[str]]:
    """The programme of a design's block that its schema lets pass; what is wrong with it."""
    from gelpump.cycles.programme import Programme

    if "programme" not in block:
        return None, []
    given, problems = block["programme"], []

    def quantity(key, text, unit, example) -> float:
        try:
            return units.si(units.parsed(text, unit), unit)
        except Exception as problem:  # pint raises many things at units it does not know
            problems.append(
                f"programme.{key} = {text!r}: {problem}; must be a quantity in {unit} or the like, "
                f"such as {example!r}"
            )
            return np.nan

    knots, T, last = [], T_start, 0.0
    for i, step in enumerate(given["steps"]):
        to = quantity(f"steps.{i}.to", step["to"], "K", "35 degC")
        at = quantity(f"steps.{i}.at", step["at"], "s", "30 s")
        within = quantity(f"steps.{i}.within", step.get("within", "0 s"), "s", "5 s")
        if at < last or within < 0:
            problems.append(
                f"programme.steps.{i}: at = {step['at']!r}, within = {step.get('within')!r}: must "
                f"begin at {last:g} s or later, where the step before has ended"
            )
        if to <= 0:
            problems.append(f"programme.steps.{i}.to = {step['to']!r}: must be above 0 K")
        knots.append((at, at + within, to))
        last = at + within
    repeats = [key for key in ("period", "cycles") if key in given]
    if len(repeats) == 1:
        problems.append(
            f"programme: has {repeats[0]} only: must have period and cycles, or neither"
        )
    period, count = last, int(given.get("cycles", 1))
    if "period" in given:
        period = quantity("period", given["period"], "s", "60 s")
        if period < last or not period > 0:
            problems.append(
                f"programme.period = {given['period']!r}: must be at least {last:g} s, when the "
                "last step has ended"
            )
    elif last == 0:
        problems.append("programme: all is at 0 s: must have a period and cycles, or a later step")
    if problems:
        return None, problems
    whole = []
    for k in range(count):
        for begin, end, to in knots:
            whole += [(k * period + begin, T), (k * period + end, to)]
            T = to
    # what repeats ends where the last period does
    if count * period > whole[-1][0]:
        whole.append((count * period, T))
    kept = [each for i, each in enumerate(whole) if not i or each != whole[i - 1]]
    try:
        return Cycles(Programme(T_start, tuple(kept)), period, count), []
    except ValueError as refusal:
        return None, [str(refusal)]


def range_problems(cycles: Cycles, material: Any) -> Iterator[str]:
    """What a gel says of the programme's temperatures."""
    if not material.energy_based:
        return
    low, high = material.gel.temperature_range
    for T in cycles.temperature.extremes:
        if not low <= T <= high:
            yield (
                f"programme: T = {T:g} K: must be within {low:g} to {high:g} K, the range of gel = "
                f"{material.name!r}"
            )


def solved(design: Design) -> tuple[dict[str, Any], list[Result], str]:
    """Variables (dim moment), numbers with their uncertainty, and what is to be said."""
    return (_tube if design.kind == "tube" else _bead)(design)


def parted(lost: tuple, second: float, L: float) -> str:
    """When and where D < 0 was met in a tube, in words."""
    when, where, state = lost
    t, z = (units.shown(value, unit) for value, unit in ((second * when, "s"), (L * where, "m")))
    return (
        f"phases separate after {units.told(t[0])} {units.readable(t[1])} at "
        f"z = {units.told(z[0])} {units.readable(z[1])}, "
        f"φ = {units.told(state.polymer_fraction)}, {state.temperature:.2f} K: D < 0"
    )


def _times(cycles):
    return np.linspace(0.0, cycles.period * cycles.count, OUTPUTS * cycles.count + 1)


def _scaled(programme, second, T_C=0.0, step=1.0):
    from gelpump.cycles.programme import Programme

    return Programme(
        (programme.start - T_C) / step,
        tuple((t / second, (T - T_C) / step) for t, T in programme.knots),
    )


def _results(numbers, texts, unit):
    return [
        Result(key, text, "", numbers[1][key], unit, SOURCE,
               float(convergence_index(*(each[key] for each in numbers))))
        for key, text in texts.items()
    ]  # fmt: skip


def _variables(design, times, name, values, unit, text):
    T = [design.programme.temperature.at(t) for t in times]
    return {
        "programme_elapsed": variable("moment", times, "s", "elapsed time of the programme"),
        "programme_temperature": variable("moment", T, "K", "temperature of the programme"),
        name: variable("moment", values, unit, text),
    }


def _tube(design):
    from gelpump.cycles import production, tube
    from gelpump.design.device import lewis_number, scales, tubes

    cycles, scale, Le = design.programme, scales(design), lewis_number(design)
    second, a_1, L = (units.si(scale[key], unit) for key, unit in
                      (("time", "s"), ("across", "m"), ("along", "m")))  # fmt: skip
    own = design.material.gel if design.material.energy_based else None
    T_C, step = 0.5 * (design.T_hot + design.T_cold), 0.5 * (design.T_hot - design.T_cold)
    programme = (
        _scaled(cycles.temperature, second, T_C, step)
        if own is None
        else _scaled(cycles.temperature, second)
    )
    tau, volume = _times(cycles) / second, np.pi * a_1**2 * L
    runs = [
        tube.solve(tubes(design), programme, Le, tau, gel=own, cell=cell, tolerance=tolerance)
        for cell, tolerance in LEVELS
    ]
    fine = runs[1]
    data = _variables(design, _times(cycles)[: fine.tau.size], "programme_pumped",
                      volume * fine.station, "m^3",
                      "water that has gone past a station far ahead, water conserved")  # fmt: skip
    if fine.lost:
        return data, [], f"Of the programme: {parted(fine.lost, second, L)}; it ends there."
    numbers = []
    for run in runs:
        per = production.per_cycle(run, cycles.period / second, cycles.count)
        numbers.append({key: volume * float(value[-1]) for key, value in per.items()})
        numbers[-1]["net_all"] = volume * float(run.station[-1])
    named = [{f"cycle_{key}": value for key, value in each.items()} for each in numbers]
    found = _results(
        named,
        {
            "cycle_stroke": "volume to and fro past a station, last cycle",
            "cycle_net": "volume left past a station by the last cycle",
            "cycle_net_all": f"volume left past a station by all {cycles.count} cycles",
            "cycle_net_within": "most left past any section by the last cycle",
        },
        "m^3",
    )
    return (
        data,
        found,
        (
            "Of the programme: what a cycle leaves past a station far ahead tends to nothing as "
            "cycles repeat, whatever the gel; what it moves to and fro does not."
        ),
    )


def _bead(design):
    from gelpump.cycles import bead
    from gelpump.design.device import scales

    cycles, scale = design.programme, scales(design)
    second, R_dry = units.si(scale["time"], "s"), units.si(scale["along"], "m")
    times = _times(cycles)
    programme = _scaled(cycles.temperature, second)
    runs = [
        bead.solve(design.material.gel, programme, times / second, shells,
                   tolerance=tolerance, model="lens")
        for shells, tolerance in SHELLS
    ]  # fmt: skip
    fine = runs[1]
    data = _variables(design, second * fine.t, "programme_radius", R_dry * fine.radius, "m",
                      "radius of the bead along the programme")  # fmt: skip
    if fine.lost:
        return (
            data,
            [],
            (
                f"Of the programme: phases separate at {fine.lost} (lengths in R_dry, times in "
                "t_BMJ); it ends there."
            ),
        )
    last = times >= times[-1] - cycles.period * (1 + 1e-9)
    numbers = [
        {"cycle_least_radius": R_dry * float(run.radius[last].min()),
         "cycle_largest_radius": R_dry * float(run.radius[last].max())}
        for run in runs
    ]  # fmt: skip
    texts = {
        "cycle_least_radius": "least radius in the last cycle",
        "cycle_largest_radius": "largest radius in the last cycle",
    }
    return data, _results(numbers, texts, "m"), ""
