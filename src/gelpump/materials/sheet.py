"""A gel as a user meets it: its curves, its fit to measured points, the jumps that part phases."""

from typing import TYPE_CHECKING

import numpy as np

from gelpump.materials import measured, tables
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
    for name, error in zip(measured.NAMES, fit.errors, strict=True):
        data[f"{name}_uncertainty"] = ((), error, _attributes(f"standard error of {name}"))
    phi = data.polymer_fraction.values
    data["equilibrium_error"] = (
        "polymer_fraction",
        _spread(fit, phi),
        {"units": "K", "long_name": "standard deviation of the fitted equilibrium temperature"},
    )
    for name, unit in (("T", "K"), ("T_error", "K"), ("phi", "1"), ("phi_error", "1")):
        data[f"measured_{name}"] = (
            "point",
            getattr(points, name),
            {"units": unit, "long_name": f"measured point: {name}"},
        )
    data["reduced_chi2"] = (
        (),
        fit.reduced_chi2,
        {"units": "1", "long_name": "chi^2 per degree of freedom"},
    )
    data["covariance"] = (
        ("parameter", "parameter_2"),
        fit.covariance,
        {"units": "1", "long_name": f"covariance of {', '.join(measured.NAMES)}, in K and 1"},
    )
    return data.assign_attrs({"warnings": "; ".join(fit.warnings)} if fit.warnings else {})


def _attributes(name):
    return {"units": "K-1" if name.split()[-1].startswith("B") else "1", "long_name": name}


def _spread(fit, phi):
    """Standard deviation of T_eq(phi); the slopes of T_eq are those of a linear equation."""
    gel, h = fit.gel, 1e-6
    here = gel.equilibrium_temperature(phi)
    slopes = []
    for name in measured.NAMES:
        step = h * abs(getattr(gel, name))
        moved = {key: getattr(gel, key) for key in measured.NAMES} | {
            name: getattr(gel, name) + step
        }
        slopes.append((type(gel)("moved", **moved).equilibrium_temperature(phi) - here) / step)
    slopes = np.array(slopes)
    return np.sqrt(np.maximum(np.einsum("ip,ij,jp->p", slopes, fit.covariance, slopes), 0.0))


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
    for name in gel.parameters:
        error = f"{name}_uncertainty"
        yield name, float(data[name]), f"{float(data[error]):.3g}" if error in data else ""
    for i, T in enumerate(data.fold_temperature.values):
        yield f"fold {i + 1} (K)", float(T), ""
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
