"""Curves and special points of an energy-based gel as one dataset (appendix A)."""

from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

    from gelpump.materials import EnergyBasedGel

SWOLLEN_POINTS = 200


def polymer_fractions(count: int) -> np.ndarray:
    """Polymer fractions from 1e-4 to 1 - 1e-4, evenly spaced in the middle, dense at both ends."""
    s = np.linspace(-1.0, 1.0, count)
    shape = np.tanh(3.0 * s) / np.tanh(3.0)
    return 0.5 + (0.5 - 1e-4) * shape


def tabulated(gel: "EnergyBasedGel", temperatures: Sequence[float], count: int) -> "xr.Dataset":
    """Dims polymer_fraction (``count``), temperature (K), fold, equilibrium, swollen_temperature.

    Pi and D at each (temperature, polymer_fraction), in k_B T/Omega_f; T_eq and T_sp of each
    polymer fraction; folds of the equilibrium curve, and the tip of the spinodal if it has one;
    every equilibrium of the given temperatures, listed along ``equilibrium`` with its temperature
    and whether it is stable; the swollen phi_0 and its low-temperature asymptote, on
    temperatures up to the transition.
    """
    import xarray as xr

    phi = polymer_fractions(count)
    T = np.asarray(temperatures, dtype=float)
    curves = ("temperature", "polymer_fraction")
    folds = gel.folds()
    roots = [gel.equilibrium_polymer_fractions(each) for each in T]
    lowest, highest = gel.temperature_range
    transition = folds.temperature.max(initial=min(gel.singular_temperature, highest))
    cold = np.linspace(lowest, transition, SWOLLEN_POINTS, endpoint=False)
    pressure = {"units": "1", "comment": "in units of k_B T/Omega_f"}

    def kelvin(long_name):
        return {"units": "K", "long_name": long_name}

    def fraction(long_name):
        return {"units": "1", "long_name": long_name}

    variables = {
        "temperature_equilibrium": (
            "polymer_fraction",
            gel.equilibrium_temperature(phi),
            kelvin("temperature at which the osmotic pressure vanishes"),
        ),
        "equilibrium_is_stable": (
            "polymer_fraction",
            (gel.osmotic_modulus(phi, gel.equilibrium_temperature(phi)) > 0).astype("i1"),
            fraction("whether the equilibrium of this polymer fraction is stable"),
        ),
        "temperature_spinodal": (
            "polymer_fraction",
            gel.spinodal_temperature(phi),
            kelvin("temperature at which the polymer diffusivity vanishes"),
        ),
        "osmotic_pressure": (
            curves,
            gel.osmotic_pressure(phi, T[:, None]),
            pressure | {"long_name": "osmotic pressure"},
        ),
        "diffusivity": (
            curves,
            gel.diffusivity(phi, T[:, None]),
            pressure | {"long_name": "polymer diffusivity times mu_l/k"},
        ),
        "swollen_polymer_fraction": (
            "swollen_temperature",
            np.array([gel.equilibrium_polymer_fraction(each) for each in cold]),
            fraction("equilibrium polymer fraction of the swollen state"),
        ),
        "asymptotic_polymer_fraction": (
            "swollen_temperature",
            gel.asymptotic_polymer_fraction(cold),
            fraction("low-temperature asymptote of the equilibrium polymer fraction"),
        ),
        "singular_temperature": (
            (),
            gel.singular_temperature,
            kelvin("temperature at which the low-temperature asymptote diverges"),
        ),
        "fold_temperature": (
            "fold",
            folds.temperature,
            kelvin("temperature of a fold of the equilibrium curve"),
        ),
        "fold_polymer_fraction": (
            "fold",
            folds.polymer_fraction,
            fraction("polymer fraction of a fold of the equilibrium curve"),
        ),
        "equilibrium_temperature": (
            "equilibrium",
            np.repeat(T, [len(root.polymer_fraction) for root in roots]),
            kelvin("temperature of an equilibrium"),
        ),
        "equilibrium_polymer_fraction": (
            "equilibrium",
            np.concatenate([root.polymer_fraction for root in roots]),
            fraction("polymer fraction of an equilibrium"),
        ),
        "equilibrium_stable": (
            "equilibrium",
            np.concatenate([root.stable for root in roots]).astype("i1"),
            fraction("whether an equilibrium is stable"),
        ),
    }
    with suppress(ValueError):  # it has none
        tip = gel.spinodal_tip()
        variables["spinodal_tip_temperature"] = (
            (),
            tip.temperature,
            kelvin("lowest temperature with a vanishing diffusivity"),
        )
        variables["spinodal_tip_polymer_fraction"] = (
            (),
            tip.polymer_fraction,
            fraction("polymer fraction of the spinodal's tip"),
        )
    return xr.Dataset(
        variables,
        coords={
            "polymer_fraction": ("polymer_fraction", phi, fraction("polymer volume fraction")),
            "temperature": ("temperature", T, kelvin("temperature")),
            "swollen_temperature": (
                "swollen_temperature",
                cold,
                kelvin("temperature below the transition"),
            ),
        },
        attrs={"gel": gel.name},
    )
