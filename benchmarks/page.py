"""docs/performance.md and its figure, from what was measured; no number is typed."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmarks import profile
from benchmarks.cost import FAR, LEAST, MOST, OURS, SUNDIALS, TARGET, TEXTBOOK, concluded
from gelpump.figures import style

COLOURS = {
    OURS: style.LENS,
    SUNDIALS: style.NONLINEAR,
    TEXTBOOK: style.PUBLISHED,
    "CVODE": style.SEPARATING,
    "LSODA": style.DRYING,
    "BDF": "#CC79A7",
    "Radau": "#56B4E9",
    "py-pde": style.GREY,
}
MARKERS = dict(zip(COLOURS, "osD^v<>x", strict=True))


def _number(value: float | None, extrapolated: bool = False, bound: bool = False) -> str:
    if value is None:
        return "not reached"
    if bound:
        return f"> {value:.2g}"
    return f"{value:.2g}" + ("*" if extrapolated else "")


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


def cost_table(problems: Sequence[Mapping[str, Any]]) -> str:
    """CPU seconds at the target error, and the ratio to ours."""
    rows = [
        [
            record["problem"] if i == 0 else "",
            each["tool"],
            _number(each["seconds"], each["extrapolated"], each["bound"]),
            _number(each["ratio"], each["extrapolated"], each["bound"]),
        ]
        for record in problems
        for i, each in enumerate(record["tools"])
    ]
    return table(["problem", "tool", "CPU s", "over gelpump's"], rows)


def verdicts(problems: Sequence[Mapping[str, Any]]) -> str:
    """What is asked for, and whether it holds."""
    rows = []
    for record in problems:
        if "times_sundials" in record:
            value, most = record["times_sundials"], record["most"]
            rows.append(
                [
                    record["problem"],
                    f"at most {most:g} times SUNDIALS",
                    _number(value),
                    "holds" if value <= most else "does not hold",
                ]
            )
        if "beats_textbook" in record:
            value, bound = record["beats_textbook"], record["bound"]
            verdict = "holds" if value >= LEAST else "does not hold"
            if bound and value < LEAST:
                verdict = "undecided: a lower bound"
            condition = f"textbook FiPy costs {LEAST:g} times as much"
            rows.append([record["problem"], condition, _number(value, bound=bound), verdict])
    return table(["problem", "condition", "measured", "verdict"], rows) + alone(problems)


def alone(problems: Sequence[Mapping[str, Any]]) -> str:
    """What is to be said of tubes that miss, alone, what is asked of their family."""
    tubes = [each for each in problems if each["kind"] == "tube" and "times_sundials" in each]
    missed = [each for each in tubes[:-1] if each["times_sundials"] > each["most"]]
    if not missed or tubes[-1]["times_sundials"] > tubes[-1]["most"]:
        return ""
    told = " and ".join(
        f"{each['problem']} costs {each['times_sundials']:.2g} times SUNDIALS'" for each in missed
    )
    return f"""
