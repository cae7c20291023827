"""Figure X3: where each closure of the slender tube is within 1, 5 and 20 % of two dimensions."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.patches import Patch

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

TAU = 0.01  # of the eps that are written beside T
LEVELS = (0.0, 0.01, 0.05, 0.2, np.inf)
NAMES = ("within 1 %", "5 %", "20 %", "further off")
COLOURS = ("#08519c", "#6baed6", "#fdd49e", "#d7301f")
QUANTITIES = {
    "pumped": "volume pumped",
    "V_far": "velocity far ahead",
    "width": "front, 10 to 90 %",
    "tau99": r"$\tau_{99}$, heated\neverywhere".replace(r"\n", "\n"),
}


def draw(slender: "xr.Dataset"):
    """Rows are quantities, columns closures; each tile is a tube and its error in per cent, or the
    factor where that is more than two.

    slender: of ``truth.slenderness``.
    """
    fig = style.figure(height=5.6)
    closures = slender.closure.values
    axes = fig.subplots(len(QUANTITIES), len(closures), height_ratios=[1, 1, 1, 0.75])
    T = slender["T"].values
    eps = np.sqrt(TAU / T)
    colours = ListedColormap(COLOURS)
    norm = BoundaryNorm(np.arange(5), 4)
    for row, (quantity, title) in enumerate(QUANTITIES.items()):
        for column, closure in enumerate(closures):
            ax = axes[row, column]
            error = slender[f"{quantity}_error"].sel(closure=closure).values
            flat = error.ndim == 1
            table = error[np.newaxis, :] if flat else error
            ax.imshow(_classes(table), cmap=colours, norm=norm, aspect="auto", origin="lower")
            for (i, j), value in np.ndenumerate(table):
                dark = _classes(value) in (0, 3)
                ax.text(
                    j,
                    i,
                    _told(value),
                    ha="center",
                    va="center",
                    fontsize=4.4,
                    color="white" if dark else "black",
                )
            ax.tick_params(length=0, labelsize=6.5)
            if flat:
                ell = slender.wall_ell.values
                ax.set_xticks(range(ell.size), [f"{x:g}" for x in ell])
                ax.set_yticks([])
                ax.set_xlabel(r"$\ell$", labelpad=1)
                columns = {Quantity.ELL: ell, "relative_error [1]": error}
            else:
                ell = slender.ell.values
                ax.set_yticks(range(ell.size), [f"{x:g}" for x in ell])
                ax.set_xticks(range(0, T.size, 2), [f"{x:.2g}" for x in eps[::2]])
                columns = {
                    Quantity.ELL: ell[:, np.newaxis],
                    "T [mu_l a_1^2/(k Pi_00)]": T,
                    "eps at tau = 0.01 [1]": eps,
                    "relative_error [1]": error,
                }
                if row == 2:
                    ax.set_xlabel(r"$\varepsilon$ at $\tau=0.01$", labelpad=1)
            if column == 0:
                label = title if flat else f"{title}\n$\\ell$"
                ax.set_ylabel(label, fontsize=7.5)
            if row == 0:
                ax.set_title(str(closure))
            style.tell(ax, f"{quantity} {closure}", "slender over two dimensions - 1", columns)
    handles = [Patch(color=colour, label=name) for colour, name in zip(COLOURS, NAMES, strict=True)]
    fig.legend(handles=handles, loc="outside upper center", ncols=4)
    return fig


def _told(error):
    """Per cent; the factor where that is beyond two."""
    if error > 1:
        return f"×{1 + error:.2g}"
    return f"{100 * error:+.0f}".replace("-", "−") if abs(error) >= 0.005 else "0"


def _classes(error):
    return np.clip(np.searchsorted(LEVELS, np.abs(error), side="left") - 1, 0, 3)
