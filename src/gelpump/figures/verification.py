"""Errors of the FiPy solvers on known solutions, against the mesh and against the time step."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from gelpump.figures import style

PANELS = {
    "cells": ("number of cells", 2, (20, 40, 80, 160)),
    "steps": ("number of time steps", 3, (20, 30, 40)),
}
COLOURS = {
    "Barenblatt's bead": style.LENS,
    "relaxing bead": style.SEPARATING,
    "manufactured tube": style.NONLINEAR,
    "relaxing tube": style.DRYING,
    "manufactured tube, conservative": "#56B4E9",
    "resting front, conservative": "#CC79A7",
}
MARKERS = ("o", "s", "^")
NAMES = {
    "Phi_1": r"$\Phi_1$",
    "Phi_1 at Z_C": r"$\Phi_1$ at $Z_C$",
    "radii of all shells, up to the edge phi = 0": r"all radii, up to an edge $\phi = 0$",
}


def draw(studies: Sequence[Mapping[str, Any]]) -> Figure:
    """(a) Error against cells, (b) against steps; ``studies`` as in verification.json."""
    fig = style.figure(height=4.2)
    for axes, letter, (against, (label, slope, ticks)) in zip(
        fig.subplots(1, 2, sharey=True), "ab", PANELS.items(), strict=True
    ):
        shown = [each for each in studies if each["against"] == against]
        drawn = dict.fromkeys(COLOURS, 0)
        for each in shown:
            problem, quantity = each["problem"], each["quantity"]
            axes.loglog(
                each["resolutions"],
                each["errors"],
                color=COLOURS[problem],
                marker=MARKERS[drawn[problem]],
                markerfacecolor="white",
                label=f"{problem}: {NAMES.get(quantity, quantity)}",
            )
            drawn[problem] += 1
        _reference(axes, shown, slope)
        axes.set_xlabel(label)
        axes.set_xticks(ticks, labels=map(str, ticks))
        axes.set_xticks([], minor=True)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), fontsize=7)
        style.panel_label(axes, letter)
        if letter == "a":
            axes.set_ylabel("largest error")
    return fig


def _reference(axes, shown, slope: int) -> None:
    """A line of the formal order below all curves."""
    counts = np.array([min(each["resolutions"][0] for each in shown), 0.0])
    counts[1] = max(each["resolutions"][-1] for each in shown)
    lowest = min(
        e * n**slope for s in shown for e, n in zip(s["errors"], s["resolutions"], strict=True)
    )
    errors = 0.4 * lowest * counts**-slope
    axes.loglog(counts, errors, "--", color=style.GREY, linewidth=0.8)
    axes.annotate(
        f"slope −{slope}",
        (counts.prod() ** 0.5, errors.prod() ** 0.5),
        xytext=(-4, -4),
        textcoords="offset points",
        ha="right",
        va="top",
        color=style.GREY,
        fontsize=8,
    )
