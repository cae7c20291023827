"""What each way of being fast is worth: gelpump with it and without, at the same error.

Production code has no switches for this: what is left out is left out here, by a class or a
function of the package that another takes the place of while a run lasts.
"""

import dataclasses
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

from benchmarks import cost, tools
from benchmarks.growing import empty_jobs
from benchmarks.measure import cpu, forked
from benchmarks.problems import Bead, Tubes
from benchmarks.settings import paper
from gelpump import bdf, finite_volume
from gelpump.bead import lens
from gelpump.tube import slender
from gelpump.tube.production import family_ell

WARM = ("--executor", "warm", "--warm-preload", "xarray", "netCDF4", "matplotlib.figure")
BEADS = [(16, 1e-3), (24, 3e-4), (32, 1e-4)]
TUBES = [(16, 10, 1e-3), (24, 16, 1e-3), (32, 20, 3e-4), (48, 30, 2e-4)]


class EvenTubes(slender.Family):
    """Cells of one size behind the front and of another ahead of it, as far as production's."""

    def faces(self, t, X_C):
        behind = X_C * np.linspace(0.0, 1.0, self.behind + 1)
        layer = self.front(t) / np.sqrt(4 + self.front(t) ** 2)
        ahead = np.linspace(0.0, 1.0, self._fore.size + 1)[1:]
        return np.hstack([behind, X_C + self.reach * layer * ahead])


def public_terms(cells: int, drifts: bool, first):
    """FiPy's public terms alone, in the place of `finite_volume.trusted`."""
    return finite_volume.Equation(cells, drifts).correction


def even_steps(steps: int) -> Callable:
    """Backward Euler with steps even in sqrt(t), in the place of `bdf.integrate`."""

    def integrate(advance, initial, end, *, order, tolerance, first_step, error_norm, **_):
        times, solutions = [0.0], [np.array(initial)]
        for t in end * np.linspace(0.0, 1.0, steps + 1)[1:] ** 2:
            rate = 1.0 / (t - times[0])
            solutions.insert(0, advance(t, solutions[0], rate, -rate * solutions[0]))
            times.insert(0, t)
            del times[2:], solutions[2:]
            yield bdf.Step(np.array(times), np.array(solutions))

    return integrate


def bead_of_order(order: int):
    """Production's bead with another order of the time steps."""
    return partial(tools.our_bead, order=order)


def evenly(problem: Bead, cells: int, steps: int):
    """A bead by backward Euler, without error control."""
    with patch.object(lens.bdf, "integrate", even_steps(int(steps))):
        return tools.our_bead(problem, cells, 1e-4)


def without(run: Callable, *patches: tuple[Any, str, Any]) -> Callable:
    """`run` while others take the place of what is named."""

    def patched(*arguments):
        with ExitStack() as stack:
            for module, name, other in patches:
                stack.enter_context(patch.object(module, name, other))
            return run(*arguments)

    return patched


def _lever(name: str, instead: str, where: str, with_: float, other: float | None) -> dict:
    record = {"lever": name, "instead": instead, "where": where, "with": with_, "without": other}
    print(record, flush=True)
    return record


def _seconds(problem, name: str, run: Callable, settings: Sequence[tuple]) -> float | None:
    """CPU seconds at the target error; None if no run comes near it."""
    found = cost.ladder(problem, name, run, settings)
    done = [each["error"] for each in found["runs"] if "error" in each]
    return found["seconds"] if done and min(done) < cost.FAR * cost.TARGET else None


def of_beads() -> list[dict]:
    """Levers of a bead that dries, and of one that swells, whose surface is the sharper."""
    problem = cost.with_bead_reference(Bead.of(paper(), "drying"), tools.second_bead, 160, 1e-9)
    ours = tools.our_bead
    best = _seconds(problem, "as it is", ours, BEADS)
    tight = [(32, tolerance) for tolerance in (1e-3, 1e-4, 3e-5, 1e-5)]
    tries = [
        ("third order in time", "second order", bead_of_order(2), tight[:3]),
        ("third order in time", "first order", bead_of_order(1), tight),
        (
            "third order, steps by their error",
            "backward Euler, steps even in √t",
            evenly,
            [(32, 100), (32, 200), (32, 400)],
        ),
        (
            "three diagonals, no constraints",
            "FiPy's public terms alone",
            without(ours, (finite_volume, "trusted", public_terms)),
            BEADS,
        ),
    ]
    return [
        _lever(name, instead, problem.name, best, _seconds(problem, instead, run, settings))
        for name, instead, run, settings in tries
    ]


