"""A gel at a glance: equilibrium with measured points, spinodal, and jumps that part phases."""

import textwrap

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.materials import sheet

LINE = 0.12  # inches of a line below


def draw(data) -> Figure:
    """Left: T_eq with its error, the points, and where D < 0. Right: which jumps separate.

    What `materials.sheet.said` has to say stands below.
    """
    lines = [line for each in sheet.said(data) for line in textwrap.wrap(each, 115)]
    fig = style.figure(height=2.9 + LINE * len(lines))
    left, right = fig.subplots(1, 2, width_ratios=[1.35, 1.0])
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
        left.errorbar(
            data.measured_T, data.measured_phi, data.measured_phi_error, data.measured_T_error,
            linestyle="none", marker="o", markersize=2.5, color=style.NONLINEAR, linewidth=0.6,
            label="measured",
        )  # fmt: skip
    if data.sizes["fold"]:
        left.plot(data.fold_temperature, data.fold_polymer_fraction, "sk", label="fold")
    left.set(xlim=(low - 0.5, high + 0.5), ylim=(0, 1), xlabel="temperature $T$ (K)",
             ylabel=r"polymer fraction $\phi$")  # fmt: skip
    left.legend(fontsize=7)
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
