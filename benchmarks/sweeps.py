"""What sweeps cost, measured, and docs/sweeps.md made from it.

python -m benchmarks.sweeps measure FILE.json [PART ...]
python -m benchmarks.sweeps page FILE.json FOLDER
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from benchmarks.growing import machine
from benchmarks.measure import forked, growth
from benchmarks.page import table
from benchmarks.settings import PROJECT
from gelpump.sweep import plan
from gelpump.sweep.solving import FAMILY

PARTS = ("Snakefile", "config", "profiles", "workflow", "src")
CHUNKS = (10, 30, 100, 250, 500, 2000)  # designs
THREE_PLACES = 500  # designs of the largest chunk that is measured at three places
COMBINED = (1_000, 10_000, 100_000)  # designs
SAMPLED = (10_000, 100_000, 1_000_000)  # designs
PLANNED = (100, 400, 1600, 6400)  # chunks
FORMULAE = 1_000_000  # designs
EXTRAPOLATED = ((10_000, 500), (100_000, 500), (100_000, 5000), (10_000_000, 20_000))
MANY = 100_000  # designs of which the measured chunks are parts, sorted as in a sweep


def hypercube(**changed) -> dict:
    """The hypercube of config/sweeps, with other numbers."""
    return plan.load(PROJECT / "config/sweeps/hypercube.yaml") | changed


@cache
def _designs(count):
    from gelpump.sweep import sampling

    return sampling.sample(hypercube(samples=count))


def peak() -> float:
    """Peak memory in MB of a process that does nothing, with what is imported here so far."""
    return forked(lambda: None)[1]


def solve(start: int, size: int, path: Path | None = None) -> None:
    """A chunk of the many designs, as its job solves it."""
    from gelpump import netcdf
    from gelpump.sweep import solving

    sweep = hypercube()
    here = _designs(MANY).isel(index=slice(start, start + size))
    solved = solving.solve_designs(here, sweep["tau"], sweep["numerics"])
    if path is not None:
        netcdf.write(solved, path, "a chunk of a sweep", sweep, flag="status")


def _start(place, size):
    return int(place * MANY) - size // 2


def chunk_sizes() -> list[dict]:
    """CPU seconds and peak memory of a chunk by its size, imports excluded."""
    _designs(MANY)
    solve(0, 1)  # imports
    found = []
    for size in CHUNKS:
        places = (0.1, 0.5, 0.9) if size <= THREE_PLACES else (0.5,)
        runs = [forked(lambda at=at, n=size: solve(_start(at, n), n)) for at in places]
        seconds, memory, _ = zip(*runs, strict=True)
        found.append(
            {
                "designs": size,
                "seconds": [each / size for each in seconds],
                "memory_mb": max(memory),
            }
        )
        print(found[-1], flush=True)
    return found


def combining(folder: Path) -> list[dict]:
    """CPU seconds and memory of combining beyond its libraries, by the number of designs."""
    import netCDF4  # noqa: F401

    from gelpump.sweep import combine

    chunk, target, found = folder / "chunk.nc", folder / "sweep.nc", []
    forked(lambda: solve(_start(0.5, 250), 250, chunk))
    base = peak()
    for designs in COMBINED:
        paths = [chunk] * (designs // 250)
        seconds, memory, _ = forked(
            lambda paths=paths, n=designs: combine.combine(paths, target, n, "t", {}, {})
        )
        size = target.stat().st_size
        found.append(
            {"designs": designs, "seconds": seconds, "memory_mb": memory - base, "bytes": size,
             "chunk_bytes": chunk.stat().st_size}
        )  # fmt: skip
        print(found[-1], flush=True)
    return found


def sampled() -> list[dict]:
    """CPU seconds and memory of drawing the designs beyond its libraries."""
    from gelpump.sweep import sampling

    sampling.sample(hypercube(samples=2))  # imports
    base, found = peak(), []
    for count in SAMPLED:
        seconds, memory, _ = forked(lambda n=count: sampling.sample(hypercube(samples=n)))
        found.append({"designs": count, "seconds": seconds, "memory_mb": memory - base})
        print(found[-1], flush=True)
    return found


def formulae() -> dict:
    """CPU seconds of tau_99 of a million designs."""
    from gelpump.sweep import sampling
    from gelpump.tube.deswelling import deswelling_time
    from gelpump.tube.tubes import Tubes

    designs = sampling.sample(hypercube(samples=FORMULAE))
    tubes = Tubes(*(designs[key].values for key in ("ell", "eps", "M", "Pi_ratio", "Phi_inf")))
    seconds, memory, _ = forked(lambda: deswelling_time(tubes))
    return {"designs": FORMULAE, "seconds": seconds, "memory_mb": memory}


def waves() -> dict:
    """CPU seconds and memory of the ten million of config/sweeps: all drawn, one chunk solved."""
    from gelpump.sweep import sampling, solving

    sweep = plan.load(PROJECT / "config/sweeps/millions.yaml")
    designs, size = plan.designs(sweep), sweep["chunk"]
    few = sampling.sample(sweep | {"samples": 4 * size})
    here = few.isel(index=slice(size, 2 * size))

    def chunk(designs=here):
        solving.solve_designs(designs, sweep["tau"], sweep["numerics"], sweep["accuracy"]["error"])

    chunk(here.isel(index=slice(10)))  # imports
    spent, memory, _ = forked(chunk)
    found = {"chunk": size, "seconds": spent / size, "memory_mb": memory, "designs": designs}
    del few, here
    drawing, memory, _ = forked(lambda: sampling.sample(sweep))
    found |= {"draw_seconds": drawing, "draw_mb": memory}
    print(found, flush=True)
    return found


def _clone(folder: Path, samples: int, chunk: int) -> None:
    for part in PARTS:
        copy = shutil.copytree if (PROJECT / part).is_dir() else shutil.copy2
        copy(PROJECT / part, folder / part)
    describe(folder, samples, chunk)


def describe(folder: Path, samples: int, chunk: int) -> None:
    """The sweep `measured` of a clone."""
    keys = ("method", "seed", "parameters", "tau")
    sweep = {k: v for k, v in hypercube().items() if k in keys}
    sweep |= {"samples": samples, "chunk": chunk}
    (folder / "config/sweeps/measured.yaml").write_text(yaml.safe_dump(sweep, sort_keys=False))


def _snakemake(folder: Path, *arguments: str) -> tuple[float, float]:
    def run():
        subprocess.run(
            [sys.executable, "-m", "snakemake", "--cores", "1", *arguments],
            cwd=folder,
            env=os.environ | {"PYTHONPATH": str(folder / "src")},
            check=True,
            capture_output=True,
        )

    return forked(run)[:2]


def planning(folder: Path) -> list[dict]:
    """CPU seconds and peak memory of Snakemake's plan, by the number of chunks."""
    found = []
    for count in PLANNED:
        describe(folder, 250 * count, 250)
        seconds, memory = _snakemake(folder, "--dry-run", "--quiet", "all", "--", "sweep_measured")
        found.append({"chunks": count, "seconds": seconds, "memory_mb": memory})
        print(found[-1], flush=True)
    return found


