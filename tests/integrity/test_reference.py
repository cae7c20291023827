"""Which numbers are compared with the reference."""

import json

from gelpump.integrity import reference
from gelpump.integrity.build import Build


def test_statements_of_and_beyond_the_paper_are_compared(tmp_path, monkeypatch):
    """Those with numbers; one uncertainty may stand for several."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "results").mkdir()
    for name, said in {
        "manifest": {},
        "claims": [{"id": "a", "computed": 2.0, "uncertainty": 0.1}],
        "beyond": [
            {"id": "b", "computed": [1.0, 3.0], "uncertainty": 0.2},
            {"id": "c", "computed": True, "uncertainty": 0.0},
        ],
    }.items():
        (tmp_path / f"results/{name}.json").write_text(json.dumps(said))
    found = reference.of_figures(Build().figure_numbers())
    assert {name: each["value"] for name, each in found.items()} == {
        "statement: a": 2.0,
        "statement: b, 1 of 2": 1.0,
        "statement: b, 2 of 2": 3.0,
    }
    assert found["statement: b, 2 of 2"]["tolerance"] == 0.2 * reference.SAFETY
    rows, problems = reference.compared(found, {**found, "statement: a": {"value": 2.3}})
    assert len(rows) == 3
    assert [each.where for each in problems] == ["statement: a"]
