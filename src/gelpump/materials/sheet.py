"""A gel as a user meets it: its curves, its fit to measured points, the jumps that part phases."""

from typing import TYPE_CHECKING

import numpy as np

from gelpump.materials import from_config, measured, tables
from gelpump.materials.jumps import jump

if TYPE_CHECKING:
    import xarray as xr

NO_PHASES, SEPARATES, NO_STATE = 0, 1, 2  # what a jump of temperature comes to


def assembled(gel, temperatures, count, fit=None, points=None) -> "xr.Dataset":
    """`tables.tabulated` with ``separates(before, after)``, and the fit with its points if any.

    Jumps are those between the gel's ``temperature`` values; ``unstable(before, after, end)`` is
    the whole stretch, from the first polymer fraction with D < 0 that is met to the last, 0 where
    there is none. ``equilibrium_error`` is the standard deviation of T_eq that the covariance of
    the parameters leaves, to first order.
    """
    data = tables.tabulated(gel, temperatures, count)
    T = data.temperature.values
    parted = np.zeros((len(T), len(T)), "i1")
    unstable = np.zeros((len(T), len(T), 2))
    for i, before in enumerate(T):
        for j, after in enumerate(T):
            try:
                met = jump(gel, before, after).unstable if before != after else ()
            except ValueError:
                parted[i, j] = NO_STATE
                continue
            if met:
                parted[i, j] = SEPARATES
                unstable[i, j] = met[0][0], met[-1][1]
    data = data.assign(
        separates=(
            ("before", "after"),
            parted,
            {
                "units": "1",
                "long_name": "whether phases separate after a jump of temperature",
                "flag_values": np.array([NO_PHASES, SEPARATES, NO_STATE], "i1"),
                "flag_meanings": "no yes no_stable_state",
            },
        ),
        unstable=(
            ("before", "after", "end"),
            unstable,
            {"units": "1", "long_name": "first and last polymer fraction with D < 0 on the way"},
        ),
        **{
            name: ((), value, {"units": unit, "long_name": name})
            for name, (value, unit) in gel.parameters.items()
        },
    ).assign_coords(
        before=("before", T, {"units": "K", "long_name": "temperature before the jump"}),
        after=("after", T, {"units": "K", "long_name": "temperature after the jump"}),
    )
    if fit is None:
        return data
    units = {name: unit for name, (_, unit) in gel.parameters.items()}
    drawn, folds = measured.bootstrap(fit, points)
    kept = np.isfinite(drawn).all(axis=1)
    for i, (name, error) in enumerate(zip(fit.names, fit.errors, strict=True)):
        unit = {"units": units[name]}
        data[f"{name}_uncertainty"] = ((), error, unit | {"long_name": f"standard error of {name}"})
        if kept.sum() > 1:
            data[f"{name}_interval"] = (
                "end",
                np.percentile(drawn[kept, i], INTERVAL),
                unit | {"long_name": f"bootstrap interval of {name}, 95 per cent"},
            )
    whole = [each for each in folds if len(each) == data.sizes["fold"]]
    if data.sizes["fold"] and len(whole) > 1:
        data["fold_temperature_interval"] = (
            ("fold", "end"),
            _ordered(np.percentile(whole, INTERVAL, axis=0).T, data.fold_temperature.values),
            {"units": "K", "long_name": "bootstrap interval of the folds, 95 per cent"},
        )
    data["share_with_folds"] = (
        (),
        np.mean([len(each) > 1 for each in folds]),
        {"units": "1", "long_name": "share of bootstrap draws with a hysteresis"},
    )
    data["equilibrium_error"] = (
        "polymer_fraction",
        _spread(fit, data.polymer_fraction.values),
        {"units": "K", "long_name": "standard deviation of the fitted equilibrium temperature"},
    )
    for name, unit in (("T", "K"), ("T_error", "K"), ("phi", "1"), ("phi_error", "1")):
        data[f"measured_{name}"] = (
            "point",
            getattr(points, name),
            {"units": unit, "long_name": f"measured point: {name}"},
        )
    data["measured_branch"] = (
        "point",
        points.on("heating").astype("i1") + 2 * points.on("cooling").astype("i1"),
        {
            "units": "1",
            "long_name": "how the point was reached",
            "flag_values": np.arange(3, dtype="i1"),
            "flag_meanings": "not_told heating cooling",
        },
    )
    data["residual"] = (
        "point",
        fit.residuals,
        {"units": "1", "long_name": "distance of the point from the fit, in errors"},
    )
    data["reduced_chi2"] = (
        (),
        fit.reduced_chi2,
        {"units": "1", "long_name": "chi^2 per degree of freedom"},
    )
    data["covariance"] = (
        ("parameter", "parameter_2"),
        fit.covariance,
        {"units": "1", "long_name": f"covariance of {', '.join(fit.names)}, in K and 1"},
    )
    told = {"warnings": fit.warnings, "forms_passed_over": fit.passed_over}
    return data.assign_attrs({"form": fit.form} | {k: "; ".join(v) for k, v in told.items() if v})


INTERVAL = (2.5, 97.5)  # per cent


def _ordered(intervals, folds):
    """Intervals of sorted temperatures in the order of ``folds``."""
    return intervals[np.argsort(np.argsort(folds))]


def _spread(fit, phi):
    """Standard deviation of T_eq(phi), to first order, along the axes of the covariance."""
    variances, axes = np.linalg.eigh(fit.covariance)
    total = np.zeros_like(phi)
    for variance, axis in zip(variances, axes.T, strict=True):
        shift = 0.1 * np.sqrt(max(variance, 0.0)) * axis
        up, down = (
            from_config("moved", fit.block(fit.parameters + sign * shift)).equilibrium_temperature(
                phi
            )
            for sign in (1, -1)
        )
        total += ((up - down) / 0.2) ** 2
    return np.sqrt(total)


def said(data) -> list[str]:
    """What has to be said of the gel wherever it is shown: warnings, and what it has not."""
    return [
        f"{what}: {each}"
        for what, key in (("warning", "warnings"), ("left out", "left_out"))
        for each in data.attrs.get(key, "").split("; ")
        if each
    ]


def rows(data, gel):
    """Rows of the table: warnings, parameters, folds, spinodal tip, and what jumps part phases."""
    for each in said(data):
        what, _, text = each.partition(": ")
        yield what, "", text
    if "form" in data.attrs:
        yield "form", data.attrs["form"], data.attrs.get("forms_passed_over", "")
    for name in gel.parameters:
        error = f"{name}_uncertainty"
        told = f"{float(data[error]):.3g}" if error in data else ""
        if f"{name}_interval" in data:
            told += "; bootstrap {:.5g} to {:.5g}".format(*data[f"{name}_interval"].values)
        yield name, float(data[name]), told
    for i, T in enumerate(data.fold_temperature.values):
        ends = data.get("fold_temperature_interval")
        told = "" if ends is None else "bootstrap {:.6g} to {:.6g}".format(*ends.values[i])
        yield f"fold {i + 1} (K)", float(T), told
    if "spinodal_tip_temperature" in data:
        yield "spinodal tip (K)", float(data.spinodal_tip_temperature), ""
    T = data.before.values
    for i, before in enumerate(T):
        for j, after in enumerate(T):
            verdict = int(data.separates[i, j])
            if verdict == SEPARATES:
                yield (
                    f"jump {before:g} K to {after:g} K",
                    "phases separate",
                    str(jump(gel, before, after)),
                )
            elif verdict == NO_STATE:
                yield f"jump {before:g} K to {after:g} K", "no stable state at one of them", ""
