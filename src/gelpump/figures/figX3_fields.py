"""Figure X3, fields: the tube in two dimensions, and the sharpness of its front."""

from string import ascii_lowercase
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import Normalize

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

BEHIND, AHEAD = 1.9, 1.9  # of what is drawn, in a_1
SPACING = 0.19  # of arrows
LONGEST = 0.16  # arrow in the wall, in a_1
LEAST = 0.03  # of the longest arrow
ARROWS = {"angles": "xy", "scale_units": "xy", "scale": 1.0, "units": "inches", "zorder": 4}
HEAD = {"headwidth": 4.5, "headlength": 5.0, "headaxislength": 4.6, "minlength": 0.1}
DEPTHS = (0.03, 0.3, 0.7, 0.97)  # of the arrows in the wall, from its inner edge
FRONT = {"color": style.NONLINEAR, "linestyle": "--", "linewidth": 0.9}
POSITION = "z-Z_C [a_1]"
SHARP = "A [1/a_1]"
LINES = {"printed": "--", "conservative": ":"}


def draw(pulses: "xr.Dataset", waves: "xr.Dataset", slender: "xr.Dataset"):
    """Sections of the tubes at one time; then Phi in the middle of the wall, and A.

    pulses, waves: of ``truth.production``; slender: of ``truth.slenderness``.
    """
    tubes = pulses.sizes["ell"]
    fig = style.figure(height=2.75 + 1.5 * tubes)
    grid = fig.add_gridspec(tubes + 1, 2, height_ratios=[1] * tubes + [1.7])
    axes = [fig.add_subplot(grid[row, :]) for row in range(tubes)]
    labels = ascii_lowercase[: tubes + 2]
    for i, (ax, label) in enumerate(zip(axes, labels, strict=False)):
        mesh = _section(ax, pulses.isel(ell=i), label)
        style.panel_label(ax, label)
        if i < tubes - 1:
            ax.tick_params(labelbottom=False)
    axes[-1].set_xlabel(r"axial position from the front, $(z-Z_C)/a_1$")
    bar = fig.colorbar(mesh, ax=axes, pad=0.02, label=r"polymer fraction $\phi/\phi_{00}$")
    bar.set_ticks([1.0, 1.25, 1.5, 1.75, 2.0])
    left, right = (fig.add_subplot(grid[tubes, column]) for column in range(2))
    _profiles(left, pulses, slender, labels[-2])
    _sharpness(right, waves, slender, labels[-1])
    for ax, label in zip((left, right), labels[-2:], strict=True):
        style.panel_label(ax, label)
    return fig


def _section(ax, tube, panel):
    z, r, Phi = (tube[name].values for name in ("z", "r", "Phi"))
    mesh = ax.pcolormesh(
        z,
        r,
        Phi,
        shading="gouraud",
        norm=Normalize(1.0, 2.0),
        rasterized=True,
    )
    for edge in (0, -1):
        ax.plot(z[:, edge], r[:, edge], color="black", linewidth=0.9)
    ax.axvline(0.0, **FRONT)
    ax.set(xlim=(-BEHIND, AHEAD), ylim=(0.0, 1.12), aspect="equal", ylabel=r"$r/a_1$")
    ax.set_title(rf"$\ell={float(tube.ell):g}$")
    style.tell(
        ax, panel, "wall", {POSITION: z[::3], Quantity.RADIAL: r[::3], Quantity.PHI: Phi[::3]}
    )
    places = np.arange(-BEHIND + SPACING / 2, AHEAD, SPACING)
    arrows = []
    for depth in DEPTHS:
        column = round(depth * (z.shape[1] - 1))
        row = [
            _at(places, z[:, column], tube[name].values[:, column]) for name in ("r", "u_z", "u_r")
        ]
        arrows.append([places, *row])
    x, y, u, v = np.concatenate(arrows, axis=1)
    _arrows(
        ax,
        x,
        y,
        u,
        v,
        panel,
        "wall",
        {"facecolor": "white", "edgecolor": "black", "width": 0.012, "linewidth": 0.35},
    )
    inner = tube.lumen_z.values
    V = np.interp(places, inner, tube.lumen_V.values)
    height = 0.45 * np.interp(places, inner, tube.lumen_b.values)
    _arrows(
        ax,
        places,
        height,
        V,
        np.zeros_like(V),
        panel,
        "lumen",
        {"color": style.LENS, "width": 0.011},
    )
    return mesh


def _at(places, z, values):
    """Each side of the front by itself: values may jump there."""
    front = int(np.abs(z).argmin()) + 1
    return np.where(
        places < 0,
        np.interp(places, z[:front], values[:front]),
        np.interp(places, z[front:], values[front:]),
    )


