"""How cost and memory grow, and what a rebuild spends before and around its physics."""

import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from benchmarks import tools
from benchmarks.measure import forked, growth
from benchmarks.problems import Bead, Tubes
from benchmarks.settings import PROJECT, paper
from gelpump.bead import lens

IMPORTS = {
    "interpreter": "pass",
    "numpy": "import numpy",
    "scipy.sparse": "import scipy.sparse",
    "xarray": "import xarray",
    "fipy": "import os; os.environ['FIPY_SOLVERS'] = 'scipy'; import fipy",
    "matplotlib": "import matplotlib.figure",
    "snakemake": "import snakemake.cli",
}
NEEDED = "import numpy, scipy.sparse, xarray, netCDF4, matplotlib, fipy"  # the measure of a rebuild


def _series(name: str, unit: str, why: str, counts, run) -> dict:
    cost, done, failed = [], [], []
    for n in counts:
        try:
            cost.append(forked(lambda n=n: run(n)))
            done.append(n)
        except ChildProcessError:  # its traceback is in the log
            failed.append(n)
    return _record(name, unit, why, done, cost) | {"failed": failed}


def _record(name: str, unit: str, why: str, counts, cost) -> dict:
    seconds = [each.seconds for each in cost]
    fit, upper = growth(counts, seconds), growth(counts[-3:], seconds[-3:])
    record = {
        "what": name,
        "unit": unit,
        "why": why,
        "n": [int(n) for n in counts],
        "seconds": seconds,
        "wall": [each.wall for each in cost],
        "memory_mb": [each.memory_mb for each in cost],
        "exponent": fit.exponent,
        "exponent_uncertainty": fit.exponent_uncertainty,
        "upper_exponent": upper.exponent,
        "upper_exponent_uncertainty": upper.exponent_uncertainty,
        "fixed": fit.fixed,
        "slope": fit.slope,
        "crossover": fit.crossover if np.isfinite(fit.crossover) else None,
    }
    print(record, flush=True)
    return record


def series() -> list[dict]:
    """Cells, tubes, cases, jobs and steps, each with the others fixed."""
    swelling = Bead.of(paper(), "swelling")

    def tubes(count):
        ell = np.linspace(0.1, 0.9, count) if count > 1 else [0.5]
        return Tubes.of(paper(), "tubes", ell, [1e-3])

    tools.our_bead(swelling, 12, 1e-2)  # imports are not part of it
    tools.our_tubes(tubes(1), 8, 8, 1e-2)
    return [
        _series(
            "cells of a bead",
            "cells",
            "a sweep is some hundred calls of NumPy, most by FiPy, whose cost does not depend on "
            "the length of their arrays until these are long; and finer shells ask Newton's "
            "method for more accuracy, so for more sweeps",
            [40, 320, 2560],
            lambda n: tools.our_bead(swelling, n, 1e-3),
        ),
        _series(
            "cells of five tubes",
            "cells a tube",
            "the same calls, on the cells of all tubes at once",
            [32, 256, 2048],
            lambda n: tools.our_tubes(tubes(5), n // 2, n // 2, 1e-3),
        ),
        _series(
            "tubes of a family",
            "tubes of 52 cells",
            "tubes are blocks of one mesh and share each sweep, so that another tube costs only "
            "its cells, until these outweigh the calls; and all take the steps of the one that "
            "needs most",
            [1, 16, 256],
            lambda n: tools.our_tubes(tubes(n), 32, 20, 1e-3),
        ),
        _series(
            "bead cases, one after the other",
            "cases",
            "nothing is shared: in proportion from the first case on",
            [1, 2, 4],
            lambda n: [tools.our_bead(swelling, 24, 1e-3) for _ in range(n)],
        ),
        _series(
            "Snakemake jobs that do nothing",
            "jobs",
            "Snakemake starts once and reads the workflow once; each job then starts a Python of "
            "its own, which those of gelpump's workflow do not",
            [1, 4, 16],
            empty_jobs,
        ),
        steps(swelling),
    ]


def empty_jobs(count: int, *options: str, imports: str = "os") -> None:
    """A workflow of ``count`` jobs that import something and write an empty file."""
    with tempfile.TemporaryDirectory() as folder:
        here = Path(folder)
        (here / "Snakefile").write_text(
            f"rule all:\n    input: expand('{{i}}.txt', i=range({count}))\n\n"
            "rule one:\n    output: '{i}.txt'\n    script: 'one.py'\n"
        )
        code = f"import {imports}\nopen(snakemake.output[0], 'w').close()\n"
        (here / "one.py").write_text(code)
        command = [sys.executable, "-m", "snakemake", "--cores", "1", "--quiet", "all", *options]
        subprocess.run([*command, "--", "all"], cwd=here, check=True, capture_output=True)


def steps(problem: Bead) -> dict:
    """Against the number of time steps: the tolerance varies."""

    def run(tolerance):
        return lens.solve(
            problem.gel,
            problem.temperature,
            problem.phi_initial,
            problem.times,
            40,
            tolerance=tolerance,
        )

    tolerances = (1e-3, 1e-4, 1e-5)
    return _record(
        "time steps of a bead",
        "steps",
        "short steps are predicted better and take fewer sweeps each; set-up is paid once",
        [int(run(tolerance).attrs["steps"]) for tolerance in tolerances],
        [forked(lambda tolerance=tolerance: run(tolerance)) for tolerance in tolerances],
    )


def rebuild() -> dict:
    """Start-up costs, Snakemake's own, and the process that a whole rebuild is measured by."""
    start = {
        name: min(forked(lambda code=code: _python("-c", code)).seconds for _ in range(2))
        for name, code in IMPORTS.items()
    }
    needed = [forked(lambda: _python("-c", NEEDED)) for _ in range(3)]

    def dry():
        _python("-m", "snakemake", "--cores", "1", "--dry-run", "--forceall", "all")

    try:
        plan = forked(dry).seconds
    except ChildProcessError:  # the workflow does not parse: its message is in the log
        plan = None
    return {
        "start": start,
        "plan": plan,
        "needed": {
            kind: min(getattr(each, kind) for each in needed) for kind in ("seconds", "wall")
        },
    }


def _python(*arguments: str) -> None:
    subprocess.run([sys.executable, *arguments], cwd=PROJECT, check=True, capture_output=True)


def machine() -> dict:
    """What the numbers were measured on."""
    model = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        names = [line for line in info.read_text().splitlines() if line.startswith("model name")]
        model = names[0].partition(":")[2].strip() if names else model
    return {
        "cpu": model,
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        "system": platform.system(),
        "load": round(os.getloadavg()[0], 1),
    }
