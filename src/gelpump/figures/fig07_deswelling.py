"""Figure 7: how fast a tube deswells when it is heated everywhere at once."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

SLOW = LinearSegmentedColormap.from_list("slow", ["#ffffff", "#b4b4b4"])  # slow tubes are dark
MILLI = 1e3
TIME_UNIT = r"\mu_lL^2/k\Pi_{00}"


def draw(
    times: "xr.Dataset", curves: "xr.Dataset", published: Sequence[tuple[float, float]]
) -> Figure:
    """(a) Time tau_99 to deswell over M and the ratio of osmotic pressures; (b) its course.

    times: ``tau99`` over (``M``, ``Pi_ratio``), of the tube ``map_ell``.  curves: ``Phi1`` over
    ``tau`` for each ``ell``.  published: times and values of Phi1 read off the paper's figure.
    """
    fig = style.figure(height=2.75)
    left, right = fig.subplots(1, 2, width_ratios=(1.0, 1.05))
    _map(left, times)
    columns = {
        "M [1]": times.M.values,
        "Pi_ratio [1]": times.Pi_ratio.values[:, np.newaxis],
        "tau_99 [mu_l L^2/(k Pi_00)]": times.tau99.transpose("Pi_ratio", "M"),
    }
    style.tell(fig, "a", f"time to deswell at ell = {float(times.map_ell):g}", columns)
    _courses(fig, right, curves, published)
    style.panel_label(left, "a")
    style.panel_label(right, "b")
    return fig


def _map(ax, times):
    tau99 = times.tau99.transpose("Pi_ratio", "M").values
    decades = np.arange(np.floor(np.log10(tau99.min())), np.ceil(np.log10(tau99.max())) + 1)
    levels = np.ravel([digit * 10.0 ** decades[:, np.newaxis] for digit in (1, 2, 5)])
    levels = np.unique(levels[(levels > tau99.min()) & (levels < tau99.max())])
    ax.contourf(
        times.M, times.Pi_ratio, tau99, levels=levels, colors=style.shades(SLOW, len(levels) + 1),
        extend="both",
    )  # fmt: skip
    lines = ax.contour(
        times.M, times.Pi_ratio, tau99, levels=levels, colors="black", linewidths=0.8
    )
    ax.set(xscale="log", yscale="log", xlabel=r"$\mathcal{M}=\mu_s/\Pi_{00}$")
    ax.set_ylabel(r"$\tilde\Pi=\Pi_{0\infty}/\Pi_{00}$")
    ax.clabel(lines, fmt=_power, fontsize=7.5, inline_spacing=3)
    ax.set_title(rf"$\tau_{{99}}$ for $\ell={float(times.map_ell):g}$")


def _power(value):
    """A contour's label, like 2 x 10^-4."""
    exponent = int(np.floor(np.log10(value) + 1e-9))
    digit = value / 10.0**exponent
    return (rf"${digit:.0f}\times" if round(digit) > 1 else "$") + rf"10^{{{exponent}}}$"


def _courses(fig, ax, curves, published):
    ells = curves.ell.values
    colours = dict(zip(ells, style.ell_colours(ells), strict=True))
    for ell, colour in colours.items():
        Phi1 = curves.Phi1.sel(ell=ell)
        ax.plot(MILLI * curves.tau, Phi1, color=colour, clip_on=False)
        columns = {Quantity.ELL: ell, Quantity.TAU: curves.tau, Quantity.PHI: Phi1}
        style.tell(fig, "b", "course", columns)
    Phi_inf = float(curves.Phi1_reswelling.isel(ell=0, tau=0))  # where re-swelling starts
    end = MILLI * float(curves.tau[-1])
    ax.axhline(Phi_inf, color=style.GREY, linestyle="--", linewidth=0.8)
    ax.text(0.04 * end, Phi_inf + 0.01, r"$\Phi_\infty$", ha="left", va="bottom")
    ax.plot(
        [MILLI * tau for tau, _ in published],
        [Phi1 for _, Phi1 in published],
        label="published",
        zorder=5,
        **style.PUBLISHED_MARKER,
    )
    columns = {
        Quantity.TAU: [tau for tau, _ in published],
        Quantity.PHI: [Phi1 for _, Phi1 in published],
    }
    style.tell(fig, "b", "course published", columns)
    ax.set(xlim=(0.0, end), ylim=(1.0, 1.0 + 1.1 * (Phi_inf - 1.0)))
    ax.set(xlabel=rf"time $\tau$ ($10^{{-3}}\,{TIME_UNIT}$)", ylabel=r"polymer fraction $\Phi_1$")
    ax.legend(loc="lower right", handlelength=0.8)
    style.steps(fig, ax, ells, list(colours.values()), r"$\ell=a_0/a_1$")
