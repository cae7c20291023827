"""Two states that meet at a front: equal areas, the critical point, surfaces that lose a phase."""

import numpy as np
import pytest

from gelpump.materials import EnergyBasedGel
from gelpump.separation.coexistence import Coexistence, OnePhase, Surface, equal_area
from gelpump.separation.energy import ENERGIES

HHT = EnergyBasedGel("HHT", A0=-62.22, A1=-58.28, B0=0.20470, B1=0.19044, Omega=720.0)
ANB = EnergyBasedGel("ANB", A0=-12.947, A1=17.92, B0=0.04496, B1=-0.0569, Omega=100.0)


@pytest.mark.parametrize("model", ["nonlinear", "lens"])
@pytest.mark.parametrize("l_t", [1.3, 2.0, 2.6])
def test_stresses_are_slopes_of_the_energy(model, l_t):
    energy = ENERGIES[model](HHT, 308.0)
    J, h = np.array([1.5, 4.0, 20.0]), 1e-5
    slope = (energy.density(1 / (J + h), l_t) - energy.density(1 / (J - h), l_t)) / (2 * h)
    np.testing.assert_allclose(slope, energy.radial_stress(1 / J, l_t), atol=1e-7)
    along = (energy.density(1 / J, l_t + h) - energy.density(1 / J, l_t - h)) / (2 * h)
    np.testing.assert_allclose(
        -l_t / (2 * J) * along, energy.stress_difference(1 / J, l_t), atol=1e-7
    )
    s = [energy.radial_stress(1 / (J * (1 + sign * h)), l_t) for sign in (1, -1)]
    np.testing.assert_allclose((s[0] - s[1]) / (2 * h), energy.stiffness(1 / J, l_t), atol=1e-5)


@pytest.mark.parametrize(("gel", "temperature"), [(HHT, 308.0), (ANB, 306.0), (ANB, 310.0)])
@pytest.mark.parametrize("model", ["nonlinear", "lens"])
def test_equal_areas(gel, temperature, model):
    """The area between the stress and its common value, by quadrature, is nothing."""
    energy, l_t = ENERGIES[model](gel, temperature), 1.8
    swollen, dry = equal_area(energy, l_t)
    S = energy.radial_stress(np.array([swollen, dry]), l_t)
    np.testing.assert_allclose(S[0], S[1], atol=1e-10)
    nodes, weights = np.polynomial.legendre.leggauss(200)
    phi = swollen * (dry / swollen) ** (0.5 + 0.5 * nodes)
    excess = (energy.radial_stress(phi, l_t) - S[0]) / phi
    assert abs(weights @ excess) < 1e-6 * (weights @ abs(excess))


def test_table_ends_where_the_two_phases_are_one():
    energy = ENERGIES["nonlinear"](HHT, 307.7)
    table = Coexistence.between(energy, 1.0, 3.5)
    assert table.critical
    assert table.hoop_stretch[-1] == pytest.approx(3.5, rel=1e-12)
    l_t = table.hoop_stretch
    assert np.all(table.dry[1:] > table.swollen[1:])
    # the sides part like the root of the distance
    apart = (table.dry - table.swollen)[[2, 4, 8]]
    np.testing.assert_allclose(
        apart / np.sqrt(l_t[[2, 4, 8]] - l_t[0]), apart[0] / np.sqrt(l_t[2] - l_t[0]), rtol=0.05
    )
    for each in (1.9, 2.5):
        np.testing.assert_allclose(table.sides(each), equal_area(energy, each), rtol=1e-4)


def test_lens_has_one_pair_whatever_the_hoop_stretch():
    table = Coexistence.between(ENERGIES["lens"](HHT, 308.0), 1.0, 3.5)
    np.testing.assert_allclose(table.swollen, table.swollen[0], rtol=1e-10)


def test_no_phases_to_coexist_is_said():
    with pytest.raises(OnePhase, match="no two phases"):
        Coexistence.between(ENERGIES["lens"](HHT, 306.0), 1.0, 3.5)


def test_surfaces_are_free_of_stress_and_end_at_a_spinodal():
    energy = ENERGIES["nonlinear"](HHT, 307.8)
    surface = Surface.between(energy, "swollen", 1.0, 3.0, 2.6)
    assert surface.lost_below is not None
    for a in np.linspace(surface.lost_below + 0.01, 2.9, 7):
        assert abs(energy.radial_stress(surface.state(a), a)) < 1e-6
    lost = surface.state(surface.lost_below)
    assert abs(energy.stiffness(lost, surface.lost_below)) < 1e-6