The bound on tubes is asked of their family, and holds there. Alone, {told}: a sweep costs nearly
the same for one tube as for all of them, and one tube has to pay for it alone. Where a single tube
is wanted, SUNDIALS is the better tool.
"""


def models(rows: Sequence[Mapping[str, Any]]) -> str:
    """LENS against nonlinear, with a verdict."""
    if not rows:
        return "Not measured.\n"
    ratios = [row["ratio"] for row in rows]
    if min(ratios) > 1.25:
        verdict = "LENS is cheaper in both"
    elif max(ratios) < 0.8:
        verdict = "the nonlinear model is cheaper in both"
    else:
        verdict = "neither is clearly cheaper in both"
    head = ["bead", "LENS, CPU s", "nonlinear, CPU s", "nonlinear over LENS"]
    body = [
        [r["case"], _number(r["lens"]), _number(r["nonlinear"]), _number(r["ratio"])] for r in rows
    ]
    return table(head, body) + f"\nVerdict: {verdict} (clearly: by a quarter).\n"


def growth_table(series: Sequence[Mapping[str, Any]]) -> str:
    """Cost over the range, and exponents, whole and of the last three runs."""
    rows = [
        [
            each["what"],
            f"{each['n'][0]} to {each['n'][-1]} {each['unit']}",
            f"{each['seconds'][0]:.2g} to {each['seconds'][-1]:.2g}",
            f"{each['wall'][0]:.2g} to {each['wall'][-1]:.2g}",
            f"{each['memory_mb'][0]:.0f} to {each['memory_mb'][-1]:.0f}",
            f"{each['exponent']:.2f} ± {each['exponent_uncertainty']:.2f}",
            f"{each['upper_exponent']:.2f} ± {each['upper_exponent_uncertainty']:.2f}",
        ]
        for each in series
    ]
    head = ["what grows", "range", "CPU s", "wall s", "peak MB", "exponent", "of the last three"]
    return table(head, rows)


LINEAR = 0.1  # of the cost at the largest n: less that is fixed, and growth is linear throughout


def growth_reasons(series: Sequence[Mapping[str, Any]]) -> str:
    """Where each stops being linear, and why."""
    rows = []
    for each in series:
        unit = each["unit"].split()[0]
        fixed, slope, last = each["fixed"], each["slope"], each["n"][-1]
        at = each["crossover"]
        if at is None or slope <= 0:
            where = "does not grow here"
        elif fixed < LINEAR * (fixed + slope * last):
            where = "linear throughout" if at < each["n"][0] else f"linear from {at:.2g} on"
        elif at > last:
            where = f"not yet linear at {last}: it would be from {at:.2g} on"
        else:
            where = f"linear from {at:.2g} on"
        if each["upper_exponent"] - 2 * each["upper_exponent_uncertainty"] > 1:
            where += "; the last three grow faster than that"
        rows.append(
            [each["what"], f"{fixed:.2g}", f"{slope:.2g} a {unit.rstrip('s')}", where, each["why"]]
        )
    return table(["what grows", "fixed, CPU s", "and", "so it is", "because"], rows)


def rebuild_tables(rebuild: Mapping[str, Any], profiled: Mapping[str, Any]) -> str:
    """Start-up, plan, and where the seconds of a whole rebuild go."""
    start = rebuild["start"]
    bare = start["interpreter"]
    rows = [["interpreter", f"{bare:.2f}"]]
    rows += [[f"import {k}", f"{v - bare:.2f}"] for k, v in start.items() if k != "interpreter"]
    rows.append(["Snakemake: plan of the whole build", _number(rebuild["plan"])])
    return f"""{table(["before any physics", "CPU s"], rows)}
{ratios(rebuild["needed"], profiled)}
{spent_table(profiled)}
Imports by the package that a job waits for, with what that imports in turn:

{imports_table(profiled)}
The jobs, by rule:

{rules_table(profiled)}"""


MOST_REBUILD, MOST_WALL = 45.0, 0.6  # times the import process's CPU; wall over CPU on two cores
MOST_AGAIN = (1.5, 2.5)  # times its wall time: nothing to do, one figure from data
MOST_MEMORY = 300.0  # MB, of one process


def ratios(needed: Mapping[str, float], profiled: Mapping[str, Any]) -> str:
    """A rebuild by the measure of one process that imports what it needs, and what is asked."""
    asked = [
        ("a rebuild, CPU", profiled["seconds"] / needed["seconds"], MOST_REBUILD),
        ("a rebuild, wall over CPU", profiled["wall"] / profiled["seconds"], MOST_WALL),
        *(
            (f"{what}, wall", used["wall"] / needed["wall"], most)
            for (what, used), most in zip(profiled["again"].items(), MOST_AGAIN, strict=True)
        ),
        (
            "the largest process, MB",
            max(rule["memory_mb"] for rule in profiled["rules"].values()),
            MOST_MEMORY,
        ),
    ]
    rows = [
        [what, f"{value:.3g}", f"{most:g}", "holds" if value <= most else "does not hold"]
        for what, value, most in asked
    ]
    return f"""
