"""Tubes whose end is heated and cooled again and again: beyond the paper (docs/programmes.md)."""

import numpy as np

from gelpump.statements.statement import Collection, Computed

statements = Collection()
states = statements.states
CYCLES, NEEDS = "cycle_tube", "gelpump.cycles.tube"


@states("beyond-cycle-left", NEEDS, f"{CYCLES}: net, stroke")
def left(e):
    """What the last cycle of the longest period leaves past a station far ahead, over what it moves
    to and fro there, is nothing: the wall conserves water, and gives a fixed share to the lumen."""
    if CYCLES not in e.data:
        return None
    last = e.data[CYCLES].isel(period=-1, cycle=-1)
    within = float(last.net_within / last.stroke)
    return Computed(
        float(last.net / last.stroke),
        float(last.net_uncertainty / last.stroke),
        within,
        "left past a section that the front comes near, at most:",
        paper={"value": 0.0, "resolution": 1e-4},
    )


@states("beyond-cycle-stroke", NEEDS, f"{CYCLES}: stroke, stroke_second")
def stroke(e):
    """What the last cycle moves past the station is the same by a second solver, in the laboratory
    frame: over it, 1, for each period."""
    if CYCLES not in e.data:
        return None
    last = e.data[CYCLES].isel(cycle=-1)
    balance = float(last.water_balance_error.max())
    return Computed(
        (last.stroke_second / last.stroke).values,
        (last.stroke_uncertainty / last.stroke).values,
        balance,
        "water that the books do not account for:",
        paper={"value": 1.0, "resolution": 1e-3},
    )


@states("beyond-cycle-root", NEEDS, f"{CYCLES}: stroke, period")
def root(e):
    """What the first cycle moves grows as the root of the period, as the front's reach does: the
    exponent between the two longest is 1/2."""
    if CYCLES not in e.data or e.data[CYCLES].sizes["period"] < 2:
        return None
    first = e.data[CYCLES].isel(cycle=0, period=slice(-2, None))
    run = np.diff(np.log(first.period.values))[0]
    slope = np.diff(np.log(first.stroke.values))[0] / run
    doubt = float((first.stroke_uncertainty / first.stroke).sum()) / run
    return Computed(float(slope), doubt, paper={"value": 0.5, "resolution": 0.02})
