"""Figures 3 and 4 are one drawing: polymer fraction of a bead over time and radius, two panels."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

MODELS = {"lens": "LENS", "nonlinear": "nonlinear"}
COLOURS = {"lens": style.LENS, "nonlinear": style.NONLINEAR}
RADIUS = r"$r/R_\mathrm{dry}$"
TIME = r"$t_\mathrm{BMJ}$"
SHORTEST = 1e-3  # of the case's end: where a logarithmic axis begins without profile times
THINNED = (2, 4)  # of the map, one time in 2 and one shell in 4 are told in numbers


def draw(
    beads: Mapping[str, "xr.Dataset"], case: Mapping, published: Mapping, time_scale: str
) -> Figure:
    """(a) Polymer fraction of the LENS bead, with radii; (b) profiles of both models.

    beads: datasets of ``bead.dataset`` for "lens" and "nonlinear".  case: its ``published_times``
    and ``profile_times`` are used.  published: radii read off the paper at the published times,
    by model.  time_scale: "log" or "linear".  A run that stopped, be it at t = 0, ends with a
    cross, its last profile, in black, and the sentence that says why.
    """
    fig = style.figure(height=2.7)
    left, right = fig.subplots(1, 2, width_ratios=(1.1, 1.0))
    _kymograph(fig, left, beads["lens"], time_scale)
    for model, bead in beads.items():
        left.plot(
            bead.t,
            bead.radius,
            "-" if model == "lens" else "--",
            color=COLOURS[model],
            linewidth=1.3,
            label=MODELS[model],
        )
        columns = {Quantity.BEAD_TIME: bead.t, Quantity.BEAD_RADIUS: bead.radius}
        style.tell(fig, "a", f"radius {MODELS[model]}", columns)
    for model, radii in published.items():
        left.plot(
            case["published_times"],
            radii,
            label=f"{MODELS[model]}, published",
            clip_on=False,
            zorder=5,
            **style.PUBLISHED_BY_MODEL[model],
        )
        columns = {Quantity.BEAD_TIME: case["published_times"], Quantity.BEAD_RADIUS: radii}
        style.tell(fig, "a", f"radius {MODELS[model]} published", columns)
    times = case["profile_times"] or beads["lens"].t.values[:: max(1, beads["lens"].t.size // 8)]
    stops = [bead.attrs.get("stopped_t", 0.0) / 2 for bead in beads.values()]
    earliest = min((t for t in [*times, *stops] if t > 0), default=SHORTEST * case["end"])
    start = earliest if time_scale == "log" else 0.0
    top = 1.05 * max(float(bead.radius.max()) for bead in beads.values())
    left.set(xlim=(start, case["end"]), ylim=(0.0, top), xlabel=TIME, ylabel=RADIUS)
    _profiles(fig, right, beads, times)
    _stops(fig, (left, right), beads, start)
    right.set_xlim(0.0, top)
    right.set_ylim(bottom=0.0)
    fig.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=4)
    style.panel_label(left, "a")
    style.panel_label(right, "b")
    return fig


def _stops(fig, axes, beads, start):
    """A cross where each run stopped, at the earliest time shown if that was before, and why."""
    sentences = []
    for model, bead in beads.items():
        if "stopped_t" not in bead.attrs:
            continue
        t, radius = bead.attrs["stopped_t"], float(bead.radius[-1])
        cross = {"color": COLOURS[model], "markersize": 6, "markeredgewidth": 1.6, "zorder": 6}
        axes[0].plot(max(t, start), radius, "x", clip_on=False, **cross)
        columns = {Quantity.BEAD_TIME: [t], Quantity.BEAD_RADIUS: [radius]}
        style.tell(fig, "a", f"phases separate {MODELS[model]}", columns)
        sentences.append(f"{MODELS[model]}: {bead.attrs['stopped']}")
        _profile(fig, axes[1], model, bead.isel(t=-1), "black")
    if sentences:
        fig.supxlabel("\n".join(sentences), fontsize=7)


def _kymograph(fig, ax, bead, time_scale):
    """Each material shell between two output times is one quadrilateral, as it was computed."""
    ax.set_xscale(time_scale)
    first = 1 if time_scale == "log" else 0  # t = 0 is not on a logarithmic axis
    phi = bead.polymer_fraction.values[first:]
    if len(phi) < 2:  # it stopped at once: there is no course to show
        return
    t = np.broadcast_to(bead.t.values[first:, None], (len(phi), bead.sizes["face"]))
    mesh = ax.pcolormesh(
        t,
        bead.r_face.values[first:],
        (phi[1:] + phi[:-1]) / 2,
        shading="flat",
        norm=LogNorm(phi.min(), phi.max()),
        rasterized=True,
    )
    style.polymer_fraction_bar(fig, mesh, ax, aspect=25, label=r"polymer fraction $\phi$, LENS")
    times, shells = (slice(None, None, step) for step in THINNED)
    columns = {
        Quantity.BEAD_TIME: bead.t.values[first::, np.newaxis][times],
        Quantity.BEAD_RADIUS: bead.r.values[first:][times, shells],
        Quantity.POLYMER: phi[times, shells],
    }
    every = f"one time in {THINNED[0]} and one shell in {THINNED[1]}"
    style.tell(fig, "a", f"map LENS ({every})", columns)


def _profiles(fig, ax, beads: Mapping[str, "xr.Dataset"], times: Sequence[float]):
    colours = style.shades(style.LATER, len(times))
    for model, bead in beads.items():
        for time, colour in zip(times, colours, strict=True):
            if time > bead.t.values[-1]:  # the run stopped before
                continue
            now = bead.sel(t=time, method="nearest")
            _profile(fig, ax, model, now, colour if model == "lens" else style.NONLINEAR)
    ax.set(xlabel=RADIUS, ylabel=r"polymer fraction $\phi$")
    style.steps(fig, ax, times, colours, TIME)


def _profile(fig, ax, model, now, colour):
    """phi from the centre to the surface; at t = 0 the surface has not yet responded."""
    r, phi = now.r.values, now.polymer_fraction.values
    surface = phi[-1] if now.t == 0 else float(now.surface_polymer_fraction)
    r, phi = np.r_[0.0, r, now.radius], np.r_[phi[0], phi, surface]
    ax.plot(
        r,
        phi,
        "-" if model == "lens" else "--",
        color=colour,
        linewidth=1.3 if model == "lens" else 0.7,
        dashes=(None, None) if model == "lens" else (3, 2),
    )
    columns = {Quantity.BEAD_TIME: now.t, Quantity.BEAD_RADIUS: r, Quantity.POLYMER: phi}
    style.tell(fig, "b", f"profile {MODELS[model]}", columns)
