"""Figure X7: beads heated and cooled quasi-statically jump at the folds, not at equal energies."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

COLOURS = {"heating": style.NONLINEAR, "cooling": style.LENS}
ARROWS = {"heating": (0, -22), "cooling": (0, 22)}  # points, along the jump


def draw(loops: "Sequence[xr.Dataset]") -> Figure:
    """A panel for each gel: radius over temperature of the fully nonlinear bead, its folds and the
    temperature of equal energies.  Datasets of ``gelpump.separation.hysteresis``."""
    fig = style.figure(height=2.6)
    axes = np.atleast_1d(fig.subplots(1, len(loops)))
    for ax, loop, label in zip(axes, loops, "abcd", strict=False):
        _loop(ax, loop.sel(model="nonlinear"), label)
        style.panel_label(ax, label)
    axes[0].set(ylabel="radius $a$ ($R_{dry}$)")
    return fig


def _loop(ax, loop, panel):
    gel = loop.attrs["gel"]
    folds = np.sort(loop.fold_temperature.values)
    for fold in folds:
        ax.axvline(fold, color=style.GREY, linewidth=0.7, linestyle=":")
    ax.axvline(
        float(loop.equal_energy_temperature), color=style.GREY, linewidth=0.7, linestyle="--"
    )
    margin = 0.6 * (folds[1] - folds[0])
    span = folds[0] - margin, folds[1] + margin
    for way, colour in COLOURS.items():
        T, a = (loop[name].sel(way=way).values for name in ("temperature", "radius"))
        ax.plot(T, a, "o-", color=colour, markersize=2.6, linewidth=0.9, label=way)
        columns = {Quantity.TEMPERATURE: T, "a [R_dry]": a}
        style.tell(ax, panel, f"{gel} {way}", columns)
        jump = int(np.argmax(np.abs(np.diff(a))))
        middle = 0.5 * (a[jump] + a[jump + 1])
        ax.annotate(
            "",
            (T[jump], middle),
            xytext=tuple(-x for x in ARROWS[way]),
            textcoords="offset points",
            arrowprops={"arrowstyle": "->", "color": colour, "linewidth": 0.9},
        )
    ax.set(xlabel="temperature $T$ (K)", xlim=span)
    low, high = ax.get_ylim()
    ax.set_ylim(low - 0.15 * (high - low), high)
    ax.ticklabel_format(useOffset=False)
    ax.locator_params(axis="x", nbins=4)
    ax.legend(title=gel, title_fontsize=8, fontsize=7, loc="lower left", handlelength=1.2)
