"""`snakemake verify` names everything that is wrong with a build, and fails."""

import json
import re
import shutil
from contextlib import contextmanager

import netCDF4
import pytest

from gelpump.provenance import file_digest

pytestmark = pytest.mark.xdist_group("workflow")

REFERENCE = "workflow/reference/values.json"
DATASET = "results/data/materials_ANB.nc"


def verify(clone, config="config/quick.yaml"):
    result = clone.snakemake("verify", config=config)
    return result.returncode, result.stdout + result.stderr


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
            made |= set(line.removeprefix("    output: ").split(", "))
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


def test_a_build_of_another_configuration_is_not_compared_with_the_reference(built):
    code, said = verify(built)
    assert code == 0, said
    assert "NOT compared: the reference is for the paper's configuration" in said


def test_an_untouched_build_passes_again_and_again(renewed):
    for _ in range(2):
        code, said = verify(renewed)
        assert code == 0, said
        assert "Everything agrees." in said
        assert "| numbers agree with the reference | passed |" in said
    again = renewed.snakemake()
    assert "Nothing to be done" in again.stdout + again.stderr


def test_all_that_is_wrong_is_named_at_once(renewed):
    figure, table = "results/figures/fig13_osmotic.pdf", "results/tables/ledger.md"
    stray = renewed.path / "results/data/tube_of_last_year.nc"
    with kept(renewed, figure, table):
        with (renewed.path / figure).open("ab") as stream:
            stream.write(b" ")
        altered = (renewed.path / figure).read_bytes()
        (renewed.path / table).unlink()
        stray.write_bytes(b"old")
        try:
            code, said = verify(renewed)
        finally:
            stray.unlink()
        assert (renewed.path / figure).read_bytes() == altered, "made again before it was seen"
        assert not (renewed.path / table).exists()
    assert code != 0
    assert f"altered: {figure}: " in said
    assert f"missing: {table}: " in said
    assert "leftover: results/data/tube_of_last_year.nc: " in said
    assert "3 problems" in said
    assert "3 problems" in (renewed.path / "results/tables/verify.md").read_text()


def test_an_altered_number_fails_even_if_its_digest_is_forged(renewed):
    with kept(renewed, DATASET, "results/manifest.json"):
        before = json.loads((renewed.path / "results/manifest.json").read_text())
        with netCDF4.Dataset(renewed.path / DATASET, "a") as dataset:
            dataset["fold_temperature"][0] += 0.01
        before["outputs"][DATASET]["sha256"] = file_digest(renewed.path / DATASET)
        (renewed.path / "results/manifest.json").write_text(json.dumps(before))
        code, said = verify(renewed)
    assert code != 0
    assert "differs: materials_ANB: fold_temperature(fold=0): " in said
    assert "altered: results/ro-crate-metadata.json: " in said
    assert "fold_temperature(fold=1): 30" not in said


def test_a_removed_attribute_breaks_the_conventions(renewed):
    with kept(renewed, DATASET):
        with netCDF4.Dataset(renewed.path / DATASET, "a") as dataset:
            dataset["osmotic_pressure"].delncattr("units")
            dataset.delncattr("Conventions")
        code, said = verify(renewed)
    assert code != 0
    assert f"cf:1.11: {DATASET}: osmotic_pressure has no units" in said
    assert f"cf:1.11: {DATASET}: §2.6.1 Conventions field is not present" in said


def test_a_truncated_dataset_does_not_hide_the_other_checks(renewed):
    with kept(renewed, DATASET):
        content = (renewed.path / DATASET).read_bytes()
        (renewed.path / DATASET).write_bytes(content[:3000])
        code, said = verify(renewed)
    assert code != 0
    assert f"unreadable: {DATASET}: " in said
    assert "not there: materials_ANB: fold_temperature(fold=0): " in said
    assert "front_fit: exponent" in said


@pytest.mark.parametrize(
    ("edited", "named", "spared"),
    [
        ("src/gelpump/bead/lens.py", "results/data/bead_drying_lens.nc", "bead_drying_nonlinear"),
        ("workflow/scripts/fig13_osmotic.py", "results/figures/fig13_osmotic.png", "fig14"),
    ],
)
def test_edited_code_makes_outputs_stale(renewed, edited, named, spared):
    with kept(renewed, edited):
        with (renewed.path / edited).open("a") as stream:
            stream.write("# edited\n")
        code, said = verify(renewed)
    assert code != 0
    assert f"stale: {named}: module {edited} has changed" in said
    assert f"stale: results/data/{spared}" not in said
    assert f"stale: results/figures/{spared}" not in said


def test_an_edited_configuration_makes_outputs_stale(renewed):
    changed = renewed.path / "changed.yaml"
    changed.write_text(
        (renewed.path / "config/quick.yaml").read_text() + "\nscales:\n  permeability: 2.0e-15\n"
    )
    code, said = verify(renewed, config="changed.yaml")
    changed.unlink()
    assert code != 0
    assert "stale: results/claims.json: its part of the configuration has changed" in said
    assert "stale: results/data" not in said


def test_a_tampered_file_does_not_enter_a_new_manifest(renewed):
    table = "results/tables/table2_gel_parameters.csv"
    with kept(renewed, table, "results/manifest.json", "results/ro-crate-metadata.json"):
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


def test_renewing_shows_what_changes(renewed):
    with kept(renewed, REFERENCE):
        reference = json.loads((renewed.path / REFERENCE).read_text())
        entry = reference["values"]["front_fit: exponent"]
        entry["value"] -= 4 * entry["tolerance"]
        (renewed.path / REFERENCE).write_text(json.dumps(reference))
        code, said = verify(renewed)
        assert code != 0
        assert "differs: front_fit: exponent: " in said
        result = renewed.snakemake("renew_reference")
        said = result.stdout + result.stderr
        assert result.returncode == 0, said
        assert re.search(r"front_fit: exponent: \S+ -> \S+ \(\+4 tolerances\)", said), said
        assert "1 of them changed" in said
        assert verify(renewed)[0] == 0


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
