"""Figure 11: flow in the wall next to the drying front, in a thick and a thin tube."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from gelpump.figures import style, tube_flow, tube_section

if TYPE_CHECKING:
    import xarray as xr

SHAPE = 1.2  # of the panels, width over height
MARGIN = 0.22  # around the wall, as a share of its thickness
ARROWS = 15  # along a panel
DEPTHS = (0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95)  # of the arrows in the wall


def draw(
    views: Sequence["xr.Dataset"], budget: "xr.Dataset", arrow_times: Sequence[float]
) -> Figure:
    """One tube beside another, each to scale, so that arrows have their true directions.

    views: datasets of ``tube.views``; ``polymer_fraction`` over ``Z`` and ``radius``, ``u_z`` and
    ``u_r`` as printed in the paper.  An arrow is the way covered in that tube's arrow time.
    budget: a dataset of ``tube.budget``, whose ``radial_to_axial_velocity`` stands below.
    """
    fig = style.figure(height=2.42)
    axes = fig.subplots(1, len(views), squeeze=False)[0]
    for ax, label, view, time in zip(axes, "abcdefgh", views, arrow_times, strict=False):
        eps, front = float(view.eps), float(view.Z_C)
        inner, outer = float(view.radius.min()), float(view.radius.max())
        margin = MARGIN * (outer - inner)
        height = outer - inner + 2 * margin
        half = SHAPE * height * eps / 2
        ax.set(xlim=(front - half, front + half), ylim=(inner - margin, outer + margin), aspect=eps)
        mesh, _ = tube_flow.section(ax, view, front + 2 * half, panel=label)
        tube_flow.wall_arrows(ax, view, time, 2 * half / ARROWS, DEPTHS, panel=label)
        style.panel_label(ax, label)
        ax.set_title(rf"$\ell={float(view.ell):g}$, $\Delta\tau=${tube_flow.scale(time)}")
        here = budget.sel(ell=view.ell, tau=view.tau, method="nearest")
        ratio = float(here.radial_to_axial_velocity)
        ax.set_xlabel("$Z=z/L$, to scale\n" rf"$\max|u_r|/\max|u_z|={ratio:.3f}$")
        ax.locator_params(nbins=5)
    axes[0].annotate(
        "front $Z_C$",
        (float(views[0].Z_C), axes[0].get_ylim()[0]),
        (4, 4),
        textcoords="offset points",
        color=style.NONLINEAR,
    )
    axes[0].set_ylabel(tube_section.RADIAL)
    tube_section.bar(fig, mesh, axes, aspect=20)
    return fig