Seconds mean little on another machine, so a rebuild is measured by one process that imports numpy,
scipy.sparse, xarray, netCDF4, matplotlib and fipy and ends: here {needed["seconds"]:.2f} CPU s, in
{needed["wall"]:.2f} s.

{table(["times that", "measured", "at most", "verdict"], rows)}"""


def spent_table(profiled: Mapping[str, Any]) -> str:
    """CPU seconds of a rebuild by what they were spent on and by group of jobs."""
    groups = profiled["table"]
    total = profiled["seconds"]
    rows = []
    for name in profile.ROWS:
        spent = [counted.get(name, 0.0) for counted in groups.values()]
        cells = [f"{value:.1f}" if value >= 0.05 else "" for value in spent]
        rows.append([name, *cells, f"{sum(spent):.1f}", f"{sum(spent) / total:.0%}"])
    sums = [sum(counted.values()) for counted in groups.values()]
    rows.append(["**all**", *(f"{v:.1f}" for v in sums), f"**{total:.1f}**", ""])
    return f"""
Where {total:.0f} CPU seconds of a rebuild from nothing went: every process of
`snakemake --cores 2 all` took a sample of itself each 4 ms of CPU time, which took another
{profiled["sampling"]:.1f} s ({profiled["sampling"] / total:.0%}), not counted here.

{table(["CPU s", *groups, "all", "share"], rows)}"""


def imports_table(profiled: Mapping[str, Any]) -> str:
    """Imports by package, the dearest first."""
    rows = [
        [package, number, f"{seconds:.1f}"]
        for package, (number, seconds) in sorted(
            profiled["imports"].items(), key=lambda item: -item[1][1]
        )
        if seconds >= 0.1
    ]
    return table(["package", "processes", "CPU s"], rows)


def rules_table(profiled: Mapping[str, Any]) -> str:
    """Jobs by rule, the dearest first; cheap ones together."""
    rules = sorted(profiled["rules"].items(), key=lambda item: -item[1]["seconds"])
    rows = [
        [
            rule,
            spent["number"],
            f"{spent['seconds']:.1f}",
            f"{spent['wall']:.1f}",
            f"{spent['memory_mb']:.0f}",
        ]
        for rule, spent in rules
    ]
    return table(["rule", "jobs", "CPU s", "wall s", "peak MB"], rows)


def levers_table(levers: Sequence[Mapping[str, Any]]) -> str:
    """CPU seconds with each lever and without it."""
    rows = [
        [
            each["lever"],
            each["instead"],
            each["where"],
            f"{each['with']:.2g}",
            "error above 1 %" if each["without"] is None else f"{each['without']:.2g}",
            "–" if each["without"] is None else f"{each['without'] / each['with']:.1f}",
        ]
        for each in levers
    ]
    return table(["lever", "instead of", "where", "CPU s with", "without", "times"], rows)


def left(profiled: Mapping[str, Any], rebuild: Mapping[str, Any]) -> str:
    """What a rebuild spends outside the physics' own arithmetic, and what a lower time needs."""
    spent = {
        name: sum(counted.get(name, 0.0) for counted in profiled["table"].values())
        for name in profile.ROWS
    }
    begun = spent[profile.START] + spent[profile.END]
    fipy = spent["FiPy: matrix assembly"] + spent["FiPy: the rest"]
    saved = {k: v for k, v in spent.items() if k.startswith("figures: saving")}
    plan = min(rebuild["plan"] or 0.0, spent[profile.SCHEDULING])
    rows = [
        [
            "imports, and interpreters that begin and end",
            begun + spent[profile.IMPORTS],
            "nothing but what jobs are forked from, and Snakemake itself",
            rebuild["needed"]["seconds"] + rebuild["start"]["snakemake"],
        ],
        [
            "Snakemake's plan and schedule",
            spent[profile.SCHEDULING],
            "only the plan of the whole build, no watching of jobs",
            plan,
        ],
        [
            "FiPy around its linear solves",
            fipy,
            "the same scheme in NumPy alone; but FiPy is what users of the project ask for",
            0.0,
        ],
        [
            "rates and Jacobians that SUNDIALS asks for",
            spent["SUNDIALS and the rates it asks for"],
            "the same in a compiled language (not counted as saved: it would be written twice)",
            spent["SUNDIALS and the rates it asks for"],
        ],
        [
            "three formats of each figure",
            sum(saved.values()),
            "one of them, PNG",
            saved["figures: saving PNG"],
        ],
    ]
    now, then = sum(row[1] for row in rows), sum(row[3] for row in rows)
    total = profiled["seconds"]
    body = [[what, f"{a:.1f}", need, f"{b:.1f}"] for what, a, need, b in rows]
    body.append(
        ["all the rest: physics, drawing, files", f"{total - now:.1f}", "", f"{total - now:.1f}"]
    )
    body.append(["**all**", f"**{total:.1f}**", "", f"**{total - now + then:.1f}**"])
    head = ["what is spent on", "CPU s", "what a lower time would need", "CPU s then"]
    return f"""{table(head, body)}
Two cores take at least half of the CPU seconds, {total / 2:.0f} s; this rebuild, which also
sampled itself, took {profiled["wall"]:.0f} s. All of the above together would leave
{(total - now + then) / 2:.0f} s.
"""


