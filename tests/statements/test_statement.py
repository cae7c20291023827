"""Statuses follow from numbers, and numbers are shown as far as they are known."""

import pytest

from gelpump.statements import views
from gelpump.statements.statement import (
    IDENTITY,
    LINE,
    RESULT,
    Collection,
    Computed,
    Evidence,
    holds,
    record,
    said,
    status,
    where_from,
)

TWICE = {"value": 304.5, "resolution": 0.05, "drawn": 304.7, "drawn_resolution": 0.05}


def judged(computed, paper=None, kind=RESULT):
    """The record of a statement for which ``computed`` was computed."""
    collection = Collection()

    @collection.states("id", "where", "evidence", kind)
    def statement(e):
        """Says so."""
        return computed

    return record(collection[0], computed, paper)


@pytest.mark.parametrize(
    ("computed", "uncertainty", "paper", "expected"),
    [
        (0.6425, 1e-6, {"value": 0.64, "resolution": 0.005}, "reproduced"),
        (0.6460, 1e-6, {"value": 0.64, "resolution": 0.005}, "deviates"),
        (0.6460, 2e-3, {"value": 0.64, "resolution": 0.005}, "reproduced"),
        ([1.0, 2.0], [1e-6, 1e-6], {"value": [1.0, 2.0], "resolution": 1e-3}, "reproduced"),
        ([1.0, 2.1], [1e-6, 1e-6], {"value": [1.0, 2.0], "resolution": 1e-3}, "deviates"),
        ([1.0, 2.1], [1e-6, 1e-6], {"value": [1.0, 2.0], "resolution": [1e-3, 0.2]}, "reproduced"),
        (True, 0.0, {"value": True}, "reproduced"),
        (False, 0.0, {"value": True}, "deviates"),
        (None, None, {"value": 1.0, "resolution": 1.0}, "qualitative"),
        (1.0, 0.1, None, "qualitative"),
        (304.74, 1e-6, TWICE, "inconsistent-in-paper"),
        (304.51, 1e-6, TWICE, "inconsistent-in-paper"),
        (304.60, 0.06, TWICE, "reproduced"),
        (306.00, 1e-6, TWICE, "deviates"),
    ],
)
def test_status(computed, uncertainty, paper, expected):
    assert status(RESULT, Computed(computed, uncertainty), paper) == expected


@pytest.mark.parametrize(
    ("kind", "computed", "expected"),
    [
        (IDENTITY, 2.0, "identity"),
        (IDENTITY, 2.5, "deviates"),
        (LINE, 2.0, "reproduced"),
        (LINE, 2.5, "misprint"),
    ],
)
def test_what_is_counted_apart_can_come_out_otherwise(kind, computed, expected):
    assert status(kind, Computed(computed, 0.0), {"value": 2.0, "resolution": 0.1}) == expected


def test_a_record_says_who_computed_it():
    entry = judged(Computed([1.0, 2.2], [0.0, 0.0]), {"value": [1.0, 2.0], "resolution": 0.1})
    assert entry["relative_difference"] == pytest.approx(0.1)
    assert entry["statement"] == "says so"
    assert entry["code"] == f"{__name__}.judged.<locals>.statement"


def test_a_number_that_is_not_finite_is_an_error():
    with pytest.raises(ValueError, match="statement id: computed"):
        judged(Computed(float("nan"), 0.0))


def test_what_the_paper_prints_goes_before_what_its_equation_gives():
    collection = Collection()

    @collection.states("id", "where", "evidence")
    def statement(e):
        """Says so."""
        return Computed(2.0, 0.0, paper={"value": 1.0, "resolution": 0.0})

    printed = {"id": {"value": 2.0}}
    for published, expected in (({}, "deviates"), (printed, "reproduced")):
        evidence = Evidence({}, {}, {}, {}, {}, published)
        assert [each["status"] for each in collection.records(evidence)] == [expected]


def test_what_cannot_be_computed_is_left_out():
    collection = Collection()
    collection.states("id", "where", "evidence", text="says so")(lambda e: None)
    assert not list(collection.records(Evidence({}, {}, {}, {}, {}, {})))