def job(folder: Path, chunks: int = 6, size: int = 10) -> dict:
    """CPU seconds of a job on one machine beside its solve; what it leaves beside its dataset."""
    describe(folder, chunks * size, size)
    target = "results/sweeps/measured/sweep.nc"
    _snakemake(folder, "results/sweeps/measured/designs.nc")
    planned, _ = _snakemake(folder, "--dry-run", target)
    whole, _ = _snakemake(folder, target)
    sweep = hypercube(samples=chunks * size)

    def solves():
        from gelpump.sweep import sampling, solving

        designs = sampling.sample(sweep)
        for i in range(chunks):
            here = designs.isel(index=slice(i * size, (i + 1) * size))
            solving.solve_designs(here, sweep["tau"], sweep["numerics"])

    solve(0, 1)  # imports
    alone, *_ = forked(solves)
    left = [
        folder / "results/logs/sweep_measured/000000.log",
        folder / "results/provenance/sweep_measured/000000.json",
    ]
    return {
        "seconds": (whole - planned - alone) / chunks,
        "files": 1 + len(left),
        "bytes": sum(file.stat().st_size for file in left),
    }


def whole_run(folder: Path) -> dict:
    """The hypercube of config/sweeps as a user runs it, on two cores."""
    from gelpump.netcdf import read
    from gelpump.sweep.accuracy import verdict

    before = time.monotonic()
    seconds, _ = _snakemake(folder, "--cores", "2", "sweep_hypercube")
    spent, made = time.monotonic() - before, folder / "results/sweeps/hypercube"
    passed, told = verdict(read(made / "accuracy.nc"))
    sweep = read(made / "sweep.nc")
    ended = {
        word: int((sweep.status == flag).sum())
        for flag, word in enumerate(sweep.status.flag_meanings.split())
    }
    plan_ = hypercube()
    found = {"designs": plan_["samples"], "chunk": plan_["chunk"], "seconds": seconds,
             "wall": spent, "passed": passed, "told": told, "ended": ended}  # fmt: skip
    print(found, flush=True)
    return found


