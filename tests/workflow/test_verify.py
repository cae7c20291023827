"""`snakemake verify` names everything that is wrong with a build, and fails.

Two runs go through Snakemake with all checks.  The others ask the function behind the rule, and
leave out the CF checker, which takes longer than all else, unless they are about it.
"""

import json
import re
import shutil
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import netCDF4
import pytest

from gelpump.integrity import conventions
from gelpump.integrity.examination import examine
from gelpump.provenance import file_digest

REFERENCE = "workflow/reference/values.json"
DATASET = "results/data/materials_ANB.nc"
HERE = SimpleNamespace(path=Path())  # the working directory


def verify(clone, config="config/quick.yaml"):
    result = clone.snakemake("verify", config=config)
    return result.returncode, result.stdout + result.stderr


@pytest.fixture
def examined(renewed, monkeypatch):
    """Examines the build as its configuration was; problems as text, and the examination."""
    monkeypatch.chdir(renewed.path)
    monkeypatch.setattr(conventions, "problems", lambda files: [])

    def run():
        jobs = json.loads(Path("results/manifest.json").read_text())["jobs"]
        blocks = {name: job["config_digest"] for name, job in jobs.items()}
        found = examine(blocks, Path("workflow/reference/quantities.yaml"), Path(REFERENCE))
        return [str(each) for check in found.checks.values() for each in check], found

    return run


@contextmanager
def kept(clone, *files):
    """Put the files back as they were, with their times, whatever was done to them."""
    aside = clone.path / ".aside"
    aside.mkdir(exist_ok=True)
    copies = {path: aside / path.replace("/", "_") for path in files}
    for path, copy in copies.items():
        shutil.copy2(clone.path / path, copy)
    try:
        yield
    finally:
        for path, copy in copies.items():
            shutil.copy2(copy, clone.path / path)


@pytest.fixture(scope="module")
def renewed(built):
    """The build, with a reference for its quick configuration."""
    result = built.snakemake("renew_reference")
    assert result.returncode == 0, result.stdout + result.stderr
    return built


def test_the_manifest_lists_every_output_of_the_build(built):
    manifest = json.loads((built.path / "results/manifest.json").read_text())
    result = built.snakemake("--dry-run", "--forceall")
    made = set()
    for line in (result.stdout + result.stderr).splitlines():
        if line.startswith("    output: "):
            # "(update)": a failed job gives back what was there before it
            made |= {
                path.removesuffix(" (update)")
                for path in line.removeprefix("    output: ").split(", ")
            }
    assert set(manifest["outputs"]) == made - {
        "results/manifest.json",
        "results/ro-crate-metadata.json",
    }
    for path, output in manifest["outputs"].items():
        job = manifest["jobs"][output["job"]]
        assert job["rule"] == output["rule"]
        assert f"workflow/scripts/{job['rule']}.py" in job["code"], path
        assert output["size"] == (built.path / path).stat().st_size


def test_every_dataset_and_figure_says_what_it_was_made_from(built):
    manifest = json.loads((built.path / "results/manifest.json").read_text())
    for path, output in manifest["outputs"].items():
        job = manifest["jobs"][output["job"]]
        if path.endswith(".nc"):
            with netCDF4.Dataset(built.path / path) as dataset:
                assert dataset.code_version.endswith(job["code_digest"])
                assert dataset.config_digest.endswith(job["config_digest"])
                assert json.loads(dataset.input_digests) == job["inputs"]
                assert "numpy" in dataset.package_versions
        elif "/figures/" in path:
            content = (built.path / path).read_bytes()
            assert job["code_digest"].encode() in content, path
            for sha256 in job["inputs"].values():
                assert sha256.encode() in content, path
    assert str(built.path) not in (built.path / "results/manifest.json").read_text()


def test_manifest_and_crate_are_the_same_bytes_again(built):
    files = [built.path / f"results/{n}.json" for n in ("manifest", "ro-crate-metadata")]
    before = [file.read_bytes() for file in files]
    for file in files:
        file.unlink()
    result = built.snakemake()
    assert result.returncode == 0, result.stdout + result.stderr
    assert [file.read_bytes() for file in files] == before


