"""The maps, the verdict and the seconds are those of the workflow."""

import json
import re
from pathlib import Path

import pytest
import yaml

from gelpump import build_map, imports
from gelpump.build_map import Job
from gelpump.statements import paper

PROJECT = Path(__file__).resolve().parents[2]
README = (PROJECT / "README.md").read_text(encoding="utf-8")
MODELS = (PROJECT / "docs/map.md").read_text(encoding="utf-8")
SECONDS = json.loads((PROJECT / "workflow/reference/seconds.json").read_text(encoding="utf-8"))


def jobs_of_dry_run(said: str) -> dict[str, Job]:
    """Jobs by the name of their benchmark, as a dry run of everything tells them."""
    jobs = {}
    for block in re.split(r"\n(?=(?:local)?rule )", said):
        rule = re.match(r"(?:local)?rule (\w+):", block)
        told = dict(re.findall(r"^    (input|output|benchmark): (.*)$", block, re.M))
        if rule and "benchmark" in told:
            files = [
                told.get(key, "").replace(" (update)", "").split(", ")
                for key in ("input", "output")
            ]
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


@pytest.fixture(scope="module")
def values():
    text = (PROJECT / "config/config.yaml").read_text(encoding="utf-8")
    return yaml.safe_load(text)["published"]


def test_the_maps_are_those_of_the_workflow(workflow_jobs, values):
    rows = build_map.rows(workflow_jobs)
    scripts = {path.stem for path in (PROJECT / "workflow/scripts").glob("*.py")}
    shown = {name for name in scripts if name.startswith(build_map.SHOWN)}
    rules = "".join(
        (PROJECT / f"workflow/rules/{each}.smk").read_text(encoding="utf-8")
        for each in ("truth", "separation")
    )
    apart = {name for name in shown if f"rule {name}:" in rules}  # no part of a rebuild
    assert {row.rule for row in rows} == shown - apart
    assert all(f"`{name}`" in MODELS for name in apart)
    table, models = (
        build_map.table(rows, SECONDS),
        build_map.model_table(rows, workflow_jobs, paper.statements, values),
    )
    for found, page in ((table, README), (models, MODELS)):
        assert found == build_map.between("map", page), (
            "a map is not that of the workflow: build, then `snakemake --cores 1 renew_map`"
        )


def test_every_figure_leads_to_its_module_its_test_and_its_dataset(workflow_jobs):
    derived = (PROJECT / "docs/model.md").read_text(encoding="utf-8")
    made_by = {path: job for job in workflow_jobs.values() for path in job.outputs}
    for row in build_map.rows(workflow_jobs):
        job = workflow_jobs[row.jobs[-1]]
        drawn = imports.modules(PROJECT / f"workflow/scripts/{row.rule}.py")
        if not row.rule.startswith("table"):
            assert f"src/gelpump/figures/{row.rule}.py" in drawn
            assert row.datasets, row.rule
        imported = set()
        for path in job.inputs:
            maker = made_by[path].rule
            code = set(imports.modules(PROJECT / f"workflow/scripts/{maker}.py"))
            own = {f"src/gelpump/{name.replace('.', '/')}.py" for name in build_map.MODELS[maker]}
            assert own
            assert own <= code, f"{maker} does not import what the map says that it solves"
            imported |= code
        for module in build_map.models(row, workflow_jobs):
            test = (PROJECT / build_map.test_of(module)).read_text(encoding="utf-8")
            package = module.rpartition(".")[0]
            known = rf"^from gelpump(\.{package}\b| import .*\b{package}\b)"
            assert re.search(known, test, re.M), f"{build_map.test_of(module)} is not of {package}"
            assert re.search(r"^ *def test_", test, re.M)
            assert re.search(rf"^\[gelpump\.{module}\]\(", derived, re.M), module


def test_what_the_paper_shows_of_a_figure(values):
    found = build_map.published("fig09_relax", paper.statements, values)
    assert found["front-phi"] == [1.439, 1.458]
    assert "front-fig8" not in found
    assert "figure-10-ell" not in build_map.published("fig01_lens", paper.statements, values)
    told = {name for name in values if name in {each.id for each in paper.statements}}
    assert len(told) == len(values), "a published value that no statement is compared with"


def test_labels_stand_in_the_docstring_of_their_module():
    assert build_map.labels("tube.heat") == ["eqn:temp_field", "eqn:temp_field_sol"]
    assert "eqn:app:helmholtz_free_energy" in build_map.labels("bead.nonlinear")
    assert build_map.labels("separation.sharp") == []


def test_the_seconds_are_of_jobs_that_there_are(workflow_jobs):
    # jobs that are newer than the last measured build have none yet, and the map a dash
    assert set(SECONDS) <= set(workflow_jobs), "build, then `snakemake --cores 1 renew_map`"
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
    del seconds["fit"]
    assert "| fig01_front | `fit`, `solve` | 0.5 | – |" in build_map.table([row], seconds)
    assert "| – | – |" in build_map.table([row], {})
    with pytest.raises(KeyError, match="solve"):
        build_map.models(row, jobs)


def test_markers_must_stand_there_once():
    text = "a\n<!-- map -->\nold\n<!-- end map -->\nb"
    assert build_map.between("map", text) == "old"
    assert build_map.between("map", build_map.replaced("map", text, "new")) == "new"
    with pytest.raises(ValueError, match="map"):
        build_map.replaced("map", text + "<!-- map -->", "new")
