"""The README's map, verdict and seconds are those of the workflow."""

import json
import re
from pathlib import Path

import pytest

from gelpump import build_map
from gelpump.build_map import Job

PROJECT = Path(__file__).resolve().parents[2]
README = (PROJECT / "README.md").read_text(encoding="utf-8")
SECONDS = json.loads((PROJECT / "workflow/reference/seconds.json").read_text(encoding="utf-8"))


def jobs_of_dry_run(said: str) -> dict[str, Job]:
    """Jobs by the name of their benchmark, as a dry run of everything tells them."""
    jobs = {}
    for block in re.split(r"\n(?=(?:local)?rule )", said):
        rule = re.match(r"(?:local)?rule (\w+):", block)
        told = dict(re.findall(r"^    (input|output|benchmark): (.*)$", block, re.M))
        if rule and "benchmark" in told:
            files = [told.get(key, "").split(", ") for key in ("input", "output")]
            inputs, outputs = ([file for file in kind if file] for kind in files)
            read = sorted(file for file in inputs if not file.endswith(".py"))
            jobs[Path(told["benchmark"]).stem] = Job(rule[1], tuple(read), tuple(outputs))
    return jobs


@pytest.fixture(scope="module")
def workflow_jobs(tmp_path_factory):
    from clone import Clone

    clone = Clone(tmp_path_factory.mktemp("map") / "project")
    # the production configuration, whose cases and views the map names
    result = clone.snakemake("--dry-run", "--forceall", config="config/config.yaml")
    assert result.returncode == 0, result.stdout + result.stderr
    return jobs_of_dry_run(result.stdout + result.stderr)


@pytest.mark.xdist_group("workflow")
def test_the_map_is_that_of_the_workflow(workflow_jobs):
    rows = build_map.rows(workflow_jobs)
    assert len(rows) == 16
    assert build_map.table(rows, SECONDS) == build_map.between("map", README), (
        "the README's map is not that of the workflow: build, then `snakemake --cores 1 renew_map`"
    )


@pytest.mark.xdist_group("workflow")
def test_the_seconds_are_of_the_jobs_that_there_are(workflow_jobs):
    assert set(SECONDS) == set(workflow_jobs), "build, then `snakemake --cores 1 renew_map`"
    assert all(0 <= seconds < 600 for seconds in SECONDS.values())


def test_the_verdict_counts_what_it_lists():
    numbers = map(int, re.findall(r"\d+", build_map.between("verdict", README)))
    total, *counts, identities, misprints = numbers
    assert total == sum(counts) > 40
    assert identities + misprints > 0


def test_the_number_of_compared_values_is_that_of_the_reference():
    reference = json.loads((PROJECT / "workflow/reference/values.json").read_text(encoding="utf-8"))
    compared = re.search(r"compares (\d+) numbers", README)
    assert int(compared[1]) == len(reference["values"]) + len(reference["figures"])


def test_the_picture_is_a_figure_of_a_build():
    picture = (PROJECT / "docs/pump.png").read_bytes()
    assert b"results/data/tube_pulse.nc" in picture
    assert b"code_version" in picture


def test_a_figure_needs_what_its_datasets_need():
    jobs = {
        "solve": Job("solve", (), ("solve.nc",)),
        "fit": Job("fit", ("solve.nc",), ("fit.nc",)),
        "fig01_front": Job("fig01_front", ("fit.nc", "solve.nc"), ("front.png",)),
        "claims": Job("claims", ("fit.nc",), ("claims.json",)),
    }
    (row,) = build_map.rows(jobs)
    assert row == ("fig01_front", ("fit", "solve"), ("solve", "fit", "fig01_front"))
    seconds = {"solve": 2.0, "fit": 1.0, "fig01_front": 0.5}
    assert "| fig01_front | `fit`, `solve` | 0.5 | 3.5 |" in build_map.table([row], seconds)
    with pytest.raises(KeyError, match="fit"):
        build_map.table([row], {"solve": 2.0, "fig01_front": 0.5})


def test_markers_must_stand_there_once():
    text = "a\n<!-- map -->\nold\n<!-- end map -->\nb"
    assert build_map.between("map", text) == "old"
    assert build_map.between("map", build_map.replaced("map", text, "new")) == "new"
    with pytest.raises(ValueError, match="map"):
        build_map.replaced("map", text + "<!-- map -->", "new")
