"""Scripts forked from one interpreter are jobs like any others."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest
import yaml

PROJECT = Path(__file__).resolve().parents[2]
SNAKEFILE = """
rule all:
    input:
        [f"{name}.json" for name in ("one", "two", "three", "four", "five")]

rule tell:
    output:
        "{name}.json",
    params:
        what=lambda wildcards: config.get(wildcards.name, "tell"),
    benchmark:
        "{name}.tsv"
    threads: lambda wildcards: 2 if wildcards.name == "four" else 1
    resources:
        own_interpreter=lambda wildcards: int(wildcards.name == "five"),
    script:
        "script.py"
"""
NAMES = ["one", "two", "three", "four", "five"]
SCRIPT = """
import atexit, json, os, signal, sys, time
from pathlib import Path

what = snakemake.params.what
told = {
    "pid": os.getpid(),
    "parent": os.getppid(),
    "threads": os.environ["OMP_NUM_THREADS"],
    "temporary": os.environ["TMPDIR"],
    "preloaded": "fractions" in sys.modules,
    "main": __name__,
    "argv": sys.argv[1:],
}
Path(snakemake.output[0]).write_text(json.dumps(told))
if what == "wait":
    time.sleep(600)
elif what == "kill":
    os.kill(os.getpid(), signal.SIGKILL)
elif what == "refuse":
    sys.exit("refused in words")
elif what == "fail":
    raise ValueError("failed on purpose")
atexit.register(print, "left in order")
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "Snakefile").write_text(SNAKEFILE)
    (tmp_path / "script.py").write_text(SCRIPT)
    return tmp_path


ENVIRONMENT = os.environ | {"PYTHONPATH": str(PROJECT / "src")}


def command(*options, preload="fractions", **what):
    run = [sys.executable, "-m", "snakemake", "--cores", "2", "--executor", "warm", *options]
    return [*run, "--warm-preload", preload, "--config", *(f"{k}={v}" for k, v in what.items())]


def build(folder, *options, **what):
    return subprocess.run(
        command(*options, **what),
        cwd=folder,
        env=ENVIRONMENT,
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )


def test_scripts_of_one_thread_are_forked_and_others_are_not(folder):
    result = build(folder)
    assert result.returncode == 0, result.stderr
    told = {name: json.loads((folder / f"{name}.json").read_text()) for name in NAMES}
    forked = [told.pop(name) for name in NAMES[:3]]
    assert len({each["parent"] for each in forked}) == 1
    assert len({each["pid"] for each in forked}) == 3
    assert all(each["preloaded"] and each["threads"] == "1" for each in forked)
    for own in told.values():
        assert own["parent"] != forked[0]["parent"]
        assert not own["preloaded"]
    assert [own["threads"] for own in told.values()] == ["2", "1"]
    for each in [*told.values(), *forked]:
        assert (each["main"], each["argv"]) == ("__main__", [])
        assert each["temporary"] == told["four"]["temporary"]
    assert result.stdout.count("left in order") == 5
    seconds = (folder / "one.tsv").read_text().splitlines()
    assert float(seconds[1].split("\t")[0]) > 0


def test_a_script_that_ends_badly_fails_alone(folder):
    result = build(folder, "--keep-going", one="kill", two="fail", three="refuse")
    assert result.returncode == 1
    for words in ("SIGKILL", "failed on purpose", "refused in words"):
        assert words in result.stdout + result.stderr
    assert sorted(file.name for file in folder.glob("*.json")) == ["five.json", "four.json"]


def test_a_module_that_cannot_be_imported_is_named(folder):
    result = build(folder, preload="no_such_module")
    assert result.returncode == 1
    assert "No module named 'no_such_module'" in result.stderr
    assert "forked from has ended" in result.stderr


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_scripts_and_their_interpreter_end_with_snakemake(folder, number):
    process = subprocess.Popen(
        command(one="wait", two="wait"), cwd=folder, env=ENVIRONMENT, start_new_session=True
    )
    try:
        told = wait_for(lambda: json.loads((folder / "one.json").read_text()))
        family = [told["pid"], told["parent"]]
        assert all(map(alive, family))
        # an interrupt reaches the foreground's whole group, a kill one process
        os.killpg(process.pid, number) if number == signal.SIGINT else process.kill()
        process.wait(timeout=300)
        assert wait_for(lambda: not any(map(alive, family)) or None)
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


def wait_for(something, seconds=300):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        with suppress(OSError, ValueError):
            if (found := something()) is not None:
                return found
        time.sleep(0.05)
    raise TimeoutError


def alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def test_the_project_uses_it_unless_another_profile_is_named():
    import yte

    text = (PROJECT / "profiles/default/config.yaml").read_text()

    def executor(*arguments):
        sys.argv, kept = ["snakemake", *arguments], sys.argv
        try:
            return yte.process_yaml(text).get("executor")
        finally:
            sys.argv = kept

    assert executor("--cores", "2") == "warm"
    for other in (["--profile", "workflow/profiles/slurm"], ["--profile=mine"]):
        assert executor(*other) is None
    assert yaml.safe_load((PROJECT / "workflow/profiles/slurm/config.yaml").read_text())["executor"]
