"""The tools of the benchmarks solve the problems; costs and exponents are fitted rightly."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from benchmarks import cost, lines, page, tools
from benchmarks.measure import cost_at, cpu, forked, growth
from benchmarks.problems import Bead, Drop, Tubes
from benchmarks.settings import paper


@pytest.mark.parametrize("method", cost.METHODS)
def test_barenblatt_by_the_method_of_lines(method):
    drop = Drop()
    errors = [drop.error(lines.DropLines(drop, n).solve(method, 1e-5)) for n in (50, 100)]
    assert errors[1] < 3e-4
    assert errors[0] / errors[1] > 2.5


def test_barenblatt_by_gelpump_and_by_the_textbook():
    drop = Drop()
    assert drop.error(tools.our_drop(drop, 40, 1e-4)) < 2e-2
    assert drop.error(tools.textbook_drop(drop, 40, 20)) < 2e-2


@pytest.fixture(scope="module")
def swelling():
    return cost.with_bead_reference(Bead.of(paper(), "swelling"), tools.second_bead, 60, 1e-7)


def test_all_tools_swell_the_same_bead(swelling):
    assert swelling.reference_uncertainty < 1e-3
    assert swelling.error(tools.our_bead(swelling, 24, 1e-3)) < 5e-3
    assert swelling.error(tools.second_bead(swelling, 40, 1e-4)) < 5e-3
    assert swelling.error(lines.LensLines(swelling, 16).solve("CVODE", 1e-4)) < 5e-3


def test_the_textbook_bead_converges(swelling):
    """Uniform cells, first order in time: slowly, but to the same radius."""
    errors = [swelling.error(tools.textbook_bead(swelling, *n)) for n in ((20, 40), (40, 160))]
    assert errors[0] < 2e-2
    assert errors[1] < 4e-3


def test_sweeps_of_the_textbook_that_do_not_end_are_an_error(swelling, monkeypatch):
    monkeypatch.setattr(tools, "MOST_SWEEPS", 3)
    with pytest.raises(ArithmeticError, match="3 sweeps left a change"):
        tools.textbook_bead(swelling, 20, 20)


def test_the_nonlinear_bead_swells_nearly_as_the_lens_bead(swelling):
    radius = lines.NonlinearLines(swelling, 12).solve("CVODE", 1e-4)
    assert np.abs(radius / swelling.reference - 1).max() < 2e-2


def test_all_tools_dry_the_same_tube():
    tube = Tubes.of(paper(), "tube", [0.25], [1e-3])
    tube = cost.with_tube_reference(tube, 100, 1e-6)
    assert tube.reference_uncertainty < 1e-3
    assert tube.error(tools.our_tubes(tube, 24, 16, 1e-3)) < 1e-2
    assert tube.error([lines.TubeLines(tube, 0.25, 150).solve("LSODA", 1e-4)]) < 3e-2
    assert tube.error(tools.textbook_tube(tube, 100, 40)) < 5e-2


def test_costs_are_interpolated_on_what_no_run_beats():
    errors, seconds = [1e-2, 1e-4, 1e-1], [1.0, 100.0, 50.0]
    assert cost_at(1e-3, errors, seconds).seconds == pytest.approx(10.0)
    assert cost_at(1e-2, errors, seconds) == (1.0, False)
    beyond = cost_at(1e-5, errors, seconds)
    assert beyond.extrapolated
    assert beyond.seconds == pytest.approx(1000.0)
    assert cost_at(1e-3, [], []) is None


def test_exponents_and_their_uncertainty():
    n = np.array([10, 20, 40, 80])
    exact = growth(n, 3.0 * n**1.5)
    assert exact.exponent == pytest.approx(1.5)
    assert exact.exponent_uncertainty < 1e-12
    line = growth(n, 5.0 + 0.1 * n)
    assert line.crossover == pytest.approx(50.0)
    assert line.exponent_uncertainty > 0.01
    with pytest.raises(ValueError, match="need three"):
        growth([1, 2], [1, 2])


def test_a_forked_run_is_measured_and_its_failure_is_not_hidden():
    used = forked(lambda: sum(range(3_000_000)))
    assert 0 < used.seconds < 10
    assert used.wall > 0
    assert used.memory_mb > 1
    with pytest.raises(ChildProcessError):
        forked(lambda: 1 / 0)
    assert cpu(lambda: 7, repeats=1)[1] == 7


def test_verdicts_are_computed():
    rows = [{"case": "swelling", "lens": 1.0, "nonlinear": 2.0, "ratio": 2.0}]
    assert "LENS is cheaper in both" in page.models(rows)
    rows[0]["ratio"] = 0.5
    assert "nonlinear model is cheaper" in page.models(rows)
    record = {"problem": "bead", "kind": "bead", "times_sundials": 51.0, "most": 50.0}
    assert "does not hold" in page.verdicts([record])
    assert "does not hold" not in page.verdicts([record | {"times_sundials": 49.0}])


def test_what_stays_far_from_the_target_is_a_lower_bound():
    runs = {
        cost.OURS: [{"error": 5e-4, "seconds": 1.0}],
        cost.SUNDIALS: [{"error": 5e-4, "seconds": 0.5}],
        cost.TEXTBOOK: [{"error": 0.1, "seconds": 4.0}],
    }
    tools_ = [
        {"tool": name, "runs": done, "seconds": done[0]["seconds"], "extrapolated": False}
        for name, done in runs.items()
    ]
    record = cost.concluded({"problem": "p", "kind": "tube", "tools": tools_})
    assert record["times_sundials"] == pytest.approx(2.0)
    assert record["bound"]
    assert record["beats_textbook"] == pytest.approx(4.0)
    assert "undecided" in page.verdicts([record])


def series(n, cost):
    fit = growth(n, cost)
    return {
        "what": "cells",
        "unit": "cells",
        "why": "so it is",
        "n": n,
        "fixed": fit.fixed,
        "slope": fit.slope,
        "crossover": fit.crossover,
        "upper_exponent": 1.0,
        "upper_exponent_uncertainty": 0.1,
    }


@pytest.mark.parametrize(
    ("fixed", "slope", "said"),
    [
        (0.0, 1.0, "linear throughout"),
        (5.0, 0.1, "linear from 50 on"),
        (5.0, 0.001, "not yet linear at 80: it would be from 5e+03 on"),
    ],
)
def test_where_growth_is_linear(fixed, slope, said):
    n = [10, 20, 40, 80]
    rows = page.growth_reasons([series(n, [fixed + slope * each for each in n])])
    assert f"| {said} | so it is |" in rows


def test_single_tubes_that_miss_are_told_of_beside_their_family():
    tube = {"problem": "tube", "kind": "tube", "times_sundials": 6.0, "most": 5.0}
    family_ = tube | {"problem": "family", "times_sundials": 0.4}
    assert "tube costs 6 times SUNDIALS'" in page.alone([tube, family_])
    assert page.alone([tube | {"times_sundials": 4.0}, family_]) == ""
    assert page.alone([tube, family_ | {"times_sundials": 7.0}]) == ""