def functions_table(profiled: Mapping[str, Any]) -> str:
    """The functions of jobs that take most, with all that they call; imports excluded."""
    rows = [
        ["/".join(name.split("/")[-3:]), f"{seconds:.1f}"]
        for name, seconds in profiled["functions"]
    ]
    return table(["function of a job, imports excluded", "CPU s with what it calls"], rows)


def profile_table(profile: Sequence[Mapping[str, Any]]) -> str:
    """Shares of FiPy in our own runs."""
    rows = [
        [
            each["problem"],
            each["sweeps"],
            f"{each['seconds']:.2f}",
            *(
                f"{100 * each['shares'][k]:.0f} %"
                for k in ("correction", "_prepareLinearSystem", "_solve_")
            ),
        ]
        for each in profile
    ]
    head = [
        "run of gelpump's",
        "sweeps",
        "s, profiled",
        "in FiPy",
        "of it assembly",
        "of it linear solve",
    ]
    return table(head, rows)


QUIET = 0.3  # load at the start, up to which a machine is taken to do nothing else


def page(measured: Mapping[str, Any]) -> str:
    """The page as Markdown."""
    machine = measured["machine"]
    quiet = "quiet" if machine["load"] < QUIET else "not quiet"
    cost = measured["cost"] | {"problems": list(map(concluded, measured["cost"]["problems"]))}
    return f"""# Performance

Made by `snakemake --cores 1 performance --forcerun benchmarks`, which measures all of it. Measured
on {machine["cpu"]}, {machine["cores"]} cores, Python {machine["python"]}, {machine["system"]}, at a
load of {machine["load"]} when it began ({quiet}). CPU seconds are user and system time of one
process, imports excluded unless stated; the lesser of two runs, or one if that took a second.

## Cost against error

CPU seconds at a relative error of {TARGET:g}, interpolated between runs that no other run of the
tool beats in both; * marks what is extrapolated beyond the smallest error reached (the textbook
family: as many times its cheapest tube), > the dearest run of a tool that stays more than
{FAR:g} times the error away. SUNDIALS are the package's second solvers: CVODE for the
bead, with a dense Jacobian; IDA for the tubes, on nodes that follow the front. CVODE, LSODA, BDF
and Radau are the method of lines with a tridiagonal Jacobian, for tubes on a uniform mesh. py-pde
solves Barenblatt's drop only: its meshes are uniform, and it has no place for a surface that moves
with the solution.

![Error against CPU seconds for each tool and problem](performance.png)

{cost_table(cost["problems"])}
What is asked for, bead at most {MOST["bead"]:g} and tubes at most {MOST["tube"]:g} times SUNDIALS:

{verdicts(cost["problems"])}
## The floor

What FiPy takes of our own runs, which no numerics around it can remove. The profiler itself slows
Python down, so that shares mean more than seconds.

{profile_table(cost["profile"])}
## LENS against nonlinear

The same integrator (CVODE), the same unknowns, mesh, band and tolerances, each model against its
own converged solution, at an error of {TARGET:g}:

{models(cost["models"])}
## Growth

CPU seconds ~ n^exponent, fitted to all runs and to the last three. Each run has a process of its
own; imports are excluded, and the memory is that of the process with all that it has loaded.

{growth_table(measured["growth"])}
The same as a fixed cost and one in proportion, fitted together; where the second is larger, growth
is called linear.

{growth_reasons(measured["growth"])}
## Levers

What was done to make it fast, each left out alone: a factor of 1 says that it is worth nothing on
this problem at this error. For beads and tubes: CPU seconds at an error of {TARGET:g}, interpolated
as above, the lesser of two runs; for what is around them, of what is named.

{levers_table(measured["levers"])}
Two more were measured in one run when they were left out or put aside (November 2026, 2 cores, CPU
seconds with others at work). Runs of their own time steps could once meet in threads to share a
FiPy sweep: refinement of the beads and tubes and all known solutions took 8.9 s with that, 12.2 s
without, of 138 s of a rebuild; it is gone. FiPy's public terms alone, without
`gelpump.tridiagonal`, take 43 s instead of 11 s for all beads and tubes of the paper.

Forked scripts gave the same 142 files to the byte as an interpreter each. 57 jobs then took 137
CPU s where the process that imports all packages took 3.3 (packages without bytecode, others at
work, which also made Snakemake's own share 31 s); of 22 s of imports pint had 10, and is now loaded
beforehand too. Two more ways were not taken: to begin that interpreter before Snakemake plans would
shorten one figure, at the cost of every build with nothing to do; and an own search for equilibria
would save SciPy's import when a configuration is checked.

## A rebuild

{rebuild_tables(measured["rebuild"], measured["profile"])}
## What is left, and what a lower time would need

{left(measured["profile"], measured["rebuild"])}"""


