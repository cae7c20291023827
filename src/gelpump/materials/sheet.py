"""A gel as a user meets it: its curves, its fit to measured points, the jumps that part phases."""

from typing import TYPE_CHECKING

import numpy as np

from gelpump.materials import measured, tables

if TYPE_CHECKING:
    import xarray as xr

DRAWS = 200  # of the parameters' normal distribution, for the bands


def assembled(gel, temperatures, count, fit=None, points=None) -> "xr.Dataset":
    """`tables.tabulated` with ``separates(before, after)``, and the fit with its points if any.

    ``equilibrium_error`` is the standard deviation of T_eq over draws of the parameters.
    """
    data = tables.tabulated(gel, temperatures, count)
    T = np.asarray(temperatures, float)
    parted = np.array([[bool(measured.separates(gel, a, b)) if a != b else False for b in T]
                       for a in T])  # fmt: skip
    text = {"units": "1", "long_name": "whether phases separate after a jump of temperature"}
    data = data.assign(
        separates=(("before", "after"), parted.astype("i1"), text),
        **{name: ((), getattr(gel, name), _attributes(name)) for name in measured.NAMES},
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
    data.attrs["warnings"] = "; ".join(fit.warnings) or "none"
    return data


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


def rows(data, gel):
    """Rows of the table: parameters, folds, spinodal tip, and the jumps that part phases."""
    for name in measured.NAMES:
        error = f"{name}_uncertainty"
        yield name, float(data[name]), f"{float(data[error]):.3g}" if error in data else ""
    for i, T in enumerate(data.fold_temperature.values):
        yield f"fold {i + 1} (K)", float(T), ""
    if "spinodal_tip_temperature" in data:
        yield "spinodal tip (K)", float(data.spinodal_tip_temperature), ""
    T = data.before.values
    for i, before in enumerate(T):
        for j, after in enumerate(T):
            if data.separates.values[i, j]:
                yield (
                    f"jump {before:g} K to {after:g} K",
                    "phases separate",
                    measured.separates(gel, before, after),
                )
