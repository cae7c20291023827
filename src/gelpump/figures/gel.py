"""A gel at a glance: equilibrium with measured points, spinodal, and jumps that part phases."""

import textwrap

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.materials import sheet

LINE = 0.12  # inches of a line below
MEASURED = (  # by flag: not told, heating, cooling
    ("measured", "o", style.NONLINEAR),
    ("heating", "^", style.NONLINEAR),
    ("cooling", "v", style.SWELLING),
)


def draw(data) -> Figure:
    """(a) T_eq with its error, the points, and where D < 0. (b) Which jumps separate. (c) Of a
    fitted gel, how far each point lies from the fit, in errors.

    What `materials.sheet.said` has to say stands below.
    """
    lines = [line for each in sheet.said(data) for line in textwrap.wrap(each, 115)]
    fitted = "measured_T" in data
    fig = style.figure(height=2.9 + 1.1 * fitted + LINE * len(lines))
    names = [["a", "b"], ["c", "b"]] if fitted else [["a", "b"]]
    axes = fig.subplot_mosaic(names, width_ratios=[1.35, 1.0],
                              height_ratios=[2.4, 1.0][: len(names)])  # fmt: skip
    left, right = axes["a"], axes["b"]
    if lines:
        fig.supxlabel("\n".join(lines), fontsize=7, ha="left", x=0.02, color=style.NONLINEAR)
    T, phi = data.temperature_equilibrium.values, data.polymer_fraction.values
    stable = data.equilibrium_is_stable.values.astype(bool)
    shown = [data.before.values, data.measured_T.values if "measured_T" in data else []]
    low, high = np.concatenate(shown).min(), np.concatenate(shown).max()
    spinodal = data.temperature_spinodal.values
    within = (spinodal > low - 10) & (spinodal < high + 40)
    left.plot(
        np.where(within, spinodal, np.nan), phi, ":", color=style.SEPARATING, label="spinodal"
    )
    left.plot(np.where(stable, T, np.nan), phi, color=style.LENS, label="stable")
    left.plot(np.where(stable, np.nan, T), phi, "--", color=style.GREY, label="unstable")
    if "measured_T" in data:
        near = (low - 5 < T) & (high + 5 > T)  # elsewhere T_eq runs off to its pole
        error = np.where(near, data.equilibrium_error.values, np.nan)
        left.fill_betweenx(phi, T - error, T + error, color=style.LENS, alpha=0.25, linewidth=0)
        for flag, (label, marker, colour) in enumerate(MEASURED):
            here = data.isel(point=np.flatnonzero(data.measured_branch.values == flag))
            if not here.sizes["point"]:
                continue
            left.errorbar(
                here.measured_T, here.measured_phi, here.measured_phi_error, here.measured_T_error,
                linestyle="none", marker=marker, markersize=3, color=colour, linewidth=0.6,
                label=label, fillstyle="none" if flag == 2 else "full",
            )  # fmt: skip
            axes["c"].plot(
                here.measured_T, here.residual, marker, color=colour, markersize=3,
                fillstyle="none" if flag == 2 else "full",
            )  # fmt: skip
        _residuals(axes["c"], left, low, high, data)
    if data.sizes["fold"]:
        left.plot(data.fold_temperature, data.fold_polymer_fraction, "sk", label="fold")
    left.set(xlim=(low - 0.5, high + 0.5), ylim=(0, 1), xlabel="temperature $T$ (K)",
             ylabel=r"polymer fraction $\phi$")  # fmt: skip
    left.legend(fontsize=7)
    if fitted:
        left.set_xlabel("")
        left.tick_params(labelbottom=False)
    style.panel_label(left, "a")
    step = np.gradient(data.before.values) / 2
    edges = np.append(data.before.values - step, data.before.values[-1] + step[-1])
    right.pcolormesh(edges, edges, data.separates.values.T,
                     cmap=ListedColormap(["#f4f4f4", style.DRYING, "#c0c0c0"]),
                     vmin=0, vmax=2, edgecolors="white", linewidth=0.5)  # fmt: skip
    for i, before in enumerate(data.before.values):
        for j, after in enumerate(data.after.values):
            mark = ("", "×", "–")[int(data.separates.values[i, j])]
            right.text(before, after, mark, ha="center", va="center")
    right.set(xlabel="before the jump (K)", ylabel="after the jump (K)", aspect="equal")
    none = "" if np.all(data.separates < sheet.NO_STATE) else ", – no stable state"
    right.set_title(f"× phases separate{none}", fontsize=8)
    style.panel_label(right, "b")
    return fig


def _residuals(ax, above, low, high, data):
    """The residuals' axes; a fit that goes through its points has two in three within the band."""
    ax.axhspan(-1, 1, color="#eeeeee", zorder=0)
    ax.axhline(0, color=style.GREY, linewidth=0.6)
    largest = max(1.5, 1.15 * float(np.abs(data.residual).max()))
    ax.set(xlim=(low - 0.5, high + 0.5), ylim=(-largest, largest),
           xlabel="temperature $T$ (K)", ylabel="residual/error")  # fmt: skip
    style.panel_label(ax, "c")
