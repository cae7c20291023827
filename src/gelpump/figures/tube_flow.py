"""Flow in a section along a tube: what figures 10 and 11 share.

Datasets are those of ``tube.views``.  An arrow is the way that water would cover in a given time,
at the scales of the axes, so it points where it goes; arrows shorter than a small share of the
longest are left out.  In the wall the way is relative to the polymer.
"""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.path import Path

from gelpump.figures import style, tube_section
from gelpump.figures.style import Quantity

LEAST = 0.08  # of the longest arrow
HEAD = {"headwidth": 4.5, "headlength": 5.0, "headaxislength": 4.6, "minlength": 0.1}
ARROWS = {"angles": "xy", "scale_units": "xy", "scale": 1.0, "units": "inches", "zorder": 4}
WALL_ARROW = {"width": 0.012, "facecolor": "white", "edgecolor": "black", "linewidth": 0.35}
LUMEN_ARROW = {"width": 0.011, "color": style.LENS}
ARROW_MARK = Path(
    [
        (-1, 0.15),
        (0.3, 0.15),
        (0.3, 0.5),
        (1, 0),
        (0.3, -0.5),
        (0.3, -0.15),
        (-1, -0.15),
        (-1, 0.15),
    ],
    closed=True,
)  # of the legend


def section(ax, view, end, *, panel):
    """The wall's upper section in colour, its swollen outline and the front."""
    Z, radius = tube_section.extended(view.Z.values, view.radius.values, end)
    _, polymer_fraction = tube_section.extended(view.Z.values, view.polymer_fraction.values, end)
    for swollen in (float(view.ell), 1.0):
        ax.plot([0.0, end], [swollen] * 2, **tube_section.SWOLLEN)
    mesh = tube_section.wall(ax, Z, radius, polymer_fraction, polymer_fraction.max())
    shown = np.abs(Z - np.mean(ax.get_xlim())) <= np.ptp(ax.get_xlim()) / 2
    columns = {
        Quantity.AXIAL: Z[shown, np.newaxis],
        Quantity.RADIAL: radius[shown],
        Quantity.PHI: polymer_fraction[shown],
    }
    style.tell(ax, panel, f"wall at ell = {float(view.ell):g}", columns)
    front = ax.axvline(float(view.Z_C), label="front $Z_C$", **tube_section.FRONT)
    return mesh, front


def wall_arrows(ax, view, time, spacing, depths, *, panel):
    """Interstitial flow at some depths of the wall, from its inner edge, 0, to its outer, 1."""
    here = view.isel(R=[round(depth * (view.sizes["R"] - 1)) for depth in depths])
    _arrows(ax, here, ("radius", "u_z", "u_r"), time, spacing, WALL_ARROW, panel)


def lumen_arrows(ax, view, time, spacing, heights=(0.35, 0.75), *, panel):
    """Flow in the lumen at some heights, from its axis, 0, to the wall, 1."""
    across = [round(height * (view.sizes["R_lumen"] - 1)) for height in heights]
    here = view.isel(R_lumen=across)
    _arrows(ax, here, ("lumen_radius", "lumen_u_z", "lumen_u_r"), time, spacing, LUMEN_ARROW, panel)


def _arrows(ax, view, names, time, spacing, look, panel):
    """Arrows with the tails evenly spaced along the tube, at the radius and of the two velocities
    that names tell."""
    front, limits = float(view.Z_C), ax.get_xlim()
    places = front + spacing * (np.arange(*np.ceil((np.array(limits) - front) / spacing)) + 0.5)
    places = places[(places > 0) & (places < limits[1])]
    R, u_z, u_r = (_sampled(view, name, places) for name in names)
    Z, R, u_z, u_r = np.broadcast_arrays(places[:, np.newaxis], R, u_z, u_r)
    length = np.hypot(u_z / np.ptp(limits), u_r / np.ptp(ax.get_ylim()))
    drawn = length > LEAST * length.max()
    ways = time * u_z[drawn], time * u_r[drawn]
    ax.quiver(Z[drawn], R[drawn], *ways, **ARROWS, **HEAD, **look)
    place = "lumen" if names[0].startswith("lumen") else "wall"
    columns = {
        Quantity.AXIAL: Z[drawn],
        Quantity.RADIAL: R[drawn],
        "way_Z [L]": ways[0],
        "way_R [a_1]": ways[1],
    }
    style.tell(ax, panel, f"flow in the {place}: way in a time of {time:g}", columns)


def _sampled(view, name, places):
    """A variable at ``places`` along the tube, (place, across); it may jump at the front, so each
    side is interpolated by itself."""
    cells, front = view.Z.values, float(view.Z_C)
    columns = view[name].values.reshape(len(cells), -1).T
    sides = ((cells < front, places[places < front]), (cells > front, places[places > front]))
    return np.concatenate(
        [
            np.stack([np.interp(wanted, cells[side], column[side]) for column in columns], axis=1)
            for side, wanted in sides
        ]
    )


def scale(time):
    """What an arrow is, in words and in the units of the axes."""
    exponent = int(np.floor(np.log10(time) + 1e-9))
    digit = time / 10.0**exponent
    factor = "" if abs(digit - 1) < 1e-9 else rf"{digit:g}\times"
    return rf"${factor}10^{{{exponent}}}$"


def legend(fig, front, **times):
    """The front's line, which arrow is which flow, and the time that each stands for."""
    wall = {"color": "white", "markeredgecolor": "black", "markeredgewidth": 0.5}
    lumen = {"color": LUMEN_ARROW["color"], "markeredgewidth": 0.0}
    handles = [front]
    for place, look in (("wall", wall), ("lumen", lumen)):
        if place in times:
            label = rf"flow in the {place} over $\Delta\tau=${scale(times[place])}"
            handles.append(
                Line2D(
                    [], [], linestyle="none", marker=ARROW_MARK, markersize=11, label=label, **look
                )
            )
    fig.legend(handles=handles, loc="outside upper center", ncols=3)
