"""Uniform deswelling (section 3.4) against adaptive quadrature and a stiff ODE solver."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from gelpump.tube.deswelling import deswelling_curve, deswelling_time, response_time
from gelpump.tube.tubes import Tubes


def rate(Phi, tube, reswelling):
    Phi_0, s = (1.0, 1.0) if reswelling else (tube.Phi_inf, tube.Pi_ratio / tube.Phi_inf)
    D = s * Phi + 4 * tube.M / 3 * np.cbrt(Phi)
    return 16 * Phi ** (2 / 3) * D * (Phi_0 - Phi) / (tube.eps * (1 - tube.ell)) ** 2


def test_known_times():
    known = [4.5365139990e-4, 2.0162284440e-4, 5.0405711100e-5]
    assert np.allclose(deswelling_time(Tubes([0.25, 0.5, 0.75])), known, rtol=1e-10, atol=0)


@pytest.mark.parametrize("reswelling", [False, True])
def test_time_against_adaptive_quadrature(reswelling):
    random = np.random.default_rng(1)
    for _ in range(100):
        tube = Tubes(
            random.uniform(0.01, 0.99),
            10 ** random.uniform(-3, -0.5),
            random.choice([0, 10 ** random.uniform(-2, 2)]),
            10 ** random.uniform(-1, 1),
            1 + 10 ** random.uniform(-2, 1.3),
        )
        change = tube.Phi_inf - 1
        ends = (tube.Phi_inf, 1 + change / 100) if reswelling else (1, 1 + 0.99 * change)
        time, _ = quad(
            lambda Phi, tube=tube: 1 / rate(Phi, tube, reswelling), *ends, epsabs=0, epsrel=1e-12
        )
        assert np.isclose(deswelling_time(tube, reswelling=reswelling), time, rtol=1e-10, atol=0)


def test_published_polymer_fractions():
    Phi = deswelling_curve(1e-4, Tubes([0.01, 0.1, 0.25, 0.5]))
    assert np.allclose(Phi, [1.2979, 1.3571, 1.4964, 1.8543], rtol=0, atol=2e-4)


@pytest.mark.parametrize("reswelling", [False, True])
def test_curve_against_an_ode_solver(reswelling):
    tube = Tubes(0.3, 0.2, 0.4, 3.0, 4.0)
    tau = np.array([0, 1e-5, 1e-4, 5e-4, 2e-3, 1e-2])
    start = tube.Phi_inf if reswelling else 1.0
    ode = solve_ivp(
        lambda t, Phi: rate(Phi, tube, reswelling), (0, 1e-2), [start], "LSODA", tau,
        rtol=1e-11, atol=1e-12,
    )  # fmt: skip
    assert np.allclose(deswelling_curve(tau, tube, reswelling), ode.y[0], rtol=0, atol=1e-8)


def test_curve_and_time_agree():
    tubes = Tubes([0.1, 0.5, 0.9], Phi_inf=[1.1, 2.0, 9.0])
    Phi = deswelling_curve(deswelling_time(tubes), tubes)
    assert np.allclose((tubes.Phi_inf - Phi) / (tubes.Phi_inf - 1), 0.01, rtol=1e-9)
    assert np.allclose(deswelling_curve(1.0, tubes), tubes.Phi_inf, rtol=1e-12)


def test_time_scales_with_the_square_of_the_wall():
    times = deswelling_time(Tubes([0.2, 0.6]))
    assert np.isclose(times[0] / times[1], (0.8 / 0.4) ** 2, rtol=1e-12)


@pytest.mark.parametrize(
    ("key", "value"),
    [("ell", 0.0), ("ell", 1.0), ("ell", 1.2), ("eps", 0.0), ("eps", -0.1), ("M", -1e-9),
     ("Pi_ratio", 0.0), ("Phi_inf", 0.9), ("M", np.nan), ("eps", np.inf)],
)  # fmt: skip
def test_bad_input_is_named(key, value):
    with pytest.raises(ValueError, match=rf"{key} = {value:g} is not allowed: .*{key}"):
        Tubes(**{"ell": [0.5, 0.5], key: [0.5 if key == "ell" else 1.0, value]})


def test_a_thick_tube_is_warned_about():
    with pytest.warns(UserWarning, match="eps = 0.8 is of order one"):
        Tubes(0.5, eps=0.8)


def test_no_change_has_no_time():
    with pytest.raises(ValueError, match="Phi_inf = 1"):
        deswelling_time(Tubes(0.5, Phi_inf=1.0))
    with pytest.raises(ValueError, match="tau = -1"):
        deswelling_curve(-1.0, Tubes(0.5))


LINEAR = {"M": 1.0, "Pi_ratio": 1.0, "Phi_inf": 2.0}


def test_seconds_of_known_tubes():
    """For a_1 = 1 mm, 1e-15 m^2, 1e-3 Pa s and 1e5 Pa, mu_l (a_1/0.1)^2/(k Pi_00) is 1000 s."""
    t = response_time(1e-3 * np.array([0.25, 0.5, 0.75]), 1e-3, 1e-15, 1e-3, 1e5, **LINEAR)
    known = 1e3 * np.array([4.5365139990e-4, 2.0162284440e-4, 5.0405711100e-5])
    assert np.allclose(t, known, rtol=1e-9, atol=0)


def test_seconds_depend_on_the_thickness_of_the_wall_only():
    thick = response_time(2.0, 5.0, 1e-15, 1e-3, 1e5, **LINEAR)
    assert np.isclose(response_time(7.0, 10.0, 1e-15, 1e-3, 1e5, **LINEAR), thick, rtol=1e-12)


def test_seconds_of_many_designs_equal_those_of_each():
    random = np.random.default_rng(2)
    count = 40_001  # more than two blocks
    a_0, M, Phi_inf = random.uniform(0.1, 0.9, count), random.uniform(0, 5, count), 3.0
    t = response_time(a_0, 1.0, 1e-15, 1e-3, 1e5, M=M, Pi_ratio=0.7, Phi_inf=Phi_inf)
    for i in (0, 20_000, count - 1):
        one = response_time(a_0[i], 1.0, 1e-15, 1e-3, 1e5, M=M[i], Pi_ratio=0.7, Phi_inf=Phi_inf)
        assert t[i] == one


def test_seconds_need_positive_properties():
    with pytest.raises(ValueError, match="permeability = -1 is not allowed: permeability > 0"):
        response_time(0.5, 1.0, [1e-15, -1.0], 1e-3, 1e5, **LINEAR)
    with pytest.raises(ValueError, match=r"ell = 1\.5 is not allowed"):
        response_time(1.5, 1.0, 1e-15, 1e-3, 1e5, **LINEAR)
