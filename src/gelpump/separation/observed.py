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

    R, r: shape (t, face).  front: its R and r, shape (t, 2), nan while there is none; it
    is at the surface before its birth and at the centre after its end.
    """
    import xarray as xr

    present = np.isfinite(front[:, 0])
    born = np.maximum.accumulate(present) | (t > attributes.get("birth_t", np.inf))
    nowhere = np.where(born[:, None], 0.0, np.column_stack([np.ones(t.size), r[:, -1]]))
    front = np.where(present[:, None], front, nowhere)

    volume, dry = np.diff(r**3, axis=1), np.diff(R**3, axis=1)
    phi = dry / volume
    core = front[:, 1] ** 3 / r[:, -1] ** 3
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
            "front_present": variable("t", present.astype(float), "whether there is a front"),
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


PASSAGES = (0.7, 0.5, 0.3)


def passage(run: "xr.Dataset", R: float) -> float:
    """When the front is at the dry radius R; nan if it never is."""
    from scipy.interpolate import PchipInterpolator

    there = run.front_present.values > 0
    t, front = run.t.values[there], run.front_dry_radius.values[there]
    if t.size < 2 or not front[-1] <= R <= front[0]:
        return np.nan
    return float(PchipInterpolator(-front, t)(-R))


def with_uncertainty(run: "xr.Dataset", coarse: "xr.Dataset") -> "xr.Dataset":
    """``run`` with when its front passes some dry radii, and by how much a ``coarse`` run, of half
    the cells, a skin twice as thick and looser tolerances, differs: at least the error of ``run``;
    nan where that stopped at once.
    """
    times = [[passage(each, R) for R in PASSAGES] for each in (run, coarse)]
    if np.isfinite(times).all():
        run = run.assign(
            passage_time=variable("passage", times[0], "when the front is there", TIME),
            passage_time_uncertainty=variable(
                "passage",
                np.abs(np.subtract(*times)),
                "numerical uncertainty: when the front is there",
            ),
        ).assign_coords(passage=variable("passage", list(PASSAGES), "dry radius", LENGTH))
    for event in ("birth_t", "completion_t"):
        if event in run.attrs and event in coarse.attrs:
            doubt = abs(run.attrs[event] - coarse.attrs[event])
            run = run.assign_attrs({f"{event}_uncertainty": float(doubt)})
    difference = np.nan
    if coarse.t.size > 1:  # it may have stopped before
        both = run.radius[run.t.values <= float(coarse.t[-1])]
        difference = float(abs(both - coarse.radius.interp(t=both.t)).max())
    return run.assign_attrs(radius_uncertainty=difference)
