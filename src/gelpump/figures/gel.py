"""A gel at a glance: equilibrium with measured points, spinodal, and jumps that part phases."""

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from gelpump.figures import style


def draw(data) -> Figure:
    """Left: T_eq with its error, the points, and where D < 0. Right: which jumps separate."""
    fig = style.figure(height=2.9)
    left, right = fig.subplots(1, 2, width_ratios=[1.35, 1.0])
    T, phi = data.temperature_equilibrium.values, data.polymer_fraction.values
    stable = data.equilibrium_is_stable.values.astype(bool)
    low, high = float(data.before[0]), float(data.before[-1])
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
    left.plot(data.fold_temperature, data.fold_polymer_fraction, "s", color="black", label="fold")
    left.set(xlim=(low, high), ylim=(0, 1), xlabel="temperature $T$ (K)",
             ylabel=r"polymer fraction $\phi$")  # fmt: skip
    left.legend(fontsize=7)
    style.panel_label(left, "a")
    step = np.gradient(data.before.values) / 2
    edges = np.append(data.before.values - step, data.before.values[-1] + step[-1])
    right.pcolormesh(edges, edges, data.separates.values.T,
                     cmap=ListedColormap(["#f4f4f4", style.DRYING]),
                     vmin=0, vmax=1, edgecolors="white", linewidth=0.5)  # fmt: skip
    for i, before in enumerate(data.before.values):
        for j, after in enumerate(data.after.values):
            if data.separates.values[i, j]:
                right.text(before, after, "×", ha="center", va="center")
    right.set(xlabel="before the jump (K)", ylabel="after the jump (K)", aspect="equal")
    right.set_title("× phases separate", fontsize=8)
    style.panel_label(right, "b")
    return fig
