"""Figure X2: how fast a wall resolved in r deswells, by what its surfaces do."""

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.closures import COLOURS, line, marker

if TYPE_CHECKING:
    import xarray as xr

PANELS = {
    "M": (r"$\mathcal{M}=\mu_s/\Pi_{00}$", "log"),
    "ell": (r"$\ell=a_0/a_1$", "linear"),
    "Phi_inf": (r"$\Phi_\infty$", "linear"),
}
TIME = "tau_99/(eps(1-ell))^2 [1]"


def draw(times: "xr.Dataset") -> Figure:
    """tau_99 over the squared thickness, against M (a), ell (b) and Phi_inf (c).

    times: of `gelpump.tube.wall_times`.  Points are resolved in r, filled on the midline and open
    in the mean over the wall; lines are the slender closures.
    """
    fig = style.figure(height=2.9)
    drawn = fig.subplots(1, 3, sharey=True)
    for axes, letter, (key, (label, scale)) in zip(drawn, "abc", PANELS.items(), strict=True):
        here = times.isel(tube=times.varied.values == key)
        h_squared = (times.eps * (1 - here.ell)) ** 2
        x = here[key].values
        for closure in COLOURS:
            t = (here[f"tau99_{closure}"] / h_squared).values
            axes.plot(x, t, **line(closure))
            style.tell(fig, letter, f"slender {closure}", {f"{key} [1]": x, TIME: t})
        for surface in times.surface.values:
            for place in times.place.values:
                t = (here.tau99.sel(surface=surface, place=place) / h_squared).values
                look = marker(str(surface))
                if place == "midline":
                    look["markerfacecolor"] = look["color"]
                axes.plot(x, t, **look)
                style.tell(fig, letter, f"{surface} {place}", {f"{key} [1]": x, TIME: t})
        axes.set(xscale=scale, yscale="log", xlabel=label)
        style.panel_label(axes, letter)
    drawn[0].set_ylabel(r"$\tau_{99}\,/\,[\varepsilon(1-\ell)]^2$")
    names = {
        "printed": "slender, printed",
        "conservative": r"slender, $\Phi_s=\Phi_0$",
        "balanced": "slender, no force on the surface",
    }
    handles = [drawn[1].plot([], [], label=text, **line(name))[0] for name, text in names.items()]
    for surface, said in (("conservative", r"$\Phi_s=\Phi_0$"), ("balanced", "no force")):
        full = marker(surface) | {"markerfacecolor": COLOURS[surface]}
        handles += drawn[1].plot([], [], label=f"resolved, {said}, midline", **full)
        handles += drawn[1].plot([], [], label=f"resolved, {said}, mean", **marker(surface))
    fig.legend(handles=handles, loc="outside lower center", ncols=3, fontsize=7.5)
    return fig
