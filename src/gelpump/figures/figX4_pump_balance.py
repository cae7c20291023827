"""Figure X4: where the water of the pump goes, and what geometry says of it."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.closures import line, marker
from gelpump.figures.style import Quantity
from gelpump.tube.pump import per_advance

if TYPE_CHECKING:
    import xarray as xr

PARTS = {
    "collapse_station": ("collapse of the lumen", "#56B4E9"),
    "inner": ("out of the wall into the lumen", "#0072B2"),
    "outer": ("out of the wall into the bath", "#E69F00"),
}
PER_TOLD = "volume over pi Z_C [a_1^2]"
VELOCITY = "V [k Pi_00/(mu_l L)]"
PER = r"volume, over $\pi a_1^2 Z_C$"
VARIED = {"Phi_inf": (r"$\Phi_\infty$", "linear"), "M": (r"$\mathcal{M}$", "log")}


def draw(balance: "xr.Dataset", response: "xr.Dataset", ell: float) -> Figure:
    """(a) Parts over ell; (b) V far ahead in time; (c, d) what is pumped as the gel varies.

    balance, response: of `gelpump.tube.pump`.  Lines are geometry where they are not closures.
    """
    fig = style.figure(height=4.9)
    drawn = fig.subplots(2, 2)
    parts, velocity = drawn[0]
    _parts(fig, parts, balance)
    _velocity(fig, velocity, balance, ell)
    for axes, letter, (key, (label, scale)) in zip(drawn[1], "cd", VARIED.items(), strict=True):
        here = response.isel(tube=response.varied.values == key, tau=-1)
        late = float(response.tau[-1])
        x = here[key].values
        for name, filled in (("pumped_station", True), ("pumped_end", False)):
            y = here[name].values
            look = marker("conservative")
            if filled:
                look["markerfacecolor"] = look["color"]
            text = "past a station" if filled else "out of the tube's end"
            axes.plot(x, y, label=text, **look)
            style.tell(fig, letter, f"{name} at tau {late:g}", {f"{key} [1]": x, PER_TOLD: y})
            fine = np.geomspace(x.min(), x.max(), 60)
            Phi_inf = fine if key == "Phi_inf" else np.full_like(fine, float(here.Phi_inf[0]))
            axes.plot(
                fine, per_advance(ell, Phi_inf)[name], color=style.GREY, linewidth=0.9, zorder=0
            )
        axes.set(xscale=scale, xlabel=label, ylabel=PER)
        axes.set_ylim(0.0, 1.1 * float(here.pumped_end.max()))
        style.panel_label(axes, letter)
    drawn[1, 0].legend(loc="upper left", handlelength=0.8)
    return fig


def _parts(fig, axes, balance):
    last = balance.sel(closure="conservative").isel(tau=-1)
    ells, advance = last.ell.values, np.pi * float(last.Z_C)
    fine = np.linspace(0.02, 0.98, 97)
    expected = per_advance(fine, float(balance.Phi_inf[0]))
    below = np.zeros_like(fine)
    foot = np.zeros(len(ells))
    for name, (text, colour) in PARTS.items():
        axes.fill_between(
            fine, below, below + expected[name], color=colour, alpha=0.45, lw=0, label=text
        )
        below = below + expected[name]
        foot = foot + (last[name] / advance).values
        axes.plot(ells, foot, "o", color=colour, markeredgecolor="black", markersize=4, mew=0.5)
        columns = {Quantity.ELL: ells, PER_TOLD: (last[name] / advance).values}
        style.tell(fig, "a", name, columns)
        style.tell(fig, "a", f"{name} by geometry", {Quantity.ELL: fine, PER_TOLD: expected[name]})
    axes.set(xlabel=r"$\ell=a_0/a_1$", ylabel=PER, xlim=(0, 1), ylim=(0, 1.5 * below.max()))
    axes.legend(loc="upper right", handlelength=1.0)
    style.panel_label(axes, "a")


def _velocity(fig, axes, balance, ell):
    here = balance.sel(ell=ell, method="nearest")
    for closure in balance.closure.values:
        V = here.V_far.sel(closure=closure)
        axes.loglog(here.tau, V, label=closure, **line(str(closure)))
        style.tell(fig, "b", str(closure), {Quantity.TAU: here.tau, VELOCITY: V})
    axes.loglog(
        here.tau, here.V_far_geometry, ":", color=style.GREY, linewidth=1.6, label="geometry"
    )
    style.tell(fig, "b", "geometry", {Quantity.TAU: here.tau, VELOCITY: here.V_far_geometry})
    axes.set(xlabel=r"time $\tau$", ylabel=rf"$V$ far ahead, $\ell={float(here.ell):g}$")
    axes.legend(loc="lower left", handlelength=1.8)
    style.panel_label(axes, "b")
