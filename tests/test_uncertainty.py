"""Uncertainties are as large as the errors they stand for, and not much larger."""

from fractions import Fraction

import numpy as np
import pytest

from gelpump.tube.wall_flow import source_coefficient
from gelpump.uncertainty import convergence_index, quadrature_error, rounding_error


@pytest.mark.parametrize("order", [1, 2, 3])
def test_three_meshes_tell_the_error_of_the_middle_one(order):
    coarse, value, fine = (1.0 + h**order for h in (0.2, 0.1, 0.05))
    error = abs(value - 1.0)
    assert error <= convergence_index(coarse, value, fine) <= 1.3 * error


@pytest.mark.parametrize("nodes", [4, 8, 16])
def test_fewer_nodes_tell_the_error_of_a_quadrature(nodes):
    def integral(count):  # of 1/(1.2 - x) from -1 to 1
        node, weight = np.polynomial.legendre.leggauss(count)
        return (weight / (1.2 - node)).sum()

    error = abs(integral(nodes) - np.log(2.2 / 0.2))
    assert error <= quadrature_error(integral, nodes, nodes // 2) <= 0.5


def test_an_exact_quadrature_is_left_with_its_rounding():
    error = quadrature_error(lambda count: np.array([2.0, -3.0]), 64, 48)
    np.testing.assert_allclose(error, 64 * np.finfo(float).eps * np.array([2.0, 3.0]))


@pytest.mark.skipif(
    np.finfo(np.longdouble).eps == np.finfo(float).eps, reason="this machine has no longer numbers"
)
def test_rounding_grows_where_digits_cancel():
    def change(x):
        return (1 + x) - 1

    x = 1e-10
    error = abs(float(Fraction(change(x)) - Fraction(x)))
    assert 0 < 0.99 * error <= rounding_error(change, x) < 2 * error


def test_the_coefficient_of_thin_walls_loses_digits():
    thick, thin = rounding_error(source_coefficient, np.array([0.1, 0.999]))
    assert thin > 100 * thick
    assert thin < 1e-6


def test_a_power_is_as_uncertain_as_its_argument():
    found = rounding_error(lambda x: x**100, 1.1)
    assert found == pytest.approx(100 * 1.1**99 * np.spacing(1.1), rel=0.1)
