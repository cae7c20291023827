"""The designs of a sweep, in the order in which they are solved.

Steps in time are shared by the tubes of a chunk, and a tube's own times are w^2 with
w = eps (1-ell)/4: designs are sorted by w, so that the tubes of a chunk agree about the steps.
`design` is the number of a design in the order of its grid, its sequence or Sobol's scheme.
"""

from collections.abc import Mapping
from itertools import product

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.sweep.plan import PARAMETERS

MEANING = {
    "ell": "ratio of inner to outer radius, a_0/a_1",
    "M": "shear modulus over the osmotic pressure scale when cold",
    "Pi_ratio": "osmotic pressure scale when hot over that when cold",
    "Phi_inf": "equilibrium polymer fraction when hot over that when cold",
    "eps": "slenderness a_1/L",
    "Le": "Lewis number, kappa/D",
}


def sample(sweep: Mapping) -> xr.Dataset:
    """The parameters of all designs, sorted by w, dimension `index`."""
    varied = sweep["parameters"]
    if sweep["method"] == "grid":
        values = np.array(list(product(*varied.values())), float)
    else:
        values = _scaled(_unit_cube(sweep), varied)
    columns = dict(zip(varied, values.T, strict=True))
    for key, (default, *_) in PARAMETERS.items():
        if key not in columns:
            columns[key] = np.full(len(values), float(sweep["fixed"].get(key, default)))
    order = np.argsort(columns["eps"] * (1 - columns["ell"]), kind="stable")
    data = {key: variable("index", columns[key][order], MEANING[key]) for key in PARAMETERS}
    data["design"] = variable("index", order.astype(np.int64), "number of the design")
    return xr.Dataset(data)


def _unit_cube(sweep):
    if sweep["method"] == "latin_hypercube":
        from scipy.stats import qmc

        return qmc.LatinHypercube(len(sweep["parameters"]), rng=sweep["seed"]).random(
            sweep["samples"]
        )
    from SALib.sample import sobol

    return sobol.sample(
        problem(sweep), sweep["samples"], calc_second_order=False, seed=sweep["seed"]
    )


def problem(sweep: Mapping) -> dict:
    """What SALib asks for: indices are those of the unit cube, whatever the spacing."""
    names = list(sweep["parameters"])
    return {"num_vars": len(names), "names": names, "bounds": [[0.0, 1.0]] * len(names)}


def _scaled(unit, varied):
    columns = []
    for u, block in zip(unit.T, varied.values(), strict=True):
        low, high = block["between"]
        if block.get("spaced") == "log":
            columns.append(low * (high / low) ** u)
        else:
            columns.append(low + (high - low) * u)
    return np.array(columns).T
