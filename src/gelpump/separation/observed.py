"""The dataset of a bead that separates: its profiles, its front, its energy."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gelpump.bead.dataset import LENGTH, TIME
from gelpump.netcdf import variable
from gelpump.separation.shells import at_means, polymer_fraction

if TYPE_CHECKING:
    import xarray as xr


def energy_of(energy, R: NDArray, r: NDArray) -> float:
    """E / 4 pi of shells with faces R, r: the sum of W over dry volumes, and the surface's."""
    _, l_t = at_means(R, r)
    W = energy.density(polymer_fraction(R, r), l_t)
    return float(np.sum(W * np.diff(R**3)) / 3 + energy.surface_energy(r[-1]))


def dataset(
    energy,
    t: NDArray,
    R: NDArray,
    r: NDArray,
    surface: NDArray,
    front: NDArray,
    attributes: Mapping,
) -> "xr.Dataset":
    """Dims (t, cell), (t, face): as ``gelpump.bead.dataset``, but faces move in the dry bead too.

    R, r: shape (t, face).  front: its R and r, shape (t, 2), nan while there is none.
    """
    import xarray as xr

    volume, dry = np.diff(r**3, axis=1), np.diff(R**3, axis=1)
    phi = dry / volume
    core = np.where(np.isfinite(front[:, 1]), front[:, 1], 0.0) ** 3 / r[:, -1] ** 3
    stiffness = [
        energy.stiffness(p, at_means(*faces)[1]).min() for p, *faces in zip(phi, R, r, strict=True)
    ]
    profile = ("t", "cell")
    return xr.Dataset(
        {
            "radius": variable("t", r[:, -1], "radius of the bead", LENGTH),
            "r": variable(
                profile,
                np.sqrt(0.6 * np.diff(r**5, axis=1) / volume),
                "radial position of the shell",
                LENGTH,
            ),
            "polymer_fraction": variable(profile, phi, "polymer volume fraction"),
            "surface_polymer_fraction": variable(
                "t", surface, "polymer volume fraction at the surface"
            ),
            "polymer_volume_error": variable(
                "t",
                (phi * volume).sum(axis=1) - 1.0,
                "polymer volume of all shells relative to the dry bead's, minus one",
            ),
            "front_dry_radius": variable(
                "t", front[:, 0], "radius of the front in the dry bead", LENGTH
            ),
            "front_radius": variable("t", front[:, 1], "radius of the front", LENGTH),
            "core_share": variable("t", core, "share of the bead's volume inside the front"),
            "energy": variable(
                "t",
                [energy_of(energy, *faces) for faces in zip(R, r, strict=True)],
                "energy over 4 pi",
                "in mu_s(1) R_dry^3, its zero that of the mixing energy",
            ),
            "smallest_stiffness": variable(
                "t", stiffness, "least ds_r/d(ln J) of all shells", "in mu_s(1)"
            ),
            "r_face": variable(("t", "face"), r, "radii of the shell faces", LENGTH),
            "dry_radius": variable(
                ("t", "face"), R, "radii of the shell faces in the dry bead", LENGTH
            ),
        },
        coords={"t": variable("t", t, "elapsed time", TIME)},
        attrs={
            "model": energy.name,
            "gel": energy.gel.name,
            "temperature": energy.temperature,
            **attributes,
        },
    )
