"""Production runs of the wall that is heated everywhere: how long it takes to collapse."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from scipy.optimize import brentq

from gelpump import progress
from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.netcdf import variable
from gelpump.truth.elements import deformation
from gelpump.truth.gel import two_states
from gelpump.truth.uniform import undeformed, wall
from gelpump.tube.scaling import ell as ell_coordinate
from gelpump.uncertainty import convergence_index

LONGEST = 3.0  # squares of the thickness over D of the swollen gel: no wall takes longer
THICKNESS = "over the square of the swollen wall's thickness, eps^2 (1-ell)^2 in units of tau"


def collapse_time(
    ell: float, gel: PiecewiseLinearGel, cells: int, tolerance: float, c: float = 0.0
) -> tuple[float, float]:
    """tau_99 over the thickness squared: of the middle of the wall, and of the wall's mean.

    When Phi has come within (Phi_inf - 1)/100 of Phi_inf. Also RuntimeError if it does not.
    """
    body = wall(ell, two_states(gel, np.ones(cells, bool), c), cells, tolerance)
    target = gel.Phi_inf - (gel.Phi_inf - 1) / 100
    swollen = (1 - ell**2) / 2

    def middle(y):
        fields = body.fields(y[: body.size])
        seen = {name: body.elements.at_points(name, fields[name], True) for name in "rzRZ"}
        F, _ = deformation(seen)
        return (1 / F.J)[np.isclose(seen["R"][0], (1 + ell) / 2)].mean() - target

    def mean(y):
        return swollen / (swollen - y[-2:].sum()) - target

    found = {}
    for step in body.evolve(undeformed(body), LONGEST * (1 - ell) ** 2):
        for reached in (middle, mean):
            if reached not in found and reached(step.solution) >= 0:
                found[reached] = (_root(reached, step) / (1 - ell)) ** 2
        if len(found) == 2:
            return found[middle], found[mean]
    raise RuntimeError(f"ell = {ell}: the wall has not collapsed by {LONGEST} (1-ell)^2")


def _root(function, step):
    return brentq(lambda t: function(step.at(t)), step.start, step.time, xtol=1e-13)


def collapse_times(
    gel: PiecewiseLinearGel, ells: Sequence[float], M: Sequence[float], cells: int, tolerance: float
) -> xr.Dataset:
    """tau_99 of walls of `gel` with other shear moduli; dims (ell, M)."""
    plan = [
        (cells, tolerance, 0.0),
        (cells, 10**0.5 * tolerance, 0.0),
        (cells, 10 * tolerance, 0.0),
        (cells // 2, 10 * tolerance, 0.0),
        (2 * cells, 10 * tolerance, 0.0),
        (cells, 10 * tolerance, 1.0),
    ]
    runs = []
    for i, (n, each, c) in enumerate(plan):
        runs.append(
            [
                [
                    collapse_time(x, PiecewiseLinearGel(gel.Phi_inf, gel.Pi_ratio, m), n, each, c)
                    for m in M
                ]
                for x in ells
            ]
        )
        progress.at(i + 1.0, len(plan))
    best, loose, loosest, coarse, fine, other = np.array(runs)
    error = convergence_index(coarse, loosest, fine) + convergence_index(loosest, loose, best)
    data = {}
    for k, (name, where) in enumerate(
        [("tau99", "the middle of the wall"), ("tau99_mean", "the mean over the wall")]
    ):
        text = f"time until {where} has collapsed to 99 %"
        data |= {
            name: variable(("ell", "M"), best[..., k], text, THICKNESS),
            f"{name}_uncertainty": variable(
                ("ell", "M"), error[..., k], f"numerical uncertainty: {text}", THICKNESS
            ),
            f"{name}_energy": variable(
                ("ell", "M"),
                other[..., k] - loosest[..., k],
                f"{text}: what it gains with the energy's second invariant in place of the first",
                THICKNESS,
            ),
        }
    coords = {
        "ell": ell_coordinate(np.array(ells)),
        "M": variable("M", np.array(M, float), "shear modulus over Pi_00"),
    }
    return xr.Dataset(data, coords)