def of_tubes() -> list[dict]:
    """Levers of the family of tubes."""
    ell, _ = family_ell(paper()["tube_pulse"])
    problem = cost.with_tube_reference(
        Tubes.of(paper(), f"family of {len(ell)} tubes", ell, cost.TAU), 200, 1e-7
    )
    ours = tools.our_tubes
    best = _seconds(problem, "as it is", ours, TUBES)

    def one_by_one(tubes, *settings):
        each = (dataclasses.replace(tubes, ell=(one,), reference=[]) for one in tubes.ell)
        return [found for tube in each for found in ours(tube, *settings)]

    tries = [
        ("all tubes in one sweep", "one after the other", one_by_one, TUBES[2:3]),
        (
            "cells graded to the front",
            "even cells",
            without(ours, (slender, "Family", EvenTubes)),
            [(64, 40, 3e-4), (256, 160, 3e-4)],
        ),
        (
            "three diagonals, no constraints",
            "FiPy's public terms alone",
            without(ours, (finite_volume, "trusted", public_terms)),
            TUBES[1:],
        ),
    ]
    return [
        _lever(name, instead, problem.name, best, _seconds(problem, instead, run, settings))
        for name, instead, run, settings in tries
    ]


def of_jobs() -> list[dict]:
    """Levers around the physics: what a figure and a job cost beside it."""
    from gelpump.figures import style

    def drawn():
        with style.styled():
            fig = style.figure(height=5.6)
            for letter, axis in zip("abcdef", fig.subplots(3, 2).ravel(), strict=True):
                axis.plot(np.linspace(0, 1, 100), label=r"$\phi(t) \ [\mathrm{s}]$")
                axis.set_xlabel("$x$")
                style.panel_label(axis, letter)
                axis.legend()
        return fig

    def saved_by(save):
        with tempfile.TemporaryDirectory() as folder, style.styled():
            paths = [Path(folder, f"figure.{suffix}") for suffix in ("pdf", "svg", "png")]
            fig = drawn()
            save(fig, paths)

    def savefig(fig, paths):
        for path in paths:
            fig.savefig(path, dpi=style.DPI)

    saved_by(style.save)  # fonts and backends are loaded
    rows = [
        _lever(
            "laid out once for all formats",
            "savefig for each",
            "a figure of six panels",
            cpu(lambda: saved_by(style.save))[0],
            cpu(lambda: saved_by(savefig))[0],
        )
    ]
    needed = "xarray, netCDF4, matplotlib.figure"
    others = "scipy.optimize, scipy.interpolate, fipy, sksundae.cvode, jinja2, docutils.core, typst"
    start = "import os, sys; os.environ['FIPY_SOLVERS'] = 'scipy'; "
    rows += [
        _lever(
            "imports when they are needed",
            "all packages at the top",
            "start of a figure's job",
            _python(f"{start}import {needed}"),
            _python(f"{start}import {needed}, {others}"),
        ),
        _lever(
            "forked from one interpreter",
            "a Python for each",
            "8 scripts that import what a figure does",
            forked(lambda: empty_jobs(8, *WARM, imports=needed)).seconds,
            forked(lambda: empty_jobs(8, imports=needed)).seconds,
        ),
    ]
    return rows


def _python(code: str) -> float:
    command = [sys.executable, "-c", code]
    environment = os.environ | {"OMP_NUM_THREADS": "1"}
    return min(
        forked(lambda: subprocess.run(command, check=True, env=environment)).seconds
        for _ in range(3)
    )


def measure() -> list[dict]:
    """All levers."""
    return of_beads() + of_tubes() + of_jobs()
