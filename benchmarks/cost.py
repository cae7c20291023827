"""Cost against error: every tool on every problem, in one run; and LENS against nonlinear."""

import cProfile
import dataclasses
import pstats
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from benchmarks import lines, tools
from benchmarks.measure import cost_at, cpu
from benchmarks.problems import Bead, Drop, Tubes
from benchmarks.settings import paper
from gelpump.tube.production import family_ell

OURS, SUNDIALS, TEXTBOOK = "gelpump", "SUNDIALS", "FiPy, textbook"
METHODS = ("CVODE", "LSODA", "BDF", "Radau")
TARGET = 1e-3
MOST = {"tube": 5.0, "bead": 50.0}  # times SUNDIALS: what is asked for
LEAST = 20.0  # times gelpump: what the textbook way should cost
FAR = 10.0  # times the target: from there on nothing is extrapolated
TAU = (1e-3, 1e-2)  # figure 9 is at the latter


def ladder(
    problem, tool: str, run: Callable[..., Any], settings: Sequence[tuple], repeats: int = 2
) -> dict:
    """Seconds and error of a tool at each of the ``settings``, with what went wrong if it did."""
    runs = []
    for each in settings:
        entry: dict[str, Any] = {"settings": [float(value) for value in each]}
        try:
            seconds, solution = cpu(lambda each=each: run(problem, *each), repeats)
            error = problem.error(solution)
            if not np.isfinite(error):
                raise ArithmeticError("the solution is not finite")
            entry |= {"seconds": seconds, "error": error}
        except (ArithmeticError, RuntimeError, ValueError) as failure:
            entry["failed"] = str(failure)[:200]
        print(problem.name, tool, entry, flush=True)
        runs.append(entry)
    done = [entry for entry in runs if "error" in entry]
    cost = cost_at(TARGET, [e["error"] for e in done], [e["seconds"] for e in done])
    return {
        "tool": tool,
        "runs": runs,
        "seconds": cost and cost.seconds,
        "extrapolated": bool(cost and cost.extrapolated),
    }


def with_bead_reference(bead: Bead, solve, coarse: int, rtol: float) -> Bead:
    """The radius on two meshes, extrapolated; its uncertainty is what that added."""
    first, second = (np.asarray(solve(bead, cells, rtol)) for cells in (coarse, 2 * coarse))
    return dataclasses.replace(
        bead,
        reference=second + (second - first) / 3,
        reference_uncertainty=float(np.abs((second - first) / 3 / second).max()),
    )


