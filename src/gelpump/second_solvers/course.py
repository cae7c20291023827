"""A bead's course by a second solver, and how far it may be from the exact one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gelpump.netcdf import variable

if TYPE_CHECKING:
    import xarray as xr

ORDER = 2  # in space, at least
SAFETY = 1.25  # of the grid-convergence index
COARSER = 10.0  # times looser are the tolerances of the coarse run


class Course(NamedTuple):
    """A bead's radius a at the times t, and where it stopped.

    ``stop`` is None, or the time at which the model ended; the last of t is then before it.
    """

    t: NDArray
    radius: NDArray
    stop: float | None


def observed(
    solve: Callable[..., Course], gel, T, phi_initial, times, cells: int, rtol: float
) -> xr.Dataset:
    """Radius and stop time on two meshes, dim level, with the uncertainty of the first.

    ``solve`` is that of one of the second solvers.  The first mesh has ``cells`` shells or
    elements, the second half as many and looser tolerances, so that the difference of the two holds
    the error of time as well.
    """
    import xarray as xr

    levels = [(cells, rtol), (cells // 2, COARSER * rtol)]
    runs = [solve(gel, T, phi_initial, times, n, rtol=tolerance) for n, tolerance in levels]
    share = SAFETY / (2**ORDER - 1)
    common = min(run.t.size for run in runs)
    radius = np.array([run.radius[:common] for run in runs])
    data = {
        "radius": variable(("level", "t"), radius, "radius of the bead", "lengths in R_dry"),
        "radius_uncertainty": variable(
            "t", share * np.abs(radius[0] - radius[1]), "numerical uncertainty: radius of the bead"
        ),
    }
    stops = [run.stop for run in runs]
    if None not in stops:
        data["stop_time"] = variable("level", stops, "time at which phases begin to separate")
        data["stop_time_uncertainty"] = variable(
            (),
            share * abs(stops[0] - stops[1]),
            "numerical uncertainty: time at which phases begin to separate",
        )
    return xr.Dataset(
        data,
        coords={
            "t": variable("t", runs[0].t[:common], "elapsed time", "t_BMJ"),
            "cells": variable("level", [n for n, _ in levels], "number of shells or elements"),
            "tolerance": variable("level", [rtol for _, rtol in levels], "time tolerance"),
        },
    )
