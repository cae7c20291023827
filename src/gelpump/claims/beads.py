"""What the paper states about swelling and drying beads (section 2.1)."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from gelpump.claims.finding import Finding, holds
from gelpump.uncertainty import convergence_index

MODELS = {"nonlinear": "fully nonlinear", "lens": "LENS"}
VERBS = {"swelling": ("swell", "figure 3"), "drying": ("dry", "figure 4")}


def findings(data: Mapping, cases: Mapping) -> Iterator[Finding]:
    """data: datasets ``bead_{case}_{model}`` and ``refinement/bead_{case}_{model}``; cases: config
    blocks of the beads swelling, drying and separating."""
    for case in VERBS:
        for model in MODELS if cases[case]["published_times"] else ():
            yield _radius(data, case, model, cases[case]["published_times"])
    yield _slower(data)
    yield from _drying_course(data)
    yield from _spinodal(data)
    yield _cost(data)


def _bead(data, case, model):
    """Production run and refinement of a bead, on their common times."""
    refined = data[f"refinement/bead_{case}_{model}"]
    return data[f"bead_{case}_{model}"].sel(t=refined.t), refined


def _radius(data, case: str, model: str, times: Sequence[float]) -> Finding:
    verb, figure = VERBS[case]
    bead, refined = _bead(data, case, model)
    at = {"t": times, "method": "nearest"}
    return Finding(
        f"{verb}-radius-{model}",
        figure,
        f"{MODELS[model]} radius a/R_dry during {case} at t_BMJ = "
        + ", ".join(f"{t:g}" for t in times),
        bead.radius.sel(**at).values.tolist(),
        refined.radius_uncertainty.sel(**at).values.tolist(),
        f"data/bead_{case}_{model}.nc: radius",
    )


def _slower(data) -> Finding:
    (lens, lens_refined), (nonlinear, nonlinear_refined) = (
        _bead(data, "swelling", model) for model in ("lens", "nonlinear")
    )
    started = lens.t > 0
    ahead = (lens.radius - nonlinear.radius).values[started]
    doubt = (lens_refined.radius_uncertainty + nonlinear_refined.radius_uncertainty).values[started]
    return Finding(
        "swell-lens-slower",
        "section 2.1",
        "the LENS radius stays below the nonlinear one while the bead swells",
        holds(float(np.min(-ahead - doubt)), 0.0),
        [float(doubt[np.argmin(ahead)]), float(doubt[np.argmax(ahead)])],
        "data/bead_swelling_{lens,nonlinear}.nc: radius",
        measure=[float(ahead.min()), float(ahead.max())],
        measured="smallest and largest LENS radius minus nonlinear radius:",
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


def _drying_course(data) -> Iterator[Finding]:
    bead, refined = _bead(data, "drying", "lens")
    t = bead.t.values
    plateaus = np.array([plateau(t, radius) for radius in refined.radius.values])
    yield Finding(
        "dry-plateau",
        "section 2.1",
        "drying slows down between these times (LENS: |da/dt| below its mean over the course)",
        plateaus[0].tolist(),
        spread(plateaus).tolist(),
        "data/bead_drying_lens.nc: radius",
    )
    peaks = np.array([steepest(t, each, 1.0) for each in refined.steepest_gradient.values])
    yield Finding(
        "dry-steep-at-5",
        "section 2.1",
        "polymer-fraction gradients, past the initial jump, are largest at this time (LENS)",
        float(peaks[0]),
        float(spread(peaks)),
        "data/bead_drying_lens.nc: steepest_gradient",
    )


def spread(levels: np.ndarray) -> np.ndarray:
    """Uncertainty of level 0, from the mesh (levels 1, 2) and the time tolerance (3, 4)."""
    space = convergence_index(levels[1], levels[0], levels[2])
    return space + convergence_index(levels[3], levels[0], levels[4])


def _spinodal(data) -> Iterator[Finding]:
    for claim, case, path in (
        ("swelling-avoids-spinodal", "swelling", "308 to 304 K"),
        ("drying-3076-avoids-spinodal", "drying", "304 to 307.6 K"),
    ):
        bead, refined = _bead(data, case, "lens")
        worst = int(np.argmin(bead.smallest_diffusivity.values))
        margin = float(bead.smallest_diffusivity[worst])
        doubt = float(refined.smallest_diffusivity_uncertainty[worst])
        yield Finding(
            claim,
            "section 2.1.1, figure 5",
            f"on the path {path} the diffusivity is never negative",
            holds(margin, doubt),
            doubt,
            f"data/bead_{case}_lens.nc: smallest_diffusivity",
            measure=margin,
            measured="smallest D, in k mu_s/mu_l:",
        )
    bead, refined = _bead(data, "separating", "lens")
    stopped = "stopped_t" in data["bead_separating_lens"].attrs
    yield Finding(
        "drying-308-enters-spinodal",
        "section 2.1.1, figure 5",
        "on the path 304 to 308 K the diffusivity turns negative",
        stopped,
        float(refined.stop_time_uncertainty) if stopped else None,
        "data/bead_separating_lens.nc: stopped_t",
        measure=float(refined.stop_time[0]) if stopped else None,
        measured="at t_BMJ =",
    )


def _cost(data) -> Finding:
    lens, nonlinear = (data[f"bead_drying_{model}"].attrs for model in ("lens", "nonlinear"))
    return Finding(
        "lens-cheaper",
        "sections 1 and 4",
        "LENS predicts faster than the nonlinear model (drying: sweeps of FiPy against "
        "evaluations of the rate by CVODE)",
        None,
        None,
        "data/bead_drying_{lens,nonlinear}.nc: sweeps, evaluations",
        measure=[float(lens["sweeps"]), float(nonlinear["evaluations"])],
        measured="tridiagonal solves of LENS, rate evaluations of the nonlinear model:",
    )
