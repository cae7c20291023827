"""The dataset that both bead models return, from the radii of their material shell faces."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gelpump.coordinates import ROUNDED
from gelpump.netcdf import variable

if TYPE_CHECKING:
    import xarray as xr

LENGTH = "lengths in the dry radius R_dry of the bead (polymer fraction 1)"
TIME = "t_BMJ = k k_B T t / (mu_l Omega_p R_dry^2), T the temperature after the jump"


class Loss(NamedTuple):
    """Where and when a model stops being parabolic, and why that is so."""

    t: float
    r: float
    polymer_fraction: float
    reason: str

    def attributes(self) -> dict[str, str | float]:
        """Attributes of the dataset that the loss ended."""
        statement = (
            f"phase separation at t = {self.t:.6g}, r = {self.r:.6g}, "
            f"phi = {self.polymer_fraction:.6g}: {self.reason}"
        )
        return {
            "stopped": statement,
            "stopped_t": self.t,
            "stopped_r": self.r,
            "stopped_polymer_fraction": self.polymer_fraction,
        }


def bead_dataset(
    t: np.ndarray,
    dry_faces: np.ndarray,
    faces: np.ndarray,
    surface_polymer_fraction: np.ndarray,
    loss: Loss | None = None,
    **attributes,
) -> "xr.Dataset":
    """Profiles of a bead over time.

    t: shape (t,).  dry_faces: dry radii 0 ... 1 of the shell faces, shape (face,).  faces: their
    radii r, shape (t, face).  A shell's polymer fraction is its dry volume over its volume, and
    belongs to the root of the shell's mean r^2; ``polymer_volume_error`` sums the polymer of all
    shells again and compares it with that of the dry bead.  The attribute ``stopped`` is empty, or
    tells of the ``loss`` that ended the run.
    """
    import xarray as xr

    if loss and len(t) > 1 and t[-1] - t[-2] <= ROUNDED * t[-1]:  # both are where it stopped
        t, faces, surface_polymer_fraction = (
            np.delete(each, -2, axis=0) for each in (t, faces, surface_polymer_fraction)
        )
    volume = np.diff(faces**3, axis=1)
    phi = np.diff(dry_faces**3) / volume
    r = np.sqrt(0.6 * np.diff(faces**5, axis=1) / volume)
    profile = ("t", "cell")
    return xr.Dataset(
        {
            "radius": variable("t", faces[:, -1], "radius of the bead", LENGTH),
            "r": variable(profile, r, "radial position of the shell", LENGTH),
            "polymer_fraction": variable(profile, phi, "polymer volume fraction"),
            "surface_polymer_fraction": variable(
                "t", surface_polymer_fraction, "polymer volume fraction at the surface"
            ),
            "polymer_volume_error": variable(
                "t",
                (phi * volume).sum(axis=1) - 1.0,
                "polymer volume of all shells relative to the dry bead's, minus one",
            ),
            "r_face": variable(("t", "face"), faces, "radii of the shell faces", LENGTH),
        },
        coords={
            "t": variable("t", np.asarray(t, dtype=float), "elapsed time", TIME),
            "dry_radius": variable(
                "face", dry_faces, "radii of the shell faces in the dry bead", LENGTH
            ),
        },
        attrs=attributes | ({"stopped": ""} if loss is None else loss.attributes()),
    )
