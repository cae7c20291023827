"""Energy-based gel against the printed numbers, high precision, and the free energy."""

from decimal import Decimal, getcontext

import numpy as np
import pytest

from gelpump.materials import EnergyBasedGel

ANB = EnergyBasedGel("ANB", -12.947, 17.92, 0.04496, -0.0569, 100, (290, 320))
HHT = EnergyBasedGel("HHT", -62.22, -58.28, 0.20470, 0.19044, 720, (290, 320))
BOTH = pytest.mark.parametrize("gel", [ANB, HHT], ids=lambda gel: gel.name)
PHI = np.array([1e-6, 1e-4, 3e-3, 0.0999, 0.1001, 0.3, 0.77, 0.999, 1 - 1e-6, 1 - 1e-9])

getcontext().prec = 60


def high_precision(gel, phi, T):
    """Each quantity as a list of terms, in 60 digits: from the printed formulas, not gelpump's."""
    phi, T, omega = Decimal(float(phi)), Decimal(T), Decimal(gel.Omega)
    a = Decimal(gel.A0) + Decimal(gel.B0) * T
    b = Decimal(gel.A1) + Decimal(gel.B1) * T
    third, log = phi ** (Decimal(1) / 3), -(1 - phi).ln()
    chi = a + b * phi
    return {
        "osmotic_pressure": [
            (phi - third) / omega,
            log - phi,
            -(phi**2) * chi,
            phi**2 * (1 - phi) * b,
        ],
        "osmotic_modulus": [
            (phi - third / 3) / omega,
            phi**2 / (1 - phi),
            -2 * phi**2 * (a - b) - 6 * phi**3 * b,
        ],
        "diffusivity": [
            (phi + third) / omega,
            phi**2 / (1 - phi),
            -2 * phi**2 * (a - b) - 6 * phi**3 * b,
        ],
        "flux_potential": [
            (phi**2 / 2 + 3 * phi * third / 4) / omega,
            log - phi - phi**2 / 2,
            -2 * phi**3 * (a - b) / 3 - 3 * phi**4 * b / 2,
        ],
    }


@BOTH
@pytest.mark.parametrize(
    "quantity",
    [
        "osmotic_pressure",
        "osmotic_modulus",
        "diffusivity",
        "flux_potential",
    ],
)
@pytest.mark.parametrize("T", [296, 304, 308])
def test_accurate_over_the_whole_range(gel, quantity, T):
    for phi, value in zip(PHI, getattr(gel, quantity)(PHI, T), strict=True):
        terms = high_precision(gel, phi, T)[quantity]
        # A0 and A1 are 1e3 times the sums they cancel in, which no double can hold any better
        scale = max(abs(float(term)) for term in terms)
        assert abs(value - float(sum(terms))) <= 1e-13 * (scale + float(phi) ** 2)


@pytest.mark.parametrize("phi", [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.05, 0.09])
def test_logarithm_keeps_its_digits_at_small_phi(phi):
    """With Omega -> infinity and chi = 0 only the mixing terms are left; they cancel most."""
    mixing = EnergyBasedGel("mixing", 0, 0, 1e-300, 0, 1e300)
    exact = Decimal(phi)
    log = -(1 - exact).ln()
    assert mixing.osmotic_pressure(phi, 1.0) == pytest.approx(float(log - exact), rel=1e-13)
    assert mixing.flux_potential(phi, 1.0) == pytest.approx(
        float(log - exact - exact**2 / 2), rel=1e-13
    )


@pytest.mark.parametrize(("T", "printed"), [(308, "0.6425"), (304, "0.05227")])
def test_equilibrium_of_hht_to_the_printed_digits(T, printed):
    digits = len(printed) - 2
    assert f"{HHT.equilibrium_polymer_fraction(T):.{digits}f}" == printed


@pytest.mark.parametrize(("gel", "printed"), [(ANB, (304.738, 305.805)), (HHT, (307.584, 307.590))])
def test_folds_to_the_printed_digits(gel, printed):
    assert sorted(gel.folds().temperature.round(3)) == list(printed)


@BOTH
def test_folds_are_extrema_of_the_equilibrium_curve(gel):
    for T, phi in zip(*gel.folds(), strict=True):
        step = 1e-3
        sides = gel.equilibrium_temperature(np.array([phi - step, phi + step])) - T
        assert sides[0] * sides[1] > 0
        assert abs(gel.osmotic_modulus(phi, T)) < 1e-12


def test_spinodal_tip_of_hht():
    tip = HHT.spinodal_tip()
    assert round(tip.temperature, 3) == 307.628
    assert HHT.spinodal_polymer_fractions(tip.temperature - 1e-4).size == 0
    assert HHT.spinodal_polymer_fractions(tip.temperature + 1e-4) == pytest.approx(
        [tip.polymer_fraction] * 2, abs=1e-2
    )


@pytest.mark.parametrize(("gel", "published"), [(ANB, 308), (HHT, 311)])
def test_singular_temperature(gel, published):
    assert round(gel.singular_temperature) == published


