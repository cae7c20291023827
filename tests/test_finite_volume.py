"""FiPy's sweep solves the system it is given, whatever its size or scale."""

import numpy as np
import pytest
from scipy.linalg import solve_banded

from gelpump import finite_volume
from gelpump.finite_volume import DriftSweep, NewtonSweep, together


def banded(K, c, G):
    """div(K grad delta) - c delta = G on unit cells, solved without FiPy."""
    bands = np.zeros((3, c.size))
    bands[0, 1:] = bands[2, :-1] = K[1:-1]
    bands[1] = -(c + K[1:] + K[:-1])
    bands[1, 0] += K[0]
    bands[1, -1] += K[-1]
    return solve_banded((1, 1), bands, G)


@pytest.mark.parametrize("scale", [1.0, 1e-9, 1e9])
def test_correction_is_that_of_the_banded_system(scale):
    rng = np.random.default_rng(1)
    sweep = NewtonSweep(50)
    for _ in range(2):  # coefficients must be taken anew at each call
        K, c, G = rng.uniform(0.1, 1e3, 51), rng.uniform(0.1, 1.0, 50), rng.normal(size=50)
        K[[0, 20, 50]] = 0.0
        expected = banded(K, c, scale * G)
        delta = sweep.correction(K, c, scale * G)
        np.testing.assert_allclose(delta, expected, rtol=0.0, atol=1e-11 * np.abs(expected).max())
    assert sweep.sweeps == 2


def test_blocks_do_not_touch():
    sweep = NewtonSweep(8)
    K, c = np.full(9, 5.0), np.ones(8)
    K[4] = 0.0  # the seam
    G = np.array([1.0, 2.0, 3.0, 4.0, 0.0, 0.0, 0.0, 0.0])
    delta = sweep.correction(K, c, G)
    np.testing.assert_array_equal(delta[4:], 0.0)
    assert np.all(np.abs(delta[:4]) > 0.1)


def run(seed, cells, sweeps, kind=NewtonSweep):
    """A run whose every sweep depends on the one before, and which marks how many it made."""

    def corrections():
        rng, sweep = np.random.default_rng(seed), kind(cells)
        delta, found = np.zeros(cells), []
        for _ in range(sweeps):
            K, c = rng.uniform(0.1, 1e3, cells + 1), rng.uniform(0.1, 1.0, cells)
            drift = [rng.normal(size=cells + 1)] if kind is DriftSweep else []
            delta = sweep.correction(K, c, rng.normal(size=cells) + delta, *drift)
            found.append(delta)
        assert sweep.sweeps == sweeps
        return np.array(found)

    return corrections


RUNS = [run(1, 50, 3), run(2, 7, 5), run(3, 20, 4, DriftSweep), run(4, 50, 1), run(5, 9, 2)]


def swept(monkeypatch):
    """Sizes of the meshes that FiPy sweeps, as they come."""
    sizes, sweep = [], finite_volume._System.correction

    def counted(self, conductance, *others):
        sizes.append(conductance.size - 1)
        return sweep(self, conductance, *others)

    monkeypatch.setattr(finite_volume._System, "correction", counted)
    return sizes


def test_runs_together_give_bit_for_bit_what_they_give_alone(monkeypatch):
    alone = [each() for each in RUNS]
    sizes = swept(monkeypatch)
    for mine, found in zip(alone, together(*RUNS), strict=True):
        np.testing.assert_array_equal(mine, found)
    # of the five runs two have one kind of sweep and one has ended after each round
    assert sizes == [50 + 7 + 50 + 9, 20, 50 + 7 + 9, 20, 50 + 7, 20, 7, 20, 7]


def test_runs_may_let_others_run_together(monkeypatch):
    alone = [each() for each in RUNS]
    sizes = swept(monkeypatch)

    def inner():
        found = together(*RUNS[1:4])
        return [*found, RUNS[4]()]

    first, others = together(RUNS[0], inner)
    for mine, found in zip(alone, [first, *others], strict=True):
        np.testing.assert_array_equal(mine, found)
    assert sizes[0] == 50 + 7 + 50
    assert sizes[-2:] == [9, 9]


def test_a_run_that_fails_holds_up_nobody_and_is_told():
    ended = []

    def fails():
        NewtonSweep(5).correction(np.ones(6), np.ones(5), np.ones(5))
        raise ArithmeticError("of its own")

    def goes_on():
        ended.append(RUNS[1]())

    with pytest.raises(ArithmeticError, match="of its own"):
        together(fails, goes_on)
    np.testing.assert_array_equal(ended[0], RUNS[1]())


def test_what_fipy_refuses_reaches_every_run():
    def wrong():
        return NewtonSweep(5).correction(np.ones(6), np.ones(5), np.full(5, np.nan))

    alone = wrong()
    assert np.isnan(alone).all()  # said so, and not skipped
    with pytest.raises(ValueError, match=r"could not be broadcast|shape"):
        together(wrong, lambda: NewtonSweep(4).correction(np.ones(5), np.ones(4), np.ones(3)))
