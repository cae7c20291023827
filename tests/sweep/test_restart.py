"""A sweep as a user runs it: killed and restarted, refused, and held to its accuracy."""

import os
import signal
import subprocess
import time

import pytest
import xarray as xr
import yaml
from clone import Clone
from conventions import require_cf

MINE = {
    "method": "latin_hypercube",
    "samples": 12,
    "seed": 5,
    "parameters": {"ell": {"between": [0.2, 0.8]}, "Phi_inf": {"between": [1.5, 4.0]}},
    "tau": [0.001, 0.01],
    "chunk": 3,
    "numerics": {"cells": [24, 16], "tolerance": 2e-3},
    "accuracy": {"designs": 2, "error": 0.05},
}
SWEEP = "results/sweeps/my-own"


def describe(clone, **changed):
    file = clone.path / "config/sweeps/my-own.yaml"
    file.write_text(yaml.safe_dump(MINE | changed, sort_keys=False))


def said(result):
    return result.stdout + result.stderr


def planned(clone):
    """The chunks that a run would solve."""
    dry = clone.snakemake("--dry-run", f"{SWEEP}/sweep.nc")
    assert dry.returncode == 0, said(dry)
    return said(dry).count(f"output: {SWEEP}/chunks/")


@pytest.fixture(scope="module")
def restarted(tmp_path_factory):
    """A clone whose sweep was killed after two chunks and run again; what was there when killed."""
    clone = Clone(tmp_path_factory.mktemp("sweep") / "project")
    describe(clone)
    chunks = clone.path / SWEEP / "chunks"
    process = subprocess.Popen(
        clone.command(f"{SWEEP}/sweep.nc", "--cores", "1"),
        cwd=clone.path,
        env=clone.environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    deadline = time.monotonic() + 120
    while len(list(chunks.glob("[0-9]*.nc"))) < 2 and time.monotonic() < deadline:
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    time.sleep(0.5)
    kept = {file: file.read_bytes() for file in sorted(chunks.glob("[0-9]*.nc"))}
    assert len(kept) >= 2
    clone.snakemake("--unlock")
    left = planned(clone)
    run = clone.snakemake("sweep_my-own")
    assert run.returncode == 0, said(run)
    return clone, kept, left


def test_a_killed_sweep_loses_at_most_one_chunk(restarted):
    """On one core, one chunk is being solved; a finished one whose end was not noted may be too."""
    clone, kept, left = restarted
    assert 4 - len(kept) <= left <= 4 - len(kept) + 1
    assert sum(file.read_bytes() == was for file, was in kept.items()) == len(kept)
    assert not list((clone.path / SWEEP).rglob("*.partial"))
    with xr.open_dataset(clone.path / SWEEP / "sweep.nc") as made:
        assert made.sizes == {"index": 12, "tau": 2}
        assert int(made.status.max()) == 0
        assert sorted(made.design.values) == list(range(12))


def test_what_a_sweep_leaves_follows_the_cf_conventions(restarted):
    clone, *_ = restarted
    files = [str(clone.path / SWEEP / f"{name}.nc") for name in ("designs", "sweep", "accuracy")]
    files.append(str(clone.path / SWEEP / "chunks/000000.nc"))
    require_cf(files)


def test_only_what_depends_on_a_change_is_solved_again(restarted):
    clone, *_ = restarted
    try:
        assert planned(clone) == 0
        describe(clone, accuracy={**MINE["accuracy"], "designs": 3})
        assert planned(clone) == 0
        describe(clone, accuracy={**MINE["accuracy"], "error": 0.02})  # for waves, too
        assert planned(clone) == 4
        describe(clone, tau=[0.002])
        assert planned(clone) == 4
        describe(clone, chunk=6)
        assert planned(clone) == 2
    finally:
        describe(clone)


def test_a_sweep_that_is_too_inaccurate_fails(restarted):
    clone, *_ = restarted
    try:
        describe(clone, accuracy={"designs": 2, "error": 1e-7})
        run = clone.snakemake(f"{SWEEP}/accuracy.nc")
        assert run.returncode != 0
        assert "the sweep my-own is not as accurate as it should be: 2 designs" in said(run)
        assert "allowed 1.0e-07" in said(run)
        assert not (clone.path / SWEEP / "accuracy.nc").exists()
    finally:
        describe(clone)


def test_a_refused_sweep_starts_no_job(restarted):
    clone, *_ = restarted
    try:
        describe(clone, chunk="large")
        run = clone.snakemake("sweep_my-own")
        assert run.returncode != 0
        assert "chunk = 'large': must be a whole number from 1 to 50000" in said(run)
        assert "rule sweep_chunk" not in said(run)
        assert clone.snakemake("--dry-run", "fig13_osmotic").returncode == 0  # not asked for
    finally:
        describe(clone)


def test_a_sweep_cannot_have_the_name_of_a_rule(restarted):
    clone, *_ = restarted
    file = clone.path / "config/sweeps/chunk.yaml"
    file.write_text("method: grid\n")
    try:
        run = clone.snakemake("--dry-run", "sweep_my-own")
        assert run.returncode != 0
        assert "config/sweeps/chunk.yaml: 'chunk' must have another name" in said(run)
    finally:
        file.unlink()
