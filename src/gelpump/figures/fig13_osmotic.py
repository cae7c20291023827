"""Figure 13: osmotic pressure against polymer fraction at several temperatures."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

DEPTH = 1.12  # how far below the lowest minimum the panels reach, in its depth
HEIGHT = 1.7  # and how far above zero: further up the curves only rise
CLOSE = 1.3  # the inset shows swollen equilibria up to this temperature's, in their phi


def draw(materials: Mapping) -> Figure:
    """One panel a gel, with an inset of its swollen equilibria.

    materials: datasets of ``materials.tables`` by gel name; ``osmotic_pressure`` is drawn at every
    ``temperature``, and dots on the zero line are the stable ones of its ``equilibrium_*``.
    """
    fig = style.figure(height=2.6)
    axes = np.atleast_1d(fig.subplots(1, len(materials)))
    temperatures = [gel.temperature.values for gel in materials.values()]
    shared = all(np.array_equal(each, temperatures[0]) for each in temperatures)
    for ax, label, (name, gel) in zip(axes, "abcd", materials.items(), strict=False):
        colours = style.shades(style.TEMPERATURE, gel.sizes["temperature"])
        depth = -float(gel.osmotic_pressure.min())
        inset = ax.inset_axes((0.2, 0.62, 0.43, 0.34))
        for each in (ax, inset):
            each.axhline(0.0, color=style.GREY, linewidth=0.6)
            for T, colour in zip(gel.temperature.values, colours, strict=True):
                now = gel.osmotic_pressure.sel(temperature=T)
                each.plot(gel.polymer_fraction, now, color=colour)
                phi = _stable(gel, T)
                each.plot(phi, 0.0 * phi, "o", markersize=3.2, color=colour, zorder=4)
        _tell(fig, label, name, gel)
        ax.set(xlim=(0.0, 1.0), ylim=(-DEPTH * depth, HEIGHT * depth))
        ax.set(xlabel=r"polymer fraction $\phi$")
        style.panel_label(ax, label)
        ax.set_title(name)
        _magnify(ax, inset, gel)
        if not shared or ax is axes[-1]:
            beside = axes if shared else ax
            style.steps(fig, beside, gel.temperature.values, colours, "temperature $T$ (K)")
    axes[0].set_ylabel(r"osmotic pressure $\Pi\,\Omega_f/k_BT$")
    return fig


def _tell(fig, panel, name, gel):
    for T in gel.temperature.values:
        phi = _stable(gel, T)
        for what, fractions, Pi in (
            ("osmotic pressure", gel.polymer_fraction, gel.osmotic_pressure.sel(temperature=T)),
            ("stable equilibria", phi, 0.0 * phi),
        ):
            columns = {Quantity.TEMPERATURE: T, Quantity.POLYMER: fractions, Quantity.PRESSURE: Pi}
            style.tell(fig, panel, f"{what} of {name}", columns)


def _stable(gel, temperature):
    here = (gel.equilibrium_temperature == temperature) & (gel.equilibrium_stable == 1)
    return gel.equilibrium_polymer_fraction.values[here.values]


def _magnify(ax, inset, gel):
    """Show the swollen equilibria, those below the fold of the equilibrium curve."""
    swollen = gel.equilibrium_polymer_fraction.values[
        gel.equilibrium_polymer_fraction.values < gel.fold_polymer_fraction.values.min(initial=1.0)
    ]
    if not swollen.size:
        inset.remove()
        return
    right = CLOSE * swollen.max()
    near = gel.osmotic_pressure.sel(polymer_fraction=slice(0.0, right))
    height = -0.6 * float(near.min())
    inset.set(xlim=(0.0, right), ylim=(-height, height))
    inset.locator_params(nbins=3)
    style.zoom(ax, inset, joined=False)
