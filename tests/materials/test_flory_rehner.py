"""Gels of the literature: against forty digits, their energy, and the gel of appendix A."""

import itertools
from decimal import Decimal, localcontext
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.integrate import quad

from gelpump.materials import from_config

R = 8.31446261815324
PHI = np.array([1e-6, 1e-4, 3e-3, 0.05, 0.0999, 0.1001, 0.3, 0.7, 0.99, 1 - 1e-6, 1 - 1e-9])
FORMS = {
    "linear": {"constant": -3.9, "slope": 0.0142},
    "theta": {"A": -12.0, "Theta": 306.0},
    "enthalpy": {"enthalpy": -7505.0, "entropy": -28.41},
}
CHAINS = {
    "neo-Hookean": {"chain_length": 300.0},
    "affine": {"chain_density": 30.0, "reference_polymer_fraction": 0.07},
    "phantom": {"crosslink_density": 25.0, "reference_polymer_fraction": 0.1, "functionality": 4},
}
IONS = {"none": None, "no salt": (0.3, 0.0), "salt": (1.5, 10.0)}


def block(form, elasticity, ions, chi_2=0.55, chi_3=0.0, **chi):
    return {
        "model": "flory-rehner",
        "chi": {"chi_1": FORMS[form], "chi_2": chi_2, "chi_3": chi_3} | chi,
        "network": {"elasticity": elasticity} | CHAINS[elasticity],
        "temperature_range": [275.0, 345.0],
    } | ({"ions": dict(zip(("charges_per_chain", "salt"), IONS[ions], strict=True))}
         if IONS[ions] else {})  # fmt: skip


def family(form, elasticity, ions):
    """Every family has chi_3 in one of two, and chi of the energy in one of three."""
    chi_3 = 0.15 if ions == "none" else 0.0
    return from_config("gel", block(form, elasticity, ions, chi_3=chi_3))


FAMILIES = [family(*each) for each in itertools.product(FORMS, CHAINS, IONS)]
FOLDER = Path(__file__).resolve().parents[2] / "config/gels"
FAMILIES += [
    from_config(name, yaml.safe_load((FOLDER / f"{name}.yaml").read_text())["gels"][name])
    for name in ("afroze", "hirotsu", "acryloylpyrrolidine", "acrylamide", "polystyrene")
]


class Exact:
    """The gel's equations in 60 decimal digits, written again from their definitions."""

    def __init__(self, gel):
        D = Decimal
        self.p, self.q = [D(x) for x in gel.constant], [D(x) for x in gel.slope]
        self.inverse, self.Omega, self.kappa = gel.inverse, D(float(gel.Omega)), D(float(gel.kappa))
        self.i, self.c = D(float(gel.charge)), D(float(gel.salt))

    def pressure(self, phi, s):
        third = (phi.ln() / 3).exp()
        chi = sum((p + q * s) * phi**k for k, (p, q) in enumerate(zip(self.p, self.q, strict=True)))
        ions = ((self.i * phi) ** 2 + 4 * self.c**2).sqrt() - 2 * self.c
        chains = (self.kappa * phi - third) / self.Omega
        return chains - (1 - phi).ln() - phi - phi**2 * chi + ions

    def modulus(self, phi, s):
        h = phi * min(phi, 1 - phi) * Decimal("1e-12")
        return phi * slope(lambda x: self.pressure(x, s), phi, h)

    def diffusivity(self, phi, s):
        return self.modulus(phi, s) + 4 * (phi.ln() / 3).exp() / (3 * self.Omega)

    def s_of(self, function, phi):
        """s at which a function that is linear in s vanishes."""
        a, b = function(phi, Decimal(0)), function(phi, Decimal(1))
        return a / (a - b)

    def T(self, s):
        return 1 / s if self.inverse else s


def slope(f, x, h):
    """Sixth order, so that h = 1e-12 leaves some fifty digits."""
    return (45 * (f(x + h) - f(x - h)) - 9 * (f(x + 2 * h) - f(x - 2 * h))
            + (f(x + 3 * h) - f(x - 3 * h))) / (60 * h)  # fmt: skip


