"""Figure 14: equilibrium polymer fraction against temperature, with its folds."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

RANGE = (300.0, 312.0)  # K; of a gel that is not known there, its own temperatures
NARROW = 0.2  # K: a hysteresis narrower than this needs an inset to be seen
ARROWS = (r"\downarrow", r"\uparrow")  # a gel collapses at the swollen fold, swells at the dry one


def draw(materials: Mapping, published: Mapping[str, Sequence[float]]) -> Figure:
    """One panel a gel: stable equilibria solid, unstable ones dashed, folds as dots.

    materials: datasets of ``materials.tables`` by gel name; ``temperature_equilibrium``,
    ``equilibrium_is_stable`` and ``fold_*`` are drawn.  published: transition temperatures read
    off the paper's figure, by gel, on the temperature axis.
    """
    fig = style.figure(height=2.6)
    axes = np.atleast_1d(fig.subplots(1, len(materials), sharey=True))
    for ax, label, (name, gel) in zip(axes, "abcd", materials.items(), strict=False):
        limits = _limits(gel)
        _curve(ax, gel)
        _tell(fig, label, name, gel, published.get(name, []), limits)
        for temperature in published.get(name, []):
            ax.plot(
                temperature,
                0.0,
                clip_on=False,
                zorder=5,
                label="published $T_C$",
                **style.PUBLISHED_MARKER,
            )
        ax.set(xlim=limits, ylim=(0.0, 1.0), xlabel="temperature $T$ (K)")
        style.panel_label(ax, label)
        ax.set_title(name)
        T, phi = _folds(gel)
        if len(T) == 2 and np.ptp(T) < NARROW:
            _magnified(ax, gel)
        else:
            _annotate(ax, T, phi)
    axes[0].set_ylabel(r"equilibrium polymer fraction $\phi_0$")
    handles, labels = axes[0].get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    fig.legend(unique.values(), unique.keys(), loc="outside upper center", ncols=4)
    return fig


def _limits(gel):
    """RANGE, if the gel's own temperatures cover half of it; else these, in K."""
    T = gel.temperature.values
    common = min(T.max(), RANGE[1]) - max(T.min(), RANGE[0])
    return RANGE if common >= 0.5 * (RANGE[1] - RANGE[0]) else (T.min(), T.max())


def _tell(fig, panel, name, gel, published, limits):
    T, phi = gel.temperature_equilibrium.values, gel.polymer_fraction.values
    stable = gel.equilibrium_is_stable.values.astype(bool)
    drawn = (limits[0] <= T) & (limits[1] >= T)
    for what, temperatures, fractions in (
        ("stable equilibria", T[stable & drawn], phi[stable & drawn]),
        ("unstable equilibria", T[~stable & drawn], phi[~stable & drawn]),
        ("folds", *_folds(gel)),
    ):
        columns = {Quantity.TEMPERATURE: temperatures, Quantity.POLYMER: fractions}
        style.tell(fig, panel, f"{what} of {name}", columns)
    style.tell(fig, panel, f"T_C published of {name}", {Quantity.TEMPERATURE: published})


def _curve(ax, gel):
    T = gel.temperature_equilibrium.values
    stable = gel.equilibrium_is_stable.values.astype(bool)
    phi = gel.polymer_fraction.values
    ax.plot(np.where(stable, T, np.nan), phi, color=style.LENS, label="stable")
    ax.plot(np.where(stable, np.nan, T), phi, "--", color=style.GREY, label="unstable")
    ax.plot(*_folds(gel), "o", color=style.NONLINEAR, label="fold", zorder=4)


def _folds(gel):
    """Temperatures and polymer fractions of the folds, the swollen one first."""
    order = np.argsort(gel.fold_polymer_fraction.values)
    return gel.fold_temperature.values[order], gel.fold_polymer_fraction.values[order]


def _annotate(ax, T, phi, fontsize=8):
    """Name the transition temperatures: the collapse to the right of its fold, the other left."""
    for arrow, temperature, fraction, side in zip(ARROWS, T, phi, (1, -1), strict=False):
        ax.annotate(
            f"$T_C^{arrow}$\n{temperature:.3f} K",
            (temperature, fraction),
            (5 * side, 0),
            textcoords="offset points",
            ha="left" if side > 0 else "right",
            va="center",
            fontsize=fontsize,
        )


def _magnified(ax, gel):
    """An inset of some ten times the hysteresis about the folds."""
    T, phi = _folds(gel)
    inset = ax.inset_axes((0.115, 0.5, 0.495, 0.44))
    _curve(inset, gel)
    _annotate(inset, T, phi, fontsize=7)
    middle, height = phi.mean(), 1.7 * np.ptp(phi)
    inset.set(
        xlim=(T.min() - 6 * np.ptp(T), T.max() + 6 * np.ptp(T)),
        ylim=(middle - height, middle + height),
    )
    inset.ticklabel_format(useOffset=False)
    inset.locator_params(axis="x", nbins=3)
    style.zoom(ax, inset, joined=True)
