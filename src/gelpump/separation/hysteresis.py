r"""A bead heated and cooled so slowly that it is always at rest: where it jumps.

The uniform bead that no stress holds, phi_0(T), is at rest in both models.  It stays while its
energy E/4 pi = W/3 + w has a minimum there, up to a fold of phi_0(T), although from the temperature
of equal energies on another state has less.  Nothing of that is assumed: the bead with interfaces
(``gelpump.separation.diffuse``, one kappa for all temperatures) is held at one temperature after
another, from the state that it is in, until it rests.  A step of temperature in which the radius
jumps is halved, the bead having come back to the state before, down to a ``resolution``.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump.bead.dataset import LENGTH
from gelpump.netcdf import variable
from gelpump.separation import diffuse, watch
from gelpump.separation.coexistence import equal_area
from gelpump.separation.energy import ENERGIES

if TYPE_CHECKING:
    import xarray as xr

HELD = 3e3  # t_BMJ at a temperature; a bead relaxes in some
AT_REST = 1e-6  # change of the radius in the last half of that, relative, that is rest
JUMP = 0.1  # change of the radius in a step of temperature, relative, that is a jump


class Restless(RuntimeError):
    """A bead that does not come to rest."""


def rest(energy, kappa: float, r: NDArray, cells: int, sides):
    """The radii of the faces at rest, from r on; and the most fronts on the way.

    Every accepted step is watched; UnderResolved if one is not sound, Restless if HELD ends first.
    """
    bead = diffuse.Bead(energy, kappa, cells)
    seen = watch.Watch(sides, layers=True)
    halfway = r[-1]
    for step in diffuse.steps(bead, r, HELD):
        seen.see(step.time, *bead.faces(step.solution), bead.energy_of(step.solution))
        if step.time <= 0.5 * HELD:
            halfway = step.solution[-1]
    if abs(step.solution[-1] / halfway - 1) > AT_REST:
        raise Restless(f"at {energy.temperature} K the bead does not rest within t = {HELD:g}")
    return step.solution, seen.most


def course(
    model: str,
    gel,
    temperatures: Sequence[float],
    cells: int,
    *,
    kappa: float,
    sides: tuple[float, float],
    resolution: float,
) -> tuple[NDArray, NDArray, tuple[float, float], int]:
    """(T, a) at rest, the temperatures between which the bead jumps, and the most fronts.

    temperatures: in order, one way; the bead begins at rest at the first.  Restless unless it jumps
    once.
    """
    r = (
        gel.equilibrium_polymer_fraction(
            temperatures[0], "dry" if temperatures[0] > temperatures[-1] else "swollen"
        )
        ** (-1 / 3)
        * np.linspace(0.0, 1.0, cells + 1)[1:]
    )
    due, known, jumped, most = list(temperatures), [], None, 0
    while due:
        T = due[0]
        found, fronts = rest(ENERGIES[model](gel, T), kappa, r, cells, sides)
        leaps = bool(known) and abs(found[-1] / r[-1] - 1) > JUMP
        if leaps and abs(T - known[-1][0]) > resolution:
            due.insert(0, 0.5 * (T + known[-1][0]))
            continue
        if leaps:
            if jumped is not None:
                raise Restless(f"a second jump, at {T} K")
            jumped = (known[-1][0], T)
        r, most = found, max(most, fronts)
        known.append((due.pop(0), r[-1]))
    if jumped is None:
        raise Restless(f"no jump from {temperatures[0]} to {temperatures[-1]} K")
    T, a = np.array(known).T
    return T, a, jumped, most


def equal_energy(model: str, gel, low: float, high: float) -> float:
    """The temperature between ``low`` and ``high``, two folds, at which swollen and dry beads at
    rest have one energy."""
    from scipy.optimize import brentq

    def excess(T):
        energy = ENERGIES[model](gel, T)
        a = np.array([gel.equilibrium_polymer_fraction(T, each) for each in ("swollen", "dry")])
        a = a ** (-1 / 3)
        E = energy.density(a**-3, a) / 3 + energy.surface_energy(a)
        return float(E[0] - E[1])

    margin = 1e-6 * (high - low)
    return float(brentq(excess, low + margin, high - margin, xtol=1e-9))


def dataset(
    gel,
    temperatures: Sequence[float],
    cells: int,
    *,
    width: float,
    width_at: float,
    resolution: float,
) -> "xr.Dataset":
    """Dims (model, way, step): T and a of both loops, where they jump, the folds, equal energy.

    temperatures: rising, from below the lower fold to above the upper one.  width: of a flat
    interface at hoop stretch 2 and the temperature ``width_at``, which gives kappa.
    """
    import xarray as xr

    models, ways = list(ENERGIES), {"heating": 1, "cooling": -1}
    shape = len(models), len(ways)
    found, jumps, fronts = {}, np.empty((*shape, 2)), np.empty(shape)
    equal = np.empty(len(models))
    folds = np.sort([T for T in gel.folds().temperature if temperatures[0] < T < temperatures[-1]])
    for i, model in enumerate(models):
        energy = ENERGIES[model](gel, width_at)
        fixed = {"kappa": diffuse.kappa_of(energy, width), "resolution": resolution}
        sides = equal_area(energy, watch.WIDTH_AT)
        for j, sign in enumerate(ways.values()):
            T, a, jumps[i, j], fronts[i, j] = course(
                model, gel, list(temperatures)[::sign], cells, sides=sides, **fixed
            )
            found[i, j] = T, a
        equal[i] = equal_energy(model, gel, *folds[[0, -1]])
    # loops have different numbers of steps: the last state is repeated
    count = max(T.size for T, _ in found.values())
    padded = {
        key: [np.pad(x, (0, count - x.size), mode="edge") for x in each]
        for key, each in found.items()
    }
    T, a = (
        np.array([[padded[i, j][k] for j in range(len(ways))] for i in range(len(models))])
        for k in (0, 1)
    )
    kelvin = {"units": "K"}
    loop = ("model", "way", "step")
    return xr.Dataset(
        {
            "temperature": (loop, T, kelvin | {"long_name": "temperature at which the bead rests"}),
            "radius": variable(loop, a, "radius of the bead at rest", LENGTH),
            "jump_temperature": (
                ("model", "way"),
                jumps.mean(axis=-1),
                kelvin | {"long_name": "temperature at which the bead jumps"},
            ),
            "jump_temperature_uncertainty": (
                ("model", "way"),
                0.5 * np.abs(np.diff(jumps))[..., 0],
                kelvin | {"long_name": "numerical uncertainty: half the last step of temperature"},
            ),
            "fronts": variable(("model", "way"), fronts, "most fronts at once while it jumps"),
            "fold_temperature": (
                ("way",),
                folds[::-1],
                kelvin | {"long_name": "fold of phi_0(T) at which the loop should jump"},
            ),
            "equal_energy_temperature": (
                ("model",),
                equal,
                kelvin | {"long_name": "temperature of equal energies, swollen and dry"},
            ),
        },
        coords={
            "model": ("model", models, {"long_name": "model of the bead"}),
            "way": ("way", list(ways), {"long_name": "way of the temperature"}),
        },
        attrs={"gel": gel.name, "cells": cells, "width": width, "width_at": width_at},
    )
