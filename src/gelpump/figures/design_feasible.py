"""The tubes that do what is wanted, and the best of them, of `gelpump.design.feasible`."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from gelpump.design import units
from gelpump.figures import style
from gelpump.figures.sweep import label_logarithmic

if TYPE_CHECKING:
    import xarray as xr

LABELS = {
    "ell": r"$\ell$",
    "a_1": r"$a_1$",
    "heated_length": r"$L$",
    "permeability": r"$k$",
    "heating_step": r"$\Delta T$",
    "response_time": "response time",
    "pumped_volume": "volume pumped",
    "wall": "wall",
    "travel_time": "time of the pulse",
}
PANELS = [
    ("response_time", "pumped_volume"),
    ("a_1", "ell"),
    ("heated_length", "permeability"),
    ("heating_step", "wall"),
]
EVEN = {"ell", "heating_step"}
BEST, SOLVED = "#D55E00", "#000000"
MOST = 3000  # points


def picture(found: "xr.Dataset", some: "xr.Dataset") -> Figure:
    """The feasible set over its parameters, coloured by the time of the pulse; the best in front.

    found, some: of `feasible.scan` and `feasible.confirmed`.
    """
    best = found.isel(index=np.flatnonzero(found.best.values))
    drawn = found.isel(index=slice(None, None, -(-found.sizes["index"] // MOST)))
    unit = {key: _unit(found[key]) for key in LABELS}
    lasts = drawn.travel_time.values * unit["travel_time"][0]
    norm = LogNorm(lasts.min(), max(lasts.max(), 1.01 * lasts.min()))
    fig = style.figure(height=4.6)
    axes = fig.subplots(2, 2)
    for ax, (x, y), letter in zip(axes.flat, PANELS, "abcd", strict=True):

        def place(data, x=x, y=y):
            return tuple(data[key].values * unit[key][0] for key in (x, y))

        dots = ax.scatter(*place(drawn), c=lasts, norm=norm, cmap=style.POLYMER_FRACTION, s=5,
                          linewidths=0, rasterized=True)  # fmt: skip
        ax.plot(*place(best), "o", color=BEST, ms=3, mew=0.6, mfc="none", label="best")
        if x == "response_time":
            times, _ = place(some)
            solved = some.solved_volume.values * unit["pumped_volume"][0]
            ax.plot(times, solved, "x", color=SOLVED, ms=5, mew=0.8, label="solved pulse")
            ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderaxespad=0.2)
        for key, name, axis in ((x, "x", ax.xaxis), (y, "y", ax.yaxis)):
            if key not in EVEN:
                getattr(ax, f"set_{name}scale")("log")
                label_logarithmic(axis, *axis.get_view_interval())
            getattr(ax, f"set_{name}label")(f"{LABELS[key]}{unit[key][1]}")
        style.panel_label(ax, letter)
    label = f"{LABELS['travel_time']}{unit['travel_time'][1]}"
    bar = fig.colorbar(dots, ax=axes, pad=0.02, aspect=40, label=label)
    label_logarithmic(bar.ax.yaxis, norm.vmin, norm.vmax)
    return fig


def _unit(values):
    """What a number in SI units is multiplied by to be read, and in which unit."""
    middle = float(np.exp(np.log(values.values).mean()))
    shown, unit = units.shown(middle, values.units)
    return shown / middle, f" ({units.readable(unit)})" if unit else ""
