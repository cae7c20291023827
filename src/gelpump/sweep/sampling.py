"""The designs of a sweep, in the order in which they are solved.

Steps in time are shared by the tubes of a chunk, and a tube's own times are w^2 with
w = eps (1-ell)/4: designs are sorted by w, so that the tubes of a chunk agree about the steps.
`design` is the number of a design in the order of its grid, its sequence or Sobol's scheme.
"""

from collections.abc import Callable, Mapping
from itertools import product

import numpy as np
import xarray as xr

from gelpump.netcdf import variable
from gelpump.sweep.plan import PARAMETERS, designs

MEANING = {
    "ell": "ratio of inner to outer radius, a_0/a_1",
    "M": "shear modulus over the osmotic pressure scale when cold",
    "Pi_ratio": "osmotic pressure scale when hot over that when cold",
    "Phi_inf": "equilibrium polymer fraction when hot over that when cold",
    "eps": "slenderness a_1/L",
    "Le": "Lewis number, kappa/D",
}


def sample(sweep: Mapping) -> xr.Dataset:
    """The parameters of all designs, sorted by w, dimension `index`.

    Column by column, so that beside the result there are never more than a few of them.
    """
    column = _columns(sweep)
    order = np.argsort(column("eps") * (1 - column("ell")), kind="stable")
    data = {key: variable("index", column(key)[order], MEANING[key]) for key in PARAMETERS}
    data["design"] = variable("index", order.astype(np.int32), "number of the design")
    return xr.Dataset(data)


def _columns(sweep) -> Callable[[str], np.ndarray]:
    """What gives all values of a parameter, in the order of the numbers of the designs."""
    varied, count = sweep["parameters"], designs(sweep)
    if sweep["method"] == "grid":
        values = np.array(list(product(*varied.values())), float)
    elif sweep["method"] == "sobol":
        from SALib.sample import sobol

        values = sobol.sample(
            problem(sweep), sweep["samples"], calc_second_order=False, seed=sweep["seed"]
        )

    def column(key):
        if key not in varied:
            return np.full(count, float(sweep["fixed"].get(key, PARAMETERS[key][0])))
        place = list(varied).index(key)
        if sweep["method"] == "grid":
            return values[:, place]
        if sweep["method"] == "sobol":
            return _scaled(values[:, place], varied[key])
        return _scaled(_latin(count, [sweep["seed"], place]), varied[key])

    return column


def _latin(count, seed):
    """A column of a latin hypercube: one number in each of `count` slices of (0, 1), shuffled."""
    rng = np.random.default_rng(seed)
    column = rng.random(count)
    column += np.arange(count)
    column /= count
    rng.shuffle(column)
    return column


def problem(sweep: Mapping) -> dict:
    """What SALib asks for: indices are those of the unit cube, whatever the spacing."""
    names = list(sweep["parameters"])
    return {"num_vars": len(names), "names": names, "bounds": [[0.0, 1.0]] * len(names)}


def _scaled(unit, block):
    low, high = block["between"]
    if block.get("spaced") == "log":
        return low * (high / low) ** unit
    return low + (high - low) * unit
