"""Jumps of temperature: the stretch with D < 0 is that of a walk along the way."""

import numpy as np
import pytest

from gelpump.materials import from_config
from gelpump.materials.jumps import jump

TEMPERATURES = np.arange(291.0, 320.0, 1.37)


@pytest.mark.parametrize("name", ["anb", "hht"])
def test_the_stretch_is_what_a_walk_meets(name, request):
    """All jumps between 22 temperatures, heating and cooling, from inside and outside."""
    gel, kinds = request.getfixturevalue(name), set()
    for before in TEMPERATURES:
        for after in TEMPERATURES[before != TEMPERATURES]:
            found = jump(gel, before, after)
            way = np.linspace(found.start, found.end, 4001)[1:-1]
            negative = way[gel.diffusivity(way, after) < 0]
            assert bool(found.unstable) == bool(negative.size), (before, after)
            if not negative.size:
                continue
            [(first, last)] = found.unstable
            step = abs(way[1] - way[0])
            assert first == pytest.approx(negative[0], abs=1.01 * step)
            assert last == pytest.approx(negative[-1], abs=1.01 * step)
            kinds.add((after > before, first == found.start))
    assert {(True, True), (True, False)} <= kinds  # heating, from inside and from outside
    if name == "anb":  # whose hysteresis reaches below the spinodal's tip
        assert any(not heating for heating, _ in kinds)


def test_hht_to_312_begins_inside(hht):
    found = jump(hht, 304.0, 312.0)
    [(first, last)] = found.unstable
    assert first == found.start == pytest.approx(0.052, abs=5e-4)
    assert last == pytest.approx(0.854, abs=5e-4)
    assert "with D < 0 from the start, phi = 0.0523 to 0.854: phases separate" in str(found)


def test_a_gel_that_swells_when_heated_keeps_its_dry_branch():
    """Within the hysteresis the branch is that which it comes from."""
    chi = {"chi_1": {"A": 6.0, "Theta": 302.0}, "chi_2": 0.7}
    mirrored = chi | {"chi_1": {"A": -6.0, "Theta": 302.0}}
    network = {"elasticity": "neo-Hookean", "chain_length": 600.0}
    gel, usual = (
        from_config("mine", {"model": "flory-rehner", "chi": each, "network": network,
                             "temperature_range": [270.0, 345.0]})
        for each in (chi, mirrored)
    )  # fmt: skip
    assert usual.collapses_when_heated
    assert not gel.collapses_when_heated
    inside = gel.folds().temperature.mean()
    dry, swollen = (gel.equilibrium_polymer_fraction(inside, b) for b in ("dry", "swollen"))
    assert dry > 1.5 * swollen
    low, high = gel.folds().temperature.min() - 3, gel.folds().temperature.max() + 3
    assert jump(gel, low, inside).end == dry
    assert jump(gel, high, inside).end == swollen
    assert jump(gel, high, low).unstable  # it collapses


def test_a_jump_is_told(anb, hht):
    assert "phases separate" in str(jump(anb, 303.0, 308.0))
    assert not jump(anb, 298.0, 303.0).unstable
    assert "D > 0 all along" in str(jump(hht, 304.0, 307.6))
    assert "from 304 K to 308 K" in str(jump(hht, 304.0, 308.0))
    (first, last), *_ = jump(anb, 312.0, 304.0).unstable  # cooled: from the dry side
    assert first > last
