"""A design as a user builds it: with a gel of their own, or refused before any job."""

import csv

import pytest
import yaml
from clone import PROJECT

TUBE = yaml.safe_load((PROJECT / "config/designs/millitube.yaml").read_text())
MINE = TUBE | {"gel": "synthetic", "critical_temperature": "303 K"}


def build(clone, design, *arguments):
    folder = clone.path / "bench"
    folder.mkdir(exist_ok=True)
    (folder / "my-tube.yaml").write_text(yaml.safe_dump(design))
    quick = yaml.safe_load((clone.path / "config/quick.yaml").read_text())
    gels = {"synthetic": {"model": "measured", "points": "config/gels/synthetic.csv"}}
    (folder / "gel.yaml").write_text(yaml.safe_dump(quick | {"gels": gels}))
    return clone.snakemake(
        "design_my-tube", "--config", "design=bench/my-tube.yaml", *arguments,
        config="bench/gel.yaml",
    )  # fmt: skip


def test_a_design_with_a_measured_gel_carries_its_errors(clone):
    run = build(clone, MINE)
    assert run.returncode == 0, run.stdout + run.stderr
    made = clone.path / "results/designs"
    assert {file.name for file in made.iterdir()} == {
        f"my-tube.{suffix}" for suffix in ("nc", "csv", "html", "pdf")
    }
    with open(made / "my-tube.csv", encoding="utf-8") as stream:
        rows = {row["key"]: row for row in csv.DictReader(stream)}
    response = rows["response_time"]
    assert 0 < float(response["gel error"]) < 0.2 * float(response["value"])
    assert rows["travel_time"]["gel error"] == ""
    assert "gel ± " in (made / "my-tube.html").read_text(encoding="utf-8")
    assert (made / "my-tube.pdf").read_bytes().count(b"/Type /Page\n") <= 1
    again = build(clone, MINE, "--dry-run")
    assert "Nothing to be done" in again.stdout + again.stderr


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"a_1": "1 s"}, "a_1 = '1 s': is in s; must be a quantity in m or the like"),
        ({"a_0": "2 mm"}, "a_0 = '2 mm': must be less than a_1 = '1 mm'"),
    ],
)
def test_a_refused_design_starts_no_job(clone, change, told):
    run = build(clone, MINE | change)
    assert run.returncode != 0
    assert told in run.stdout + run.stderr
    assert not (clone.path / "results/designs").exists()