def test_a_statement_holds_only_beyond_doubt():
    assert holds(0.2, 0.1)
    assert not holds(0.05, 0.1)
    assert not holds(-0.2, 0.1)


@pytest.mark.parametrize(
    ("value", "uncertainty", "text"),
    [
        (1.495846, 9e-5, "1.49585"),
        (1.495846, 9.6e-5, "1.4958"),
        (0.14527, 2e-4, "0.1453"),
        (304.73768, 1e-11, "304.738"),
        (1234.5, 20.0, "1230"),
        (1e-12, 1e-6, "1e-12"),
        (0.25, None, "0.25"),
    ],
)
def test_numbers_keep_the_digits_that_mean_something(value, uncertainty, text):
    assert views.digits(value, uncertainty) == text


@pytest.mark.parametrize(
    ("value", "uncertainty", "text"),
    [
        (0.6425163, 9e-16, "0.642516"),
        (1.495138, 8e-6, "1.49514 ± 8e-06"),
        (1.495846, 1e-4, "1.4958 ± 0.0001"),
        (-0.00039, 1e-4, "-0.0004 ± 0.0001"),
        (1e-12, 1e-6, "1e-12 ± 1e-06"),
        (532.1, 23.6, "530 ± 20"),
        ([1.0, 2.0], [0.1, 1e-9], "1.0 ± 0.1, 2.00000"),
    ],
)
def test_an_uncertainty_is_shown_where_it_touches_a_digit(value, uncertainty, text):
    assert views.number(value, uncertainty) == text


@pytest.mark.parametrize(
    ("computed", "size", "measured"),
    [(304.74, 0.24, "computed minus published"), (304.51, -0.19, "computed minus drawn")],
)
def test_the_ledger_tells_the_value_that_disagrees(computed, size, measured):
    (entry,) = views.ledger([judged(Computed(computed, 0.0), TWICE)])
    assert entry["size"] == pytest.approx(size)
    assert (entry["measured"], entry["allowed"]) == (measured, 0.05)


@pytest.mark.parametrize(
    ("evidence", "file"),
    [
        ("front_fit: A", "data/front_fit.nc: A"),
        ("truth/waves: shed", "truth/waves.nc: shed, by pump_truth"),
        ("config: scales", "config: scales"),
        ("docs/performance.md", "docs/performance.md"),
    ],
)
def test_evidence_is_a_file_below_results(evidence, file):
    assert where_from(evidence) == file


@pytest.mark.parametrize(
    ("docstring", "text"),
    [
        ("Temperature at which.", "temperature at which"),
        ("Phi_1 is\n    here.", "Phi_1 is here"),
        ("A V_max is.", "A V_max is"),
        ("LENS is.", "LENS is"),
    ],
)
def test_a_statement_is_part_of_a_sentence(docstring, text):
    def statement(e):
        pass

    statement.__doc__ = docstring
    assert said(statement) == text


def test_tables_count_and_list():
    claims = [
        judged(Computed(0.6425, 1e-6), {"value": 0.64, "resolution": 0.005}),
        judged(Computed(True, 0.0, 0.3, "margin:"), {"value": True}),
        judged(Computed(2.0, 0.0, follows="two"), {"value": 1.0}, LINE),
    ]
    page = views.claims(claims)
    assert "Of 2 statements" in page
    assert "2 reproduced, 0 deviates" in page
    assert "1 printed lines" in page
    assert "true: margin: 0.3" in page
    assert page.count("\n| id |") == 3
    (entry,) = views.ledger(claims)
    assert (entry["size"], entry["allowed"], entry["verdict"]) == (1.0, 0.0, "misprint")
    assert "computed minus published: 1 | 0 | misprint" in views.ledger_table([entry])


def test_small_numbers_are_shown_with_a_power_of_ten():
    assert views.number(8.064912345e-06, 1e-19) == "8.06491e-06"
    assert views.number(8.064912345e-06, 2e-9) == "8.065e-06 ± 2e-09"


def test_there_is_no_relative_difference_from_zero():
    entry = judged(Computed(0.003, 1e-3), {"value": 0.0, "resolution": 0.05})
    assert entry["relative_difference"] is None
    assert entry["status"] == "reproduced"
