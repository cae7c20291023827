"""The FiPy solvers on known solutions: orders, errors, conservation, limits; and its refusals."""

import numpy as np
import pytest

from gelpump.known_solutions import bead, manufactured, tube
from gelpump.known_solutions.study import (
    ORDER,
    NotVerified,
    Study,
    markdown,
    one_run,
    require_all,
    space,
)


@pytest.mark.parametrize("model", [bead, tube], ids=["bead", "tube"])
def test_all_studies_pass(model):
    studies = model.studies()
    require_all(studies)
    for against in ("cells", "steps"):
        smooth = [s for s in studies if s.against == against and "edge" not in s.quantity]
        assert smooth
        assert all(s.orders[-1] >= ORDER for s in smooth)


def test_barenblatt_conserves_the_polymer():
    """The exact solution, integrated over the bead, is the bead's polymer; its faces spread so."""
    exact = bead.Barenblatt(bead.INSIDE)
    for t in (1.0, 2.0):
        a = exact.faces(np.array([1.0]), t)[0]
        b = a / bead.INSIDE
        r, weights = np.polynomial.legendre.leggauss(8)
        r = a / 2 * (1 + r)
        phi = b**2 / (10 * t) * (1 - (r / b) ** 2)
        assert 3 * a / 2 * (weights * phi * r**2).sum() == pytest.approx(1.0, rel=1e-12)
        assert exact.surface.polymer_fraction(a) == pytest.approx(
            b**2 / (10 * t) * (1 - bead.INSIDE**2), rel=1e-12
        )


def test_the_manufactured_tube_has_a_jump_and_an_integral():
    problem = manufactured.Manufactured(manufactured.TUBE, manufactured.HEAT)
    tau, Z_C = problem.end, float(manufactured.HEAT.front(problem.end))
    at = np.array([Z_C])
    (Phi, slope, _), (Phi_ahead, slope_ahead, _) = (problem.Phi(at, tau, h) for h in (True, False))
    D, D_ahead = (problem.diffusivity(Phi, s) for s in (problem.hot[0], problem.cold[0]))
    np.testing.assert_allclose(Phi, Phi_ahead, rtol=1e-12)
    np.testing.assert_allclose(D * slope, D_ahead * slope_ahead, rtol=1e-12)
    assert slope / slope_ahead > 2
    Z = np.linspace(0.1, 0.9, 5) * Z_C
    d = 1e-6
    rate = (problem.Phi(Z, tau * (1 + d), True)[0] - problem.Phi(Z, tau * (1 - d), True)[0]) / (
        2 * d * tau
    )
    np.testing.assert_allclose(problem.Phi_tau(Z, tau, True), rate, rtol=1e-6)
    d = 1e-5 * Z_C
    for hot, where in ((True, Z), (False, Z + Z_C)):
        ahead, behind = problem.Phi(where + d, tau, hot), problem.Phi(where - d, tau, hot)
        _, slope, curvature = problem.Phi(where, tau, hot)
        np.testing.assert_allclose(slope, (ahead[0] - behind[0]) / (2 * d), rtol=1e-6)
        np.testing.assert_allclose(curvature, (ahead[1] - behind[1]) / (2 * d), rtol=1e-5)


def test_a_slow_or_large_error_is_refused():
    slow = space("problem", "slow", [10, 20], [1e-3, 5e-4], bound=1.0)
    large = one_run("problem", "large", 2.0, bound=1.0)
    good = Study("problem", "good", "cells", [10, 20], [4e-3, 1e-3], 1e-2, ORDER)
    assert [study.passes for study in (slow, large, good)] == [False, False, True]
    assert not one_run("problem", "not a number", np.nan, bound=1.0).passes
    with pytest.raises(NotVerified, match=r"problem, slow: .*orders 1\.00; problem, large"):
        require_all([slow, large, good])
    assert "1 of 3 studies pass" in markdown([slow, large, good])
