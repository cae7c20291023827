"""Statuses follow from numbers."""

import pytest

from gelpump.claims import table
from gelpump.claims.finding import Finding, holds
from gelpump.claims.verdict import judged, status


def finding(computed, uncertainty=1e-6, **rest):
    return Finding("id", "where", "statement", computed, uncertainty, "evidence", **rest)


@pytest.mark.parametrize(
    ("computed", "uncertainty", "published", "expected"),
    [
        (0.6425, 1e-6, {"value": 0.64, "resolution": 0.005}, "reproduced"),
        (0.6460, 1e-6, {"value": 0.64, "resolution": 0.005}, "deviates"),
        (0.6460, 2e-3, {"value": 0.64, "resolution": 0.005}, "reproduced"),
        ([1.0, 2.0], [1e-6, 1e-6], {"value": [1.0, 2.0], "resolution": 1e-3}, "reproduced"),
        ([1.0, 2.1], [1e-6, 1e-6], {"value": [1.0, 2.0], "resolution": 1e-3}, "deviates"),
        (True, 0.0, {"value": True}, "reproduced"),
        (False, 0.0, {"value": True}, "deviates"),
        (None, None, {"value": 1.0, "resolution": 1.0}, "qualitative"),
        (1.0, 0.1, None, "qualitative"),
        (
            304.74,
            1e-6,
            {"value": 304.5, "resolution": 0.05, "drawn": 304.7, "drawn_resolution": 0.05},
            "inconsistent-in-paper",
        ),
        (
            307.59,
            1e-6,
            {"value": 307.6, "resolution": 0.05, "drawn": 307.6, "drawn_resolution": 0.05},
            "reproduced",
        ),
    ],
)
def test_status(computed, uncertainty, published, expected):
    assert status(finding(computed, uncertainty), published) == expected


def test_relative_difference_is_the_largest():
    entry = judged(finding([1.0, 2.2]), {"value": [1.0, 2.0], "resolution": 0.1})
    assert entry["relative_difference"] == pytest.approx(0.1)
    assert entry["status"] == "deviates"


def test_a_number_that_is_not_finite_is_an_error():
    with pytest.raises(ValueError, match="claim id: computed"):
        judged(finding(float("nan")), {"value": 1.0, "resolution": 0.1})


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
    assert table.digits(value, uncertainty) == text


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
    assert table.number(value, uncertainty) == text


def test_the_table_counts_and_lists():
    claims = [
        judged(finding(0.6425), {"value": 0.64, "resolution": 0.005}),
        judged(finding(True, measure=0.3, measured="margin"), {"value": True}),
    ]
    page = table.markdown(claims)
    assert "2 reproduced, 0 deviates" in page
    assert "true: margin 0.3" in page
    assert page.count("\n| id |") == 2


def test_small_numbers_are_shown_with_a_power_of_ten():
    assert table.number(8.064912345e-06, 1e-19) == "8.06491e-06"
    assert table.number(8.064912345e-06, 2e-9) == "8.065e-06 ± 2e-09"


def test_there_is_no_relative_difference_from_zero():
    entry = judged(finding(0.003, 1e-3), {"value": 0.0, "resolution": 0.05})
    assert entry["relative_difference"] is None
    assert entry["status"] == "reproduced"
