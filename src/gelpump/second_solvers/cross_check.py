"""The production solutions against second ones: do they differ by more than both admit?

A quantity agrees if the largest difference is at most

    limit = min( u_1 + u_2, bound )

with u_1 the uncertainty that refinement of the production runs claims, u_2 that of the second
solver and ``bound`` the most that is allowed whatever is claimed.  Both are grid-convergence
indices that hold a safety factor of 1.25 each; no other is granted.  Uncertainties are the largest
along the course, as the difference is: where a course crosses that of another mesh, its own is an
accident.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.interpolate import CubicSpline

from gelpump.tables import page
from gelpump.uncertainty import convergence_index

if TYPE_CHECKING:
    import xarray as xr

Row = dict[str, Any]

MODELS = {"lens": "LENS", "nonlinear": "fully nonlinear"}

CLOSING = 1e-3  # of the time: the step that FiPy's bead could not make any more (`gelpump.bdf`)


class Disagreement(ArithmeticError):
    """Two solvers differ by more than both claim."""


def row(quantity: str, difference, first, second, bound: float, at: str = "") -> Row:
    """One line of the table: a difference, the uncertainty of either solver, and a verdict."""
    difference, first, second = float(difference), float(first), float(second)
    limit = min(first + second, bound)
    return {
        "quantity": quantity,
        "at": at,
        "difference": difference,
        "uncertainty_first": first,
        "uncertainty_second": second,
        "bound": bound,
        "limit": limit,
        "agrees": bool(difference <= limit),  # false for NaN
    }


def bead_rows(
    case: str,
    first: "xr.Dataset",
    refinement: "xr.Dataset",
    second: "xr.Dataset",
    bounds: Mapping[str, float],
) -> list[Row]:
    """Radius of a bead at all times that both reach, and the time at which phases separate."""
    t = np.intersect1d(first.t, second.t)
    t = t[t < first.attrs.get("stopped_t", np.inf)]
    rows = []
    if t.size and refinement.sizes["t"]:  # else it stops at once
        difference = np.abs(first.radius.sel(t=t).values - second.radius.sel(t=t).values[0])
        rows.append(
            row(
                f"radius, {case}",
                difference.max(),
                refinement.radius_uncertainty.max(),
                second.radius_uncertainty.max(),
                bounds["radius"],
                f"t = {t[difference.argmax()]:.3g}",
            )
        )
    stops = "stopped_t" in first.attrs, "stop_time" in second
    if stops[0] != stops[1]:
        raise Disagreement(f"{case}: production stops: {stops[0]}, the second solver: {stops[1]}")
    if all(stops):
        rows.append(
            row(
                f"stop time, {case}",
                _apart(first, float(second.stop_time[0])),
                # some of the runs do not stop: nothing but the bound is known
                refinement.get("stop_time_uncertainty", bounds["stop_time"]),
                second.stop_time_uncertainty,
                bounds["stop_time"],
            )
        )
    return rows


def _apart(first: "xr.Dataset", stop: float) -> float:
    """Between the stops of the two; FiPy's is within the step that it could not make any more."""
    last = first.attrs["stopped_t"]
    end = (1 + CLOSING) * last if "sweeps" in first.attrs else last
    return max(last - stop, stop - end, 0.0)


def tube_rows(
    first: "xr.Dataset", refinement: "xr.Dataset", second: "xr.Dataset", bound: float
) -> list[Row]:
    """Phi_1 of each tube, in all cells and at the front, at all times of the second solution."""
    first = first.sel(ell=second.ell, tau=second.tau, method="nearest")
    claimed = _profile_uncertainty(refinement.Phi1_difference.values)
    rows = []
    for i, ell in enumerate(second.ell.values):
        there = int(np.abs(refinement.ell.values - ell).argmin())
        profile = [
            _profile_difference(first.isel(ell=i, tau=j), second.isel(ell=i, tau=j))
            for j in range(second.sizes["tau"])
        ]
        front = np.abs(first.Phi1_front.values[i] - second.Phi1_front.values[i])
        for name, found, own, others in (
            ("Phi_1", np.array(profile), claimed[there], second.Phi1_uncertainty),
            (
                "Phi_1 at Z_C",
                front,
                refinement.Phi1_front_uncertainty.values[there],
                second.Phi1_front_uncertainty,
            ),
        ):
            rows.append(
                row(
                    f"{name}, ell = {ell:g}",
                    found.max(),
                    own.max(),
                    others.values[i].max(),
                    bound,
                    f"tau = {second.tau.values[found.argmax()]:.3g}",
                )
            )
    return rows


def _profile_uncertainty(difference):
    """As `tube.production.compared`, from largest differences to production; (ell, tau)."""
    _, loose, loosest, coarse, fine, far = difference
    return (
        convergence_index(coarse, np.zeros_like(fine), fine)
        + convergence_index(loosest, loose, np.zeros_like(loose))
        + far
    )


def _profile_difference(first, second):
    """Largest difference of Phi_1 in the cells of ``first``, by a spline on each side."""
    front = second.sizes["node"] // 2
    hot = first.hot.values
    Z, Phi = second.Z.values, second.Phi1.values
    worst = 0.0
    for cells, nodes in ((hot, slice(0, front + 1)), (~hot, slice(front, None))):
        there = np.minimum(first.Z.values[cells], Z[-1])
        difference = CubicSpline(Z[nodes], Phi[nodes])(there) - first.Phi1.values[cells]
        worst = max(worst, np.abs(difference).max())
    return worst


def require_agreement(rows: Sequence[Row]) -> None:
    """Disagreement, with every row that fails, if one does."""
    failed = [each for each in rows if not each["agrees"]]
    if failed:
        raise Disagreement(
            "production and the second solver differ by more than they claim: "
            + "; ".join(
                f"{each['quantity']} by {each['difference']:.2e}, allowed {each['limit']:.2e}"
                for each in failed
            )
        )


def markdown(rows: Sequence[Row]) -> str:
    """The table as a page."""
    agree = sum(each["agrees"] for each in rows)
    columns = {
        "quantity": lambda each: each["quantity"],
        "largest difference": lambda each: f"{each['difference']:.1e}",
        "at": lambda each: each["at"],
        "uncertainty, production": lambda each: f"{each['uncertainty_first']:.1e}",
        "uncertainty, second": lambda each: f"{each['uncertainty_second']:.1e}",
        "bound": lambda each: f"{each['bound']:.0e}",
        "allowed": lambda each: f"{each['limit']:.1e}",
        "verdict": lambda each: "agrees" if each["agrees"] else "differs",
    }
    intro = f"{agree} of {len(rows)} quantities agree."
    return page("Production against a second solver", intro, columns, rows)
