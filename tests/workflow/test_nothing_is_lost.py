"""A job that fails leaves what an earlier build had made, and the next build makes it anew."""

DATA = "results/data/materials_HHT.nc"
TABLE = "results/tables/table2_gel_parameters.md"


def test_a_failed_job_gives_back_what_was_there(clone):
    assert clone.snakemake(DATA, TABLE).returncode == 0
    before = {name: (clone.path / name).read_bytes() for name in (DATA, TABLE)}
    script = clone.path / "workflow/scripts/materials.py"
    text = script.read_text("utf-8")
    begin = "with job(snakemake) as provenance:\n"
    assert begin in text
    script.write_text(text.replace(begin, f"{begin}    raise RuntimeError('broken on purpose')\n"))
    failed = clone.snakemake(DATA, "--forcerun", "materials")
    assert failed.returncode != 0
    assert "broken on purpose" in failed.stdout + failed.stderr
    for name, bytes_ in before.items():
        assert (clone.path / name).read_bytes() == bytes_, name
    # what was restored is not taken for what was asked for
    assert "materials" in clone.rules(DATA)
    script.write_text(text, "utf-8")
    assert clone.snakemake(DATA).returncode == 0
    assert (clone.path / DATA).read_bytes() == before[DATA]
