"""Builds: what is made, what is made again, and what is left when something goes wrong."""

import hashlib
import json
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from conventions import require_cf


def digests(folder: Path, *patterns: str) -> dict[str, str]:
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for pattern in patterns
        for path in sorted(folder.rglob(pattern))
    }


def said(result) -> str:
    return result.stdout + result.stderr


def test_everything_is_built_once(built):
    assert "Nothing to be done" in said(built.snakemake())
    claims = json.loads((built.path / "results/claims.json").read_text())
    assert len({claim["id"] for claim in claims}) == len(claims) > 20
    for log in (built.path / "results/logs").iterdir():
        assert "Traceback" not in log.read_text(), log


def test_every_figure_has_key_numbers_with_their_uncertainty(built):
    numbers = json.loads((built.path / "results/tables/figure_numbers.json").read_text())
    figures = {file.stem for file in (built.path / "results/figures").glob("fig[0-9]*.png")}
    assert {row["figure"] for row in numbers} == figures
    assert len(figures) == 14
    for row in numbers:
        value, uncertainty = np.atleast_1d(row["value"]), np.atleast_1d(row["uncertainty"])
        assert value.shape == uncertainty.shape
        assert (uncertainty > 0).all(), row
        if "distance" not in row["quantity"]:  # which the quick paper's meshes cannot tell from 0
            assert (uncertainty < 0.1 * np.abs(value)).all(), row
        file = row["evidence"].partition(":")[0]
        assert "{" in file or (built.path / "results" / file).exists()


def test_a_rebuild_gives_the_same_bytes(built):
    results = built.path / "results"
    patterns = ("*.nc", "*.png", "*.pdf", "*.svg", "*.csv")
    before = digests(results, *patterns)
    again = [
        "results/data/materials_ANB.nc",
        "results/data/bead_separating_lens.nc",
        "results/data/bead_swelling_nonlinear.nc",
        "results/data/refinement/bead_separating_lens.nc",
        *(
            f"results/figures/{figure}.{suffix}"
            for figure in ("fig01_lens_schematic", "fig03_swell_bead", "fig13_osmotic")
            for suffix in ("pdf", "png", "svg", "csv")
        ),
    ]
    for file in again:
        (built.path / file).unlink()
    result = built.snakemake(*again)
    assert result.returncode == 0, said(result)
    assert digests(results, *patterns) == before
    assert len(before) > 30


def test_datasets_follow_the_cf_conventions(built):
    files = sorted((built.path / "results/data").rglob("*.nc"))
    require_cf(files)


def test_one_figure_needs_nothing_else(clone):
    assert clone.rules("fig05_spinodal") == {"materials", "bead_lens", "fig05_spinodal"}
    assert clone.rules("fig14_equilibrium") == {"materials", "fig14_equilibrium"}
    assert clone.rules("table2_gel_parameters") == {"table2_gel_parameters"}


def append_comment(path: Path) -> None:
    path.write_text(path.read_text() + "\n# edited\n")


@pytest.mark.parametrize(
    ("edited", "rerun", "kept"),
    [
        ("figures/style.py", {"fig03_swell_bead"}, {"materials", "bead_lens", "statements"}),
        ("figures/fig13_osmotic.py", {"fig13_osmotic"}, {"fig14_equilibrium", "materials"}),
        (
            "bead/lens.py",
            {"bead_lens", "fig03_swell_bead", "statements"},
            {"bead_nonlinear", "materials", "fig14_equilibrium"},
        ),
        (
            "bead/nonlinear.py",
            {"bead_nonlinear", "fig03_swell_bead"},
            {"bead_lens", "fig05_spinodal", "materials"},
        ),
        ("statements/beads.py", {"statements"}, {"bead_lens", "fig03_swell_bead"}),
    ],
)
def test_an_edit_reruns_what_depends_on_it(built, edited, rerun, kept):
    source = built.path / "src/gelpump" / edited
    original, stamp = source.read_text(), source.stat().st_mtime_ns
    try:
        append_comment(source)
        rules = built.rules()
    finally:
        source.write_text(original)
        os.utime(source, ns=(stamp, stamp))
    assert rerun <= rules
    assert not kept & rules
    assert built.rules() == set()


def test_a_changed_number_reruns_the_rules_that_take_it(built, tmp_path):
    config = (built.path / "config/quick.yaml").read_text()
    changed = tmp_path / "changed.yaml"
    changed.write_text(
        config + "\nbeads:\n  swelling:\n    end: 0.9\n    published_times: []\n"
        "    profile_times: [0.1]\n"
    )
    result = built.snakemake("--dry-run", "--quiet", "rules", config=str(changed))
    assert result.returncode == 0, said(result)
    detailed = said(built.snakemake("--dry-run", config=str(changed)))
    assert "bead_swelling_lens.nc" in detailed
    assert "output: results/data/bead_drying_lens.nc" not in detailed
    assert "output: results/data/materials_HHT.nc" not in detailed