def test_poles_where_temperature_drops_out():
    assert ANB.spinodal_pole == pytest.approx(0.597, abs=5e-4)
    assert ANB.equilibrium_pole == pytest.approx(0.895, abs=5e-4)
    assert HHT.spinodal_pole is None
    assert HHT.equilibrium_pole is None
    D = ANB.diffusivity(ANB.spinodal_pole, np.array([290.0, 320.0]))
    assert D[0] == pytest.approx(D[1], rel=1e-12)
    Pi = ANB.osmotic_pressure(ANB.equilibrium_pole, np.array([290.0, 320.0]))
    assert Pi[0] == pytest.approx(Pi[1], rel=1e-12)


def test_second_spinodal_branch_behind_the_pole_of_anb():
    assert ANB.spinodal_polymer_fractions(290).size == 0
    roots = ANB.spinodal_polymer_fractions(285)
    assert roots.size == 2
    assert (roots > ANB.spinodal_pole).all()


@BOTH
@pytest.mark.parametrize("phi", [0.02, 0.1, 0.3, 0.55, 0.62, 0.8, 0.95])
def test_explicit_temperatures_are_roots(gel, phi):
    assert abs(gel.osmotic_pressure(phi, gel.equilibrium_temperature(phi))) < 1e-12
    assert abs(gel.diffusivity(phi, gel.spinodal_temperature(phi))) < 1e-12


@BOTH
@pytest.mark.parametrize("T", np.linspace(291, 319, 29))
def test_every_equilibrium_is_found_and_classified(gel, T):
    phi, stable = gel.equilibrium_polymer_fractions(T)
    grid = np.concatenate([np.geomspace(1e-4, 0.1, 20001), np.linspace(0.1, 0.9999, 200001)])
    Pi = gel.osmotic_pressure(grid, T)
    assert phi.size == np.count_nonzero(Pi[1:] * Pi[:-1] < 0)
    step = 1e-6 * phi * (1 - phi)
    rising = gel.osmotic_pressure(phi + step, T) > gel.osmotic_pressure(phi - step, T)
    assert (stable == rising).all()
    # a root to the last digits: no neighbouring double is better by more than rounding
    noise = 1e-15 * 60 * phi**2 + 1e-17
    assert (
        np.abs(gel.osmotic_pressure(phi, T)) <= noise + 1e-14 * gel.osmotic_modulus(phi, T)
    ).all()


def test_hysteresis_has_two_stable_branches():
    phi, stable = ANB.equilibrium_polymer_fractions(305.2)
    assert list(stable) == [True, False, True]
    assert ANB.equilibrium_polymer_fraction(305.2, "swollen") == phi[0]
    assert ANB.equilibrium_polymer_fraction(305.2, "dry") == phi[2]
    for T in (300, 310):
        assert ANB.equilibrium_polymer_fraction(T, "swollen") == (
            ANB.equilibrium_polymer_fraction(T, "dry")
        )


def free_energy(gel, stretches, T):
    """eqn:app:helmholtz_free_energy in k_B T/Omega_f, stretches from the dry state."""
    phi = 1 / np.prod(stretches)
    chi = gel.A0 + gel.B0 * T + (gel.A1 + gel.B1 * T) * phi
    elastic = (np.dot(stretches, stretches) - 3 + 2 * np.log(phi)) / (2 * gel.Omega)
    return elastic + (1 - phi) / phi * np.log1p(-phi) + chi * (1 - phi)


@BOTH
@pytest.mark.parametrize("phi", [0.05, 0.2, 0.5, 0.9])
@pytest.mark.parametrize("T", [300, 306, 312])
def test_stresses_derive_from_the_free_energy(gel, phi, T):
    """sigma_i = phi l_i dW/dl_i: isotropic part -Pi, and 2 mu_s eps under a small deviator."""

    def stress(stretches, i, h=3e-4):
        shift = np.exp(h * np.eye(3)[i])
        W = [free_energy(gel, stretches * shift**k, T) for k in (-2, -1, 1, 2)]
        return (W[0] - 8 * W[1] + 8 * W[2] - W[3]) / (12 * h) / np.prod(stretches)

    isotropic = np.full(3, phi ** (-1 / 3))
    Pi = gel.osmotic_pressure(phi, T)
    assert -stress(isotropic, 0) == pytest.approx(Pi, abs=1e-9)

    # F F^T = (phi/phi_00)^{-2/3} I + 2 (phi_00/phi) eps, from a reference phi_00
    phi_00, eps = 0.4 * phi, 1e-4
    strain = eps * np.array([1.0, -0.5, -0.5])
    squares = (phi / phi_00) ** (-2 / 3) + 2 * phi_00 / phi * strain
    stretches = phi_00 ** (-1 / 3) * np.sqrt(squares)
    stretches *= (phi * np.prod(stretches)) ** (-1 / 3)
    deviator = stress(stretches, 0) - stress(stretches, 1)
    assert deviator == pytest.approx(2 * gel.shear_modulus(phi_00) * 1.5 * eps, rel=1e-3)


