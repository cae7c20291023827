"""FiPy's sweep solves the system it is given, whatever its size or scale."""

import numpy as np
import pytest
from scipy.linalg import solve_banded

from gelpump.finite_volume import NewtonSweep


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
