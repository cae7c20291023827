"""What docs/sweeps.md extrapolates, from measurements that are known."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from benchmarks import sweeps

MEASURED = {
    "machine": {"cpu": "a", "cores": 2, "python": "3", "system": "Linux", "load": 0.0},
    "chunks": [
        {"designs": n, "seconds": [0.01 + 1 / n] * 3, "memory_mb": 100.0} for n in sweeps.CHUNKS
    ],
    "combined": [
        {"designs": n, "seconds": 5e-5 * n, "memory_mb": 10.0, "bytes": 200 * n,
         "chunk_bytes": 75_000}
        for n in sweeps.COMBINED
    ],
    "sampled": [
        {"designs": n, "seconds": 1e-6 * n, "memory_mb": 5 + 1e-4 * n} for n in sweeps.SAMPLED
    ],
    "planned": [
        {"chunks": n, "seconds": 2 + 4e-3 * n, "memory_mb": 160 + 0.03 * n}
        for n in sweeps.PLANNED
    ],
    "job": {"seconds": 2.0, "files": 3, "bytes": 1000},
    "waves": {"chunk": 250_000, "seconds": 4e-5, "memory_mb": 300.0, "designs": 10**7,
              "draw_seconds": 9.0, "draw_mb": 700.0},
    "formulae": {"designs": 10**6, "seconds": 3.0, "memory_mb": 300.0},
    "whole": {"designs": 10**4, "chunk": 500, "seconds": 250.0, "wall": 130.0, "passed": True,
              "told": "one", "ended": {"solved": 10**4, "failed": 0}},
}  # fmt: skip


def test_costs_of_ten_million_designs_by_hand():
    cost = sweeps.extrapolated(MEASURED, 10_000_000, 2000)
    assert sweeps.extrapolated(MEASURED, 10_000_000, 20_000)["solve_hours"] == cost["solve_hours"]
    assert cost["jobs"] == 5000
    assert cost["solve_hours"] == pytest.approx(1e7 * (0.01 + 1 / 2000) / 3600)
    assert cost["job_hours"] == pytest.approx(1e4 / 3600)
    assert cost["one_job"] == pytest.approx(2000 * (0.01 + 1 / 2000) + 2)
    assert cost["combine_hours"] == pytest.approx(500 / 3600)
    assert cost["plan_seconds"] == pytest.approx(22, rel=1e-6)
    assert cost["plan_mb"] == pytest.approx(310, rel=1e-6)
    assert cost["draw_mb"] == pytest.approx(1005, rel=1e-6)
    assert cost["files"] == 15_000
    assert cost["bytes"] == pytest.approx(5000 * (600_000 + 1000) + 2e9)


def test_the_page_tells_them():
    page = sweeps.page(MEASURED)
    assert "| 10 000 000 | 20000 | 500 | 29 + 0.28 | 15 h | 8.8 min | 8.3 min | 1 500 | 5 |" in page
    assert "a million designs take 3.0 CPU s" in page
    assert "- 10 000 solved\n- 0 failed\n- one\n" in page
    assert "chunks of 500" in page
    assert "| 10 000 000 | 8 min | 4 min | 2.4 s |" in page
    assert "| 1 000 000 000 | 13 h | 6.7 h | 4 min |" in page
    assert "{{" not in page
