"""Dataset of the drying front: its sharpness A, the power law, and how far the model holds."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from gelpump.netcdf import variable
from gelpump.tube import scaling
from gelpump.tube.front import (
    WINDOW,
    largest_difference,
    local_exponent,
    power_law,
    sharpness,
    wall_length,
)
from gelpump.tube.wall_flow import PRINTED_SOURCE_COEFFICIENT, source_coefficient

SHARPNESS = "in units of 1/L"


def front_fit(pulse: xr.Dataset, refinement: xr.Dataset, settings: Mapping) -> xr.Dataset:
    """Fits of all tubes at all times; A, the misfit and the power law at the time of figure 9."""
    ell, tau = pulse.ell.values, pulse.tau.values
    now = int(np.abs(tau - settings["tau"]).argmin())
    in_law = pulse.in_power_law.values
    A, rms = sharpness(pulse)
    error = A * relative_error(refinement, pulse)
    laws = [power_law(ell[in_law], *(a[in_law, j] for a in (A, error))) for j in range(len(tau))]
    w = wall_length(pulse)[:, np.newaxis]
    Phi_inf = pulse.Phi_inf.values[:, np.newaxis]
    departure = np.maximum(Phi_inf - pulse.Phi1_front.values, pulse.Phi1_front.values - 1)
    data = {
        "A": variable("ell", A[:, now], "sharpness of the front", SHARPNESS),
        "A_uncertainty": variable(
            "ell", error[:, now], "numerical uncertainty of the sharpness", SHARPNESS
        ),
        "fit_rms": variable(
            "ell", rms[:, now], "root-mean-square misfit of Phi1 over the window", scaling.POLYMER
        ),
        "exponent": variable((), laws[now].exponent, "n of the power law A = c (1-ell)^-n"),
        "exponent_uncertainty": variable(
            (), laws[now].exponent_uncertainty, "uncertainty of n, by scatter and numerical error"
        ),
        "prefactor": variable((), laws[now].prefactor, "c of the power law A = c (1-ell)^-n"),
        "in_power_law": pulse.in_power_law,
        "local_exponent": variable(
            "ell", local_exponent(ell, A[:, now]), "-d ln A/d ln(1-ell) between neighbouring tubes"
        ),
        "A_window": variable(
            ("ell", "window"),
            np.stack(
                [sharpness(pulse.isel(tau=[now]), x)[0][:, 0] for x in settings["windows"]], 1
            ),
            "sharpness of the front, fitted within a window around it",
            SHARPNESS,
        ),
        "A_window_own": variable(
            ("ell", "window"),
            np.stack(
                [sharpness(pulse.isel(tau=[now]), x, True)[0][:, 0] for x in settings["windows"]], 1
            ),
            "the same with the window in units of 1/A",
            SHARPNESS,
        ),
        "A_tau": variable(("ell", "tau"), A, "sharpness of the front at each time", SHARPNESS),
        "fit_rms_tau": variable(
            ("ell", "tau"), rms, "misfit of Phi1 at each time", scaling.POLYMER
        ),
        "exponent_tau": variable("tau", [law.exponent for law in laws], "n at each time"),
        "exponent_uncertainty_tau": variable(
            "tau", [law.exponent_uncertainty for law in laws], "uncertainty of n at each time"
        ),
        "A_consistent_source": variable(
            "ell",
            consistent_sharpness(ell, tau, A, tau[now]),
            "sharpness if F had the coefficient that follows from the conditions on Phi_2",
            SHARPNESS,
        ),
        "Phi1_front": variable(
            "ell",
            pulse.Phi1_front.values[:, now],
            "polymer fraction in the middle of the wall at Z_C",
            scaling.POLYMER,
        ),
        "profile_change": variable(
            ("ell", "tau"),
            largest_difference(pulse, pulse.isel(tau=[-1])),
            "largest difference of Phi1 from the last time at the same Z - Z_C",
            scaling.POLYMER,
        ),
        "departure_front": variable(
            ("ell", "tau"),
            departure,
            "largest distance of Phi1 from its equilibrium, which is at the front",
            scaling.POLYMER,
        ),
        "departed_length": variable(
            ("ell", "tau"),
            pulse.departed_length.values,
            pulse.departed_length.attrs["long_name"],
            scaling.AXIAL,
        ),
        "departed_length_over_w": variable(
            ("ell", "tau"), pulse.departed_length.values / w, "the same in units of w"
        ),
        "departed_share": variable(
            ("ell", "tau"), pulse.departed_length.values / pulse.Z_C.values, "the same over Z_C"
        ),
    }
    coords = {
        "ell": scaling.ell(ell),
        "tau": scaling.tau(tau),
        "window": variable(
            "window", np.array(settings["windows"], float), "half width of the window", "over w"
        ),
        "fit_tau": variable((), tau[now], "time of the fits that have no tau"),
    }
    dataset = xr.Dataset(data, coords)
    dataset.attrs["fit_window_over_w"] = WINDOW
    return dataset


def relative_error(refinement: xr.Dataset, pulse: xr.Dataset) -> NDArray:
    """That of A, shape (ell, tau): the largest of the refined times, interpolated in ln(1-ell)."""
    refined = np.log(1 - refinement.ell.values)
    relative = (refinement.A_uncertainty / refinement.A.isel(level=0)).max("tau").values
    order = np.argsort(refined)
    here = np.interp(np.log(1 - pulse.ell.values), refined[order], relative[order])
    return here[:, np.newaxis]


def consistent_sharpness(ell: NDArray, tau: NDArray, A: NDArray, now: float) -> NDArray:
    """A at tau = now, were F's coefficient kappa instead of 16, without another solution.

    Z_C ~ sqrt(tau), so Phi_1 is a function of Z/w and tau/w^2 only. A coefficient kappa makes w
    larger by sqrt(16/kappa): the tube looks as it does at tau kappa/16, on this longer scale.
    """
    share = source_coefficient(ell) / PRINTED_SOURCE_COEFFICIENT
    earlier = [
        np.exp(np.interp(np.log(now * x), np.log(tau), np.log(each)))
        for x, each in zip(share, A, strict=True)
    ]
    return np.sqrt(share) * earlier
