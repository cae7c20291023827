"""Swelling and drying beads (section 2.1)."""

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from gelpump.statements.statement import Collection, Computed, Evidence, holds
from gelpump.uncertainty import convergence_index, rounding_error

if TYPE_CHECKING:
    import xarray as xr

statements = Collection()
states = statements.states
MODELS = {"nonlinear": "fully nonlinear", "lens": "LENS"}
VERBS = {"swelling": ("swell", "figure 3"), "drying": ("dry", "figure 4")}


def bead(
    data: Mapping[str, "xr.Dataset"], case: str, model: str
) -> tuple["xr.Dataset", "xr.Dataset"]:
    """Production run and refinement of a bead, on their common times."""
    refined = data[f"refinement/bead_{case}_{model}"]
    return data[f"bead_{case}_{model}"].sel(t=refined.t), refined


def unknown(e: Evidence, case: str, *models: str, until: float | None = None) -> Computed | None:
    """What is said where a run ended before the time ``until``, or at all; None if none did."""
    for model in models:
        run = e.data[f"bead_{case}_{model}"]
        ended = run.attrs.get("stopped_t", np.inf)
        if ended < (np.inf if until is None else until):
            return Computed(None, None, follows=f"not known: {run.attrs['stopped']}")
    return None


def spread(levels: np.ndarray) -> np.ndarray:
    """Uncertainty of level 0, from the mesh (levels 1, 2) and the time tolerance (3, 4)."""
    space = convergence_index(levels[1], levels[0], levels[2])
    return space + convergence_index(levels[3], levels[0], levels[4])


def radius(e: Evidence, case: str, model: str) -> Computed | None:
    """Radius at the times at which the paper's curves were read, if there are any."""
    if not (times := e.cases[case]["published_times"]):
        return None
    if ended := unknown(e, case, model, until=max(times)):
        return ended
    at = {"t": times, "method": "nearest"}
    run, refined = bead(e.data, case, model)
    solved, doubt = run.radius.sel(**at).values, refined.radius_uncertainty.sel(**at).values
    follows = ""
    if model == "lens":
        verb = VERBS[case][0]
        nonlinear, drawn = e.read(f"{verb}-radius-nonlinear"), e.read(f"{verb}-radius-lens")
        follows = (
            f"LENS is drawn up to {np.abs(drawn - nonlinear).max():.3g} away from the nonlinear "
            f"radius; its stated equations are within {np.abs(nonlinear - solved).max():.2g} of "
            "it; the cause is unknown"
        )
    return Computed(solved, doubt, follows=follows)


for _case, (_verb, _figure) in VERBS.items():
    for _model, _name in MODELS.items():
        states(
            f"{_verb}-radius-{_model}",
            f"{_figure}a",
            f"bead_{_case}_{_model}: radius",
            text=f"{_name} radius a/R_dry during {_case}, at the times where it was read",
        )(partial(radius, case=_case, model=_model))


@states("swell-lens-slower", "section 2.1", "bead_swelling_{lens,nonlinear}: radius")
def lens_swells_slower(e: Evidence) -> Computed:
    """The LENS radius stays below the nonlinear one while the bead swells."""
    if ended := unknown(e, "swelling", "lens", "nonlinear"):
        return ended
    (lens, of_lens), (nonlinear, of_nonlinear) = (
        bead(e.data, "swelling", m) for m in ("lens", "nonlinear")
    )
    started = lens.t > 0
    ahead = (lens.radius - nonlinear.radius).values[started]
    doubt = (of_lens.radius_uncertainty + of_nonlinear.radius_uncertainty).values[started]
    ends = [int(np.argmin(ahead)), int(np.argmax(ahead))]
    return Computed(
        holds(float(np.min(-ahead - doubt)), 0.0),
        doubt[ends],
        ahead[ends],
        "smallest and largest LENS radius minus nonlinear radius, R_dry:",
        f"LENS is ahead at first, by most at t_BMJ = {float(lens.t[started][ends[1]]):.2g}",
    )


def _crossing(t, y, level: float, start: int, step: int) -> float:
    """Where y, followed from index ``start`` in steps of +1 or -1, first rises through level."""
    i = start
    while y[i + step] < level:
        i += step
    share = (level - y[i]) / (y[i + step] - y[i])
    return float(t[i] + share * (t[i + step] - t[i]))


def plateau(t: np.ndarray, radius: np.ndarray) -> list[float]:
    """Interval around the slowest drying in which |da/dt| is below the mean of the whole course.

    The course ends when 99 % of the change is done; the mean rate is taken up to there.
    """
    rate = -np.gradient(radius, t)
    done = (radius[0] - radius) / (radius[0] - radius[-1])
    end = int(np.argmax(done >= 0.99))
    mean = (radius[0] - radius[end]) / t[end]
    fastest_late = int(np.argmax(np.where((done > 0.5) & (done < 0.99), rate, -np.inf)))
    slowest = int(np.argmin(np.where(np.arange(t.size) < fastest_late, rate, np.inf)))
    return [_crossing(t, rate, mean, slowest, -1), _crossing(t, rate, mean, slowest, +1)]


def steepest(t: np.ndarray, gradient: np.ndarray, after: float) -> float:
    """Time, past ``after``, of the largest gradient: top of the parabola through three points."""
    late = int(np.argmax(np.where(t > after, gradient, -np.inf)))
    nearby = slice(late - 1, late + 2)
    a, b, _ = np.polyfit(t[nearby] - t[late], gradient[nearby], 2)
    return float(t[late] - b / (2 * a))


