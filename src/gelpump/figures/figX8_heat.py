"""Figure X8: how far the heat that a collapse takes up holds its front back."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity
from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.stefan import tolerated

if TYPE_CHECKING:
    import xarray as xr

COLOURS = {"bath": "#000000", "pipe": "#0072B2", "insulated": "#D55E00"}
DASHES = ("-", "--", ":", "-.")
RATIO, SCALED, THETA = "Z_C/sqrt(Le tau) [1]", "tau [w^2]", "theta [Delta T]"


def draw(heat: "xr.Dataset") -> Figure:
    """(a) The front over time; (b) temperature; (c) shift over f St; (d) the printed equation.

    heat: of `gelpump.tube.heat_study`.
    """
    fig = style.figure(height=5.0)
    (front, profile), (shift, printed) = fig.subplots(2, 2)
    drawn = {}
    for i, kind in enumerate(heat.surrounding.values):
        number = sum(kind == other for other in heat.surrounding.values[:i])
        f_St = float(heat.f_St[i])
        text = "bath" if kind == "bath" else rf"{kind}, $f\,$St $={f_St:g}$"
        drawn[i] = text, {"color": COLOURS[kind], "linestyle": DASHES[number]}
        name = f"{kind} f St = {f_St:g}"
        _front(front, heat.isel(tube=i), name, drawn[i][1])
        _profile(profile, heat.isel(tube=i, tau=-1), name, *drawn[i])
    front.set(
        xlabel=r"time $\tau/w^2$", ylabel=r"$Z_C/\sqrt{\mathrm{Le}\,\tau}$", xscale="log",
        ylim=(0.55, 1.0),
    )  # fmt: skip
    profile.set(xlim=(0, 3.2), ylim=(-1.05, 1.05), ylabel=r"temperature $\theta$")
    profile.set_xlabel(r"position $Z/\sqrt{\mathrm{Le}\,\tau}$")
    profile.axhline(0.0, color=style.GREY, linewidth=0.5, zorder=0)
    profile.legend(loc="upper right", fontsize=7, handlelength=2.0)
    _shift(shift, heat)
    _printed(printed, heat)
    for axes, letter in zip((front, profile, shift, printed), "abcd", strict=True):
        style.panel_label(axes, letter)
    return fig


def _front(axes, one, name, look):
    scaled = one.tau.values / float(one.wall_length) ** 2
    axes.plot(scaled, one.front_over_diffusion, **look)
    axes.plot(scaled[-1], one.front_limit, "o", color=look["color"], markersize=4, clip_on=False)
    style.tell(axes, "a", name, {SCALED: scaled, RATIO: one.front_over_diffusion.values})
    style.tell(axes, "a", f"limit {name}", {RATIO: [float(one.front_limit)]})


def _profile(axes, one, name, text, look):
    Z = one.Z.values / np.sqrt(float(one.Le) * float(one.tau))
    Z, theta = (np.insert(each[Z < 4], 0, end) for each, end in ((Z, 0.0), (one.theta.values, 1.0)))
    axes.plot(Z, theta, label=text, **look)
    columns = {"Z/sqrt(Le tau) [1]": Z, THETA: theta}
    style.tell(axes, "b", name, columns)


def _shift(axes, heat):
    x, named = "f_St [1]", "relative shift of Z_C [1]"
    for kind in heat.kind.values:
        curve = -heat["shift"].sel(kind=kind).values
        axes.loglog(heat.f_St_curve, curve, color=COLOURS[kind], label=kind)
        style.tell(axes, "c", str(kind), {x: heat.f_St_curve.values, named: -curve})
        solved = (heat.surrounding.values == kind) & (heat.f_St.values > 0)
        if not solved.any():
            continue
        last = 1 - heat.front_over_diffusion.values[solved, -1] / FRONT_CONSTANT
        axes.plot(heat.f_St[solved], last, "o", color=COLOURS[kind])
        style.tell(axes, "c", f"solved {kind}", {x: heat.f_St.values[solved], named: -last})
    for share in (0.01, 0.05):
        axes.axhline(share, color=style.GREY, linewidth=0.6, linestyle=":", zorder=0)
        p = np.cbrt(float(heat.Phi_inf))
        axes.plot(tolerated(share) / p, share, "x", color=style.GREY, zorder=3)
        style.tell(axes, "c", f"tolerated {share:g}", {x: [tolerated(share) / p], named: [-share]})
    axes.set(xlabel=r"$f\,$St", ylabel="front held back by")
    axes.set(xlim=(float(heat.f_St_curve[0]), float(heat.f_St_curve[-1])), ylim=(1e-5, 1.0))
    axes.legend(loc="lower right")


def _printed(axes, heat):
    w = float(heat.wall_length[0])
    scaled = heat.tau_printed.values / w**2
    shades = ("#CC79A7", "#7a1b8c")
    for Z_C, N, colour in zip(heat.Z_C_printed.values / w, heat.N.values, shades, strict=False):
        axes.loglog(scaled, Z_C, color=colour, label=rf"as printed, $N={N:g}$")
        style.tell(axes, "d", f"printed N = {N:g}", {SCALED: scaled, "Z_C [w]": Z_C})
    taking = int(np.flatnonzero(heat.surrounding.values == "pipe")[-1])
    once = heat.tau.values / w**2
    shown = once <= 2 * scaled[-1]
    Z_C = heat.Z_C.values[taking] / w
    f_St = float(heat.f_St[taking])
    axes.loglog(
        once[shown], Z_C[shown], color=COLOURS["pipe"], label=rf"derived, $f\,$St $={f_St:g}$"
    )
    style.tell(axes, "d", f"f St = {f_St:g}", {SCALED: once[shown], "Z_C [w]": Z_C[shown]})
    decoupled = FRONT_CONSTANT * np.sqrt(float(heat.Le) * scaled)
    axes.loglog(scaled, decoupled, "--", color="black", label="decoupled")
    style.tell(axes, "d", "decoupled", {SCALED: scaled, Quantity.AXIAL: decoupled * w})
    axes.set(xlabel=r"time $\tau/w^2$", ylabel=r"front $Z_C/w$", xlim=(scaled[0], scaled[-1]))
    axes.legend(loc="upper left")
