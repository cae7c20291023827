"""Heat that the collapse consumes: the similarity solution, the coupled tube, a second solver."""

import numpy as np
import pytest

from gelpump.second_solvers import heated_tube
from gelpump.tube import heated
from gelpump.tube.closure import CLOSURES
from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.stefan import (
    Surrounding,
    bath_shift,
    circulated,
    front_constant,
)
from gelpump.tube.tubes import Tubes

ELL = 0.5
W = float(CLOSURES["conservative"].wall_length(Tubes(ELL)))
KINDS = ["pipe", "pipe", "pipe", "insulated", "bath"]
F_ST = np.array([0.0, 0.1, 1.0, 0.0, 2.0])  # of sections as wide as the tube
ST = F_ST / (1 - ELL**2)
LE = 1000.0  # large, so that what circulates through the outside carries nothing
TAU = W**2 * np.array([1e2, 1e4])


def tubes(count):
    return Tubes(np.full(count, ELL))


def solved(cells, Le=LE, tolerance=1e-3):
    return heated.solve(
        tubes(len(KINDS)), Le, TAU, Surrounding(KINDS), St=ST, cells=cells, tolerance=tolerance
    )


@pytest.fixture(scope="module")
def runs():
    return [solved((n, n)) for n in (24, 48, 96)]


def test_time_dependent_front_tends_to_the_root_at_second_order(runs):
    root = front_constant(tubes(len(KINDS)), ST, Surrounding(KINDS), LE)
    coarse, middle, fine = (run.front_over_diffusion.values[:, -1] for run in runs)
    order = np.log2((coarse - middle) / (middle - fine))
    assert (np.abs(order - 2) < 0.25).all(), order
    limit = fine + (fine - middle) / 3
    assert np.abs(limit - root).max() < 3e-4
    assert np.abs(fine - front_constant(tubes(len(KINDS)), ST, Surrounding(KINDS))).max() < 1e-3


def test_a_tube_that_is_not_slender_in_time_is_not_there_yet(runs):
    """At tau = 100 w^2 the wall still lags: the test above could fail."""
    root = front_constant(tubes(len(KINDS)), ST, Surrounding(KINDS), LE)
    early = np.abs(runs[-1].front_over_diffusion.values[:, 0] - root)
    assert early[3] > 1e-3


def test_energy_is_kept(runs):
    for run in runs:
        assert run.attrs["energy_balance_step"] < 1e-12
        assert run.energy_balance_error.max() < 1e-8
        assert np.abs(run.front_temperature).max() < 1e-4


def test_latent_heat_is_that_of_the_water_lost(runs):
    """St a (1 - 1/Phi) dX of each slice, by an independent sum over the profile."""
    here = runs[-1].isel(tau=-1)
    Z = np.pad((here.Z.values[:, 1:] + here.Z.values[:, :-1]) / 2, ((0, 0), (1, 0)))
    lost = ((np.cbrt(here.Phi1) - here.Phi1 ** (-2 / 3))[:, :-1].values * np.diff(Z)).sum(axis=1)
    latent = -(1 - ELL**2) * np.where(np.array(KINDS) == "bath", 0.0, ST) / 0.5 * lost
    assert here.heat_latent.values == pytest.approx(latent, rel=2e-3, abs=1e-12)


def test_without_latent_heat_or_in_a_bath_heat_is_decoupled(runs):
    fine = runs[-1].front_over_diffusion.values
    assert fine[4] == pytest.approx(fine[0], rel=1e-12)
    assert fine[0] == pytest.approx(FRONT_CONSTANT, rel=1e-3)


def test_circulation_through_the_outside_cools_an_insulated_front(runs):
    """At Le = 10 the front tends to another constant than at 1000; in a pipe to the same."""
    ten = [solved((n, n), Le=10.0).front_over_diffusion.values[:, -1] for n in (24, 48)]
    limit = ten[1] + (ten[1] - ten[0]) / 3
    root = front_constant(tubes(len(KINDS)), ST, Surrounding(KINDS), 10.0)
    assert np.abs(limit - root).max() < 2e-3
    assert root[3] == pytest.approx(0.6888, abs=5e-5)
    E, W = circulated(tubes(1), 1e9, Surrounding("insulated"))
    assert (E[0], W[0]) == pytest.approx((1, 1), abs=1e-8)


def test_second_solver_agrees():
    tau, surrounding = W**2 * np.array([1.0, 30.0]), Surrounding(["pipe", "insulated"])
    St = np.array([1 / 0.75, 0.4])
    mine = [
        heated.solve(tubes(2), 10.0, tau, surrounding, St=St, cells=(n, n), tolerance=3e-4)
        for n in (40, 80)
    ]
    a, b = (run.front_over_diffusion.values for run in mine)
    first = b + (b - a) / 3
    for row, section in enumerate((1.0, None)):
        c, d = (
            heated_tube.solve(tau, ELL, St[row], section, nodes=n, rtol=1e-6)[3] for n in (40, 80)
        )
        second = (d + (d - c) / 3) / np.sqrt(10 * tau)
        assert second == pytest.approx(first[row], rel=2e-4)


def test_printed_equation_has_a_front_of_its_own():
    """With rho c T for -U_v the collapse heats: the front runs at a speed of its own."""
    tau = W**2 * np.array([4.0, 9.0])
    run = heated.solve(
        tubes(1), 10.0, tau, Surrounding("pipe"), N=30.0, cells=(32, 32), tolerance=3e-3
    )
    Z_C = run.Z_C.values[0]
    exponent = np.log(Z_C[1] / Z_C[0]) / np.log(9 / 4)
    assert exponent > 0.9
    assert float(run.theta.max()) > 10
    taking = heated.solve(tubes(1), 10.0, tau, Surrounding("pipe"), St=1.0, cells=(32, 32))
    Z_C = taking.Z_C.values[0]
    assert np.log(Z_C[1] / Z_C[0]) / np.log(9 / 4) == pytest.approx(0.5, abs=0.01)


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: Surrounding("air"), "surrounding = 'air'"),
        (lambda: Surrounding("pipe", 0.9), "section = 0.9"),
        (lambda: Surrounding("pipe", np.inf), "section = inf"),
        (lambda: front_constant(tubes(1), -0.1, Surrounding("pipe")), "St = -0.1"),
        (lambda: bath_shift(tubes(1), np.nan), "St = nan"),
        (lambda: heated.solve(tubes(1), 10, [0.1], Surrounding("pipe"), St=-1.0), "St = -1"),
        (lambda: heated.solve(tubes(1), 10, [0.1], Surrounding("bath"), N=30.0), "bath"),
        (lambda: heated.solve(tubes(1), 10, [0.2, 0.1], Surrounding("pipe")), "tau"),
        (lambda: heated.solve(tubes(1), -1, [0.1], Surrounding("pipe")), "Le = -1"),
    ],
)
def test_refused(call, text):
    with pytest.raises(ValueError, match=text):
        call()
