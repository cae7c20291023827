"""Quasi-static loops: jumps at the folds, not at equal energies."""

import numpy as np
import pytest
import xarray as xr

from gelpump.figures import figX7_hysteresis, style
from gelpump.materials import EnergyBasedGel
from gelpump.separation import diffuse, hysteresis
from gelpump.separation.coexistence import equal_area
from gelpump.separation.energy import ENERGIES

ANB = EnergyBasedGel("ANB", A0=-12.947, A1=17.92, B0=0.04496, B1=-0.0569, Omega=100.0)
LOWER, UPPER = np.sort(ANB.folds().temperature)[-2:]


def loop(model, temperatures, resolution=0.03):
    energy = ENERGIES[model](ANB, 306.0)
    return hysteresis.course(
        model,
        ANB,
        temperatures,
        40,
        kappa=diffuse.kappa_of(energy, 0.1),
        sides=equal_area(energy, 2.0),
        resolution=resolution,
    )


@pytest.mark.parametrize(
    ("temperatures", "fold"), [((305.3, 305.7, 305.9), UPPER), ((305.0, 304.8, 304.6), LOWER)]
)
def test_a_bead_jumps_at_the_fold(temperatures, fold):
    T, a, (before, after), _ = loop("nonlinear", list(temperatures))
    assert min(before, after) < fold < max(before, after)
    assert abs(after - before) <= 0.03
    # on either side of the jump it is the uniform bead that no stress holds
    jump = int(np.argmax(np.abs(np.diff(a)))) + 1
    order = ("swollen", "dry") if temperatures[0] < temperatures[-1] else ("dry", "swollen")
    for part, branch in ((slice(0, jump), order[0]), (slice(jump, None), order[1])):
        for each, radius in zip(T[part], a[part], strict=True):
            assert radius == pytest.approx(
                ANB.equilibrium_polymer_fraction(each, branch) ** (-1 / 3), rel=1e-5
            )


def test_without_a_fold_on_the_way_there_is_no_jump():
    with pytest.raises(hysteresis.Restless, match="no jump"):
        loop("nonlinear", [305.2, 305.5])


def test_energies_are_equal_between_the_folds():
    """Both models have one energy of a uniform bead, but for a constant."""
    found = [hysteresis.equal_energy(model, ANB, LOWER, UPPER) for model in ENERGIES]
    assert found[0] == pytest.approx(305.39, abs=5e-3)
    assert found[1] == pytest.approx(found[0], abs=1e-6)


def test_the_figure_draws_both_ways():
    steps = {"model": ["nonlinear"], "way": ["heating", "cooling"]}
    T, a = [[305.0, 305.8, 305.9], [305.9, 304.8, 304.7]], [[2.0, 1.6, 1.1], [1.1, 1.2, 2.0]]
    data = xr.Dataset(
        {
            "temperature": (("model", "way", "step"), [T]),
            "radius": (("model", "way", "step"), [a]),
            "fold_temperature": ("way", [UPPER, LOWER]),
            "equal_energy_temperature": ("model", [305.4]),
        },
        coords=steps,
        attrs={"gel": "ANB"},
    )
    with style.styled():
        fig = figX7_hysteresis.draw([data, data])
    drawn = {(each.panel, each.name): each.columns for each in fig.series}
    assert set(drawn) == {(p, f"ANB {way}") for p in "ab" for way in steps["way"]}
    np.testing.assert_array_equal(drawn["a", "ANB heating"]["a [R_dry]"], a[0])