@states("dry-plateau", "section 2.1", "bead_drying_lens: radius")
def drying_plateau(e: Evidence) -> Computed:
    """Drying slows down between these times (LENS: |da/dt| below its mean over the course)."""
    if ended := unknown(e, "drying", "lens"):
        return ended
    run, refined = bead(e.data, "drying", "lens")
    found = np.array([plateau(run.t.values, level) for level in refined.radius.values])
    return Computed(found[0], spread(found))


@states("dry-steep-at-5", "section 2.1", "bead_drying_lens: steepest_gradient")
def steepest_drying(e: Evidence) -> Computed:
    """Polymer-fraction gradients, past the initial jump, are largest at this time (LENS)."""
    if ended := unknown(e, "drying", "lens"):
        return ended
    run, refined = bead(e.data, "drying", "lens")
    peaks = [steepest(run.t.values, level, 1.0) for level in refined.steepest_gradient.values]
    return Computed(peaks[0], spread(np.array(peaks)))


def never_negative(e: Evidence, case: str) -> Computed:
    """Whether D stays positive in all of a bead."""
    if (stop := e.data[f"bead_{case}_lens"].attrs).get("stopped"):
        return Computed(False, None, follows=stop["stopped"])
    run, refined = bead(e.data, case, "lens")
    worst = int(np.argmin(run.smallest_diffusivity.values))
    margin = float(run.smallest_diffusivity[worst])
    doubt = float(refined.smallest_diffusivity_uncertainty[worst])
    return Computed(holds(margin, doubt), doubt, margin, "smallest D, in k mu_s/mu_l:")


SPINODAL = "section 2.1.1, figure 5"
for _id, _case, _path in (
    ("swelling-avoids-spinodal", "swelling", "308 to 304 K"),
    ("drying-3076-avoids-spinodal", "drying", "304 to 307.6 K"),
):
    _text = f"on the path {_path} the diffusivity is never negative"
    _evidence = f"bead_{_case}_lens: smallest_diffusivity"
    states(_id, SPINODAL, _evidence, text=_text)(partial(never_negative, case=_case))


@states("drying-308-enters-spinodal", SPINODAL, "bead_separating_lens: stopped_t")
def drying_enters_the_spinodal(e: Evidence) -> Computed:
    """On the path 304 to 308 K the diffusivity turns negative."""
    if "stopped_t" not in e.data["bead_separating_lens"].attrs:
        return Computed(False, None)
    refined = e.data["refinement/bead_separating_lens"]
    if "stop_time" not in refined:  # coarser or finer runs do not stop
        return Computed(None, None, follows="not known: it depends on mesh and time steps")
    doubt = float(refined.stop_time_uncertainty)
    return Computed(True, doubt, float(refined.stop_time[0]), "at t_BMJ =")


@states(
    "negative-D-separates", "section 2.1.1", "bead_separating_nonlinear: stopped_polymer_fraction"
)
def separation_criterion(e: Evidence) -> Computed:
    """Phases separate where D < 0, also in the fully nonlinear model (304 to 308 K)."""
    stopped, gel = e.data["bead_separating_nonlinear"].attrs, e.gels["HHT"]
    if "stopped_t" not in stopped:
        return Computed(None, None, follows="not known: the nonlinear model stays parabolic")
    known = stopped["stopped_polymer_fraction"], stopped["temperature"]

    def diffusivity(phi, T):
        return gel.diffusivity(phi, T) / gel.shear_modulus(1.0)

    D, doubt = float(diffusivity(*known)), float(rounding_error(diffusivity, *known))
    lens = e.data["bead_separating_lens"].attrs.get("stopped_t", np.nan)
    return Computed(
        not holds(D, doubt),
        doubt,
        D,
        "LENS's D where the nonlinear model is no longer parabolic, in k mu_s/mu_l:",
        f"the nonlinear model stops at t_BMJ = {stopped['stopped_t']:.2g}, phi = {known[0]:.3f}, "
        f"LENS at {lens:.3g}",
    )


@states("printed-digits-of-table-2", "table 2, figure 4", "sensitivity_drying: radius_change")
def printed_digits(e: Evidence) -> Computed:
    """The parameters are printed to the digits that figure 4 needs: half a unit of the last one
    moves its last radius by less than it can be read to."""
    change = e.data["sensitivity_drying"].radius_change
    last = max(e.cases["drying"]["published_times"], default=e.cases["drying"]["end"])
    if change.t[-1] < last:
        return Computed(None, None, follows="not known: phases separate before")
    half = np.abs(change.sel(t=last, method="nearest"))
    readable = float(np.min(e.published["dry-radius-nonlinear"]["resolution"]))
    names = half.parameter_name.values
    return Computed(
        holds(readable - float(half.max()), 0.0),
        1e-2 * half.values,  # a difference of two runs, to one part in a hundred
        half.values,
        f"change of the radius at t_BMJ = {last:g} for half a unit of {', '.join(names)}:",
        f"drying passes so near the spinodal's tip that {names[int(np.argmax(half.values))]} "
        f"alone moves it by {float(half.max()):.2g}, to first order",
    )


@states("lens-cheaper", "sections 1 and 4", "docs/performance.md")
def cheaper(e: Evidence) -> Computed:
    """LENS predicts faster than the nonlinear model: time is a matter of the machine, and is
    compared with one integrator on one machine in docs/performance.md."""
    return Computed(None, None)
