"""Figure 10: water flows through the wall of a collapsing tube and along its lumen."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from gelpump.figures import style, tube_flow, tube_section

if TYPE_CHECKING:
    import xarray as xr

BEHIND, AHEAD = 0.12, 0.17  # of the front, in Z: further away nothing varies
SPACING = 0.009  # of the arrows, in Z
DEPTHS = (0.05, 0.275, 0.5, 0.725, 0.95)  # of the arrows in the wall


def draw(views: Sequence["xr.Dataset"], wall_time: float, lumen_time: float) -> Figure:
    """One tube above another, to scale: polymer fraction in colour, arrows for both flows.

    views: datasets of ``tube.views``; ``polymer_fraction`` over ``Z`` and ``radius``, ``u_z`` and
    ``u_r`` in the wall, ``lumen_u_z`` and ``lumen_u_r`` in the lumen, all as printed in the paper.
    An arrow is the way covered in wall_time or lumen_time.
    """
    fig = style.figure(height=0.55 + 1.9 * len(views))
    axes = fig.subplots(len(views), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    front, eps = float(views[0].Z_C), float(views[0].eps)
    start, end = front - BEHIND, front + AHEAD
    axes[0].set(xlim=(start, end), ylim=(0.0, 1.1))
    for ax, label, view in zip(axes, "abcdefgh", views, strict=False):
        mesh, line = tube_flow.section(ax, view, end, panel=label)
        tube_flow.wall_arrows(ax, view, wall_time, SPACING, DEPTHS, panel=label)
        tube_flow.lumen_arrows(ax, view, lumen_time, SPACING, panel=label)
        style.panel_label(ax, label)
        ax.set(ylabel=tube_section.RADIAL, aspect=eps)
        ax.set_title(rf"$\ell={float(view.ell):g}$, $\tau={float(view.tau):g}$")
    axes[-1].set_xlabel(rf"{tube_section.AXIAL} (to scale: $a_1={eps:g}\,L$)")
    tube_section.bar(fig, mesh, axes, aspect=30)
    tube_flow.legend(fig, line, wall=wall_time, lumen=lumen_time)
    return fig