def test_a_build_of_another_configuration_is_not_compared_with_the_reference(examined):
    with kept(HERE, REFERENCE):
        known = json.loads(Path(REFERENCE).read_text())
        Path(REFERENCE).write_text(json.dumps(known | {"shown_digest": "of another"}))
        _, found = examined()
        assert found.passed
        assert found.notes == [
            "the figures' key numbers were NOT compared: this build shows other ones."
        ]
        Path(REFERENCE).write_text(json.dumps(known | {"numbers_digest": "of another"}))
        _, found = examined()
    assert found.passed
    assert found.rows == []
    assert "NOT compared: the reference is for the paper's configuration" in found.notes[0]


def test_an_untouched_build_passes(renewed):
    code, said = verify(renewed)
    assert code == 0, said
    assert "Everything agrees." in said
    assert "| numbers agree with the reference | passed |" in said
    assert "| figures' key numbers agree with the reference | passed |" in said
    again = renewed.snakemake()
    assert "Nothing to be done" in again.stdout + again.stderr


def test_all_that_is_wrong_is_named_at_once(renewed):
    figure, table = "results/figures/fig13_osmotic.pdf", "results/tables/ledger.md"
    stray, changed = renewed.path / "results/data/tube_of_last_year.nc", renewed.path / "new.yaml"
    told_to_people = ("results/report.html", "results/replication.pdf")
    with kept(renewed, figure, table, DATASET, *told_to_people):
        for path in (figure, *told_to_people):
            with (renewed.path / path).open("ab") as stream:
                stream.write(b" ")
        altered = (renewed.path / figure).read_bytes()
        (renewed.path / table).unlink()
        stray.write_bytes(b"old")
        with netCDF4.Dataset(renewed.path / DATASET, "a") as dataset:
            dataset["osmotic_pressure"].delncattr("units")
            dataset.delncattr("Conventions")
            dataset["spinodal_tip_temperature"][...] += 0.01
        quick = (renewed.path / "config/quick.yaml").read_text()
        changed.write_text(quick + "\nscales:\n  permeability: 2.0e-15\n")
        try:
            code, said = verify(renewed, config="new.yaml")
        finally:
            stray.unlink()
            changed.unlink()
        assert (renewed.path / figure).read_bytes() == altered, "made again before it was seen"
        assert not (renewed.path / table).exists()
    assert code != 0
    for told in (
        f"altered: {figure}: ",
        *(f"altered: {path}: " for path in told_to_people),
        f"altered: {DATASET}: ",
        f"missing: {table}: ",
        "leftover: results/data/tube_of_last_year.nc: ",
        f"cf:1.11: {DATASET}: osmotic_pressure has no units",
        f"cf:1.11: {DATASET}: §2.6.1 Conventions field is not present",
        "differs: materials_ANB: spinodal_tip_temperature: ",
        "stale: results/figures/fig13_osmotic.pdf: input results/data/materials_ANB.nc has changed",
    ):
        assert told in said, told
    claims = re.search(r"stale: results/claims.json: .*", said)[0]
    assert "input results/data/materials_ANB.nc has changed" in claims
    assert "its part of the configuration has changed" in claims
    assert "stale: results/data" not in said
    total = re.search(r"(\d+) problems", said)[0]
    assert total in (renewed.path / "results/tables/verify.md").read_text()


def test_an_altered_number_fails_even_if_its_digest_is_forged(examined):
    with kept(HERE, DATASET, "results/manifest.json"):
        before = json.loads(Path("results/manifest.json").read_text())
        with netCDF4.Dataset(DATASET, "a") as dataset:
            dataset["spinodal_tip_temperature"][...] += 0.01
        before["outputs"][DATASET]["sha256"] = file_digest(DATASET)
        Path("results/manifest.json").write_text(json.dumps(before))
        problems, _ = examined()
    said = "\n".join(problems)
    assert "differs: materials_ANB: spinodal_tip_temperature: " in said
    assert "altered: results/ro-crate-metadata.json: " in said
    assert "materials_HHT: spinodal_tip_temperature: " not in said


def test_an_altered_key_number_fails_even_if_its_digest_is_forged(examined):
    file = "results/tables/figure_numbers.json"
    with kept(HERE, file, "results/manifest.json"):
        numbers = json.loads(Path(file).read_text())
        altered = next(row for row in numbers if row["figure"] == "fig14_equilibrium")
        altered["value"][0] += 0.01
        Path(file).write_text(json.dumps(numbers))
        before = json.loads(Path("results/manifest.json").read_text())
        before["outputs"][file]["sha256"] = file_digest(file)
        Path("results/manifest.json").write_text(json.dumps(before))
        problems, _ = examined()
    assert f"differs: fig14_equilibrium: {altered['quantity']}, 1 of 2: " in "\n".join(problems)


