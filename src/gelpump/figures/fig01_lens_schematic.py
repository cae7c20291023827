"""Figure 1: a LENS deformation as a large isotropic part and a small deviatoric one, in a bead."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from gelpump.figures import style
from gelpump.figures.style import Quantity

if TYPE_CHECKING:
    import xarray as xr

RINGS = 8  # material rings drawn, equally thick in the reference state
WEDGE = 1 / 7.5  # rad: makes the reference elements below about square
WEDGES = 7
ELEMENTS = {"A": (2, 3), "B": (7, 1)}  # the ring of each magnified element and its wedges
ARC = 15  # points on each arc of an outline
ARROW = {"arrowstyle": "-|>", "color": "black", "linewidth": 0.8}
STATES = {
    "reference": {"color": "black", "linestyle": ":", "linewidth": 1.1},
    "isotropic": {"color": style.NONLINEAR, "linestyle": "--", "linewidth": 0.9},
    "actual": {"color": "black", "linestyle": "-", "linewidth": 1.3},
}


def draw(bead: "xr.Dataset", time: float) -> Figure:
    """(a) Reference state, (b) state at ``time``, (c) two of its elements magnified.

    bead: a LENS dataset of ``bead.dataset``, whose state at t = 0 is the reference.  The material
    rings are bounded by shell faces, so ``r_face`` displaces them and ``dry_radius`` gives their
    polymer fraction.  In (c) each element is drawn about its own centroid: as it was, as it would
    be had it shrunk by (phi/phi_00)^(-1/3) in all directions, and as it is.
    """
    now = bead.sel(t=time, method="nearest")
    r_0, r = bead.r_face.values[0], now.r_face.values
    faces = [int(np.abs(r_0 - r_0[-1] * i / RINGS).argmin()) for i in range(RINGS + 1)]
    r_0, r, dry = r_0[faces], r[faces], bead.dry_radius.values[faces]
    phi_00, phi = (np.diff(dry**3) / np.diff(faces**3) for faces in (r_0, r))
    both = np.concatenate([phi_00, phi])
    scale = ScalarMappable(LogNorm(0.8 * both.min(), both.max()))

    fig = style.figure(height=3.7)
    top, bottom = fig.subfigures(2, 1, height_ratios=(1.1, 1.0))
    left, right = top.subplots(1, 2, sharex=True, sharey=True)
    _sector(left, r_0, phi_00, scale, STATES["reference"])
    _sector(right, r, phi, scale, STATES["actual"])
    right.plot(*_outline(0.0, r_0[-1], WEDGES), **STATES["reference"])
    style.panel_label(left, "a")
    style.panel_label(right, "b")
    left.set_title(rf"reference, $\phi\equiv\phi_{{00}}={phi_00[0]:.4f}$", loc="right")
    right.set_title(rf"$t_\mathrm{{BMJ}}={float(now.t):g}$, $a/a_0={r[-1] / r_0[-1]:.3f}$")
    style.polymer_fraction_bar(
        top, scale, [left, right], aspect=18, label=r"polymer fraction $\phi$"
    )

    for panel, radii, fractions in (("a", r_0, phi_00), ("b", r, phi)):
        told = {
            "ring [1]": np.arange(1, RINGS + 1),
            "r_inner [R_dry]": radii[:-1],
            "r_outer [R_dry]": radii[1:],
            Quantity.POLYMER: fractions,
        }
        style.tell(fig, panel, "material rings", told)

    columns = bottom.subplots(1, 3, width_ratios=(1.0, 1.0, 1.15))
    for ax, (name, (ring, wedges)) in zip(columns, ELEMENTS.items(), strict=False):
        pair = slice(ring, ring + 2)
        ratio = phi[ring] / phi_00[ring]
        colour = scale.to_rgba(phi[ring])
        strains = _element(ax, r_0[pair], r[pair], ratio, wedges, colour)
        told = {"ring [1]": ring + 1, "phi/phi_00 [1]": ratio} | strains
        style.tell(fig, "c", f"element {name}", told)
        ax.set_title(f"element {name}", pad=4)
    limit = max(abs(bound) for ax in columns[:2] for bound in (*ax.get_xlim(), *ax.get_ylim()))
    for ax in columns[:2]:
        ax.set(xlim=(-limit, limit), ylim=(-limit, limit))
    style.panel_label(columns[0], "c")
    _key(columns[2])
    return fig


def _outline(inner, outer, wedges):
    """x and y around a ring's part of that many wedges about the x axis."""
    angle = np.linspace(-0.5, 0.5, ARC) * wedges * WEDGE
    r = np.r_[np.full(ARC, inner), np.full(ARC, outer), inner]
    angle = np.r_[angle, angle[::-1], angle[0]]
    return r * np.cos(angle), r * np.sin(angle)


