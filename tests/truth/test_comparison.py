"""Production on small meshes, the slender tube beside it, what is drawn and what is stated."""

import numpy as np
import pytest

from gelpump.figures import figX3_fields, figX3_slenderness, style
from gelpump.materials.piecewise_linear import PiecewiseLinearGel
from gelpump.statements import truth as stated
from gelpump.statements.statement import Evidence
from gelpump.truth import production, slenderness, walls
from gelpump.tube.heat import FRONT_CONSTANT
from gelpump.tube.pump import per_advance

GEL = PiecewiseLinearGel(2.0, 1.0, 1.0)


def test_the_conservative_tube_pumps_what_geometry_says():
    ell, T = 0.5, 40.0
    found = slenderness.slender("conservative", GEL, 10.0, [ell], [T], T)
    gain = per_advance(ell, GEL.Phi_inf)["pumped_station"]
    front = FRONT_CONSTANT * np.sqrt(10 * T)
    assert found["pumped"][0, 0] == pytest.approx(gain * front, rel=0.01)
    assert found["V_far"][0, 0] == pytest.approx(gain / ell**2 * front / (2 * T), rel=0.01)


@pytest.fixture(scope="module")
def data():
    ells = [0.5, 0.75, 0.9]
    pulses = production.pulses(GEL, 10.0, ells, [0.3, 1.0], 1.0, (4, 12, 10), 3e-3)
    waves = production.waves(GEL, ells, [0.0, 1.0], (4, 8, 8))
    block = {"Phi_inf": 2.0, "Pi_ratio": 1.0}
    waves = waves.merge(production.other_gels(block, [1.0, 3.0], 0.5, 1.0, (4, 8, 8)))
    times = walls.collapse_times(GEL, [0.5, 0.75], [1.0], 8, 1e-4)
    return {
        "pulses": pulses,
        "waves": waves,
        "walls": times,
        "slenderness": slenderness.slenderness(pulses, times, GEL),
    }


def test_waves_and_pulses_agree_about_a_late_front(data):
    """Pe of the pulse at T = 1 is that of the wave but for 5 % at ell = 0.5."""
    pulse = data["pulses"].sel(ell=0.5, T=1.0)
    wave = data["waves"].sel(ell=0.5, Pe=1.0)
    for name in ("jump", "share", "radius_front"):
        assert float(pulse[name]) == pytest.approx(float(wave[name]), rel=0.03)
    assert float(data["pulses"].water_balance_error) < 1e-12


def test_the_walls_time_is_that_of_the_balanced_closure_and_not_of_the_printed_one(data):
    error = data["slenderness"].tau99_error
    assert (np.abs(error.sel(closure="balanced")) < 0.1).all()
    assert (error.sel(closure="printed") < -0.7).all()
    resolved = data["slenderness"].tau99_resolved_error
    assert (np.abs(resolved.sel(surface="balanced")) < 0.05).all()
    assert (resolved.sel(surface="conservative") < -0.5).all()


def test_a_late_slender_tube_that_conserves_water_pumps_what_the_truth_does(data):
    late = data["slenderness"].sel(T=1.0)
    assert (np.abs(late.pumped_error.sel(closure="conservative")) < 0.03).all()
    assert (np.abs(late.pumped_error.sel(closure="printed")) > 0.2).all()


def test_figures_are_drawn_and_tell_their_numbers(data, tmp_path):
    with style.styled():
        for name, fig in (
            ("map", figX3_slenderness.draw(data["slenderness"])),
            ("fields", figX3_fields.draw(data["pulses"], data["waves"], data["slenderness"])),
        ):
            style.save(fig, [tmp_path / f"{name}.png", tmp_path / f"{name}.csv"])
            assert (tmp_path / f"{name}.csv").stat().st_size > 1000


def test_statements_are_computed(data):
    evidence = Evidence({f"truth/{name}": each for name, each in data.items()}, {}, {}, {}, {}, {})
    values = {}
    for each in stated.statements:
        if "verification" in each.evidence or each.id == "beyond-truth-water":
            continue
        found = each.compute(evidence)
        assert np.isfinite(np.asarray(found.uncertainty, float)).all(), each.id
        values[each.id] = found.value
    assert values["beyond-rest-no-flow"] is True
    assert values["beyond-sheds-ahead"] is False
    assert values["beyond-front-left-behind"] is False
