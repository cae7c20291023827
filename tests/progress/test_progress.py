"""What a build says of itself: on a terminal, in a log, and when a job fails."""

import os
import pty
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from gelpump import bdf, progress
from snakemake_logger_plugin_gelpump.build import Build, duration
from snakemake_logger_plugin_gelpump.screen import reached

SNAKEFILE = """
rule all:
    input: "second.txt"

rule first:
    output: "first_{case}.txt"
    log: "logs/first_{case}.log"
    shell: "echo begun > {log}; sleep 0.6; echo 1 > {output}"

rule second:
    input: expand("first_{case}.txt", case=["hot", "cold"])
    output: "second.txt"
    log: "logs/second.log"
    shell: "echo what went wrong > {log}; test ! -e broken; cp {input[0]} {output}"

rule look:
    log: "logs/look.log"
    shell: "echo a table for the reader"
"""


@pytest.fixture
def project(tmp_path):
    (tmp_path / "Snakefile").write_text(SNAKEFILE)
    (tmp_path / "profiles/default").mkdir(parents=True)
    profile = "logger: gelpump\nshow-failed-logs: true\n"
    (tmp_path / "profiles/default/config.yaml").write_text(profile)
    return tmp_path


COMMAND = [sys.executable, "-m", "snakemake", "--cores", "2"]


def piped(project, *arguments):
    result = subprocess.run(
        [*COMMAND, *arguments], cwd=project, capture_output=True, text=True, check=False
    )
    return result.returncode, result.stdout + result.stderr


def on_a_terminal(project, *arguments, **environment):
    environment = {k: v for k, v in os.environ.items() if k != "CI"} | {
        "TERM": "xterm-256color",
        "COLUMNS": "100",
        **environment,
    }
    master, slave = pty.openpty()
    process = subprocess.Popen(
        [*COMMAND, *arguments],
        cwd=project,
        stdin=slave,
        stdout=slave,
        stderr=slave,
        env=environment,
    )
    os.close(slave)
    said = b""
    while True:
        try:
            more = os.read(master, 65536)
        except OSError:  # the other side is closed
            break
        if not more:
            break
        said += more
    os.close(master)
    return process.wait(), said.decode()


def test_a_log_gets_one_line_a_job(project):
    code, said = piped(project)
    assert code == 0, said
    assert "/3] first hot, " in said
    assert "/3] first cold, " in said
    assert "[3/3] second, " in said
    assert "3 jobs in " in said
    assert "\x1b" not in said
    for noise in ("input:", "Select jobs", "jobid", "SNAKEMAKE", "Elapsed", "localrule all"):
        assert noise not in said
    assert len(said.splitlines()) < 12
    assert "Nothing to be done" in piped(project)[1]


def test_a_terminal_shows_what_runs_and_what_is_left(project):
    code, said = on_a_terminal(project)
    assert code == 0, said
    assert "first hot" in said
    assert "0 of 3 done, 3 left" in said
    assert "[3/3] second, " in said
    assert said.count("\x1b[?25h") >= 1, "the cursor is not given back"


@pytest.mark.parametrize("environment", [{"CI": "true"}, {"TERM": "dumb"}])
def test_a_terminal_that_nobody_watches_is_a_log(project, environment):
    code, said = on_a_terminal(project, **environment)
    assert code == 0, said
    assert "\x1b[2K" not in said
    assert "[3/3] second, " in said


@pytest.mark.parametrize("run", [piped, on_a_terminal])
def test_a_failure_is_told_in_full(project, run):
    (project / "broken").touch()
    code, said = run(project)
    assert code != 0
    assert "Error in rule second" in said
    assert "logs/second.log" in said
    assert "what went wrong" in said, "the log of the failed job"
    assert "Complete log(s): " in said
    kept = sorted((project / ".snakemake/log").glob("*.log"))[-1].read_text()
    assert "Error in rule second" in kept
    assert "rule first:" in kept, "Snakemake's own log has everything"


@pytest.mark.parametrize("run", [piped, on_a_terminal])
def test_a_job_may_speak_to_the_terminal_itself(project, run):
    code, said = run(project, "look")
    assert code == 0, said
    assert "a table for the reader" in said
    assert "\x1b[2K" not in said


def test_a_dry_run_is_snakemakes_own(project):
    code, said = piped(project, "--dry-run")
    assert code == 0
    assert "rule second:" in said
    assert "This was a dry-run" in said


@pytest.mark.parametrize("quiet", ["rules", "progress", "all"])
def test_quiet_is_quiet(project, quiet):
    code, said = on_a_terminal(project, "--quiet", quiet)
    assert code == 0
    assert "first hot" not in said


def test_a_solve_says_how_far_it_is(tmp_path):
    log = tmp_path / "solve.log"
    watch = progress.Watch(log)
    assert reached(log) is None
    seen = []
    for step in bdf.integrate(
        lambda t, guess, alpha, history: -history / (alpha + 1.0),  # dy/dt = -y
        np.ones(1),
        2.0,
        order=2,
        tolerance=1e-3,
        first_step=1e-3,
        error_norm=lambda y, difference: float(np.abs(difference).max()),
    ):
        watch.write()
        seen.append(reached(log))
        assert seen[-1] == (step.time, 2.0)
    assert seen[-1] == (2.0, 2.0)
    watch.end()
    watch.write()
    assert list(tmp_path.iterdir()) == []


def record(jobid, rule, log):
    return SimpleNamespace(jobid=jobid, rule_name=rule, wildcards={}, log=[log], output=["x"])


def test_what_is_left_is_estimated_from_measured_seconds(tmp_path):
    seconds = tmp_path / "seconds.json"
    seconds.write_text('{"bead_drying_lens": 8.0, "bead_swelling_lens": 6.0, "statements": 2.0}')
    build = Build(seconds)
    build.cores = 2
    build.plan({"bead_lens": 2, "statements": 1, "all": 1, "total": 4})
    assert build.total == 3
    assert build.remaining() == pytest.approx((7.0 * 2 + 2.0) / 2)
    build.begin(record(1, "bead_lens", "results/logs/bead_drying_lens.log"))
    assert build.remaining() == pytest.approx((8.0 + 7.0 + 2.0) / 2, abs=0.2)
    build.running[1].began -= 16.0  # twice as slow as it was measured
    build.end(1)
    assert build.remaining() == pytest.approx(2 * (7.0 + 2.0) / 2, rel=0.02)
    assert Build(Path("not there")).remaining() is None


def test_durations_are_short():
    assert [duration(t) for t in (0.42, 12.4, 200, 7500)] == [
        "0.4 s",
        "12 s",
        "3 min 20 s",
        "2 h 5 min",
    ]