def with_tube_reference(tubes: Tubes, nodes: int = 400, rtol: float = 1e-8) -> Tubes:
    """The second solver on fine meshes."""
    fine = dataclasses.replace(tubes, reference=tools.second_tubes(tubes, nodes, rtol))
    doubt = fine.error(tools.second_tubes(tubes, nodes // 2, 10 * rtol)) / 3
    return dataclasses.replace(fine, reference_uncertainty=doubt)


def drop() -> dict:
    problem = Drop()

    def by(method):
        return lambda p, cells, rtol: lines.DropLines(p, cells).solve(method, rtol)

    mol = [(25, 1e-4), (50, 1e-4), (100, 1e-5), (200, 1e-6)]
    found = [ladder(problem, OURS, tools.our_drop, [(20, 1e-3), (40, 1e-4), (80, 1e-5)])]
    found += [ladder(problem, method, by(method), mol) for method in METHODS]
    found.append(ladder(problem, TEXTBOOK, tools.textbook_drop, [(50, 50), (100, 100), (100, 200)]))
    if pde := _py_pde():
        found.append(ladder(problem, "py-pde", pde, [(50, 1e-4), (100, 1e-5), (200, 1e-6)]))
    return _record(problem, "drop", found, 0.0)


def _py_pde():
    """Barenblatt's drop in py-pde, with LSODA and its band; None if it is not installed."""
    try:
        import pde
    except ImportError:
        return None

    class Spreading(pde.PDEBase):
        def evolution_rate(self, state, t=0):
            return (0.5 * state**2).laplace({"derivative": 0})

    def run(problem, cells, rtol):
        grid = pde.SphericalSymGrid(problem.box, cells)
        faces = np.linspace(0, problem.box, cells + 1)
        volume = np.diff(faces**3)
        start = np.diff(problem.within(faces, problem.start)) / volume
        end = Spreading().solve(
            pde.ScalarField(grid, start),
            t_range=problem.end - problem.start,
            solver="scipy",
            method="LSODA",
            lband=1,
            uband=1,
            rtol=rtol,
            atol=1e-2 * rtol,
            backend="numpy",
            tracker=None,
        )
        return faces, end.data * volume

    return run


def bead(case: str) -> dict:
    problem = with_bead_reference(Bead.of(paper(), case), tools.second_bead, 160, 1e-9)

    def by(method):
        return lambda p, cells, rtol: lines.LensLines(p, cells).solve(method, rtol)

    found = [
        ladder(
            problem,
            OURS,
            tools.our_bead,
            [(16, 1e-3), (24, 1e-3), (32, 1e-3), (32, 3e-4), (48, 1e-4)],
        ),
        ladder(
            problem,
            SUNDIALS,
            tools.second_bead,
            [(20, 1e-4), (30, 1e-4), (40, 1e-4), (40, 1e-5), (80, 1e-5), (120, 1e-6)],
        ),
        *(
            ladder(problem, method, by(method), [(12, 1e-4), (20, 1e-4), (28, 1e-5)])
            for method in ("CVODE", "LSODA")
        ),
        ladder(problem, "BDF", by("BDF"), [(12, 1e-4), (20, 1e-4)]),
        ladder(problem, "Radau", by("Radau"), [(12, 1e-4), (16, 1e-4)]),
        ladder(problem, TEXTBOOK, tools.textbook_bead, TEXTBOOK_BEADS[case]),
    ]
    return _record(problem, "bead", found, problem.reference_uncertainty)


def tube(ell: float) -> dict:
    problem = with_tube_reference(Tubes.of(paper(), f"tube, ell = {ell:g}", [ell], TAU))

    def by(method):
        return lambda p, cells, rtol: [lines.TubeLines(p, ell, int(cells)).solve(method, rtol)]

    base = 100 if ell < 0.5 else 500
    uniform = [(base, 1e-3), (2 * base, 1e-4), (4 * base, 1e-4)]
    found = [
        ladder(problem, OURS, tools.our_tubes, OUR_TUBES),
        ladder(problem, SUNDIALS, tools.second_tubes, SECOND_TUBES),
        ladder(problem, "LSODA", by("LSODA"), uniform),
        ladder(problem, "BDF", by("BDF"), uniform[:2]),
        ladder(problem, TEXTBOOK, tools.textbook_tube, [(base, 25), (2 * base, 50)]),
    ]
    return _record(problem, "tube", found, problem.reference_uncertainty)


# Each first order in time; in the first instants of swelling cells matter as much.
TEXTBOOK_BEADS = {
    "swelling": [(40, 160), (80, 320)],
    "drying": [(20, 80), (40, 160)],
}
OUR_TUBES = [(16, 10, 1e-3), (24, 16, 1e-3), (32, 20, 3e-4), (48, 30, 2e-4), (64, 40, 1e-4)]
SECOND_TUBES = [(24, 1e-3), (32, 1e-4), (48, 1e-4), (64, 1e-4), (100, 1e-5)]


def family(single: Sequence[dict]) -> dict:
    """All tubes of figure 9; the textbook way as many times as its cheapest tube."""
    ell, _ = family_ell(paper()["tube_pulse"])
    problem = with_tube_reference(
        Tubes.of(paper(), f"family of {len(ell)} tubes", ell, TAU), 200, 1e-7
    )
    found = [
        ladder(problem, OURS, tools.our_tubes, OUR_TUBES),
        ladder(problem, SUNDIALS, tools.second_tubes, SECOND_TUBES),
    ]
    least = [
        each["seconds"]
        for record in single
        for each in record["tools"]
        if each["tool"] == TEXTBOOK and each["seconds"]
    ]
    if least:
        seconds = len(ell) * min(least)
        found.append({"tool": TEXTBOOK, "runs": [], "seconds": seconds, "extrapolated": True})
    return _record(problem, "tube", found, problem.reference_uncertainty)


def _record(problem, kind: str, found: Sequence[dict], doubt: float) -> dict:
    return {
        "problem": problem.name,
        "kind": kind,
        "reference_uncertainty": doubt,
        "tools": list(found),
    }


def concluded(record: dict) -> dict:
    """The record with the tools' ratios to gelpump, and what the conditions ask for.

    A tool whose best error is more than FAR times the target is not extrapolated: its dearest run
    is a lower bound of what it costs.
    """
    tools_ = []
    for each in record["tools"]:
        done = [run for run in each["runs"] if "error" in run]
        bound = bool(done) and min(run["error"] for run in done) > FAR * TARGET
        seconds = max(run["seconds"] for run in done) if bound else each["seconds"]
        tools_.append(each | {"seconds": seconds, "bound": bound})
    seconds = {each["tool"]: each["seconds"] for each in tools_}
    ours = seconds[OURS]
    for each in tools_:
        each["ratio"] = each["seconds"] / ours if each["seconds"] and ours else None
    record = record | {"tools": tools_}
    others = [
        each["seconds"]
        for each in tools_
        if each["tool"] in (SUNDIALS, "CVODE") and each["seconds"] and not each["bound"]
    ]
    if record["kind"] in MOST and ours and others:
        record |= {"times_sundials": ours / min(others), "most": MOST[record["kind"]]}
    if ours and seconds.get(TEXTBOOK):
        (textbook,) = (each for each in tools_ if each["tool"] == TEXTBOOK)
        record |= {"beats_textbook": textbook["ratio"], "bound": textbook["bound"]}
    return record


def lens_against_nonlinear() -> list[dict]:
    """Both models by CVODE: faces as unknowns, the same mesh, band and tolerances."""
    rows = []
    for case in ("swelling", "drying"):
        seconds = {}
        for model, system in (("lens", lines.LensLines), ("nonlinear", lines.NonlinearLines)):

            def run(problem, cells, rtol, system=system):
                return system(problem, cells).solve("CVODE", rtol)

            start = Bead.of(paper(), case)
            fine = (tools.second_bead, 160, 1e-9) if model == "lens" else (run, 20, 1e-5)
            try:
                problem = with_bead_reference(start, *fine)
            except RuntimeError as failure:
                print(case, model, "without a reference:", failure, flush=True)
                continue
            problem = dataclasses.replace(problem, name=f"{case}, {model}")
            found = ladder(problem, "CVODE", run, [(8, 1e-4), (12, 1e-4), (16, 1e-4), (24, 1e-5)])
            seconds[model] = found["seconds"]
        if not (seconds.get("lens") and seconds.get("nonlinear")):
            continue
        rows.append({"case": case, **seconds, "ratio": seconds["nonlinear"] / seconds["lens"]})
    return rows


def fipy_share(problem, run, settings) -> dict:
    """Where a run of ours spends its time: FiPy's sweep, its assembly and its linear solve."""
    run(problem, *settings)
    profile = cProfile.Profile()
    profile.runcall(run, problem, *settings)
    stats = pstats.Stats(profile)
    named = {"correction": 0.0, "_prepareLinearSystem": 0.0, "_solve_": 0.0, "sweep": 0.0}
    calls = dict.fromkeys(named, 0)
    for (_, _, name), (_, count, _, spent, _) in stats.stats.items():
        if name in named and spent > named[name]:
            named[name], calls[name] = spent, count
    return {
        "problem": problem.name,
        "settings": [float(value) for value in settings],
        "seconds": stats.total_tt,
        "sweeps": calls["correction"],
        "shares": {name: spent / stats.total_tt for name, spent in named.items()},
    }


def measure() -> dict:
    """All of it."""
    beads = [bead("swelling"), bead("drying")]
    tubes = [tube(0.25), tube(0.9)]
    ell, _ = family_ell(paper()["tube_pulse"])
    all_tubes = Tubes.of(paper(), "family of tubes", ell, TAU)
    return {
        "problems": [drop(), *beads, *tubes, family(tubes)],
        "models": lens_against_nonlinear(),
        "profile": [
            fipy_share(Bead.of(paper(), "drying"), tools.our_bead, (24, 3e-4)),
            fipy_share(all_tubes, tools.our_tubes, (32, 20, 3e-4)),
        ],
    }
