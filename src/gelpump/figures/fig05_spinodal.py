"""Figure 5: where the polymer diffusivity is negative, and which beads come to pass there."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

COLOURS = (style.SWELLING, style.DRYING, style.SEPARATING)
CLOSE = 0.1  # share of the temperatures within which folds and tip are too close to be told apart
INSET_ABOVE = 1.6  # of the folds' height
ARROW = {"arrowstyle": "-|>", "linewidth": 0, "mutation_scale": 12, "shrinkA": 0, "shrinkB": 0}


def draw(
    material: "xr.Dataset", beads: Mapping[str, "xr.Dataset"], cases: Mapping[str, Mapping]
) -> Figure:
    """Trajectories of beads in the plane of temperature and polymer fraction.

    material: a dataset of ``materials.tables``; D < 0 on the side of ``temperature_spinodal`` that
    ``diffusivity`` tells.  beads: LENS datasets of ``bead.dataset``, cases: their config blocks,
    by name.  The temperature jumps at the first polymer fraction; then, at constant temperature,
    the thick band is every polymer fraction that is met anywhere in the bead, and the line on it
    the mean over the bead's volume, radius^-3.  A cross is where the run stopped with D < 0.
    """
    jumps = [T for case in cases.values() for T in _jump(case)]
    span = min(jumps) - 1.0, max(jumps) + 1.0
    fig = style.figure(height=3.2)
    ax = fig.subplots()
    _plane(ax, material, beads, cases, span)
    _tell(fig, material, beads, cases, span)
    T, phi = _special_points(material)
    shown = [1.12 * float(bead.polymer_fraction.max()) for bead in beads.values()]
    shown += [1.12 * bead.attrs.get("stopped_polymer_fraction", 0.0) for bead in beads.values()]
    close = len(T) > 1 and np.ptp(T) < CLOSE * np.ptp(span)
    if close:
        shown.append(phi.max() + INSET_ABOVE * np.ptp(phi))
    ax.set(ylim=(0.0, max(shown)), xlabel="temperature $T$ (K)", ylabel=r"polymer fraction $\phi$")
    if close:
        inset = ax.inset_axes((0.3, 0.27, 0.37, 0.55))
        width, height = np.ptp(T), np.ptp(phi)
        _plane(inset, material, beads, cases, (T.min() - 0.7 * width, T.max() + 0.7 * width))
        inset.set_ylim(phi.min() - 1.1 * height, phi.max() + INSET_ABOVE * height)
        inset.ticklabel_format(useOffset=False)
        inset.locator_params(axis="x", nbins=4)
        style.zoom(ax, inset, joined=True)
    handles, labels = ax.get_legend_handles_labels()
    once = dict(zip(labels, handles, strict=True))
    fig.legend(list(once.values()), list(once), loc="outside upper center", ncols=4)
    return fig


def _tell(fig, material, beads, cases, span):
    """The equilibrium curve and the spinodal as far as drawn, and the path of each bead's mean."""
    phi = material.polymer_fraction.values
    stable = material.equilibrium_is_stable.values.astype(bool)
    T, spinodal = material.temperature_equilibrium.values, material.temperature_spinodal.values
    drawn, within = ((span[0] <= each) & (each <= span[1]) for each in (T, spinodal))
    curves = [
        ("stable equilibria", T[stable & drawn], phi[stable & drawn]),
        ("unstable equilibria", T[~stable & drawn], phi[~stable & drawn]),
        ("spinodal", spinodal[within], phi[within]),
    ]
    for name, case in cases.items():
        before, after = _jump(case)
        start, mean = float(beads[name].polymer_fraction[0, 0]), beads[name].radius.values ** -3
        path = np.r_[before, np.full(len(mean), after)], np.r_[start, mean]
        curves.append((f"bead {name}: mean", *path))
        met = _met(beads[name])
        curves.append((f"bead {name}: range met", [after, after], [met.min(), met.max()]))
        if "stopped_t" in beads[name].attrs:
            stopped = beads[name].attrs["stopped_polymer_fraction"]
            curves.append((f"bead {name}: phases separate", after, stopped))
    for name, temperatures, fractions in curves:
        columns = {Quantity.TEMPERATURE: temperatures, Quantity.POLYMER: fractions}
        style.tell(fig, "a", name, columns)


def _met(bead):
    """Every polymer fraction that is met anywhere in a bead, the surface at t = 0 excepted."""
    surface = bead.surface_polymer_fraction.values[1:]
    return np.concatenate([bead.polymer_fraction.values.ravel(), surface])


def _special_points(material):
    """Temperature and polymer fraction of the folds and of the spinodal's tip."""
    T, phi = material.fold_temperature.values, material.fold_polymer_fraction.values
    if "spinodal_tip_temperature" not in material:
        return T, phi
    tip = material.spinodal_tip_temperature, material.spinodal_tip_polymer_fraction
    return np.append(T, tip[0]), np.append(phi, tip[1])


def _plane(ax, material, beads, cases, limits):
    _phases(ax, material, limits)
    for rank, (name, case) in enumerate(cases.items()):
        _trajectory(ax, beads[name], case, rank)
    ax.set_xlim(limits)


def _jump(case):
    return case["temperature_initial"], case["temperature_final"]


def _phases(ax, material, limits):
    """The region of negative diffusivity and the equilibrium curve."""
    phi = material.polymer_fraction.values
    # D is linear in T: it is negative above T_sp where it falls with T, below T_sp where it rises
    falls = np.diff(material.diffusivity.values[[0, -1]], axis=0)[0] < 0
    ax.fill_betweenx(
        phi,
        np.clip(material.temperature_spinodal.values, *limits),
        np.where(falls, limits[1], limits[0]),
        facecolor="#d9d9d9",
        edgecolor=style.GREY,
        linewidth=0.5,
        label="$D < 0$",
    )
    T = material.temperature_equilibrium.values
    stable = material.equilibrium_is_stable.values.astype(bool)
    line = {"color": "black", "linewidth": 1.0}
    ax.plot(np.where(stable, T, np.nan), phi, **line, label=r"$\phi_0(T)$, stable")
    ax.plot(np.where(stable, np.nan, T), phi, ":", **line, label=r"$\phi_0(T)$, unstable")


def _trajectory(ax, bead, case, rank):
    """One bead's path; paths coincide in part, so the first is the thinnest and lies on top."""
    before, after = _jump(case)
    start = float(bead.polymer_fraction[0, 0])
    met = _met(bead)
    mean = bead.radius.values**-3
    look = {"color": COLOURS[rank], "zorder": 3 - 0.2 * rank}
    band = look | {"alpha": 0.35, "linewidth": 6, "solid_capstyle": "butt"}
    ax.plot([after, after], [met.min(), met.max()], **band)
    ax.plot(
        [before, after, after],
        [start, start, mean[-1]],
        linewidth=1.2 + 0.8 * rank,
        label=f"{before:g} K $\\rightarrow$ {after:g} K",
        **look,
    )
    _arrow(ax, (before, start), (before + 0.65 * (after - before), start), rank)
    if "stopped_t" not in bead.attrs:
        _arrow(ax, (after, start), (after, mean[-1]), rank)
    else:
        ax.plot(
            after,
            bead.attrs["stopped_polymer_fraction"],
            "x",
            color=COLOURS[rank],
            markersize=6,
            markeredgewidth=1.6,
            zorder=4,
            label="phases separate",
        )


def _arrow(ax, tail, head, rank):
    ax.annotate("", head, tail, arrowprops=ARROW | {"color": COLOURS[rank]}, annotation_clip=True)
