"""Production and refinement runs of a bead case, and what is measured along each of them."""

import logging
from collections.abc import Callable, Mapping, Sequence
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from gelpump.coordinates import merged
from gelpump.uncertainty import convergence_index

if TYPE_CHECKING:
    import xarray as xr

    from gelpump.materials import Gel

Meshes = tuple[Sequence[int], float]
"""Numbers of cells, and the time tolerance that runs with these have in common."""

MEASURED = ("radius", "surface_polymer_fraction", "smallest_diffusivity", "steepest_gradient")
TOLERANCE_FACTOR = 4.0
LOG = logging.getLogger(__name__)


def output_times(case: Mapping, count: int) -> np.ndarray:
    """Zero, the case's published and profile times, and ``count`` others, dense early and late.

    A third of them are spaced evenly in log t, to show the singular start; the others in sqrt(t).
    """
    end, early = case["end"], count // 3
    return merged(
        [0.0, *case["published_times"], *case["profile_times"]],
        end * np.linspace(0.0, 1.0, count - early + 1)[1:] ** 2,
        np.geomspace(1e-6 * end, end, early + 1)[:-1],
    )


def initial_polymer_fraction(gel: "Gel", case: Mapping[str, Any]) -> float:
    """phi_initial of a bead's config block: as given, or in equilibrium at temperature_initial.

    Raises ValueError when there is no such equilibrium, or when no surface is stress-free at the
    final temperature.
    """
    if "phi_initial" not in case:
        return gel.equilibrium_polymer_fraction(case["temperature_initial"], case["branch"])
    phi, T = case["phi_initial"], case["temperature_final"]
    if not gel.diffusivity(phi, T) > 0.0:
        raise ValueError(f"phi_initial = {phi}: D < 0 at {T} K, phases separate at once")
    return phi


def start(gel, case: Mapping, numerics: Mapping) -> tuple[float, float, np.ndarray]:
    """Temperature after the jump, initial polymer fraction and output times of a case."""
    return (
        case["temperature_final"],
        initial_polymer_fraction(gel, case),
        output_times(case, numerics["output_times"]),
    )


def run(
    model: ModuleType, gel: "Gel", case: Mapping[str, Any], numerics: Mapping[str, Any]
) -> tuple["xr.Dataset", "xr.Dataset"]:
    """A bead of the configuration and its refinement, as `refined` gives them.

    model: `gelpump.bead.lens` or `gelpump.bead.nonlinear`.  case: a block of ``beads`` of the
    configuration (temperatures in K, times in t_BMJ).  numerics: ``cells``, ``tolerance`` and the
    number of ``output_times``.
    """
    temperature, phi_initial, times = start(gel, case, numerics)

    def runs(asked: Sequence[Meshes]) -> list["xr.Dataset"]:
        made = []
        for cells, tolerance in asked:
            beads = model.solve_meshes(
                gel, temperature, phi_initial, times, cells, tolerance=tolerance
            )
            LOG.info("%s cells, tolerance %g: %s", cells, tolerance, beads[0].attrs)
            made += [measured(bead, gel, temperature) for bead in beads]
        return made

    return refined(runs, numerics["cells"], numerics["tolerance"])


def measured(bead: "xr.Dataset", gel, temperature: float) -> "xr.Dataset":
    """``bead`` with the smallest D over the polymer fractions that its profile passes through,
    in units of k mu / mu_l, and with the steepest gradient |phi_r|, in 1 / R_dry, at each time."""
    phi = np.column_stack([bead.polymer_fraction, bead.surface_polymer_fraction])
    r = np.column_stack([bead.r, bead.radius])
    share = np.linspace(0.0, 1.0, 401)
    low, high = phi.min(axis=1, keepdims=True), phi.max(axis=1, keepdims=True)
    D = gel.diffusivity(low + (high - low) * share, temperature) / gel.shear_modulus(1.0)
    steepest = np.abs(np.diff(phi, axis=1) / np.diff(r, axis=1)).max(axis=1)
    attrs = {"units": "1"}
    return bead.assign(
        smallest_diffusivity=(
            "t",
            D.min(axis=1),
            attrs | {"long_name": "smallest polymer diffusivity over the profile's fractions"},
        ),
        steepest_gradient=(
            "t",
            steepest,
            attrs | {"long_name": "largest radial gradient of the polymer fraction"},
        ),
    )


def refined(
    runs: Callable[[Sequence[Meshes]], list["xr.Dataset"]], cells: int, tolerance: float
) -> tuple["xr.Dataset", "xr.Dataset"]:
    """A case, and beside it on half and twice the cells and with tolerances four times looser and
    tighter.

    runs(list of (list of cells, tolerance)) makes a run for each number of cells, those of one
    list with time steps that they may share.  The first dataset is the production run.  The second
    has the dims (level, t), level 0 being production; ``NAME_uncertainty(t)`` adds the estimated
    errors of space and time.  Runs that stop early are compared up to the first one's stop.
    """
    asked = [
        ([cells, cells // 2, 2 * cells], tolerance),
        ([cells], TOLERANCE_FACTOR * tolerance),
        ([cells], tolerance / TOLERANCE_FACTOR),
    ]
    levels = [(mesh, common) for meshes, common in asked for mesh in meshes]
    made = runs(asked)
    return made[0], compared(levels, made)


def compared(levels: Sequence[tuple[int, float]], runs: Sequence["xr.Dataset"]) -> "xr.Dataset":
    """The measured time series of ``runs`` side by side, with their uncertainties."""
    import xarray as xr

    stops = [run.attrs.get("stopped_t", np.inf) for run in runs]
    times = runs[0].t.values[runs[0].t.values < min(stops)]
    attrs = {"units": "1"}
    data = {}
    for name in MEASURED:
        long_name = runs[0][name].attrs["long_name"]
        values = np.array([run[name].sel(t=times).values for run in runs])
        space = convergence_index(values[1], values[0], values[2])
        time = convergence_index(values[3], values[0], values[4])
        data[name] = (("level", "t"), values, attrs | {"long_name": long_name})
        data[f"{name}_uncertainty"] = (
            "t",
            space + time,
            attrs | {"long_name": f"numerical uncertainty: {long_name}"},
        )
    if np.isfinite(stops).all():
        space = convergence_index(stops[1], stops[0], stops[2])
        time = convergence_index(stops[3], stops[0], stops[4])
        data["stop_time"] = (
            "level",
            np.array(stops),
            attrs | {"long_name": "time at which phases begin to separate"},
        )
        data["stop_time_uncertainty"] = (
            (),
            space + time,
            attrs | {"long_name": "numerical uncertainty: time at which phases begin to separate"},
        )
    return xr.Dataset(
        data,
        coords={
            "t": ("t", times, runs[0].t.attrs),
            "cells": (
                "level",
                [cells for cells, _ in levels],
                attrs | {"long_name": "number of shells"},
            ),
            "tolerance": (
                "level",
                [tolerance for _, tolerance in levels],
                attrs | {"long_name": "time tolerance"},
            ),
        },
    )
