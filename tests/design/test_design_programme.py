"""Programmes in design files, tubes of real gels from them, and the linear picture's error."""

from pathlib import Path

import pytest
import yaml
from conventions import require_cf

from gelpump import netcdf
from gelpump.design import dataset, description, own_gel, programme, sheet

PROJECT = Path(__file__).resolve().parents[2]
GELS = yaml.safe_load((PROJECT / "config/config.yaml").read_text(encoding="utf-8"))["gels"]
ONCE = {"steps": [{"to": "35 degC", "at": "0 s"}, {"to": "29 degC", "at": "2 s"}]}


def design(name, gels=GELS, **changed):
    block = description.read(PROJECT / f"config/designs/{name}.yaml") | changed
    return description.checked(name, block, gels)


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"steps": []}, "programme.steps = []"),
        ({"steps": [{"to": "35 degC"}]}, "programme.steps.0: missing ['at']"),
        ({"steps": [{"to": "35 s", "at": "0 s"}]}, "programme.steps.0.to = '35 s'"),
        ({"steps": [{"to": "35 degC", "at": "-1 s"}]}, "must begin at 0 s or later"),
        ({"steps": [{"to": "35 degC", "at": "1 s", "within": "-1 s"}]}, "must begin at"),
        ({"steps": [*reversed(ONCE["steps"])]}, "must begin at 2 s or later"),
        (ONCE | {"period": "4 s"}, "must have period and cycles, or neither"),
        (ONCE | {"period": "1 s", "cycles": 2}, "must be at least 2 s"),
        (ONCE | {"period": "4 s", "cycles": 0}, "programme.cycles = 0"),
        (ONCE | {"often": 3}, "programme.often = 3: no such key"),
        ({"steps": [{"to": "35 degC", "at": "0 s"}]}, "must have a period and cycles, or a later"),
    ],
)
def test_what_is_no_programme_is_refused_by_its_key(changed, told):
    with pytest.raises(description.DesignError) as refusal:
        design("microtube", programme=changed)
    assert told in str(refusal.value)


def test_a_programme_beyond_the_gel_or_of_a_bead_without_energy_is_refused():
    hot = {"steps": [{"to": "400 K", "at": "0 s"}, {"to": "304 K", "at": "9 s"}]}
    with pytest.raises(description.DesignError, match="T = 400 K: must be within"):
        design("millitube", programme=hot)
    moduli = description.read(PROJECT / "config/designs/microtube.yaml")["gel"]
    with pytest.raises(description.DesignError, match="must be one with an energy"):
        design("bead", gel=moduli, programme=ONCE)


def test_steps_ramps_and_cycles_mean_what_they_say():
    cycles = design("cycled_tube").programme
    T = cycles.temperature
    assert (cycles.period, cycles.count) == (1200, 10)
    assert [round(T.at(t), 6) for t in (0, 599, 630, 700, 1200, 11_999)] == [
        307.5, 307.5, 305.75, 304.0, 307.5, 304.0,
    ]  # fmt: skip


def test_the_sheet_tells_the_linear_pictures_error_and_the_cycles():
    """A tube of the HHT gel between 304 and 307.5 K, from its file."""
    given = description.read(PROJECT / "config/designs/cycled_tube.yaml")
    given["programme"]["cycles"] = 1
    found = description.checked("cycled_tube", given, GELS)
    data = dataset.assemble(found, {"cells": [32, 20], "tolerance": 2e-4, "reach": 10.0})
    own, linear = data.own_gel_pumped_volume, data.final_pumped_volume_conserving
    assert 0 < float(data.own_gel_pumped_volume_uncertainty) < 1e-2 * float(own)
    light = data.light_linearisation
    error = float(light.judged_by.split("=")[1])
    assert error == pytest.approx(abs(float(linear / own) - 1), rel=1e-5)
    assert 0.2 < error < 0.5
    assert "own D" in light.reason
    assert 0 < float(data.cycle_net) < float(data.cycle_stroke) < float(own)
    assert float(data.cycle_stroke_uncertainty) < 1e-2 * float(data.cycle_stroke)
    page = sheet.html(data, "<svg></svg>")
    assert "Of the programme: " in page


def test_the_sheets_dataset_is_one_of_cf(tmp_path):
    found = design("microtube", programme=ONCE | {"period": "4 s", "cycles": 1})
    data = dataset.assemble(found, {"cells": [16, 12], "tolerance": 2e-3, "reach": 8.0})
    path = tmp_path / "design.nc"
    netcdf.write(data, path, "a design", {}, None)
    require_cf([path])
    assert abs(float(data.cycle_net)) < 1e-3 * float(data.cycle_stroke)
    assert "own_gel_pumped_volume" not in data


def test_a_published_set_runs_from_a_file():
    text = (PROJECT / "config/gels/ethylacrylamide.yaml").read_text(encoding="utf-8")
    found = design(
        "cycled_tube", yaml.safe_load(text)["gels"], gel="ethylacrylamide",
        critical_temperature="310 K", heating_step="10 K", permeability="1e-16 m^2",
        programme={"steps": [{"to": "320 K", "at": "0 s"}, {"to": "300 K", "at": "5 min"}]},
    )  # fmt: skip
    (result,), note = own_gel.own_gel(found)
    assert not note
    assert 0 < result.uncertainty < 5e-3 * result.value
    _, numbers, _ = programme.solved(found)
    stroke = {each.key: each for each in numbers}["cycle_stroke"]
    assert 0 < stroke.uncertainty < 5e-3 * stroke.value


def test_a_tube_that_separates_says_where_and_when():
    parting = design("cycled_tube", critical_temperature="306 K", heating_step="2 K")
    results, note = own_gel.own_gel(parting)
    assert not results
    assert "phases separate after" in note
    assert "D < 0" in note
    hot = {"steps": [{"to": "308 K", "at": "10 s"}, {"to": "304 K", "at": "20 s"}]}
    _, numbers, note = programme.solved(design("cycled_tube", programme=hot))
    assert not numbers
    assert "phases separate after" in note


def test_a_bead_breathes():
    steps = [{"to": "307 K", "at": "0 s", "within": "20 s"}, {"to": "304 K", "at": "60 s"}]
    found = design("bead", programme={"steps": steps, "period": "120 s", "cycles": 1})
    data, numbers, note = programme.solved(found)
    assert not note
    least, largest = (each.value for each in numbers)
    assert 0.7 * largest < least < 0.9 * largest
    assert data["programme_radius"][1][0] == pytest.approx(150e-6, rel=1e-6)