def _arrows(ax, x, y, u, v, panel, where, look):
    length = np.hypot(u, v)
    way = LONGEST / length.max()
    drawn = length > LEAST * length.max()
    ax.quiver(x[drawn], y[drawn], way * u[drawn], way * v[drawn], **ARROWS, **HEAD, **look)
    columns = {
        POSITION: x[drawn],
        Quantity.RADIAL: y[drawn],
        "u_z [k Pi_00/(mu_l a_1)]": u[drawn],
        "u_r [k Pi_00/(mu_l a_1)]": v[drawn],
    }
    style.tell(ax, panel, f"flow in the {where}", columns)


def _profiles(ax, pulses, slender, panel):
    colours = style.ell_colours(pulses.ell.values)
    middle = pulses.sizes["across"] // 2
    for i, colour in enumerate(colours):
        thickness = 1 - float(pulses.ell[i])
        tube = pulses.isel(ell=i)
        x = tube.z.values[:, middle] / thickness
        Phi = tube.Phi.values[:, middle - 1 : middle + 1].mean(axis=1)
        ax.plot(x, Phi, color=colour, label=rf"2D, $\ell={float(tube.ell):g}$")
        columns = {"(z-Z_C)/(a_1-a_0) [1]": x, Quantity.PHI: Phi}
        style.tell(ax, panel, f"two dimensions at ell = {float(tube.ell):g}", columns)
    for closure, line in LINES.items():
        here = slender.sel(closure=closure).isel(ell=slender.sizes["ell"] // 2)
        x = here.z.values / (1 - float(here.ell))
        ax.plot(x, here.Phi, color=style.GREY, linestyle=line, label=f"slender, {closure}")
        columns = {"(z-Z_C)/(a_1-a_0) [1]": x, Quantity.PHI: here.Phi}
        style.tell(ax, panel, f"slender {closure} at ell = {float(here.ell):g}", columns)
    ax.set(xlim=(-1.6, 1.6), ylim=(0.95, 2.06))
    ax.set(xlabel="$(z-Z_C)/(a_1-a_0)$", ylabel=r"$\phi/\phi_{00}$ in the mid-wall")
    ax.legend(loc="lower left", handlelength=1.6, fontsize=7, borderaxespad=0.3)


def _sharpness(ax, waves, slender, panel):
    thickness = 1 - waves.ell.values
    colours = style.shades(style.LATER, waves.sizes["Pe"] + 1)[1:]
    for k, colour in enumerate(colours):
        A = waves.A.values[:, k]
        ax.plot(thickness, A, "o-", color=colour, markersize=2.6, linewidth=0.9)
        columns = {Quantity.THICKNESS: thickness, SHARP: A, "Pe [1]": float(waves.Pe[k])}
        style.tell(ax, panel, "two dimensions", columns)
    tubes = 1 - slender.ell.values
    A = slender.A.sel(closure="printed").values[:, -1]
    ax.plot(tubes, A, "s", color=style.NONLINEAR, markersize=3.5, label="slender, printed, late")
    style.tell(ax, panel, "slender printed", {Quantity.THICKNESS: tubes, SHARP: A})
    x = np.array([0.14, 0.4])
    for slope, at, label, k, align in (
        (-1, 1.05, "slope $-1$", 0, "right"),
        (-0.5, 15.0, "slope $-1/2$", 1, "left"),
    ):
        guide = at * (x / x[1]) ** slope
        ax.plot(x, guide, color=style.GREY, linestyle=":", linewidth=0.9)
        ax.text(
            x[k] * (0.94, 1.06)[k],
            guide[k],
            label,
            color=style.GREY,
            ha=align,
            va="center",
            fontsize=7,
        )
    first, last = float(waves.Pe[0]), float(waves.Pe[-1])
    ax.text(
        0.09,
        0.9 * waves.A.values[-1, 0],
        f"Pe = {first:g}",
        fontsize=7,
        ha="right",
        color=colours[0],
    )
    ax.text(
        0.09,
        0.9 * waves.A.values[-1, -1],
        f"Pe = {last:g}",
        fontsize=7,
        ha="right",
        color=colours[-1],
    )
    ax.set(xscale="log", yscale="log", xlim=(0.05, 1.05), ylim=(0.7, 45.0), xlabel=r"$1-\ell$")
    ax.set_ylabel("sharpness $A$ (in $1/a_1$)")
    ax.set_xticks([0.1, 0.2, 0.5, 1.0], ["0.1", "0.2", "0.5", "1"])
    ax.set_yticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
    ax.minorticks_off()
    ax.legend(loc="upper right", handlelength=0.8, fontsize=7)