def test_a_killed_build_leaves_nothing_that_looks_whole(built, clone):
    target = "results/data/bead_drying_lens.nc"
    process = subprocess.Popen(
        clone.command(target),
        cwd=clone.path,
        env=clone.environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    log = clone.path / "results/logs/bead_drying_lens.log"
    deadline = time.monotonic() + 60
    while not log.exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    assert log.exists()
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    assert not (clone.path / target).exists()
    unlock = clone.snakemake("--unlock")
    assert unlock.returncode == 0, said(unlock)
    again = clone.snakemake(target)
    assert again.returncode == 0, said(again)
    assert (clone.path / target).read_bytes() == (built.path / target).read_bytes()


def test_a_failed_job_tells_why_and_gives_back_the_figure(built, tmp_path):
    broken = built.path / "results/data/materials_ANB.nc"
    kept = tmp_path / "materials_ANB.nc"
    shutil.copy2(broken, kept)
    figure = built.path / "results/figures/fig14_equilibrium.png"
    drawn = figure.read_bytes()
    try:
        broken.write_bytes(kept.read_bytes()[:2000])
        result = built.snakemake("fig14_equilibrium", "--force")
        assert result.returncode != 0
        assert figure.read_bytes() == drawn
        assert "Traceback" in (built.path / "results/logs/fig14_equilibrium.log").read_text()
    finally:
        shutil.copy2(kept, broken)
    result = built.snakemake("fig14_equilibrium")
    assert result.returncode == 0, said(result)
    assert figure.read_bytes() == drawn


def test_snakemake_lint_is_content(clone):
    result = clone.snakemake("--lint")
    assert result.returncode == 0, said(result)
    assert "Congratulations" in said(result)


def test_a_refusal_comes_before_any_job(clone):
    bad = clone.path / "bad.yaml"
    bad.write_text("beads: {drying: {gel: HTT}}\n")
    result = clone.snakemake(config="bad.yaml")
    assert result.returncode != 0
    assert "beads.drying.gel = 'HTT': must be one of" in said(result)
    assert "['ANB', 'HHT']" in said(result)
    assert not (clone.path / "results").exists()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("tube: {Le: 5.0}\ntube: {Le: 6.0}\n", "tube (line 2): given twice"),
        ("__use_yte__: true\ntube: {Le: 5.0}\n", "templates (__use_yte__) can run code"),
        ("tube: &a {Le: 5.0}\n1: *a\n", "the key '1' is not a string"),
    ],
)
def test_what_snakemakes_loader_lets_pass_is_refused(clone, text, told):
    (clone.path / "bad.yaml").write_text(text)
    result = clone.snakemake("--dry-run", config="bad.yaml")
    assert result.returncode != 0
    assert told in said(result)


def test_a_python_object_in_a_config_is_not_made(clone):
    (clone.path / "bad.yaml").write_text("tube: !!python/object/apply:os.system ['touch ran']\n")
    result = clone.snakemake("--dry-run", config="bad.yaml")
    assert result.returncode != 0
    assert not (clone.path / "ran").exists()


def test_code_in_a_template_is_not_run(clone):
    code = "__import__('pathlib').Path('ran').touch()"
    (clone.path / "bad.yaml").write_text(f"__use_yte__: true\ntube: ?{code}\n")
    result = clone.snakemake("--dry-run", config="bad.yaml")
    assert result.returncode == 1
    assert "templates (__use_yte__) can run code and are not allowed" in said(result)
    assert "Traceback" not in said(result)
    assert not (clone.path / "ran").exists()
    clone.snakemake("--dry-run", "--workflow-profile", "none", config="bad.yaml")
    assert (clone.path / "ran").exists(), "Snakemake has changed: is the default profile needed?"


def test_the_default_profile_is_loaded(clone):
    result = clone.snakemake("--dry-run", "fig14_equilibrium")
    assert "Using workflow specific profile profiles/default" in said(result)


def test_another_gel_needs_only_a_config_block(clone):
    (clone.path / "mine.yaml").write_text(
        "gels:\n"
        "  mine: {model: energy-based, A0: -12.947, A1: 17.92, B0: 0.04496, B1: -0.0569,\n"
        "         Omega: 150.0, temperature_range: [290.0, 320.0]}\n"
        "figures:\n"
        "  fig14_equilibrium: {gels: [ANB, mine]}\n"
    )
    result = clone.snakemake("fig14_equilibrium", config="mine.yaml")
    assert result.returncode == 0, said(result)
    assert (clone.path / "results/data/materials_mine.nc").exists()


def test_a_finite_uncertainty_stands_beside_every_computed_number(built):
    for claim in json.loads((built.path / "results/claims.json").read_text()):
        if isinstance(claim["computed"], bool) or claim["computed"] is None:
            continue
        assert claim["uncertainty"] is not None, claim["id"]
        assert np.all(np.asarray(claim["uncertainty"]) > 0), claim["id"]
