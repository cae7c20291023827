"""Which job a file of a build is put down to, and what is said of a file that no job made."""

import json
import os

import pytest

from gelpump.integrity.alterations import changed, leftovers, stale
from gelpump.integrity.manifest import by_output, manifest, records


def record(rule, **outputs):
    return {
        "rule": rule,
        "wildcards": {},
        "code_digest": f"code of {rule}",
        "config_digest": f"config of {rule}",
        "code": {f"src/{rule}.py": rule},
        "inputs": {},
        "packages": {},
        "outputs": {
            path.replace("_", "."): {"sha256": sha256, "size": 1}
            for path, sha256 in outputs.items()
        },
    }


def test_of_two_jobs_that_made_a_file_the_last_one_counts():
    old, new = record("zz_old", a_nc="x"), record("new", a_nc="x")
    assert by_output([old, new], {"a.nc": "x"})["a.nc"] is new
    listed = manifest({"a.nc": "x"}, {"zz_old": old, "new": new}, {})
    assert listed["outputs"]["a.nc"]["rule"] == "new"
    assert set(listed["jobs"]) == {"new"}


def test_a_file_put_back_from_an_older_build_is_altered():
    old, new = record("old", a_nc="x"), record("new", a_nc="y")
    with pytest.raises(ValueError, match=r"a\.nc: altered since its job made it"):
        manifest({"a.nc": "x"}, {"old": old, "new": new}, {})


def test_a_file_that_no_job_made_has_no_record():
    with pytest.raises(ValueError, match=r"b\.nc: no record of its job"):
        manifest({"a.nc": "x", "b.nc": "x"}, {"new": record("new", a_nc="x")}, {})


def test_records_are_read_oldest_first(tmp_path):
    for age, name in ((1, "b"), (3, "a"), (2, "c")):
        (tmp_path / f"{name}.json").write_text(json.dumps(record(name)))
        os.utime(tmp_path / f"{name}.json", (age, age))
    assert list(records(tmp_path)) == ["b", "c", "a"]


@pytest.fixture
def built():
    return manifest({"results/a.nc": "x"}, {"new": record("new", **{"results/a_nc": "x"})}, {})


@pytest.mark.parametrize(
    ("found", "later", "what"),
    [("x", [], []), (None, [], ["missing"]), ("y", [], ["altered"]), ("y", ["y"], ["newer"])],
)
def test_a_file_is_compared_with_the_manifest(built, found, later, what):
    made = [record("new", **{"results/a_nc": sha256}) for sha256 in ["x", *later]]
    problems = changed(built, made, {"results/a.nc": found}.get)
    assert [problem.what for problem in problems] == what


@pytest.mark.parametrize(
    ("blocks", "code", "why"),
    [
        ({"new": "config of new"}, "new", None),
        ({"new": "config of new"}, "edited", "module src/new.py has changed"),
        ({"new": "config of new"}, None, "module src/new.py is gone"),
        ({"new": "another"}, "new", "its part of the configuration has changed"),
        ({"new": None}, "new", "rule new does not make it any more"),
        ({}, "new", "rule new does not make it any more"),
    ],
)
def test_a_file_is_stale_if_what_it_was_made_from_has_changed(built, blocks, code, why):
    problems = stale(built, blocks, {"src/new.py": code}.get)
    assert [problem.why for problem in problems] == ([why] if why else [])


def test_what_no_rule_made_is_left_over(built):
    files = ["results/a.nc", "results/b.nc", "results/logs/x.log", "results/manifest.json"]
    assert [problem.where for problem in leftovers(files, built)] == ["results/b.nc"]
