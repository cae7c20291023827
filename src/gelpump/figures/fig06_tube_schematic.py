"""Figure 6: a tube that collapses behind a pulse of heat, cut open along its axis."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from gelpump.figures import style, tube_section

if TYPE_CHECKING:
    import xarray as xr

HOT, COLD = style.TEMPERATURE(1.0), style.TEMPERATURE(0.0)
BEYOND = 0.6  # how much of the swollen tube is shown, as a share of the length behind the front
TURN = 0.055  # depth of a circle of radius R = 1, as a share of the length shown
ROUND = 56  # facets around the half of the tube behind the cut
BOTTOM, TOP = 1.1, 1.42  # how far the front's line reaches
ARROW = {
    "arrowstyle": "<|-|>",
    "color": "black",
    "linewidth": 0.8,
    "mutation_scale": 6,
    "shrinkA": 0,
    "shrinkB": 0,
}
EXTENSION = {"color": style.GREY, "linewidth": 0.5}


def draw(pulse: "xr.Dataset") -> Figure:
    """The half of the tube behind a plane through its axis, as solved, and as it was.

    pulse: a dataset of ``tube.slender`` at one ell and tau; ``Phi1`` over ``Z`` gives the edges
    B_0, B_1 and the colour, ``Z_C`` the front.  The cut is true to the axes; circles behind it are
    drawn as ellipses.
    """
    front = float(pulse.Z_C)
    end = (1.0 + BEYOND) * front
    Z, inner, outer, Phi1 = tube_section.shape(pulse, end)
    shown = end >= Z
    Z, inner, outer, Phi1 = (values[shown] for values in (Z, inner, outer, Phi1))
    depth = TURN * end
    scale = ScalarMappable(Normalize(1.0, float(pulse.Phi_inf)))

    fig = style.figure(height=3.1)
    tube_section.tell(fig, "a", pulse, end)
    ax = fig.subplots()
    _lumen(ax, Z, inner, Phi1, depth, scale)
    _end(ax, end, inner[-1], outer[-1], depth, scale.to_rgba(Phi1[-1]))
    for side in (1.0, -1.0):
        radius = side * np.stack([inner, outer], axis=1)
        mesh = tube_section.wall(ax, Z, radius, np.stack([Phi1, Phi1], axis=1), pulse.Phi_inf)
        ax.plot([0.0, 0.0], radius[0], **tube_section.EDGE)
        ax.plot([end, end], radius[-1], **tube_section.EDGE)
        for swollen in (float(pulse.ell), 1.0):
            ax.plot([0.0, end], [side * swollen] * 2, **tube_section.SWOLLEN)
    ax.plot([0.0, end + depth], [0.0, 0.0], color="#b0b0b0", linewidth=0.7, dashes=(8, 2, 1, 2))
    _radii(ax, pulse, inner, outer, end, depth)
    _sides(ax, pulse, front, end, depth)
    ax.set(
        xlim=(-0.11 * end, end + depth + 0.11 * end),
        ylim=(-BOTTOM, 1.66),
        xlabel=rf"{tube_section.AXIAL} (stretched: $a_1={float(pulse.eps):g}\,L$)",
        ylabel=tube_section.RADIAL,
        yticks=[-1.0, -0.5, 0.0, 0.5, 1.0],
    )
    ax.set_yticklabels(["1", "0.5", "0", "0.5", "1"])
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    ax.tick_params(top=False, right=False, direction="out")
    tube_section.bar(fig, mesh, ax, aspect=25)
    return fig


def _lumen(ax, Z, inner, Phi1, depth, scale):
    """The inner surface behind the cut, lit from the viewer's side."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, ROUND + 1)
    x = Z[:, np.newaxis] + depth * inner[:, np.newaxis] * np.cos(angle)
    y = inner[:, np.newaxis] * np.sin(angle)
    corners = [
        np.stack([values[:-1, :-1], values[1:, :-1], values[1:, 1:], values[:-1, 1:]], axis=-1)
        for values in (x, y)
    ]
    light = 0.45 + 0.4 * np.cos((angle[1:] + angle[:-1]) / 2)
    colour = scale.to_rgba((Phi1[1:] + Phi1[:-1]) / 2)[:, np.newaxis] * np.ones((1, ROUND, 1))
    colour[..., :3] = 1 - (1 - colour[..., :3] * light[:, np.newaxis]) * 0.8
    faces = PolyCollection(
        np.stack(corners, axis=-1).reshape(-1, 4, 2),
        facecolors=colour.reshape(-1, 4),
        edgecolors="face",
        linewidths=0.2,
        rasterized=True,
    )
    ax.add_collection(faces)


def _end(ax, end, inner, outer, depth, colour):
    """The far cross-section, of which the half behind the cut is seen."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 60)
    arc = np.cos(angle) * depth, np.sin(angle)
    x, y = (np.r_[outer * along, inner * along[::-1]] for along in arc)
    ax.fill(end + x, y, facecolor=colour, edgecolor="black", linewidth=0.9)


def _radii(ax, pulse, inner, outer, end, depth):
    """Arrows from the axis to the edges, of the collapsed tube on the left, the swollen right."""
    right = end + depth
    for x, name, radius, edge in (
        (-0.03 * end, "b_0", inner[0], 0.0),
        (-0.075 * end, "b_1", outer[0], 0.0),
        (right + 0.03 * end, "a_0", float(pulse.ell), end),
        (right + 0.075 * end, "a_1", 1.0, end),
    ):
        beyond = np.sign(x) * 0.012 * end
        for level in (0.0, radius):
            ax.plot([edge, x + beyond], [level, level], **EXTENSION)
        ax.annotate("", (x, radius), (x, 0.0), arrowprops=ARROW)
        ax.text(x, radius + 0.03, f"${name}$", ha="center", va="bottom")


def _sides(ax, pulse, front, end, depth):
    """The front, a ring around the lumen, and which side of it is hot."""
    edge = float(pulse.ell) * float(pulse.Phi1_front) ** (-1 / 3)
    angle = np.linspace(np.pi / 2, -np.pi / 2, 60)
    x, y = front + depth * edge * np.cos(angle), edge * np.sin(angle)
    ax.plot(np.r_[front, x, front], np.r_[TOP, y, -BOTTOM], **tube_section.FRONT)
    ax.text(front, TOP + 0.04, "front $Z_C$", ha="center", va="bottom", color=style.NONLINEAR)
    for middle, text, colour in (
        (front / 2, "hot, $T>T_C$: collapsed", HOT),
        ((front + end) / 2, "cold, $T<T_C$: swollen", COLD),
    ):
        ax.text(middle, 1.27, text, ha="center", va="center", color=colour)
    ax.text(
        front / 2, 0.9, "swollen outline", ha="center", va="center", fontsize=8, color="#606060"
    )
    ax.text(front / 2, -0.17, "lumen", ha="center", va="center", color="white")
