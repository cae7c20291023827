"""Figure 8: a tube at several times while a pulse of heat moves along it."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style, tube_section
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

END = 1.0  # where the paper's axis ends
FRONT_LABEL = "front $Z_C$"


def draw(pulse: "xr.Dataset", published: Sequence[float]) -> Figure:
    """The section through the tube at each time, one above another.

    pulse: a dataset of ``tube.slender`` of one ell; ``Phi1`` over ``Z`` gives shape and colour at
    each ``tau``, ``Z_C`` the front.  published: where the paper's figure has the front at these
    times, on the axis.
    """
    fig = style.figure(height=0.55 + 1.35 * pulse.sizes["tau"])
    axes = np.atleast_1d(fig.subplots(pulse.sizes["tau"], 1, sharex=True, sharey=True))
    end = max(END, 1.1 * float(pulse.Z_C[-1]))
    for rank, (ax, label) in enumerate(zip(axes, "abcdefgh", strict=False)):
        now = pulse.isel(tau=rank)
        mesh = _section(ax, now, end)
        tube_section.tell(fig, label, now, end)
        if rank < len(published):
            ax.plot(
                published[rank],
                -1.15,
                clip_on=False,
                zorder=5,
                label="published front",
                **style.PUBLISHED_MARKER,
            )
            columns = {Quantity.TAU: now.tau, Quantity.AXIAL: published[rank]}
            style.tell(fig, label, "front Z_C published", columns)
        style.panel_label(ax, label)
        ax.set_title(rf"$\tau={float(now.tau):g}$")
    axes[0].set(xlim=(0.0, end), ylim=(-1.15, 1.15), yticks=[-1.0, 0.0, 1.0])
    axes[0].set_yticklabels(["1", "0", "1"])
    axes[-1].set_xlabel(rf"{tube_section.AXIAL} (not to scale: $a_1={float(pulse.eps):g}\,L$)")
    for ax in axes:
        ax.set_ylabel("$R=r/a_1$")
    tube_section.bar(fig, mesh, axes, aspect=28)
    handles, labels = axes[0].get_legend_handles_labels()
    fig.legend(handles, labels, loc="outside upper center", ncols=4)
    return fig


def _section(ax, now, end):
    Z, inner, outer, Phi1 = tube_section.shape(now, end)
    for side in (1.0, -1.0):
        radius = side * np.stack([inner, outer], axis=1)
        mesh = tube_section.wall(ax, Z, radius, np.stack([Phi1, Phi1], axis=1), now.Phi_inf)
        for rank, swollen in enumerate((float(now.ell), 1.0)):
            label = "swollen tube" if side == 1.0 and rank == 0 else None
            ax.plot([0.0, end], [side * swollen] * 2, label=label, **tube_section.SWOLLEN)
    ax.axvline(float(now.Z_C), label=FRONT_LABEL, **tube_section.FRONT)
    return mesh
