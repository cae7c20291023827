"""The inverse question by a scan: its answers are designs, judged forward one by one."""

from dataclasses import replace

import numpy as np
import pytest
from test_design import GELS, block, design

from gelpump.config import ConfigError
from gelpump.design import __main__, description, device, feasible, units, validity
from gelpump.design.result import RED

WANTED = {"response_time": 10.0, "pumped_volume": 2e-9, "wall": 50e-6}


@pytest.fixture(scope="module")
def found():
    return feasible.scan(design("millitube"), WANTED, samples=2048)


def built(one):
    """The design file's device with the numbers of one answer."""
    given = {key: f"{float(one[key]):.15g} {unit}" for key, (unit, _) in feasible.INPUTS.items()}
    a_0 = float(one.ell * one.a_1)
    given |= {"a_0": f"{a_0:.15g} m"}
    del given["ell"]
    return description.checked("mine", block("millitube", **given), GELS)


def test_each_answer_is_a_design_that_does_it(found):
    assert 20 < found.sizes["index"] < found.scanned
    for i in np.linspace(0, found.sizes["index"] - 1, 6).astype(int):
        one = found.isel(index=i)
        mine = built(one)
        printed = device.response_time(mine)
        assert printed < float(one.response_time) <= WANTED["response_time"]
        assert float(one.pumped_volume) >= WANTED["pumped_volume"]
        assert mine.si("a_1") - mine.si("a_0") == pytest.approx(float(one.wall), rel=1e-9)
        assert float(one.wall) >= WANTED["wall"]
        travel = next(each for each in device.results(mine) if each.key == "travel_time")
        assert float(one.travel_time) == pytest.approx(travel.value, rel=1e-12)
        assert all(each.light != RED for each in validity.before_solving(mine))


def test_the_time_is_that_of_the_resolved_wall(found):
    from gelpump.design.solve_tube import wall_results

    one = found.isel(index=int(found.response_time.values.argmin()))
    resolved = max(each.value for each in wall_results(built(one)))
    assert float(one.response_time) == pytest.approx(resolved, rel=2e-3)


def test_volumes_are_those_of_solved_pulses(found):
    some = feasible.confirmed(design("millitube"), found)
    off = np.abs(some.pumped_volume / some.solved_volume - 1)
    assert (off <= some.pumped_volume_uncertainty + 1e-3).all()
    assert (some.best == 1).all()
    assert (np.diff(some.response_time) > 0).all()


def test_the_best_are_not_beaten(found):
    cost = np.array([found.response_time, found.travel_time, -found.pumped_volume])
    for i in range(found.sizes["index"]):
        beaten = (cost <= cost[:, [i]]).all(axis=0)
        beaten[i] = False
        assert beaten.any() != bool(found.best[i]), i


def test_more_wanted_leaves_fewer():
    base, wide = design("millitube"), None
    for factor in (1.0, 0.1):
        wanted = WANTED | {"response_time": factor * WANTED["response_time"]}
        count = feasible.scan(base, wanted, samples=512).sizes["index"]
        assert wide is None or count < wide
        wide = count
    assert not feasible.scan(base, WANTED | {"wall": 1.0}, samples=512).sizes["index"]


def test_what_cannot_be_scanned_is_refused():
    with pytest.raises(ConfigError, match="kind = 'bead'"):
        feasible.scan(design("bead"), WANTED)
    jump = design("millitube", critical_temperature="307.9 K", heating_step="9 K")
    with pytest.raises(ConfigError, match="separates at every heating step"):
        feasible.scan(replace(jump), WANTED)


def test_from_the_command_line(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(feasible, "SAMPLES", 512)
    file = "config/designs/millitube.yaml"
    ask = [file, "--within", "10 s", "--volume", "2 uL", "--inverse", str(tmp_path)]
    assert __main__.main([*ask, "--wall", "50 um"]) == 0
    assert "slender tubes do it" in capsys.readouterr().out
    left = sorted(each.name for each in tmp_path.iterdir())
    assert left == [f"millitube_feasible.{kind}" for kind in ("csv", "nc", "pdf", "png", "svg")]
    assert __main__.main([*ask, "--wall", "1 m"]) == 1
    assert "none of" in capsys.readouterr().err
    for text in ("50 s", "thin", "-1 um"):
        assert __main__.main([*ask, f"--wall={text}"]) == 1
        assert f"--wall = {text!r}" in capsys.readouterr().err


def test_what_is_wanted_may_stand_in_the_file():
    wanted = {"response_time": "10 s", "pumped_volume": "2 uL", "wall": "50 um"}
    found = design("millitube", wanted=wanted).wanted
    assert {key: units.si(found[key], unit) for key, unit in feasible.UNITS.items()} == (
        pytest.approx(WANTED)
    )
