"""Snakemake's own report holds every figure and table, with a caption, a category and labels."""

import json
import re

import pytest

LOADED = re.compile(r"<(?:script|img|iframe)[^>]*\ssrc=[\"']http|<link[^>]*\shref=[\"']http")


@pytest.fixture(scope="module")
def report(built):
    result = built.snakemake("--report", "results/snakemake-report.html")
    assert result.returncode == 0, result.stdout + result.stderr
    path = built.path / "results/snakemake-report.html"
    text = path.read_text(encoding="utf-8")
    path.unlink()
    return text


def test_everything_shown_has_a_caption_and_labels(built, report):
    found = re.search(r"var results = (\{.*\});?\s*$", report, re.M)
    results, _ = json.JSONDecoder().raw_decode(found[1])
    shown = set(built.path.glob("results/figures/*.png")) | {
        built.path / f"results/tables/{name}.md"
        for name in (
            "claims",
            "ledger",
            "beyond",
            "figure_numbers",
            "cross_check",
            "verification",
            "table1_tube_parameters",
            "table2_gel_parameters",
        )
    }
    paths = {str(path.relative_to(built.path)) for path in shown}
    assert len(paths) == 30
    assert paths <= set(results)
    for path, result in results.items():
        assert len(result["caption"]) > 60, path
        assert "{{" not in result["caption"], path
        assert "system-message" not in result["caption"], path
        assert result["labels"]["shows"], path
        assert result["name"], path


def test_nothing_is_loaded_from_elsewhere(report):
    assert not LOADED.search(report)
