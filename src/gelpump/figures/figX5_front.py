"""Figure X5: a bead that separates dries by a front, in the sharp limit of both models."""

import textwrap
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

PROFILES = 6
LOOK = {"nonlinear": ("fully nonlinear", style.NONLINEAR), "lens": ("LENS", style.LENS)}


def draw(nonlinear: "xr.Dataset", lens: "xr.Dataset") -> Figure:
    """(a) Radii of bead and front over time; (b) profiles of the nonlinear bead.

    Datasets of ``gelpump.separation.observed``.
    """
    fig = style.figure(height=2.6)
    left, right = fig.subplots(1, 2, width_ratios=(1.15, 1.0))
    end = (
        1.25 * max(run.attrs.get("completion_t", float(run.t[-1])) for run in (nonlinear, lens))
        or 1.0
    )
    for run in (nonlinear, lens):
        _courses(left, run, end)
    left.set(
        xlabel="time $t$ ($t_{BMJ}$)", ylabel="radius ($R_{dry}$)", xlim=(0, end), ylim=(0, None)
    )
    left.legend(loc="upper right", fontsize=7)
    style.panel_label(left, "a")
    _profiles(right, nonlinear)
    style.panel_label(right, "b")
    return fig


def _courses(ax, run, end):
    name, colour = LOOK[run.attrs["model"]]
    shown = run.t.values <= end
    t, a = run.t.values[shown], run.radius.values[shown]
    front = np.where(run.front_present.values > 0, run.front_radius.values, np.nan)[shown]
    ax.plot(t, a, color=colour, label=f"bead, {name}")
    style.tell(
        ax, "a", f"bead, {name}".replace(",", ""), {Quantity.BEAD_TIME: t, Quantity.BEAD_RADIUS: a}
    )
    met = np.isfinite(front)
    course = np.array([t[met], front[met]])
    if "completion_t" in run.attrs:
        course = np.column_stack([course, [run.attrs["completion_t"], 0.0]])
    ax.plot(*course, "--", color=colour, label=f"front, {name}")
    columns = {Quantity.BEAD_TIME: course[0], Quantity.BEAD_RADIUS: course[1]}
    style.tell(ax, "a", f"front {name}", columns)
    if "birth_t" in run.attrs:
        birth = run.attrs["birth_t"], run.attrs["birth_radius"]
        ax.plot(*birth, "x", color=colour, markersize=6, markeredgewidth=1.4, clip_on=False)


def _profiles(ax, run):
    front = run.front_dry_radius.where(run.front_present > 0).values
    wanted = np.linspace(0.95, 0.2, PROFILES)
    met = np.isfinite(front)
    if not met.any():
        said = run.attrs.get("stopped") or "it goes on in one phase"
        ax.text(0.5, 0.5, textwrap.fill(f"No front travels: {said}.", 34), ha="center", va="center",
                transform=ax.transAxes, fontsize=7)  # fmt: skip
        ax.set_axis_off()
        return
    chosen = np.unique([int(np.nanargmin(np.abs(front - R))) for R in wanted])
    for i, colour in zip(chosen, style.shades(style.LATER, chosen.size), strict=True):
        # faces of shells carry no polymer fraction of their own: each shell is drawn as it is
        r, phi = run.r_face.values[i], run.polymer_fraction.values[i]
        label = f"{float(run.t[i]):.2g}"
        ax.stairs(phi, r, baseline=None, color=colour, label=label)
        columns = {Quantity.BEAD_RADIUS: run.r.values[i], Quantity.POLYMER: phi}
        style.tell(ax, "b", f"t = {label}", columns)
    ax.set(xlabel="radial position $r$ ($R_{dry}$)", ylabel=r"polymer fraction $\phi$")
    ax.set(xlim=(0, None), ylim=(0, 1.35 * float(run.polymer_fraction.max())))
    ax.legend(
        title="$t$", title_fontsize=7, fontsize=7, ncols=3, loc="upper right", columnspacing=1
    )