def root(f, guess, h=Decimal("1e-15")):
    """Newton's from a double-precision guess."""
    x = Decimal(float(guess))
    for _ in range(6):
        x -= f(x) / slope(f, x, x * min(x, 1 - x) * h)
    return x


@pytest.fixture(autouse=True)
def digits():
    with localcontext() as context:
        context.prec = 90
        yield


@pytest.mark.parametrize("gel", FAMILIES, ids=str)
def test_temperatures_folds_and_equilibria_to_twelve_digits(gel):
    exact = Exact(gel)
    for found, function in ((gel.equilibrium_temperature, exact.pressure),
                            (gel.spinodal_temperature, exact.diffusivity)):  # fmt: skip
        for phi, T in zip(PHI, found(PHI), strict=True):
            s = exact.s_of(function, Decimal(float(phi)))
            # s = N/Q is a difference of terms: its digits are those of the largest of them
            size = max(1.0, abs(gel.constant[0]) / abs(float(s) * gel.slope[0]))
            assert float(exact.T(s)) == pytest.approx(T, rel=1e-12 * size), phi
    lowest, highest = gel.temperature_range
    for T in np.linspace(lowest + 1, highest - 1, 6).tolist():
        s = 1 / Decimal(T) if gel.inverse else Decimal(T)
        for phi in gel.equilibrium_polymer_fractions(T).polymer_fraction:
            if phi < 1 - 1e-6:
                truth = root(lambda x, s=s: exact.pressure(x, s), phi)
                assert float(truth) == pytest.approx(phi, rel=1e-12)
        for phi in gel.spinodal_polymer_fractions(T):
            truth = root(lambda x, s=s: exact.diffusivity(x, s), phi)
            assert float(truth) == pytest.approx(phi, rel=1e-12)
    for T, phi in zip(*gel.folds(), strict=True):
        truth = root(lambda x: slope_of_s(exact, exact.pressure, x), phi)
        assert float(exact.T(exact.s_of(exact.pressure, truth))) == pytest.approx(T, rel=1e-12)
        assert float(truth) == pytest.approx(phi, rel=1e-12)


def slope_of_s(exact, function, phi):
    return slope(lambda x: exact.s_of(function, x), phi, phi * (1 - phi) * Decimal("1e-10"))


@pytest.mark.parametrize("gel", FAMILIES, ids=str)
def test_no_equilibrium_and_no_spinodal_is_missed(gel):
    """Signs on a fine mesh at twenty temperatures change exactly at the roots."""
    mesh = np.concatenate([np.geomspace(1e-6, 0.05, 4000), np.linspace(0.05, 0.9999, 8000)])
    lowest, highest = gel.temperature_range
    for T in np.linspace(lowest + 1, highest - 1, 20):
        for function, roots in ((gel.osmotic_pressure, gel.equilibrium_polymer_fractions(T)[0]),
                                (gel.diffusivity, gel.spinodal_polymer_fractions(T))):  # fmt: skip
            values = function(mesh, T)
            changes = np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1]))
            inside = roots[(roots > mesh[0]) & (roots < mesh[-1])]
            assert len(changes) <= len(inside)
            assert (len(inside) - len(changes)) % 2 == 0  # a pair between two points of the mesh
            for i in changes:
                assert np.any((roots >= mesh[i]) & (roots <= mesh[i + 1]))


