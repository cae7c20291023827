"""Diffuse beads towards the sharp limit: each number against the width of the interface.

A number q of a bead with interfaces is taken to be q_0 + c width^p: three widths give q_0 and p.
Its uncertainty is its distance from the line through the two least widths.  Where the three are not
so (p outside ORDERS), q_0 is that of the line, and its uncertainty the line's correction.
"""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump.bead.dataset import LENGTH, TIME
from gelpump.netcdf import variable
from gelpump.separation.observed import PASSAGES, passage

if TYPE_CHECKING:
    import xarray as xr

ORDERS = 0.3, 3.0
BETWEEN = 0.1, 0.9  # dry radii of a front between which two solvers are compared
SHARP_SHARE = 2e-3  # of a number of the sharp front, its uncertainty

AT = ("passage_radius",)
NUMBERS = {
    "passage": (AT, "when the front is there", TIME),
    "travel": ((), "time of the front from the first dry radius to the last", TIME),
    "completion": ((), "when the front is at the centre", TIME),
    "radius": (AT, "radius of the bead when the front is there", LENGTH),
    "core": (AT, "mean polymer fraction inside the front when it is there", ""),
    "skin": (AT, "mean polymer fraction outside the front when it is there", ""),
    "energy": (AT, "energy over 4 pi when the front is there", "in mu_s(1) R_dry^3"),
}


def numbers(run: "xr.Dataset") -> dict[str, NDArray]:
    """NUMBERS of one run; ValueError if its front does not pass them all."""
    t = np.array([passage(run, R) for R in PASSAGES])
    if not np.isfinite(t).all() or "completion_t" not in run.attrs:
        raise ValueError(f"the front is at R = {PASSAGES} at t = {t}: it must pass them, and end")
    there = run.front_present.values > 0
    polymer = run.front_dry_radius.values[there] ** 3
    a, inside = run.radius.values[there], run.front_radius.values[there] ** 3
    courses = {
        "radius": a,
        "core": polymer / inside,
        "skin": (1 - polymer) / (a**3 - inside),
        "energy": run.energy.values[there],
    }
    return {
        "passage": t,
        "travel": t[-1] - t[0],
        "completion": np.float64(run.attrs["completion_t"]),
        **{name: np.interp(t, run.t.values[there], each) for name, each in courses.items()},
    }


def at_zero(width: NDArray, q: NDArray) -> tuple[float, float, float]:
    """(q_0, its uncertainty, p) from three widths, the least last; p = 0 where there is none."""
    from scipy.optimize import brentq

    line = q[2] + (q[2] - q[1]) * width[2] / (width[1] - width[2])

    def excess(p):
        first, second, third = width**p
        return (first - second) * (q[1] - q[2]) - (q[0] - q[1]) * (second - third)

    if (q[0] - q[1]) * (q[1] - q[2]) <= 0 or excess(ORDERS[0]) * excess(ORDERS[1]) >= 0:
        return float(line), float(abs(line - q[2])), 0.0
    p = brentq(excess, *ORDERS)
    _, second, third = width**p
    q_0 = q[2] - (q[1] - q[2]) * third / (second - third)
    return float(q_0), float(abs(q_0 - line)), float(p)


def towards(runs: "list[xr.Dataset]", sharp: "xr.Dataset | None") -> "xr.Dataset":
    """Dims (width, passage_radius): NUMBERS of three diffuse ``runs``, the least width last, at
    width 0 with uncertainty and order, and (if there is one) of the ``sharp`` front: ``agrees`` is
    whether they are one within both uncertainties.
    """
    import xarray as xr

    width = np.array([run.attrs["width"] for run in runs])
    tables = [numbers(run) for run in runs]
    expected = numbers(sharp) if sharp is not None else {}
    found = {}
    for name, (dims, text, comment) in NUMBERS.items():
        q = np.array([table[name] for table in tables])
        limits = np.array([at_zero(width, each) for each in q.reshape(len(runs), -1).T])
        limit, doubt, order = limits.T.reshape(3, *q.shape[1:])
        found |= {
            name: variable(("width", *dims), q, text, comment),
            f"{name}_at_zero": variable(dims, limit, f"{text}, at width 0", comment),
            f"{name}_at_zero_uncertainty": variable(
                dims, doubt, f"numerical uncertainty: {text}, at width 0"
            ),
            f"{name}_order": variable(dims, order, f"order in the width, or 0: {text}"),
        }
        if expected:
            apart = np.abs(limit - expected[name])
            agrees = apart <= doubt + SHARP_SHARE * np.abs(expected[name])
            found |= {
                f"{name}_sharp": variable(dims, expected[name], f"{text}, sharp front", comment),
                f"{name}_agrees": variable(dims, agrees.astype(float), f"whether one: {text}"),
            }
    return xr.Dataset(
        found,
        coords={
            "width": variable("width", width, "width of a flat interface at l_t = 2", LENGTH),
            "passage_radius": variable("passage_radius", list(PASSAGES), "dry radius", LENGTH),
        },
        attrs={key: runs[-1].attrs[key] for key in ("model", "gel", "temperature", "phi_initial")},
    )


def between_solvers(run: "xr.Dataset", other: "xr.Dataset") -> dict[str, float]:
    """Largest differences of two solvers of one diffuse bead, of its radius and of its front's dry
    radius, while that goes from R = 0.9 to 0.1."""
    front, there = run.front_dry_radius, run.front_present * other.front_present > 0
    within = there & (front > BETWEEN[0]) & (front < BETWEEN[1])
    return {
        "radius_between_solvers": float(abs(run.radius - other.radius)[within].max()),
        "front_between_solvers": float(abs(front - other.front_dry_radius)[within].max()),
    }
