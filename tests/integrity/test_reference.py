"""The comparison with the reference: values, tolerances, absences, and what a renewal says."""

import json

import numpy as np
import pytest
import xarray as xr

from gelpump.integrity import reference
from gelpump.integrity.build import Build

t = np.array([0.0, 1.0, 2.0, 4.0])
DATA = {
    "bead": xr.Dataset(
        {
            "radius": ("t", 2.0 * t + 1.0),
            "phi": (("t", "cell"), np.outer(t, [1.0, 3.0])),
            "T_fold": ("fold", [304.0, 306.0]),
        },
        {"t": t},
    ),
    "refinement/bead": xr.Dataset(
        {
            "radius": (("level", "t"), np.outer([1.0, 2.0], 2.0 * t + 1.0)),
            "radius_uncertainty": ("t", [0.1, 0.3, 0.2, 0.9]),
        },
        {"t": t},
    ),
}


def evaluated(**entry):
    whole = {"datasets": ["bead"], "variables": ["radius"], "uncertainty": 1e-3} | entry
    return reference.evaluated([whole], DATA)


@pytest.mark.parametrize(
    ("entry", "label", "value", "tolerance"),
    [
        ({}, "bead: radius", 4.5, 2.5 * 4.5e-3),
        ({"at": {"t": [1.0]}}, "bead: radius(t=1)", 3.0, 2.5 * 3e-3),
        ({"at": {"t": [3.0]}}, "bead: radius(t=3)", 7.0, 2.5 * 7e-3),
        ({"variables": ["phi"], "at": {"t": [2.0]}}, "bead: phi(t=2)", 4.0, 2.5 * 4e-3),
        ({"variables": ["T_fold"], "at": {"fold": [1]}}, "bead: T_fold(fold=1)", 306.0, 0.765),
        ({"at": {"t": [1.0]}, "uncertainty": "refinement/{dataset}"},
         "bead: radius(t=1)", 3.0, 0.75),
        ({"uncertainty": "refinement/bead"}, "bead: radius", 4.5, 2.5 * 0.9),
        ({"at": {"t": [4.0]},
          "uncertainty": {"dataset": "refinement/{dataset}", "variable": "radius"}},
         "bead: radius(t=4)", 9.0, 2.5 * 0.9),
        ({"uncertainty": 0.0}, "bead: radius", 4.5, 4.5e-10),
    ],
)  # fmt: skip
def test_a_quantity_has_its_value_and_two_and_a_half_uncertainties(entry, label, value, tolerance):
    values, problems = evaluated(**entry)
    assert not problems
    assert list(values) == [label]
    assert values[label]["value"] == pytest.approx(value, rel=1e-12)
    assert values[label]["tolerance"] == pytest.approx(tolerance, rel=0.05)


@pytest.mark.parametrize(
    "entry",
    [
        {"variables": ["volume"]},
        {"at": {"t": [5.0]}},
        {"at": {"t": [-1.0]}},
        {"at": {"tau": [1.0]}},
        {"at": {"t": [1.0]}, "uncertainty": "refinement/tube"},
        {"variables": ["T_fold"], "at": {"fold": [2]}},
    ],
)
def test_what_is_not_there_is_told(entry):
    values, (problem,) = evaluated(**entry)
    assert not values
    assert problem.kind == "not there" if hasattr(problem, "kind") else "not there" in str(problem)


def test_a_value_that_is_not_finite_is_told():
    broken = {"bead": DATA["bead"].assign(radius=("t", [1.0, np.nan, 1.0, 1.0]))}
    listed = [{"datasets": ["bead"], "variables": ["radius"], "uncertainty": 1.0}]
    assert not reference.evaluated(listed, broken)[0]


@pytest.mark.parametrize(
    ("here", "agrees"), [(1.0, True), (1.1, True), (0.9, True), (1.11, False), (np.nan, False)]
)
def test_a_number_agrees_within_its_tolerance(here, agrees):
    old = {"a": {"value": 1.0, "tolerance": 0.1000001}}
    (row,), problems = reference.compared(old, {"a": {"value": here, "tolerance": 9.0}})
    assert row.agrees is agrees
    assert len(problems) == (not agrees)
    assert row.difference == pytest.approx(here - 1.0, nan_ok=True)


def test_what_stands_on_one_side_only_is_told():
    one, other = ({key: {"value": 1.0, "tolerance": 0.1}} for key in "ab")
    rows, problems = reference.compared(one, other)
    assert not rows
    assert ["no reference" in str(each) for each in problems] == [True, False]
    assert ["not compared" in str(each) for each in problems] == [False, True]


def test_key_numbers_are_told_one_by_one():
    rows = [
        {"figure": "f", "quantity": "q", "value": [1.0, 2.0], "uncertainty": [0.1, 0.2]},
        {"figure": "f", "quantity": "r", "value": 3.0, "uncertainty": 0.0},
    ]
    values = reference.of_figures(rows)
    assert list(values) == ["f: q, 1 of 2", "f: q, 2 of 2", "f: r"]
    assert values["f: q, 2 of 2"] == {"value": 2.0, "tolerance": 0.5}
    assert values["f: r"]["tolerance"] == pytest.approx(3e-10)


def test_a_renewal_says_what_changes():
    def numbers(**pairs):
        return {name: {"value": pair[0], "tolerance": pair[1]} for name, pair in pairs.items()}

    old = numbers(same=(1.0, 0.1), gone=(2.0, 0.1), moved=(3.0, 0.5), exact=(1.0, 0.0))
    new = numbers(same=(1.0, 0.1), moved=(4.0, 0.25), new=(5.0, 0.1), exact=(1.0, 0.1))
    assert reference.changes(old, new) == [
        "exact: 1 -> 1 (+0 tolerances); tolerance 0 -> 0.1",
        "gone: dropped, was 2",
        "moved: 3 -> 4 (+2 tolerances); tolerance 0.5 -> 0.25",
        "new: new, 5",
    ]
    assert reference.as_text(old).count("\n") == 6


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
