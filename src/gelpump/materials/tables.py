"""Curves and special points of an energy-based gel as one dataset (appendix A)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

    from gelpump.materials import EnergyBasedGel

SWOLLEN_POINTS = 200
FOLLOWING = 7  # temperatures of a gel in whose range the given ones do not lie


def polymer_fractions(count: int) -> np.ndarray:
    """Polymer fractions from 1e-4 to 1 - 1e-4, evenly spaced in the middle, dense at both ends."""
    s = np.linspace(-1.0, 1.0, count)
    shape = np.tanh(3.0 * s) / np.tanh(3.0)
    return 0.5 + (0.5 - 1e-4) * shape


def temperatures_of(gel: "EnergyBasedGel", given: Sequence[float]) -> np.ndarray:
    """Those of the ``given`` temperatures (K) that lie in the gel's range.

    If these are fewer than two, as many as `FOLLOWING` that are spread over the range.
    """
    lowest, highest = gel.temperature_range
    T = np.asarray(given, dtype=float)
    inside = T[(lowest <= T) & (highest >= T)]
    return inside if len(inside) > 1 else np.linspace(lowest, highest, FOLLOWING)


def tabulated(gel: "EnergyBasedGel", temperatures: Sequence[float], count: int) -> "xr.Dataset":
    """The gel's curves, at those of ``temperatures`` that are the gel's (`temperatures_of`).

    Dims polymer_fraction (``count``, without those at a pole of T_eq or T_sp), temperature (K),
    fold, equilibrium, swollen_temperature.

    Pi and D at each (temperature, polymer_fraction), in k_B T/Omega_f; T_eq and T_sp of each
    polymer fraction; folds of the equilibrium curve, and the tip of the spinodal if it has one;
    every equilibrium of the given temperatures, listed along ``equilibrium`` with its temperature
    and whether it is stable; the swollen phi_0 and its low-temperature asymptote, on
    temperatures up to the transition. What the gel does not have is left out, and the attribute
    ``left_out`` says so.
    """
    import xarray as xr

    phi = polymer_fractions(count)
    off_pole = np.isfinite(gel.equilibrium_temperature(phi) + gel.spinodal_temperature(phi))
    phi = phi[off_pole]
    T = temperatures_of(gel, temperatures)
    curves = ("temperature", "polymer_fraction")
    folds = gel.folds()
    roots = [gel.equilibrium_polymer_fractions(each) for each in T]
    left_out: list[str] = []
    if len(outside := np.setdiff1d(temperatures, T)):
        span = "{:g} to {:g} K".format(*gel.temperature_range)
        told = ", ".join(f"{each:g}" for each in outside)
        left_out.append(f"temperatures {told} K lie outside the gel's range, {span}")
    cold, swollen = _swollen(gel, folds, left_out)
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
        **swollen,
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
    try:
        tip = gel.spinodal_tip()
    except ValueError as refusal:
        left_out.append(str(refusal).partition(": ")[2])
    else:
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
            **cold,
        },
        attrs={"gel": gel.name} | ({"left_out": "; ".join(left_out)} if left_out else {}),
    )


def _swollen(gel, folds, left_out):
    """Coordinate and variables of the swollen branch below the transition, as far as it exists."""
    lowest, highest = gel.temperature_range
    singular = gel.singular_temperature
    transition = folds.temperature.max(initial=min(singular, highest))
    cold = np.linspace(lowest, transition, SWOLLEN_POINTS, endpoint=False)
    try:
        if transition <= lowest:
            raise ValueError(f"{gel.name}: the range begins above the transition")
        phi_0 = np.array([gel.equilibrium_polymer_fraction(each) for each in cold])
    except ValueError as refusal:
        left_out.append(f"no swollen branch: {str(refusal).partition(': ')[2]}")
        return {}, {}
    text = {"units": "1", "long_name": "equilibrium polymer fraction of the swollen state"}
    variables = {"swollen_polymer_fraction": ("swollen_temperature", phi_0, text)}
    asymptote = gel.asymptotic_polymer_fraction(cold)
    if np.all(np.isfinite(asymptote)):
        text = "low-temperature asymptote of the equilibrium polymer fraction"
        variables["asymptotic_polymer_fraction"] = (
            "swollen_temperature",
            asymptote,
            {"units": "1", "long_name": text},
        )
    else:
        left_out.append("no low-temperature asymptote: chi - 1/2 does not stay below 0 as phi -> 0")
    if np.isfinite(singular):
        text = "temperature at which the low-temperature asymptote diverges"
        variables["singular_temperature"] = ((), singular, {"units": "K", "long_name": text})
    text = {"units": "K", "long_name": "temperature below the transition"}
    return {"swollen_temperature": ("swollen_temperature", cold, text)}, variables