def test_a_truncated_dataset_does_not_hide_the_other_checks(examined):
    with kept(HERE, DATASET):
        content = Path(DATASET).read_bytes()
        Path(DATASET).write_bytes(content[:3000])
        problems, found = examined()
    said = "\n".join(problems)
    assert f"unreadable: {DATASET}: " in said
    assert "not there: materials_ANB: spinodal_tip_temperature: " in said
    assert any(row.quantity == "front_fit: exponent" and row.agrees for row in found.rows)


@pytest.mark.parametrize(
    ("edited", "named", "spared"),
    [
        ("src/gelpump/bead/lens.py", "results/data/bead_drying_lens.nc", "bead_drying_nonlinear"),
        ("workflow/scripts/fig13_osmotic.py", "results/figures/fig13_osmotic.png", "fig14"),
    ],
)
def test_edited_code_makes_outputs_stale(examined, edited, named, spared):
    with kept(HERE, edited):
        with Path(edited).open("a") as stream:
            stream.write("# edited\n")
        problems, found = examined()
    said = "\n".join(problems)
    assert not found.passed
    assert f"stale: {named}: module {edited} has changed" in said
    assert f"stale: results/data/{spared}" not in said
    assert f"stale: results/figures/{spared}" not in said


def test_a_rule_that_is_gone_makes_its_outputs_stale(renewed):
    rules = "workflow/rules/bead.smk"
    with kept(renewed, rules):
        text = (renewed.path / rules).read_text()
        assert "rule bead_sensitivity:" in text
        (renewed.path / rules).write_text(text.replace("rule bead_sensitivity:", "rule another:"))
        result = renewed.snakemake("renew_reference")  # which checks files, and no conventions
    said = result.stdout + result.stderr
    assert result.returncode != 0
    dataset = "results/data/sensitivity_drying.nc"
    assert f"stale: {dataset}: rule bead_sensitivity does not make it any more" in said
    assert "is not defined in this workflow" not in said


def test_a_tampered_file_does_not_enter_a_new_manifest(renewed):
    table = "results/tables/table2_gel_parameters.csv"
    made_again = ("report.html", "provenance/report_page.json", "replication.pdf",
                  "provenance/article.json", "manifest.json", "ro-crate-metadata.json")  # fmt: skip
    with kept(renewed, table, *(f"results/{name}" for name in made_again)):
        with (renewed.path / table).open("a") as stream:
            stream.write("forged\n")
        result = renewed.snakemake()
        said = result.stdout + result.stderr
    assert result.returncode != 0
    assert f"{table}: altered since its job made it" in said


def test_without_a_build_it_says_so(clone):
    code, said = verify(clone)
    assert code != 0
    assert "there is no build here" in said
    assert "Traceback" not in said


def test_renewing_shows_what_changes(renewed, examined):
    with kept(renewed, REFERENCE):
        reference = json.loads((renewed.path / REFERENCE).read_text())
        entry = reference["values"]["front_fit: exponent"]
        entry["value"] -= 4 * entry["tolerance"]
        (renewed.path / REFERENCE).write_text(json.dumps(reference))
        problems, _ = examined()
        assert len(problems) == 1
        assert problems[0].startswith("differs: front_fit: exponent: ")
        result = renewed.snakemake("renew_reference")
        said = result.stdout + result.stderr
        assert result.returncode == 0, said
        assert re.search(r"front_fit: exponent: \S+ -> \S+ \(\+4 tolerances\)", said), said
        assert "1 of them changed" in said
        assert examined()[1].passed


def test_an_altered_build_is_no_reference(renewed):
    figure = "results/figures/fig13_osmotic.pdf"
    with kept(renewed, figure):
        before = (renewed.path / REFERENCE).read_bytes()
        with (renewed.path / figure).open("ab") as stream:
            stream.write(b" ")
        result = renewed.snakemake("renew_reference")
    assert result.returncode != 0
    assert "the reference is kept" in result.stdout + result.stderr
    assert (renewed.path / REFERENCE).read_bytes() == before
