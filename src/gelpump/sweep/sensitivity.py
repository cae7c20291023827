"""Sobol's indices of a sweep, by SALib: which parameter decides about an output.

First-order indices are the share of an output's variance that a parameter explains alone, total
ones the share that it takes part in. Intervals are 95 per cent, from a bootstrap. Outputs that
span decades are compared by their logarithm, all of them being positive.
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.sweep.sampling import problem

ANALYSED = ("tau99", "A", "Phi1_front", "V_peak", "pulse_flux")


def indices(sweep: Mapping, dataset: xr.Dataset) -> xr.Dataset:
    """Indices of the logarithms of the outputs, dims (output, tau, parameter).

    ValueError if a design failed: the scheme has no place for holes.
    """
    from SALib.analyze import sobol

    if int((dataset.status == 3).sum()):
        raise ValueError("a design failed; Sobol's scheme needs them all: narrow the parameters")
    ordered = dataset.sortby("design")
    names = list(sweep["parameters"])
    shape = (len(ANALYSED), dataset.sizes["tau"], len(names))
    found = {key: np.zeros(shape) for key in ("S1", "S1_conf", "ST", "ST_conf")}
    for i, output in enumerate(ANALYSED):
        for j in range(shape[1]):
            values = ordered[output].values
            values = np.log(values if values.ndim == 1 else values[:, j])
            result = sobol.analyze(
                problem(sweep), values, calc_second_order=False, seed=sweep["seed"]
            )
            for key, array in found.items():
                array[i, j] = result[key]
    dims = ("output", "tau", "parameter")
    meaning = {
        "S1": "first-order index of the output's logarithm",
        "S1_conf": "half width of its 95 per cent interval",
        "ST": "total index of the output's logarithm",
        "ST_conf": "half width of its 95 per cent interval",
    }
    return xr.Dataset(
        {key: variable(dims, found[key], text) for key, text in meaning.items()},
        coords={
            "output": ("output", np.array(ANALYSED, object), {"long_name": "output"}),
            "parameter": ("parameter", np.array(names, object), {"long_name": "parameter"}),
            "tau": dataset.tau,
        },
    )
