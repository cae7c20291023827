"""Figure X1: whether the wall of the tube conserves water, by closure."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.closures import line
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

ROUNDING = 1e-17  # what is drawn of an error that is zero
WIDTHS = 6.0  # of a wall's w on either side of the front
LOST = "Phi_1 loss over Z_C [1]"
THROUGH = "through the edges over Z_C [1]"
MISSING = "unaccounted over Z_C [1]"


def draw(balance: "xr.Dataset", printed: "xr.Dataset", conserving: "xr.Dataset", ell) -> Figure:
    """(a) What the wall loses against what goes through its edges; (b) the rest; (c) the front.

    balance: of `gelpump.tube.pump`.  printed and conserving: pulses at the same times, the latter
    by closure.
    """
    fig = style.figure(height=4.6)
    grid = fig.add_gridspec(2, 2)
    loss, rest = fig.add_subplot(grid[0, 0]), fig.add_subplot(grid[0, 1])
    front = fig.add_subplot(grid[1, :])
    here = balance.sel(ell=ell, method="nearest")
    scale = np.pi * (1 - float(here.ell) ** 2) * here.Z_C
    for closure in balance.closure.values:
        one = here.sel(closure=closure)
        lost, left = one.loss / scale, one.source_loss / scale
        loss.semilogx(one.tau, lost, **line(closure))
        loss.semilogx(one.tau, left, **(line(closure) | {"linestyle": ":"}))
        columns = {Quantity.TAU: one.tau, LOST: lost, THROUGH: left}
        style.tell(fig, "a", closure, columns)
        missing = np.maximum(one.water_balance_error, ROUNDING)
        rest.loglog(one.tau, missing, label=closure, **line(closure))
        style.tell(fig, "b", closure, {Quantity.TAU: one.tau, MISSING: missing})
    loss.set(xlabel=r"time $\tau$", ylabel=r"water of the wall, over $Z_C$")
    loss.plot([], [], color=style.GREY, label="lost by the wall")
    loss.plot([], [], ":", color=style.GREY, label="gone through its edges")
    loss.legend(loc="lower left", handlelength=1.6)
    rest.set(xlabel=r"time $\tau$", ylabel=r"unaccounted for, over $Z_C$", ylim=(1e-16, 30))
    rest.legend(loc="center right", handlelength=1.6)
    _fronts(fig, front, printed, conserving, ell)
    for axes, letter in ((loss, "a"), (rest, "b"), (front, "c")):
        style.panel_label(axes, letter)
    return fig


def _fronts(fig, axes, printed, conserving, ell):
    """Profiles at the last time, Z from the front in units of the printed w."""
    pulses = {"printed": printed} | {
        str(name): conserving.sel(closure=name) for name in conserving.closure.values
    }
    for closure, pulse in pulses.items():
        last = pulse.isel(tau=-1).sel(ell=ell, method="nearest")
        w = float(last.eps) * (1 - float(last.ell)) / 4
        ahead = (last.Z - last.Z_C).values / w
        near = np.abs(ahead) < WIDTHS
        axes.plot(ahead[near], last.Phi1.values[near], **line(closure))
        columns = {"(Z-Z_C)/w [1]": ahead[near], Quantity.PHI: last.Phi1.values[near]}
        style.tell(fig, "c", closure, columns)
    axes.axvline(0.0, color=style.GREY, linewidth=0.6)
    axes.set(xlabel=r"distance from the front, $(Z-Z_C)\,/\,[\varepsilon(1-\ell)/4]$")
    axes.set(ylabel=r"polymer fraction $\Phi_1$", xlim=(-WIDTHS, WIDTHS))