@pytest.mark.parametrize("gel", FAMILIES, ids=str)
def test_thermodynamic_identities(gel):
    """D and its relatives from Pi; the spinodal where D vanishes; all by other means."""
    phi, T = np.array([0.003, 0.03, 0.2, 0.6, 0.95]), 307.0
    h = 1e-5 * phi

    def along(f):
        return (8 * (f(phi + h, T) - f(phi - h, T)) - f(phi + 2 * h, T) + f(phi - 2 * h, T)) / (
            12 * h
        )

    np.testing.assert_allclose(gel.osmotic_modulus(phi, T), phi * along(gel.osmotic_pressure), 1e-7)
    pressure = phi**2 * along(gel.osmotic_energy)
    np.testing.assert_allclose(pressure, gel.osmotic_pressure(phi, T), rtol=1e-7, atol=1e-11)
    for phi_00 in (0.05, 1.0):
        deviatoric = 4 / 3 * gel.shear_modulus(phi_00) * np.cbrt(phi / phi_00)
        D = gel.osmotic_modulus(phi, T) + deviatoric
        np.testing.assert_allclose(gel.diffusivity(phi, T), D, rtol=1e-12)
    for end, integral in zip(phi, gel.flux_potential(phi, T), strict=True):
        found = quad(lambda x: float(gel.diffusivity(x, T)), 0, end, epsabs=0, epsrel=1e-11)
        assert integral == pytest.approx(found[0], rel=1e-9)
    for x in gel.spinodal_polymer_fractions(T):
        assert abs(gel.diffusivity(x, T)) < 1e-10


@pytest.mark.parametrize(("elasticity", "of"), itertools.product(CHAINS, ("pressure", "energy")))
def test_the_pressure_is_the_slope_of_the_energy(elasticity, of):
    """Pi = phi^2 d(F/phi)/dphi with F per volume, chains by their own stored energy."""
    chi = {"of": "free-energy"} if of == "energy" else {}
    given = block("theta", elasticity, "no salt", chi_3=0.2, **chi)
    gel, T = from_config("gel", given), 301.0
    network, v = given["network"], 1.8e-5
    phi_ref = network.get("reference_polymer_fraction", 1.0)
    n = {"neo-Hookean": phi_ref / 300.0, "affine": 30.0 * v, "phantom": 2 * 25.0 * v}[elasticity]
    b = {"neo-Hookean": 2, "affine": 1, "phantom": 0}[elasticity]
    front = 0.5 if elasticity == "phantom" else 1.0
    g = [0.5 + 12.0 * (1 - 306.0 / T), 0.55, 0.2]

    def per_polymer(phi):  # F/phi in k_B T/v
        lam2 = (phi_ref / phi) ** (2 / 3)
        chains = front * n / 2 * (3 * lam2 - 3 - b * np.log(phi_ref / phi)) / phi_ref
        ions = 0.3 * n / phi_ref * np.log(phi)
        if of == "energy":
            mixing = (1 - phi) * (g[0] + g[1] * phi + g[2] * phi**2)
        else:  # the energy whose chemical potential has chi phi^2: -integral of chi
            mixing = -(g[0] * phi + g[1] * phi**2 / 2 + g[2] * phi**3 / 3)
        return chains + ions + (1 / phi - 1) * np.log1p(-phi) + mixing

    phi = np.array([0.02, 0.1, 0.4, 0.8])
    h = 1e-4 * phi
    derivative = (8 * (per_polymer(phi + h) - per_polymer(phi - h))
                  - per_polymer(phi + 2 * h) + per_polymer(phi - 2 * h)) / (12 * h)  # fmt: skip
    np.testing.assert_allclose(gel.osmotic_pressure(phi, T), phi**2 * derivative, rtol=1e-7)


def test_the_gel_of_appendix_a_is_one_of_them(anb, hht):
    for old in (anb, hht):
        new = from_config(old.name, {
            "model": "flory-rehner",
            "chi": {"of": "free-energy", "chi_1": {"constant": old.A0, "slope": old.B0},
                    "chi_2": {"constant": old.A1, "slope": old.B1}},
            "network": {"elasticity": "neo-Hookean", "chain_length": old.Omega},
            "temperature_range": [290.0, 320.0],
        })  # fmt: skip
        phi = np.geomspace(1e-4, 0.99, 50)
        for each in ("osmotic_pressure", "diffusivity", "flux_potential", "osmotic_energy"):
            mine, theirs = (getattr(gel, each)(phi, 306.0) for gel in (new, old))
            np.testing.assert_allclose(mine, theirs, rtol=1e-9, atol=1e-13)
        np.testing.assert_allclose(new.folds().temperature, old.folds().temperature, rtol=1e-13)
        np.testing.assert_allclose(new.spinodal_tip(), old.spinodal_tip(), rtol=1e-7)
        assert new.singular_temperature == pytest.approx(old.singular_temperature, rel=1e-13)


