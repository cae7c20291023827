"""How accurate a sweep is: some of its designs, drawn at random, solved again and much finer."""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.sweep.solving import OUTPUTS, REFINED, solve_designs

FINER = {"cells": 4, "tolerance": 10}


def subset(sweep: Mapping, count: int) -> np.ndarray:
    """Places of the designs that are solved again, sorted."""
    wanted = min(sweep["accuracy"]["designs"], count)
    rng = np.random.default_rng([sweep["seed"], 1])
    return np.sort(rng.choice(count, wanted, replace=False))


def errors(coarse: xr.Dataset, sweep: Mapping) -> xr.Dataset:
    """Relative error of each output of the designs `coarse`, against the finer solutions."""
    numerics = sweep["numerics"]
    fine = solve_designs(
        coarse[["ell", "M", "Pi_ratio", "Phi_inf", "eps", "Le", "design"]],
        sweep["tau"],
        {
            **numerics,
            "cells": [FINER["cells"] * n for n in numerics["cells"]],
            "tolerance": numerics["tolerance"] / FINER["tolerance"],
        },
    )
    compared = ((coarse.status <= REFINED) & (fine.status <= REFINED)).values
    data = {}
    for name, (text, _) in OUTPUTS.items():
        relative = np.abs(coarse[name] / fine[name] - 1).values[compared]
        data[f"error_{name}"] = variable(
            ("index", "tau"), relative, f"relative error of {text}, against a finer mesh"
        )
    kept = fine[["ell", "M", "Pi_ratio", "Phi_inf", "eps", "Le", "design"]]
    made = kept.isel(index=compared).assign(data).assign_coords(tau=fine.tau)
    worst = max(float(made[name].max()) for name in data) if compared.any() else 0.0
    made["largest_error"] = variable((), worst, "largest relative error of all outputs")
    made["allowed_error"] = variable((), float(sweep["accuracy"]["error"]), "error asked for")
    made["not_compared"] = variable((), int((~compared).sum()), "designs without two solutions")
    return made
