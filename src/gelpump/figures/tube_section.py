"""A section along a tube, coloured by polymer fraction: what figures 6, 8, 10 and 11 share."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import Normalize

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

AXIAL = "axial position $Z=z/L$"
RADIAL = "radius $R=r/a_1$"
POLYMER = r"polymer fraction $\phi/\phi_{00}$"
EDGE = {"color": "black", "linewidth": 0.9}
SWOLLEN = {"color": "#909090", "linestyle": ":", "linewidth": 1.0}
FRONT = {"color": style.NONLINEAR, "linestyle": "--", "linewidth": 0.9}


def shape(pulse: "xr.Dataset", end: float):
    """Z, inner and outer radius and polymer fraction of a tube at one time, from Z = 0 to ``end``.

    pulse: a dataset of ``tube.slender`` at one ell and tau.  The edges follow ``Phi1`` as B_0 =
    ell Phi1^(-1/3) and B_1 = Phi1^(-1/3); ahead of its last cell the tube is swollen.
    """
    Z, Phi1 = extended(pulse.Z.values, pulse.Phi1.values, end)
    outer = Phi1 ** (-1 / 3)
    return Z, float(pulse.ell) * outer, outer, Phi1


def tell(fig, panel: str, pulse: "xr.Dataset", end: float) -> None:
    """The numbers of ``shape`` and the place of the front."""
    Z, inner, outer, Phi1 = shape(pulse, end)
    time = {Quantity.ELL: pulse.ell, Quantity.TAU: pulse.tau}
    columns = {Quantity.AXIAL: Z, Quantity.INNER: inner, Quantity.OUTER: outer, Quantity.PHI: Phi1}
    style.tell(fig, panel, "wall", time | columns)
    style.tell(fig, panel, "front Z_C", time | {Quantity.AXIAL: pulse.Z_C})


def extended(Z, values, end):
    """``values`` at ``Z`` drawn out evenly to Z = 0 and to ``end``: nothing varies there."""
    after = [end] if end > Z[-1] else []
    pad = [(1, len(after))] + [(0, 0)] * (np.ndim(values) - 1)
    return np.concatenate([[0.0], Z, after]), np.pad(values, pad, mode="edge")


def wall(ax, Z, radius, polymer_fraction, Phi_inf):
    """The wall of a tube; ``radius`` and ``polymer_fraction`` have the dimensions (Z, across)."""
    mesh = ax.pcolormesh(
        np.broadcast_to(Z[:, np.newaxis], radius.shape),
        radius,
        polymer_fraction,
        shading="gouraud",
        norm=Normalize(1.0, float(Phi_inf)),
        rasterized=True,
    )
    for edge in (0, -1):
        ax.plot(Z, radius[:, edge], **EDGE)
    return mesh


def bar(fig, mesh, axes, **options):
    """The colour bar of polymer fractions, in units of that of the swollen tube."""
    bar = fig.colorbar(mesh, ax=axes, pad=0.02, label=POLYMER, **options)
    ticks = np.linspace(mesh.norm.vmin, mesh.norm.vmax, 5)
    bar.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    return bar
