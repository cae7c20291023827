"""Any parameters of a gel: a physically valid gel, or a refusal that names the key."""

import warnings

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from refusals import refused

from gelpump import netcdf
from gelpump.materials import from_config
from gelpump.materials.tables import tabulated

NUMBERS = st.floats(allow_nan=True, allow_infinity=True)
ANYTHING = st.one_of(
    NUMBERS,
    st.integers(),
    st.just(10**400),
    st.booleans(),
    st.none(),
    st.text(max_size=5),
    st.lists(NUMBERS, max_size=3),
    st.dictionaries(st.text(max_size=3), st.none(), max_size=1),
)
# interaction parameters between a hundred times weaker and stronger than table 2 has them
PLAUSIBLE = {
    "model": st.just("energy-based"),
    "A0": st.floats(-100.0, 100.0),
    "A1": st.floats(-100.0, 100.0),
    "B0": st.floats(-0.5, 0.5),
    "B1": st.floats(-0.5, 0.5),
    "Omega": st.floats(1.0, 1e4),
    "temperature_range": st.just([280.0, 330.0]),
}
HHT = {
    "model": "energy-based",
    "A0": -62.22,
    "A1": -58.28,
    "B0": 0.2047,
    "B1": 0.19044,
    "Omega": 720.0,
    "temperature_range": [290.0, 320.0],
}
LINEAR = {"model": "piecewise-linear", "Phi_inf": 2.0, "Pi_ratio": 1.0, "M": 1.0}


@given(st.sampled_from([HHT, LINEAR]), st.data())
@settings(max_examples=300)
def test_a_value_of_any_kind_is_taken_or_refused_by_name(block, data):
    key = data.draw(st.sampled_from(sorted(block)))
    value = data.draw(ANYTHING)
    with refused(ValueError, f"gel.{key}", "B0 = B1 = 0"):
        taken = getattr(from_config("gel", block | {key: value}), key)
        assert np.all(np.isfinite(taken))


@given(st.dictionaries(st.text(max_size=8), ANYTHING, max_size=6))
def test_a_block_of_any_keys_is_refused_in_words(block):
    with pytest.raises(ValueError, match=r"gel\."):
        from_config("gel", block)


CHI = st.one_of(
    st.floats(-3.0, 3.0),
    st.fixed_dictionaries({"constant": st.floats(-30.0, 30.0), "slope": st.floats(-0.1, 0.1)}),
    st.fixed_dictionaries({"A": st.floats(-30.0, 30.0), "Theta": st.floats(250.0, 400.0)}),
)
LITERATURE = st.fixed_dictionaries({
    "model": st.just("flory-rehner"),
    "chi": st.fixed_dictionaries(
        {"chi_1": CHI}, optional={"chi_2": CHI, "chi_3": CHI, "of": st.just("free-energy")}
    ),
    "network": st.fixed_dictionaries({
        "elasticity": st.sampled_from(["neo-Hookean", "affine", "phantom"]),
        "reference_polymer_fraction": st.floats(0.01, 1.0),
        "chain_length": st.floats(2.0, 1e4),
    }),
    "temperature_range": st.just([280.0, 330.0]),
})  # fmt: skip


@given(LITERATURE, st.data())
@settings(max_examples=300)
def test_a_gel_of_the_literature_is_taken_or_refused_by_name(block, data):
    """Any value in place of any key, at any depth, or any key beside them."""
    whole = {**block, "ions": {"charges_per_chain": 1.0, "salt": 3.0}}
    inside = data.draw(st.sampled_from([(), ("chi",), ("network",), ("ions",)]))
    target = dict(whole)
    for key in inside:
        target = whole[key] = dict(whole[key])
    if not inside:
        whole = target
    target[data.draw(st.sampled_from([*target, "x"]))] = data.draw(ANYTHING)
    with refused(ValueError, "gel"):
        gel = from_config("gel", whole)
        assert np.isfinite(gel.osmotic_pressure(0.3, 300.0))


@given(LITERATURE, st.floats(281.0, 329.0))
@settings(max_examples=150)
def test_what_a_gel_of_the_literature_says_holds(block, T):
    with refused(ValueError, "no coefficient depends", "all be linear in T") as refusal:
        gel = from_config("gel", block)
    if refusal.happened:
        return
    phi, stable = gel.equilibrium_polymer_fractions(T)
    assert np.all(np.diff(phi) > 0)
    away = (1 - phi > 1e-6) & (phi > 1e-8)
    below, above = (gel.osmotic_pressure(phi[away] * s, T) for s in (1 - 1e-9, 1 + 1e-9))
    assert np.all(below * above <= 0)
    if len(phi) > 1:  # stable and unstable equilibria alternate
        assert np.all(stable[1:] != stable[:-1])
    for root in gel.spinodal_polymer_fractions(T):
        low, high = (gel.diffusivity(root * s, T) for s in (1 - 1e-9, 1 + 1e-9))
        assert low * high <= 0 or root > 1 - 1e-6
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        table = tabulated(gel, [300.0, 310.0], 101)
    for name, values in table.variables.items():
        assert np.all(np.isfinite(values)), name


@given(st.fixed_dictionaries(PLAUSIBLE), st.floats(280.0, 330.0))
@settings(max_examples=150)
def test_equilibria_and_spinodals_are_what_they_say(block, T):
    with refused(ValueError, "B0 = B1 = 0") as refusal:
        gel = from_config("gel", block)
    if refusal.happened:
        return
    phi, stable = gel.equilibrium_polymer_fractions(T)
    assert np.all((phi > 0) & (phi < 1))
    assert np.all(np.diff(phi) > 0)
    away = 1 - phi > 1e-6  # nearer to 1 the next numbers are too far apart
    below, above = (gel.osmotic_pressure(phi[away] * s, T) for s in (1 - 1e-9, 1 + 1e-9))
    assert np.all(below * above <= 0)
    if stable.any():
        swollen = gel.equilibrium_polymer_fraction(T, "swollen")
        assert swollen <= gel.equilibrium_polymer_fraction(T, "dry")
        assert gel.diffusivity(swollen, T) > 0  # stable against uniform swelling, so D > 0 too
    else:
        with pytest.raises(ValueError, match="no stable equilibrium"):
            gel.equilibrium_polymer_fraction(T)
    for spinodal in gel.spinodal_polymer_fractions(T):
        assert 0 < spinodal < 1


@given(st.fixed_dictionaries(PLAUSIBLE))
@example({**HHT, "A0": 0.2, "A1": 0.1, "B0": 1e-6, "B1": 0.0})  # no fold, no spinodal
def test_a_table_is_finite_or_refused(tmp_path_factory, block):
    path = tmp_path_factory.mktemp("hostile") / "materials.nc"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        with refused(ValueError, "B0 = B1 = 0") as refusal:
            table = tabulated(from_config("gel", block), [300.0, 310.0], 101)
            netcdf.write(table, path, "a gel", {})
    assert path.exists() != refusal.happened
    if refusal.happened:
        return
    for name, values in netcdf.read(path).variables.items():
        assert np.all(np.isfinite(values)), name


@given(st.floats(), st.floats(allow_nan=False, allow_infinity=False))
def test_a_polymer_fraction_outside_its_bounds_is_refused(phi, T):
    gel = from_config("gel", HHT)
    if 0 < phi < 1:
        return
    for function in (gel.osmotic_pressure, gel.diffusivity, gel.flux_potential):
        with pytest.raises(ValueError, match="polymer fraction phi ="):
            function(phi, T)
