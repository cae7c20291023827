"""Figure X9: beads and tubes that are heated and cooled again and again."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr

VOLUME = "pumped [pi a_1^2 L]"
ERROR = "uncertainty [pi a_1^2 L]"
PERIOD = "period [mu_l L^2/(k Pi_00)]"
SHARE = "elapsed [periods]"
LESS = "the same, less than"
HEATED = "#f7e3d4"
COLOURS = ("#D55E00", "#0072B2", "#009E73", "#7a1b8c")
LINES = {  # of panel d: the variable, its marker, colour and name
    "stroke": ("o", "#0072B2", "to and fro, past the station"),
    "net_within": ("^", "#D55E00", "left past a section, at most"),
    "net": ("s", "#555555", "left past the station"),
}


def draw(beads: "xr.Dataset", tube: "xr.Dataset", gels: "Mapping") -> Figure:
    """(a) Loops a(T) and equilibria; (b) T and a over time; (c) water past a station; (d) what a
    cycle moves and what it leaves, over the period.

    Datasets of ``gelpump.cycles.production``; ``gels`` are those of the beads.
    """
    fig = style.figure(height=4.6)
    (loops, course), (past, cycle) = fig.subplots(2, 2)
    _loops(loops, course, beads, gels)
    _past(past, tube.isel(period=-1))
    _per_cycle(cycle, tube.isel(cycle=-1))
    for axes, label in ((loops, "a"), (course, "b"), (past, "c"), (cycle, "d")):
        style.panel_label(axes, label)
    return fig


def _loops(loops, course, beads, gels):
    span = float(beads.temperature.min()) - 2.2, float(beads.temperature.max()) + 0.3
    drawn = {name.partition(",")[0] for name in beads.loop.values.tolist()}
    for gel in (gels[name] for name in sorted(drawn & set(gels))):
        phi = np.geomspace(0.02, 0.9, 1200)
        T = gel.equilibrium_temperature(phi)
        inside = (span[0] < T) & (span[1] > T)
        a = np.where(inside, phi, np.nan) ** (-1 / 3)
        loops.plot(np.where(inside, T, np.nan), a, color="#aaaaaa", linewidth=2.2, zorder=0)
        style.tell(loops, "a", f"equilibria {gel.name}",
                   {Quantity.TEMPERATURE: T[inside], "a [R_dry]": a[inside]})  # fmt: skip
    for i, colour in zip(range(beads.sizes["loop"]), COLOURS, strict=False):
        one = beads.isel(loop=i)
        name = str(one.loop.values)
        T, a, t = one.temperature.values, one.radius.values, one.elapsed.values / float(one.period)
        loops.plot(T, a, color=colour, label=name)
        course.plot(t, a, color=colour)
        told = {Quantity.TEMPERATURE: T, "a [R_dry]": a, SHARE: t}
        style.tell(loops, "a", name.replace(",", ""), told)
    loops.set(xlim=span, xlabel="temperature $T$ (K)", ylabel=r"radius $a/R_\mathrm{dry}$")
    loops.legend(fontsize=7, loc="lower left")
    other = course.twinx()
    kelvin = beads.temperature
    share = (kelvin - kelvin.min("moment")) / (kelvin.max("moment") - kelvin.min("moment"))
    first = beads.isel(loop=0)
    t = first.elapsed.values / float(first.period)
    other.plot(t, share.isel(loop=0).values, ":", color=style.GREY)
    other.set(ylabel="programme, cold to hot", ylim=(0, 1.05))
    other.set_yticks([0, 1])
    style.tell(course, "b", "programme", {SHARE: t, "share [1]": share.isel(loop=0).values})
    course.set(xlabel="time (periods)", ylabel=r"radius $a/R_\mathrm{dry}$", xlim=(0, t[-1]))


def _past(axes, tube):
    period = float(tube.period)
    t = tube.elapsed.values / period
    for k in range(tube.sizes["cycle"]):
        axes.axvspan(k, k + 0.5, color=HEATED, linewidth=0)
    axes.plot(t, tube.station.values, color="#0072B2", label="finite volumes of the wall")
    some = slice(2, None, 4)
    axes.plot(t[some], tube.station_second.values[some], **style.PUBLISHED_MARKER,
              label="second solver")  # fmt: skip
    axes.set(xlabel="time (periods); shaded: hot", xlim=(0, t[-1]))
    axes.set_ylabel(r"past a station $(\pi a_1^2 L)$")
    axes.set_ylim(top=1.42 * float(tube.station.max()))
    axes.legend(
        fontsize=7, loc="upper left", frameon=True, framealpha=1.0, edgecolor="none", borderpad=0.2
    )
    style.tell(axes, "c", "station", {SHARE: t, VOLUME: tube.station.values})
    style.tell(axes, "c", "second solver", {SHARE: t, VOLUME: tube.station_second.values})


def _per_cycle(axes, tube):
    period = tube.period.values
    for name, (marker, colour, text) in LINES.items():
        value, error = np.abs(tube[name].values), tube[f"{name}_uncertainty"].values
        known = value > error
        options = {"color": colour, "linewidth": 0.9, "markersize": 4, "capsize": 2}
        axes.errorbar(period[known], value[known], error[known], marker=marker, label=text,
                      **options)  # fmt: skip
        # nothing but a bound is known of a value below its own uncertainty
        if (~known).any():
            axes.plot(period[~known], (value + error)[~known], "v", color=colour, markersize=4,
                      fillstyle="none", label=LESS)  # fmt: skip
        columns = {PERIOD: period, VOLUME: tube[name].values, ERROR: error}
        style.tell(axes, "d", text.replace(",", ""), columns)
    axes.set(xscale="log", yscale="log", xlabel=r"period $(\mu_l L^2/k\,\Pi_{00})$")
    axes.set_ylabel(r"per cycle $(\pi a_1^2 L)$")
    axes.set_xticks(period, labels=[f"{each:g}" for each in period])
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlim(period[0] / 1.6, period[-1] * 1.6)
    axes.set_ylim(top=4e3 * float(tube.stroke.max()))
    handles, names = axes.get_legend_handles_labels()
    order = sorted(range(len(names)), key=lambda i: names[i] == LESS)
    axes.legend([handles[i] for i in order], [names[i] for i in order], fontsize=7,
                loc="upper left", borderpad=0.2)  # fmt: skip