def _sector(ax, r, phi, scale, state):
    """The material rings in their colours, with the wedges and the two elements."""
    for inner, outer, each in zip(r[:-1], r[1:], phi, strict=True):
        ax.fill(*_outline(inner, outer, WEDGES), facecolor=scale.to_rgba(each))
        ax.plot(*_outline(inner, outer, WEDGES), color=style.GREY, linewidth=0.4)
    for i in range(1, WEDGES):
        angle = (i - WEDGES / 2) * WEDGE
        x, y = r[-1] * np.cos(angle), r[-1] * np.sin(angle)
        ax.plot([0.0, x], [0.0, y], color=style.GREY, linewidth=0.4)
    for name, (ring, wedges) in ELEMENTS.items():
        ax.plot(*_outline(r[ring], r[ring + 1], wedges), zorder=4, **state)
        dark = np.mean(scale.to_rgba(phi[ring])[:3]) < 0.4
        ax.text(
            r[ring : ring + 2].mean(),
            0.0,
            name,
            ha="center",
            va="center",
            fontsize=8,
            color="white" if dark else "black",
        )
    ax.set_aspect("equal")
    ax.set_axis_off()


def _element(ax, r_0, r, ratio, wedges, colour):
    """One element in its three states, and its strains.

    With e = 1 - r_0/r along the circle, eps_tt = e - [1 - ratio^(1/3)], and eps has no trace.
    Returns the deviatoric strains.
    """
    shapes = {
        "reference": _centred(_outline(*r_0, wedges)),
        "isotropic": _centred(_outline(*r_0, wedges)) * ratio ** (-1 / 3),
        "actual": _centred(_outline(*r, wedges)),
    }
    ax.fill(*shapes["actual"], facecolor=colour)
    for state, shape in shapes.items():
        ax.plot(*shape, **STATES[state])
    eps = np.cbrt(ratio) - (r_0 / r).mean()
    ax.set_aspect("equal")
    ax.set(xticks=[], yticks=[], frame_on=False)
    ax.set_xlabel(
        rf"$\phi/\phi_{{00}}={ratio:.2f}$" + "\n"
        rf"$\epsilon_{{rr}}={-2 * eps:.3f}$, $\epsilon_{{\theta\theta}}={eps:.3f}$",
        fontsize=8,
    )
    return {"epsilon_rr [1]": -2 * eps, "epsilon_tt [1]": eps}


def _centred(outline):
    """An outline about its centroid."""
    x, y = outline
    cross = x[:-1] * y[1:] - x[1:] * y[:-1]
    return np.array([x - ((x[:-1] + x[1:]) * cross).sum() / (3 * cross.sum()), y])


def _key(ax):
    """What the outlines mean, and the decomposition they show."""
    labels = {
        "reference": "reference",
        "isotropic": r"isotropic: sides $\times\,(\phi/\phi_{00})^{-1/3}$",
        "actual": "actual: with deviatoric part",
    }
    for state, label in labels.items():
        ax.plot([], [], label=label, **STATES[state])
    ax.set_axis_off()
    ax.legend(loc="upper left", handlelength=2.2, borderpad=0.0)
    ax.text(
        0.5,
        0.3,
        r"$\mathbf{e}=\left[1-(\phi/\phi_{00})^{1/3}\right]\mathbf{I}+\boldsymbol{\epsilon}$",
        transform=ax.transAxes,
        ha="center",
        fontsize=9,
    )
    ax.annotate("", (0.75, 0.08), (0.45, 0.08), xycoords="axes fraction", arrowprops=ARROW)
    ax.text(0.77, 0.08, "$r$", transform=ax.transAxes, va="center")
