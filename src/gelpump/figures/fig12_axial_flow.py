"""Figure 12: the pulse of water in the lumen."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

WITHOUT = r"$\int_0^Z\Phi_1\mathcal{D}(\Phi_0-\Phi_1)\,\mathrm{d}Z$"
PREFACTOR = r"$8/\varepsilon^2(1-\ell)^2$"
MAXIMUM = "V_max_without_prefactor [L]"
WITH_PREFACTOR = "V_max [k Pi_00/(mu_l L)]"
GUIDE = {"color": style.GREY, "linewidth": 0.9, "linestyle": ":"}


def draw(pulse: "xr.Dataset", published: Sequence[float]) -> Figure:
    """(a) Axial velocity along the lumen and (b) its maximum, both without the prefactor of
    eqn:lumen, as the paper plots them; (c) the maximum with it.

    pulse: a dataset of ``tube.lumen_pulse``; (a) ``V_plotted`` over ``Z`` for each ``tau``, (b)
    ``V_max_plotted`` over ``A``, (c) ``V_max`` over ``one_minus_ell``, of the tanh form, and
    ``V_front_printed``, of the solved tubes at the last time.  published: heights of the curves of
    (a), of the peak and far ahead, that were read off; not where along Z, so they mark the axis.
    """
    fig = style.figure(height=4.1)
    grid = fig.add_gridspec(2, 2)
    top, left, right = (fig.add_subplot(grid[cell]) for cell in ((0, slice(None)), (1, 0), (1, 1)))
    _pulses(fig, top, pulse, published)
    _maximum(left, pulse)
    _with_prefactor(right, pulse)
    for ax, label in zip((top, left, right), "abc", strict=True):
        style.panel_label(ax, label)
    return fig


def _pulses(fig, ax, pulse, published):
    times = pulse.tau.values
    colours = style.shades(style.LATER, len(times))
    for now, colour in zip(times, colours, strict=True):
        V = pulse.V_plotted.sel(tau=now)
        ax.plot(pulse.Z, V, color=colour)
        columns = {Quantity.TAU: now, Quantity.AXIAL: pulse.Z, "V_without_prefactor [L]": V}
        style.tell(ax, "a", "axial velocity", columns)
    end = float(pulse.Z[-1])
    ax.plot(
        np.full(len(published), end),
        published,
        label="published height",
        clip_on=False,
        zorder=5,
        **style.PUBLISHED_MARKER | {"marker": "<"},
    )
    style.tell(ax, "a", "axial velocity published", {"V_without_prefactor [L]": published})
    ax.set(xlim=(0.0, end), ylim=(0.0, 1.12 * float(pulse.V_plotted.max())))
    ax.set(xlabel="axial position $Z=z/L$", ylabel=f"{WITHOUT}\n(in $L$)")
    ax.set_title(rf"$A={float(pulse.drawn_A):g}/L$, without the prefactor {PREFACTOR}")
    ax.legend(loc="upper left", bbox_to_anchor=(0.26, 1.0), handlelength=0.8)
    style.steps(fig, ax, times, colours, r"time $\tau$ ($\mu_lL^2/k\Pi_{00}$)")


def _maximum(ax, pulse):
    A = pulse.A.values
    ax.plot(A, pulse.V_max_plotted, color=style.LENS, label="tanh form")
    style.tell(ax, "b", "tanh form", {Quantity.SHARPNESS: A, MAXIMUM: pulse.V_max_plotted})
    _guide(ax, A, 2.2 * float(pulse.V_max_plotted[0] * A[0]), -1)
    ax.set(xscale="log", yscale="log", xlim=(A[0], A[-1]))
    ax.set(xlabel="sharpness $A$ (in $1/L$)", ylabel="maximum without\nprefactor (in $L$)")
    ax.legend(loc="lower left", handlelength=1.4, borderaxespad=0.3)


def _with_prefactor(ax, pulse):
    thickness = pulse.one_minus_ell.values
    some = thickness < 1
    ax.plot(thickness[some], pulse.V_max.values[some], color=style.LENS, label="tanh form")
    ax.plot(
        1 - pulse.ell,
        pulse.V_front_printed.isel(tau=-1),
        "o",
        markersize=2.4,
        color=style.DRYING,
        label="solved tubes",
    )
    for name, thick, V in (
        ("tanh form", thickness[some], pulse.V_max.values[some]),
        ("solved tubes", 1 - pulse.ell, pulse.V_front_printed.isel(tau=-1)),
    ):
        style.tell(ax, "c", name, {Quantity.THICKNESS: thick, WITH_PREFACTOR: V})
    bounds = np.array([0.9 * min(thickness.min(), float((1 - pulse.ell).min())), 1.0])
    _guide(ax, bounds, 2.2 * float(pulse.V_max[some][0] * thickness[some][0]), -1)
    ax.set(xscale="log", yscale="log", xlim=bounds, xlabel=r"$1-\ell$")
    ax.set_ylabel(r"$V_\mathrm{max}$ with prefactor" "\n" r"(in $k\Pi_{00}/\mu_lL$)")
    for axis, ticks in ((ax.xaxis, [0.05, 0.1, 0.2, 0.5, 1.0]), (ax.yaxis, [50, 100, 200, 500])):
        axis.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    ax.minorticks_off()
    ax.legend(loc="lower left", handlelength=1.4, borderaxespad=0.3)


def _guide(ax, bounds, factor, slope):
    x = np.geomspace(bounds[0], bounds[-1], 9)[[3, 6]]
    ax.plot(x, factor * x**slope, **GUIDE)
    middle = np.sqrt(x.prod())
    ax.text(
        middle,
        1.1 * factor * middle**slope,
        f"slope ${slope}$",
        color=style.GREY,
        ha="left",
        va="bottom",
    )