def test_what_fixes_the_chains_is_the_same_gel():
    """Chain length, chains, junctions and modulus that mean the same give the same numbers."""
    base = block("linear", "phantom", "none")
    n = 2 * 25.0 * 1.8e-5
    ways = [
        {"crosslink_density": 25.0},
        {"chain_density": 50.0},
        {"chain_length": 0.1 / n},
        {"shear_modulus": 0.5 * n * R * 298.0 / 1.8e-5, "shear_modulus_temperature": 298.0},
    ]
    network = {"elasticity": "phantom", "reference_polymer_fraction": 0.1}
    gels = [from_config("gel", base | {"network": network | way}) for way in ways]
    for each in gels[1:]:
        assert each.Omega == pytest.approx(gels[0].Omega, rel=1e-14)
    G = gels[0].shear_modulus(0.1) * R * 298.0 / 1.8e-5  # of the relaxed state, in pascal
    assert pytest.approx(ways[3]["shear_modulus"], rel=1e-12) == G


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"chi": 3}, "gel.chi = 3: must be a block"),
        ({"chi": {}}, "gel.chi.chi_1 is missing"),
        ({"chi": {"chi_1": 0.4}}, "no coefficient depends on temperature"),
        ({"chi": {"chi_1": {"A": 1.0}}}, "gel.chi.chi_1 = {'A': 1.0}: must be a number or have"),
        ({"chi": {"chi_1": {"A": 1.0, "Theta": -3.0}}}, "gel.chi.chi_1.Theta = -3.0: must be"),
        ({"chi": {"chi_1": FORMS["theta"], "chi_2": FORMS["linear"]}},
         "all be linear in T or all in 1/T"),
        ({"chi": {"chi_1": FORMS["theta"], "of": "water"}}, "gel.chi.of = 'water': must be one"),
        ({"chi": {"chi_1": FORMS["theta"], "chi_4": 1}}, "gel.chi.chi_4 = 1: unknown key"),
        ({"network": {"chain_length": 9.0}}, "gel.network.elasticity is missing"),
        ({"network": {"elasticity": "affine"}}, "must have one of ['chain_length'"),
        ({"network": {"elasticity": "affine", "chain_length": 1, "chain_density": 2}}, "has ["),
        ({"network": {"elasticity": "affine", "shear_modulus": 1e3}}, "shear_modulus_temperature"),
        ({"network": {"elasticity": "stiff", "chain_length": 9}}, "network.elasticity = 'stiff'"),
        ({"network": {"elasticity": "phantom", "chain_length": 9, "functionality": 2}}, "than 2"),
        ({"ions": {"charges_per_chain": -1}}, "gel.ions.charges_per_chain = -1: must be"),
        ({"ions": {"salt": 1.0}}, "gel.ions.charges_per_chain is missing"),
        ({"omega": 3}, "gel.omega = 3: unknown key"),
    ],
)  # fmt: skip
def test_refusals(change, told):
    with pytest.raises(ValueError, match=r"^gel") as refusal:
        from_config("gel", block("linear", "affine", "none") | change)
    assert told in str(refusal.value)


def test_a_bead_of_one_of_them_swells_and_ends_in_equilibrium():
    from gelpump.bead import lens

    gel = from_config("gel", block("linear", "affine", "none", chi_2=0.3))
    phi = gel.equilibrium_polymer_fraction(305.0)
    run = lens.solve(gel, 290.0, phi, np.linspace(0, 30.0, 13), 40, tolerance=1e-4)
    assert not run.attrs["stopped"]
    end = gel.equilibrium_polymer_fraction(290.0)
    np.testing.assert_allclose(run.polymer_fraction[-1], end, rtol=1e-4)