def measure(parts: Sequence[str] = (), found: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Everything that the page tells, or some parts of it anew."""
    found = dict(found or {}) | {"machine": machine()}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "clone").mkdir()
        _clone(folder / "clone", 1, 1)
        of = {
            "sampled": sampled,  # memory first, before more is imported
            "combined": lambda: combining(folder),
            "planned": lambda: planning(folder / "clone"),
            "job": lambda: job(folder / "clone"),
            "whole": lambda: whole_run(folder / "clone"),
            "formulae": formulae,
            "waves": waves,
            "chunks": chunk_sizes,
        }
        for part in parts or of:
            found[part] = of[part]()
    return found


def extrapolated(measured: Mapping[str, Any], designs: int, size: int) -> dict[str, float]:
    """Cost of a sweep from what was measured: hours of CPU, jobs, files and bytes."""
    jobs = -(-designs // size)
    nearest = max(
        (c for c in measured["chunks"] if c["designs"] <= size), key=lambda c: c["designs"]
    )
    per_design = np.mean(nearest["seconds"])  # larger chunks are families one after the other
    planned = measured["planned"]
    counts = [each["chunks"] for each in planned]
    plan_of = {
        key: _line(counts, [each[key] for each in planned], jobs)
        for key in ("seconds", "memory_mb")
    }
    combined = measured["combined"][-1]
    chunk_bytes = combined["chunk_bytes"] / 250 * size  # attributes weigh little in large ones
    draws = measured["sampled"]
    return {
        "jobs": jobs,
        "solve_hours": designs * per_design / 3600,
        "job_hours": jobs * measured["job"]["seconds"] / 3600,
        "one_job": size * per_design + measured["job"]["seconds"],
        "combine_hours": designs * combined["seconds"] / combined["designs"] / 3600,
        "plan_seconds": plan_of["seconds"],
        "plan_mb": plan_of["memory_mb"],
        "draw_mb": _line([d["designs"] for d in draws], [d["memory_mb"] for d in draws], designs),
        "files": jobs * measured["job"]["files"],
        "bytes": jobs * (chunk_bytes + measured["job"]["bytes"])
        + designs * combined["bytes"] / combined["designs"],
    }


def _line(counts, values, there):
    """A fixed part and one that grows, fitted relatively; at least the fixed one."""
    fit = growth(counts, values)
    return fit.fixed + fit.slope * there


def tables(measured: Mapping[str, Any]) -> dict[str, str]:
    """The page's tables."""
    sizes = [
        [
            f"{c['designs']}",
            f"{1000 * np.mean(c['seconds']):.0f}",
            f"{1000 * min(c['seconds']):.0f} to {1000 * max(c['seconds']):.0f}"
            if len(c["seconds"]) > 1
            else "–",
            f"{1000 * (np.mean(c['seconds']) + measured['job']['seconds'] / c['designs']):.0f}",
            f"{c['designs'] * np.mean(c['seconds']):.0f}",
            f"{c['memory_mb']:.0f}",
        ]
        for c in measured["chunks"]
    ]
    costs = []
    for designs, size in EXTRAPOLATED:
        cost = extrapolated(measured, designs, size)
        hours = cost["solve_hours"] + cost["job_hours"]
        costs.append(
            [
                f"{designs:,}".replace(",", " "),
                size,
                _two(cost["jobs"]),
                f"{_two(cost['solve_hours'])} + {_two(cost['job_hours'])}",
                *(_time(max(3600 * hours / cores, cost["one_job"])) for cores in (2, 200)),
                _time(3600 * cost["combine_hours"]),
                _two(cost["files"]),
                _two(cost["bytes"] / 1e9),
                _time(cost["plan_seconds"]),
                _two(cost["plan_mb"] / 1000),
                _two(cost["draw_mb"] / 1000),
            ]
        )
    return {
        "chunks": table(
            ["designs of a chunk", "CPU ms per design", "least to most of three places",
             "with the job around it", "CPU s of the solve", "peak MB"],
            sizes,
        ),
        "combined": table(
            ["designs", "chunks of 250", "CPU s", "MB in memory", "MB on disk"],
            [
                [c["designs"], c["designs"] // 250, f"{c['seconds']:.2f}", f"{c['memory_mb']:.0f}",
                 f"{c['bytes'] / 1e6:.2f}"]
                for c in measured["combined"]
            ],
        ),
        "planned": table(
            ["chunks", "CPU s", "peak MB"],
            [[p["chunks"], f"{p['seconds']:.1f}", f"{p['memory_mb']:.0f}"]
             for p in measured["planned"]],
        ),
        "waves": _wave_costs(measured["waves"], measured["job"]),
        "costs": table(
            ["designs", "chunk", "jobs", "core hours: solving + jobs", "on 2 cores",
             "on 200 cores", "combining", "files", "GB", "Snakemake's plan", "of GB",
             "drawing, GB"],
            costs,
        ),
    }  # fmt: skip


def _wave_costs(waves, job):
    rows = []
    for designs in (waves["designs"], 100 * waves["designs"]):
        spent = designs * (waves["seconds"] + job["seconds"] / waves["chunk"])
        times = [_time(spent / cores) for cores in (1, 2, 200)]
        rows.append([f"{designs:,}".replace(",", " "), *times])
    return table(["designs", "CPU", "on 2 cores", "on 200 cores"], rows)


def _time(seconds: float) -> str:
    for unit, length in (("d", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 2 * length:
            return f"{_two(seconds / length)} {unit}"
    return f"{_two(seconds)} s"


def _two(value: float) -> str:
    """Two digits, without a power of ten."""
    return f"{float(f'{value:.2g}'):,.10g}".replace(",", " ")


def page(measured: Mapping[str, Any]) -> str:
    """The page as Markdown."""
    import jinja2

    text = (Path(__file__).parent / "sweeps.md.j2").read_text(encoding="utf-8")
    sampling = measured["sampled"][-1]
    return jinja2.Template(
        text, trim_blocks=True, undefined=jinja2.StrictUndefined, keep_trailing_newline=True
    ).render(
        **measured,
        tables=tables(measured),
        largest=plan.WHOLE["chunk"][1],
        family=FAMILY,
        drawn=sampling,
    )


def main(arguments: list[str]) -> int:
    """Measure, or make the page of what was measured."""
    from gelpump.text import write_json, write_text

    match arguments:
        case ["measure", file, *parts]:
            Path(file).parent.mkdir(parents=True, exist_ok=True)
            before = json.loads(Path(file).read_text(encoding="utf-8")) if parts else None
            write_json(measure(parts, before), file)
        case ["page", file, folder]:
            measured = json.loads(Path(file).read_text(encoding="utf-8"))
            write_text(page(measured), Path(folder) / "sweeps.md")
        case _:
            print(__doc__)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
