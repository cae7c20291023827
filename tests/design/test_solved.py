"""Solved designs on coarse meshes, in SI units."""

from pathlib import Path

import numpy as np
import pytest
import yaml

from gelpump.design import dataset, description, device, sheet

PROJECT = Path(__file__).resolve().parents[2]
GELS = yaml.safe_load((PROJECT / "config/config.yaml").read_text())["gels"]
TUBE = {"cells": [32, 20], "tolerance": 2e-4, "reach": 10.0}
BEAD = {"cells": 48, "tolerance": 4e-4}


def solved(name, numerics, **changed):
    block = description.read(PROJECT / f"config/designs/{name}.yaml") | changed
    found = description.checked(name, block, GELS)
    return found, dataset.assemble(found, numerics)


@pytest.fixture(scope="module")
def tube():
    return solved("microtube", TUBE)


def test_the_front_ends_at_the_heated_length(tube):
    found, data = tube
    assert float(data.front_position[-1]) == pytest.approx(2e-3, rel=1e-9)
    assert float(data.t[-1]) == pytest.approx(float(data.travel_time), rel=1e-9)
    assert np.allclose(data.front_position, data.front_coefficient * np.sqrt(data.t), rtol=1e-9)
    assert float(data.response_time) == pytest.approx(device.response_time(found))


def test_the_wall_sheds_the_water_of_its_collapse(tube):
    """Behind the front a slice shrinks to 1/Phi_inf of its volume, and is that much shorter."""
    _, data = tube
    swollen = np.pi * ((100e-6) ** 2 - (50e-6) ** 2) * 2e-3
    collapsed = swollen * 2 ** (1 / 3) * (1 - 1 / 2)
    assert float(data.final_shed_volume) == pytest.approx(collapsed, rel=2e-2)


def test_pumped_volumes_are_integrals_of_the_flow(tube):
    _, data = tube
    for form in ("printed", "continuous"):
        flow, t = data[f"flow_far_{form}"].values, data.t.values
        volume = np.trapezoid(flow, t) + flow[0] * t[0] / 2
        assert float(data[f"final_pumped_volume_{form}"]) == pytest.approx(volume, rel=2e-2)


def test_every_number_has_unit_source_and_sane_uncertainty(tube):
    _, data = tube
    for key in dataset.numbers(data):
        assert data[key].source_equation
        if f"{key}_uncertainty" in data:
            assert 0 <= float(data[f"{key}_uncertainty"]) < 0.5 * abs(float(data[key])), key
    assert len(dataset.lights(data)) == 8
    rows = list(dataset.csv_rows(data))
    assert {len(row) for row in rows} == {6}
    page = sheet.html(data, "<svg></svg>")
    assert "What responds within 50 ms?" in page
    assert page.count('class="light"') == 8


def test_a_scaled_bead_responds_with_the_square_of_its_radius():
    _, data = solved("bead", BEAD)
    _, larger = solved("bead", BEAD, radius="0.3 mm")
    assert float(larger.response_time / data.response_time) == pytest.approx(4, rel=1e-6)
    assert float(data.radius[0]) == pytest.approx(150e-6, rel=1e-9)
    assert float(data.radius[-1]) == pytest.approx(float(data.final_radius), rel=2e-3)


def test_a_bead_whose_phases_separate_says_so():
    _, data = solved("bead", BEAD, critical_temperature="306 K", heating_step="2.5 K")
    lights = {row.text: row for row in sheet.light_rows(data)}
    assert lights["phases do not separate on the way"].light == "red"
    assert "response_time" not in data
