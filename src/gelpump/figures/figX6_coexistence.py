"""Figure X6: which two phases meet at a front, beside figure 5's spinodal, and T*(a)."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

SHADES = ("#f2a97c", style.NONLINEAR, "#8a3c00")
RADIUS = "a [R_dry]"
STRETCH = "l_t [1]"


def draw(material: "xr.Dataset", phases: "xr.Dataset") -> Figure:
    """(a) Plane of temperature and polymer fraction: LENS's D < 0 and both models' coexistence;
    (b) T*(a) of both models, the temperature from which the core decomposes, and the least hoop
    stretch at which the nonlinear bead has a front.

    Datasets of ``materials.tables`` and ``gelpump.separation.phases``.
    """
    fig = style.figure(height=2.9)
    left, right = fig.subplots(1, 2)
    T = phases.temperature.values
    span = T[0], T[-1]
    phi = material.polymer_fraction.values
    spinodal = np.clip(material.temperature_spinodal.values, *span)
    left.fill_betweenx(phi, spinodal, span[1], color="#d9d9d9", linewidth=0)
    left.text(0.62, 0.62, "$D < 0$", transform=left.transAxes)
    stable = material.equilibrium_is_stable.values.astype(bool)
    T_eq = material.temperature_equilibrium.values
    line = {"color": "black", "linewidth": 0.9}
    left.plot(np.where(stable, T_eq, np.nan), phi, **line, label=r"$\phi_0(T)$")
    left.plot(np.where(stable, np.nan, T_eq), phi, ":", **line)
    _sides(left, T, phases.sel(model="lens").isel(hoop_stretch=0), style.LENS, "LENS")
    for j, colour in enumerate(SHADES):
        at = phases.sel(model="nonlinear").isel(hoop_stretch=j)
        _sides(left, T, at, colour, f"nonlinear, $l_t = {float(at.hoop_stretch):g}$")
    left.set(xlim=span, ylim=(0, 0.85), xlabel="temperature $T$ (K)")
    left.set(ylabel=r"polymer fraction $\phi$")
    left.legend(fontsize=7, loc="center right", bbox_to_anchor=(1.0, 0.42))
    style.panel_label(left, "a")
    for model, colour, name in (
        ("lens", style.LENS, "$T^*(a)$, LENS"),
        ("nonlinear", style.NONLINEAR, "$T^*(a)$, nonlinear"),
    ):
        loss = phases.loss_temperature.sel(model=model)
        known = loss.values > 0
        right.plot(loss.values[known], loss.radius.values[known], color=colour, label=name)
        columns = {Quantity.TEMPERATURE: loss.values[known], RADIUS: loss.radius.values[known]}
        style.tell(right, "b", f"T* {model}", columns)
    core, a = phases.core_loss_temperature.values, phases.radius.values
    right.plot(core, a, ":", color="black", label="$D = 0$ in the core")
    style.tell(right, "b", "D = 0 in the core", {Quantity.TEMPERATURE: core, RADIUS: a})
    critical = phases.critical_hoop_stretch.values
    known = critical > 1.0
    right.plot(T[known], critical[known], "--", color=style.NONLINEAR, label="critical $l_t$")
    style.tell(
        right, "b", "critical l_t", {Quantity.TEMPERATURE: T[known], STRETCH: critical[known]}
    )
    right.set(xlabel="temperature $T$ (K)", ylabel="radius $a$, hoop stretch $l_t$")
    right.legend(fontsize=7, loc="lower right")
    style.panel_label(right, "b")
    return fig


def _sides(ax, T, at, colour, name):
    two = at.two_phases.values > 0
    for rank, side in enumerate(("swollen", "dry")):
        ax.plot(T[two], at[side].values[two], color=colour, label=None if rank else name)
        columns = {Quantity.TEMPERATURE: T[two], Quantity.POLYMER: at[side].values[two]}
        plain = name.replace("$", "").replace(",", "")
        style.tell(ax, "a", f"{plain}: {side}", columns)
