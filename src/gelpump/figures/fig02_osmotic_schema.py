"""Figure 2: how a rise in temperature dries a gel, on two osmotic pressure curves of a real one."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

ARROW = {"arrowstyle": "-|>", "color": "black", "linewidth": 1.0, "shrinkA": 0, "shrinkB": 0}


def draw(material: "xr.Dataset", temperatures: Sequence[float]) -> Figure:
    """Pi(phi) at a temperature below the transition and one above, their stable equilibria, and
    the way from one to the other when a gel of uniform phi is heated.

    material: a dataset of ``materials.tables``; its ``osmotic_pressure`` and ``equilibrium_*`` at
    the two temperatures are drawn.  The inset magnifies the jump.
    """
    cold, hot = (float(T) for T in temperatures)
    phi = material.polymer_fraction.values
    colours = dict(zip((cold, hot), style.shades(style.TEMPERATURE, 2), strict=True))
    pressure = {T: material.osmotic_pressure.sel(temperature=T).values for T in (cold, hot)}
    swollen, dry = _equilibria(material, cold)[0], _equilibria(material, hot)[-1]
    jump = np.interp(swollen, phi, pressure[hot])
    path = np.r_[swollen, phi[(phi > swollen) & (phi < dry)], dry]
    way = np.interp(path, phi, pressure[hot])

    fig = style.figure(height=2.8, width=4.4)
    ax = fig.subplots()
    close = ax.inset_axes((0.08, 0.56, 0.32, 0.35))
    for axes in (ax, close):
        axes.axhline(0.0, color=style.GREY, linewidth=0.6)
        axes.plot(path, way, color=colours[hot], linewidth=4, alpha=0.25, solid_capstyle="butt")
        for T, colour in colours.items():
            axes.plot(phi, pressure[T], color=colour)
        axes.plot(swollen, 0.0, "o", color=colours[cold], zorder=4)
        axes.plot(dry, 0.0, "o", color=colours[hot], zorder=4)
    for name, T, fractions, Pi in (
        *(("osmotic pressure", T, phi, pressure[T]) for T in colours),
        ("way of a gel that is heated", hot, path, way),
        ("equilibrium", cold, swollen, 0.0),
        ("equilibrium", hot, dry, 0.0),
    ):
        columns = {Quantity.TEMPERATURE: T, Quantity.POLYMER: fractions, Quantity.PRESSURE: Pi}
        style.tell(fig, "a", name, columns)
    close.annotate("", (swollen, jump), (swollen, 0.0), arrowprops=ARROW)
    for share in (0.3, 0.7, 0.93):  # arrow heads along the way, at these shares of its length
        i = int(np.searchsorted(path, swollen + share * (dry - swollen)))
        ax.annotate("", (path[i], way[i]), (path[i - 1], way[i - 1]), arrowprops=ARROW)

    lowest = int(np.argmin(way))
    depth = -way[lowest]
    ax.set(xlim=(0.0, 1.0), ylim=(-1.5 * depth, 3.0 * depth))
    ax.set(xlabel=r"polymer fraction $\phi$", ylabel=r"osmotic pressure $\Pi\,\Omega_f/k_BT$")
    _label(ax, rf"$T_2 = {hot:g}$ K $> T_C$", (path[lowest], -depth), (0, -14), colours[hot])
    beyond = phi > swollen
    at = np.interp(2 * depth, pressure[cold][beyond], phi[beyond])
    _label(ax, rf"$T_1 = {cold:g}$ K $< T_C$", (at, 2 * depth), (-40, 0), colours[cold])
    _label(ax, r"$\phi_0(T_1)$", (swollen, 0.0), (0, 6), colours[cold])
    _label(ax, r"$\phi_0(T_2)$", (dry, 0.0), (16, -11), colours[hot])
    close.set(xlim=(0.4 * swollen, 1.8 * swollen), ylim=(1.8 * jump, -1.0 * jump))
    close.locator_params(nbins=4)
    close.ticklabel_format(axis="y", scilimits=(0, 0), useMathText=True)
    style.zoom(ax, close, joined=False)
    return fig


def _label(ax, text, at, offset, colour):
    ax.annotate(text, at, offset, textcoords="offset points", ha="center", color=colour)


def _equilibria(material, temperature):
    """The stable equilibrium polymer fractions at a temperature, increasing."""
    here = (material.equilibrium_temperature == temperature) & (material.equilibrium_stable == 1)
    return np.sort(material.equilibrium_polymer_fraction.values[here.values])
