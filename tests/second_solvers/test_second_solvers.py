"""The second solvers by themselves, and the comparison's verdicts."""

import numpy as np
import pytest

from gelpump.bead import lens
from gelpump.materials import PiecewiseLinearGel, from_config
from gelpump.second_solvers import cross_check, lens_bead, tube

TIMES = np.array([0.0, 1e-3, 0.01, 0.1])


def test_bead_jacobian_is_that_of_the_rate(hht):
    shells = lens_bead.Shells(hht, 304.0, 0.6, 12)
    J = 1 / np.linspace(0.5, 0.1, 12)
    steps = 1e-6 * np.eye(12)
    differences = np.array([shells.rate(J + e) - shells.rate(J - e) for e in steps]).T / 2e-6
    np.testing.assert_allclose(shells.jacobian(J), differences, atol=1e-7 * abs(differences).max())


def test_bead_is_of_second_order_within_its_uncertainty(hht):
    phi = hht.equilibrium_polymer_fraction(308.0)
    radius = [lens_bead.solve(hht, 304.0, phi, TIMES, n).radius[1:] for n in (40, 80, 160)]
    steps = np.abs(np.diff(radius, axis=0))
    assert np.log2(steps[0] / steps[1]).min() > 1.7
    observed = lens_bead.observed(hht, 304.0, phi, TIMES, 80, 1e-8)
    limit = lens_bead.solve(hht, 304.0, phi, TIMES, 320).radius
    assert (np.abs(observed.radius[0] - limit) <= observed.radius_uncertainty + 1e-12).all()


def test_bead_stops_where_phases_separate(hht):
    phi = hht.equilibrium_polymer_fraction(304.0)
    course = lens_bead.solve(hht, 308.0, phi, np.array([0.0, 0.1, 1.0]), 80)
    assert course.stop == pytest.approx(0.14525, abs=2e-5)
    assert course.t.tolist() == [0.0, 0.1]


@pytest.mark.parametrize(
    ("elasticity", "ions"), [("affine", {}), ("phantom", {"charges_per_chain": 0.5, "salt": 2.0})]
)
def test_both_beads_of_a_gel_of_the_literature_agree(elasticity, ions):
    """The library's formulae and those that are written again here, through two solvers."""
    network = {"elasticity": elasticity, "reference_polymer_fraction": 0.2, "chain_length": 80.0}
    chi = {"chi_1": {"A": -6.0, "Theta": 312.0}, "chi_2": 0.3, "chi_3": 0.1}
    block = {"model": "flory-rehner", "chi": chi, "network": network}
    gel = from_config(
        "mine", block | {"temperature_range": [280.0, 330.0]} | ({"ions": ions} if ions else {})
    )
    phi = gel.equilibrium_polymer_fraction(308.0)
    first = lens.solve(gel, 295.0, phi, TIMES, 160, tolerance=1e-6)
    second = lens_bead.solve(gel, 295.0, phi, TIMES, 160)
    np.testing.assert_allclose(first.radius.values[1:], second.radius[1:], rtol=5e-4)
    swollen = second.radius[-1] / second.radius[0]
    assert swollen > 1.02


def test_tube_uncertainty_covers_its_error():
    gel = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=1.0, M=1.0)
    tau = np.array([1e-3, 1e-2])
    observed = tube.observed(gel, {"eps": 0.1, "Le": 10.0}, [0.5], tau, 100, 1e-6)
    limit = tube.solve(tau, 0.5, nodes=400, rtol=1e-8)[1][:, 400]
    assert (np.abs(observed.Phi1_front[0] - limit) <= observed.Phi1_front_uncertainty[0]).all()
    with pytest.raises(ValueError, match="nodes = 33: must be even"):
        tube.observed(gel, {"eps": 0.1, "Le": 10.0}, [0.5], tau, 33, 1e-6)


@pytest.mark.parametrize(
    ("difference", "first", "second", "agrees"),
    [
        (3e-4, 2e-4, 2e-4, True),
        (5e-4, 2e-4, 2e-4, False),  # more than both claim
        (2e-3, 5e-3, 0.0, False),  # within what is claimed, but beyond the bound
        (np.nan, 1.0, 1.0, False),
    ],
)
def test_verdict(difference, first, second, agrees):
    row = cross_check.row("radius", difference, first, second, bound=1e-3)
    assert row["agrees"] is agrees
    if agrees:
        cross_check.require_agreement([row])
    else:
        with pytest.raises(cross_check.Disagreement, match="radius by"):
            cross_check.require_agreement([row])