def draw(problems: Sequence[Mapping[str, Any]]):
    """Work-precision diagrams, one panel a problem."""
    fig = style.figure(height=5.6)
    axes = fig.subplots(3, 2, sharex=True, sharey=True).ravel()
    handles = {}
    for letter, axis, record in zip("abcdef", axes, problems, strict=False):
        for each in record["tools"]:
            done = [run for run in each["runs"] if "error" in run]
            if not done:
                continue
            (handles[each["tool"]],) = axis.loglog(
                [run["seconds"] for run in done],
                [run["error"] for run in done],
                color=COLOURS[each["tool"]],
                marker=MARKERS[each["tool"]],
                markerfacecolor="white",
                linewidth=1.8 if each["tool"] == OURS else 0.9,
            )
        axis.axhline(TARGET, color=style.GREY, linewidth=0.6, linestyle="--")
        style.panel_label(axis, letter)
        axis.set_title(record["problem"], fontsize=8, pad=4)
    for axis in axes[4:]:
        axis.set_xlabel("CPU seconds")
    for axis in axes[::2]:
        axis.set_ylabel("relative error")
    fig.legend(handles.values(), handles, loc="outside lower center", ncols=4)
    return fig


def write(measured: Mapping[str, Any], folder: Path) -> None:
    """performance.md and performance.png."""
    from gelpump.text import write_text

    write_text(page(measured), folder / "performance.md")
    with style.styled():
        style.save(draw(measured["cost"]["problems"]), [folder / "performance.png"])