@BOTH
@pytest.mark.parametrize("phi_00", [0.02, 0.3, 1.0])
def test_diffusivity_is_its_definition_whatever_the_reference(gel, phi_00):
    phi, T, h = np.linspace(0.02, 0.9, 45), 306.0, 1e-4
    Pi = [gel.osmotic_pressure(phi * np.exp(k * h), T) for k in (-2, -1, 1, 2)]
    modulus = (Pi[0] - 8 * Pi[1] + 8 * Pi[2] - Pi[3]) / (12 * h)
    shear = 4 / 3 * gel.shear_modulus(phi_00) * (phi / phi_00) ** (1 / 3)
    np.testing.assert_allclose(gel.osmotic_modulus(phi, T), modulus, atol=1e-10, rtol=1e-10)
    np.testing.assert_allclose(gel.diffusivity(phi, T), modulus + shear, atol=1e-10, rtol=1e-10)


@BOTH
def test_flux_potential_is_the_integral_of_diffusivity(gel):
    phi, T, h = np.linspace(0.02, 0.9, 45), 306.0, 1e-4
    f = [gel.flux_potential(phi + k * h, T) for k in (-2, -1, 1, 2)]
    derivative = (f[0] - 8 * f[1] + 8 * f[2] - f[3]) / (12 * h)
    np.testing.assert_allclose(gel.diffusivity(phi, T), derivative, atol=1e-9, rtol=1e-9)
    assert gel.flux_potential(1e-12, T) == pytest.approx(0, abs=1e-15)


@BOTH
def test_linear_in_temperature_at_fixed_polymer_fraction(gel):
    phi, T = np.linspace(0.02, 0.98, 20)[:, None], np.array([290.0, 300.0, 310.0])
    for quantity in (gel.osmotic_pressure, gel.diffusivity, gel.chi):
        np.testing.assert_allclose(np.diff(quantity(phi, T), n=2), 0, atol=1e-10)


@BOTH
def test_osmotic_pressure_at_both_ends(gel):
    T = np.linspace(300, 315, 4)
    assert (gel.osmotic_pressure(1e-4, T) < 0).all()
    assert (gel.osmotic_pressure(1 - 1e-9, T) > 10).all()


def test_shear_modulus_in_pascal_grows_with_temperature():
    """k_B T/Omega_f scales the dimensionless modulus, which depends on neither T nor phi."""
    k_B, Omega_f = 1.380649e-23, 2.99e-29
    physical = [k_B * T / Omega_f * HHT.shear_modulus(0.05) for T in (300, 310)]
    assert physical[1] / physical[0] == pytest.approx(31 / 30)
    assert HHT.shear_modulus(0.08) / HHT.shear_modulus(0.01) == pytest.approx(2)


def test_low_temperature_asymptote():
    """phi_0 (1 + O(phi_0^{2/3})): exact in the limit, -3/5 in the distance to the singular T."""
    distance = np.array([1e6, 2e6])
    T = HHT.singular_temperature - distance
    phi = HHT.asymptotic_polymer_fraction(T)
    assert np.log2(phi[1] / phi[0]) == pytest.approx(-0.6, abs=1e-9)
    for each, asymptote in zip(T, phi, strict=True):
        assert HHT.equilibrium_polymer_fractions(each).polymer_fraction[0] == pytest.approx(
            asymptote, rel=2 * asymptote ** (2 / 3)
        )
    assert np.isnan(HHT.asymptotic_polymer_fraction(HHT.singular_temperature + 1))


@pytest.mark.parametrize("phi", [0.0, 1.0, -0.1, 1.5, np.nan])
def test_polymer_fraction_outside_its_range_is_refused(phi):
    for call in (HHT.osmotic_pressure, HHT.diffusivity, HHT.flux_potential, HHT.chi):
        with pytest.raises(ValueError, match=r"phi = .*greater than 0 and less than 1"):
            call(np.array([0.5, phi]), 304)


@pytest.mark.parametrize("T", [289.9, 320.1, np.nan])
def test_temperature_outside_validity_is_refused(T):
    with pytest.raises(ValueError, match=r"HHT: T = .* within 290.0 to 320.0 K"):
        HHT.equilibrium_polymer_fraction(T)


def test_no_stable_state_and_unknown_branch_are_refused():
    """No cross-links and good solvent: the gel dissolves."""
    solvent = EnergyBasedGel("solvent", -1, 0, 1e-5, 0, 1e12)
    with pytest.raises(ValueError, match="branch = 'wet'"):
        HHT.equilibrium_polymer_fraction(304, "wet")
    with pytest.raises(ValueError, match="no spinodal tip"):
        solvent.spinodal_tip()
    unbound = EnergyBasedGel("unbound", -1e6, 0, 1e-5, 0, 1e12)
    with pytest.raises(ValueError, match="no stable equilibrium"):
        unbound.equilibrium_polymer_fraction(304)
