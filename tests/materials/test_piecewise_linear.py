"""Piecewise-linear gel: its limits, and the relations every gel obeys."""

import numpy as np
import pytest

from gelpump.materials import PiecewiseLinearGel

GEL = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=0.7, M=0.4)
SWOLLEN, DRY = -0.5, 1.0
PHI = np.linspace(0.3, 4, 38)


def test_equilibrium_jumps_at_the_transition():
    assert GEL.equilibrium_polymer_fraction(SWOLLEN) == 1
    assert GEL.equilibrium_polymer_fraction(0.0) == 1
    assert GEL.equilibrium_polymer_fraction(DRY) == 2
    np.testing.assert_array_equal(GEL.equilibrium_polymer_fraction([-1, 0, 1e-9]), [1, 1, 2])


@pytest.mark.parametrize("theta", [SWOLLEN, DRY])
def test_pressure_vanishes_at_equilibrium_and_rises(theta):
    assert GEL.osmotic_pressure(GEL.equilibrium_polymer_fraction(theta), theta) == 0
    assert (np.diff(GEL.osmotic_pressure(PHI, theta)) > 0).all()


@pytest.mark.parametrize("theta", [SWOLLEN, DRY])
@pytest.mark.parametrize("Phi_00", [1.0, 0.2])
def test_diffusivity_is_its_definition(theta, Phi_00):
    slope = np.diff(GEL.osmotic_pressure([1.0, 2.0], theta))
    shear = 4 / 3 * GEL.shear_modulus(Phi_00) * (PHI / Phi_00) ** (1 / 3)
    np.testing.assert_allclose(GEL.osmotic_modulus(PHI, theta), PHI * slope)
    np.testing.assert_allclose(GEL.diffusivity(PHI, theta), PHI * slope + shear)
    assert GEL.shear_modulus() == 0.4


@pytest.mark.parametrize("theta", [SWOLLEN, DRY])
def test_potential_is_the_integral_of_diffusivity(theta):
    h = 1e-4
    difference = GEL.flux_potential(PHI + h, theta) - GEL.flux_potential(PHI - h, theta)
    np.testing.assert_allclose(GEL.diffusivity(PHI, theta), difference / (2 * h), rtol=1e-7)


def test_limits():
    """No shear: D = Phi dPi/dPhi. Equal states: temperature has no effect."""
    fluid = PiecewiseLinearGel(Phi_inf=2.0, Pi_ratio=0.7, M=0)
    np.testing.assert_allclose(fluid.diffusivity(PHI, DRY), 0.7 * PHI / 2)
    same = PiecewiseLinearGel(Phi_inf=1.0, Pi_ratio=1.0, M=1.0)
    np.testing.assert_array_equal(same.diffusivity(PHI, SWOLLEN), same.diffusivity(PHI, DRY))
    assert same.diffusivity(1.0, DRY) == pytest.approx(7 / 3)


def test_no_spinodal():
    assert GEL.spinodal_polymer_fractions(DRY).size == 0


def test_negative_polymer_fraction_is_refused():
    with pytest.raises(ValueError, match=r"Phi = -1.0: must be greater than 0"):
        GEL.diffusivity([1.0, -1.0], DRY)
