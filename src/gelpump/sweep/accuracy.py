"""How accurate a sweep is: some of its designs, drawn at random, solved again and much finer."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.sweep.solving import OUTPUTS, REFINED, solve_designs

FINER = {"cells": 4, "tolerance": 10}
DESIGN = ["ell", "M", "Pi_ratio", "Phi_inf", "eps", "Le", "design"]


def subset(sweep: Mapping, count: int) -> np.ndarray:
    """Places of the designs that are solved again, sorted."""
    wanted = min(sweep["accuracy"]["designs"], count)
    rng = np.random.default_rng([sweep["seed"], 1])
    return np.sort(rng.choice(count, wanted, replace=False))


def errors(coarse: xr.Dataset, sweep: Mapping) -> xr.Dataset:
    """Relative error of each output of the designs `coarse`, against the finer solutions.

    Designs that the sweep itself flags, as failed or doubtful, are not compared. Those of the rest
    without a finer solution are counted as unconfirmed.
    """
    numerics = sweep["numerics"]
    fine = solve_designs(  # by pulses, whatever gave the designs
        coarse[DESIGN],
        sweep["tau"],
        {
            **numerics,
            "cells": [FINER["cells"] * n for n in numerics["cells"]],
            "tolerance": numerics["tolerance"] / FINER["tolerance"],
        },
    )
    accepted = (coarse.status <= REFINED).values
    compared = accepted & (fine.status <= REFINED).values
    data = {}
    for name, (text, _) in OUTPUTS.items():
        relative = np.abs(coarse[name] / fine[name] - 1).values[compared]
        data[f"error_{name}"] = variable(
            ("index", "tau"), relative, f"relative error of {text}, against a finer mesh"
        )
    made = fine[DESIGN].isel(index=compared).assign(data).assign_coords(tau=fine.tau)
    made["allowed_error"] = variable((), float(sweep["accuracy"]["error"]), "error asked for")
    made["flagged"] = variable((), int((~accepted).sum()), "designs that the sweep itself flags")
    made["unconfirmed"] = variable(
        (), int((accepted & ~compared).sum()), "designs without a finer solution"
    )
    return made


def verdict(found: xr.Dataset) -> tuple[bool, str]:
    """Whether the accuracy asked for is reached, and the largest error in words.

    It is not if no design could be compared, or one that the sweep accepts was not confirmed.
    """
    unconfirmed, flagged = int(found.unconfirmed), int(found.flagged)
    compared, allowed = found.sizes["index"], float(found.allowed_error)
    told = f"{flagged} flagged by the sweep, {unconfirmed} unconfirmed by a finer solution"
    if not compared:
        return not (flagged or unconfirmed), f"no design was compared: {told}"
    largest = {name: found[f"error_{name}"].argmax(["index", "tau"]) for name in OUTPUTS}
    errors = {name: float(found[f"error_{name}"].isel(at)) for name, at in largest.items()}
    name = max(errors, key=errors.get)
    worst = found.isel(largest[name])
    design = ", ".join(f"{key} = {float(worst[key]):.4g}" for key in DESIGN[:-1])
    passed = errors[name] <= allowed and not unconfirmed
    return passed, (
        f"{compared} designs solved again: largest relative error {errors[name]:.2e} "
        f"({name} at tau = {float(worst.tau):g} of design {int(worst.design)}: {design}), "
        f"allowed {allowed:.1e}; {told}"
    )
