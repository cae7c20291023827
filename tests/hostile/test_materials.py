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
