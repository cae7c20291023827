"""The heat of a collapse, from the energies themselves."""

import numpy as np
import pytest

from gelpump.materials.flory_rehner import FloryRehnerGel
from gelpump.materials.latent_heat import (
    BOLTZMANN,
    MOLECULE_VOLUME,
    energy_pressure,
    internal_energy,
    latent_heat,
    mixing_heat_capacity,
)

PHI, T = np.array([0.05, 0.3, 0.7]), 306.0
UNIT = BOLTZMANN * T**2 / MOLECULE_VOLUME


def test_closed_forms_of_appendix_a(hht, anb):
    for gel in (hht, anb):
        U = -UNIT * (1 - PHI) * (gel.B0 + gel.B1 * PHI)
        assert internal_energy(gel, PHI, T) == pytest.approx(U, rel=1e-9)
        U_v = UNIT * PHI**2 * (gel.B1 - gel.B0 - 2 * gel.B1 * PHI)
        assert energy_pressure(gel, PHI, T) == pytest.approx(U_v, rel=1e-9)
        assert mixing_heat_capacity(gel, PHI, T) == pytest.approx(2 * U / T, rel=1e-7)


def test_U_v_is_the_slope_of_U_in_the_volume(hht):
    h = 1e-5
    of_J = [internal_energy(hht, 1 / (1 / PHI + sign * h), T) for sign in (1, -1)]
    assert energy_pressure(hht, PHI, T) == pytest.approx((of_J[0] - of_J[1]) / (2 * h), rel=1e-5)


def test_U_follows_from_the_printed_energy(anb):
    """U = W - T dW/dT of eqn:app:helmholtz_free_energy, chains and all, by a complex step."""
    stretch = PHI ** (-2 / 3)

    def W(T):
        chi = anb.A0 + anb.B0 * T + (anb.A1 + anb.B1 * T) * PHI
        chains = (3 * stretch - 3 + 2 * np.log(PHI)) / (2 * anb.Omega)
        return T * (chains + (1 - PHI) / PHI * np.log(1 - PHI) + chi * (1 - PHI))

    h = 1e-20
    U = (W(T) - T * W(T + 1j * h).imag / h) * BOLTZMANN / MOLECULE_VOLUME
    assert internal_energy(anb, PHI, T) == pytest.approx(U, rel=1e-8)


def test_enthalpy_that_does_not_depend_on_temperature():
    """chi = dH/(R T) - dS/R takes up dH per mole of pairs, whatever T: slope in 1/T."""
    gel = FloryRehnerGel("vH", (3.0, 0.5, 0.0), (-800.0, 0.0, 0.0), True, 300.0)
    expected = -BOLTZMANN / gel.molecule_volume * -800.0 * (0.3 - 0.6)
    for T in (290.0, 310.0):
        found = latent_heat(gel, 0.3, 0.6, T, gel.molecule_volume)
        assert found == pytest.approx(-expected, rel=1e-8)
        assert mixing_heat_capacity(gel, 0.3, T) == pytest.approx(0, abs=1e-4 * abs(expected))


def test_energies_fitted_to_swelling_take_up_far_more_than_a_calorimeter_finds(hht):
    phi = hht.equilibrium_polymer_fraction(304.0), hht.equilibrium_polymer_fraction(308.0, "dry")
    found = latent_heat(hht, *phi, 306.0)
    measured = 6.5e3 / 0.11316 * 1100  # kJ per mole of repeat units of 113.16 g, 1.1 g/cm^3
    assert found > 30 * measured
    assert 4.18e6 + 0.64 * mixing_heat_capacity(hht, 0.64, 306.0) < 0


def test_refused(hht):
    with pytest.raises(ValueError, match="must be less"):
        latent_heat(hht, 0.5, 0.1, T)
