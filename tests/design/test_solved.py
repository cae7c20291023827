"""Solved designs on coarse meshes, in SI units."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import yaml
from conventions import require_cf

from gelpump import netcdf
from gelpump.design import dataset, description, device, front, sheet
from gelpump.figures import design as drawing
from gelpump.figures import style
from gelpump.tube.pump import per_advance

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


def test_the_tube_has_the_radii_it_was_given(tube):
    """Both shrink by Phi_1^{1/3}, from 50 and 100 um far ahead of the front."""
    _, data = tube
    for name, swollen in (("inner_radius", 50e-6), ("outer_radius", 100e-6)):
        radius = data[name].values
        np.testing.assert_allclose(radius * np.cbrt(data.polymer_ratio), swollen, rtol=1e-12)
        assert radius[:, -1] == pytest.approx(swollen, rel=1e-4)
        assert data[name].units == "m"


def test_pumped_volumes_are_integrals_of_the_flow(tube):
    _, data = tube
    for form, rough in (("printed", 2e-2), ("conserving", 4e-2)):
        flow, t = data[f"flow_far_{form}"].values, data.t.values
        volume = np.trapezoid(flow, t) + flow[0] * t[0] / 2
        assert float(data[f"final_pumped_volume_{form}"]) == pytest.approx(volume, rel=rough)


def test_every_number_has_unit_source_and_sane_uncertainty(tube):
    _, data = tube
    for key in dataset.numbers(data):
        assert data[key].source_equation
        if f"{key}_uncertainty" in data:
            assert 0 <= float(data[f"{key}_uncertainty"]) < 0.5 * abs(float(data[key])), key
    assert len(dataset.lights(data)) == 9
    rows = list(dataset.csv_rows(data))
    assert {len(row) for row in rows} == {7}
    page = sheet.html(data, "<svg></svg>")
    assert "What responds within 50 ms?" in page
    assert page.count('class="light"') == 9


@pytest.fixture(scope="module")
def bead():
    return solved("bead", BEAD)


def test_a_scaled_bead_responds_with_the_square_of_its_radius(bead):
    _, data = bead
    _, larger = solved("bead", BEAD, radius="0.3 mm")
    assert float(larger.response_time / data.response_time) == pytest.approx(4, rel=1e-6)
    assert float(data.radius[0]) == pytest.approx(150e-6, rel=1e-9)
    assert float(data.radius[-1]) == pytest.approx(float(data.final_radius), rel=2e-3)


def test_a_bead_whose_phases_separate_says_so():
    _, data = solved("bead", BEAD, critical_temperature="306 K", heating_step="2.5 K")
    lights = {row.text: row for row in sheet.light_rows(data)}
    assert lights["phases do not separate on the way"].light == "red"
    assert "response_time" not in data


def test_the_sheet_gives_one_direction_and_one_volume(tube):
    """Of the tube that conserves water, near what geometry says; the printed one beside it."""
    _, data = tube
    pumped, doubt = (
        data.final_pumped_volume_conserving,
        data.final_pumped_volume_conserving_uncertainty,
    )
    parts = float(data.final_collapse_volume + data.final_from_wall_volume)
    assert float(pumped) == pytest.approx(parts, rel=1e-9)
    geometry = np.pi * (100e-6) ** 2 * 2e-3 * per_advance(0.5, 2.0)["pumped_station"]
    assert float(pumped) == pytest.approx(geometry, rel=0.03)
    assert 0 < float(doubt) < 0.05 * float(pumped)
    assert float(data.final_pumped_end_volume) > float(pumped)
    note = sheet.notes(data)[0]
    assert "Water is pumped away from the heated end: " in note
    assert "As printed (eqn:lumen" in note
    assert "does not decide" not in sheet.html(data, "<svg></svg>")


def test_response_times_of_the_resolved_wall_stand_beside_the_printed_one(tube):
    _, data = tube
    ratio = float(data.response_time_resolved / data.response_time)
    assert ratio == pytest.approx(1.72, abs=0.03)
    assert float(data.response_time_forceless) > 2 * float(data.response_time_resolved)
    assert "wall resolved in r, no force" in sheet.html(data, "<svg></svg>")


def test_every_light_is_seen_on_the_sheet():
    """A stout tube that is insulated from outside: all three."""
    _, data = solved("microtube", TUBE, heated_length="0.4 mm", surrounding="insulated")
    rows = {row.text: row for row in sheet.light_rows(data)}
    assert rows["the tube is slender"].light == "amber"
    assert rows["the heat that the collapse takes is small"].light == "red"
    assert rows["the gel is many pores thick"].light == "green"
    page = sheet.html(data, "<svg></svg>")
    for light, mark in sheet.MARKS.items():
        assert f'<tr class="{light}"><td class="light"><span class="mark">{mark}' in page
    assert set(drawing.LIGHT_COLOURS) == set(drawing.LIGHT_MARKERS) == set(sheet.MARKS)
    with style.styled():
        texts = [each.get_text() for each in drawing.page(data).texts]
    assert {"green", "amber", "red"} <= set(texts)


def test_datasets_of_designs_follow_the_cf_conventions(tube, bead, tmp_path):
    files = []
    for name, (_, data) in (("tube", tube), ("bead", bead)):
        files.append(str(tmp_path / f"{name}.nc"))
        netcdf.write(data, files[-1], "a design", {})
    require_cf(files)


@pytest.mark.parametrize("name", ["tube", "bead"])
def test_the_page_keeps_to_its_margins(request, name):
    _, data = request.getfixturevalue(name)
    with style.styled():
        fig = drawing.page(data)
        fig.set_dpi(600)  # text is as wide as in the PDF, not as its pixels make it
        fig.draw_without_rendering()
        boxes = [(t.get_text(), t.get_window_extent()) for t in fig.texts]
    width, height = fig.get_size_inches() * fig.dpi
    rows = {}
    for text, box in boxes:
        assert box.x0 > 0.05 * width, text
        assert box.x1 < 0.96 * width, text
        assert box.y0 > 0.01 * height, text
        rows.setdefault(round(box.y0 + box.y1), []).append((box.x0, box.x1, text))
    for row in rows.values():
        row.sort()
        for (_, end, left), (start, _, right) in pairwise(row):
            assert end < start, (left, right)


@pytest.mark.parametrize(("step", "when"), [("2.2 K", "after "), ("3 K", "at once ")])
def test_a_bead_heated_into_its_spinodal_has_its_sheet(step, when, tmp_path):
    """A red light and the sentence, with what was solved; no response time, and why not."""
    found = {"gel": "HHT", "critical_temperature": "305.5 K", "heating_step": step}
    _, data = solved("bead", BEAD, **found, wanted={"response_time": "2 s"})
    assert int(data.light_one_phase) == 2
    assert data.light_one_phase.reason.startswith(f"phases separate {when}")
    assert (data.sizes["t"] == 1) == (when == "at once ")
    assert "response_time" not in data
    assert data.attrs["stopped"] in "".join(sheet.notes(data))
    with style.styled():
        style.save(drawing.page(data), [tmp_path / "sheet.pdf"])
    assert "phases separate" in sheet.html(data, "<svg/>")
    netcdf.write(data, tmp_path / "bead.nc", "a bead that stops", {})
    assert list(dataset.csv_rows(netcdf.read(tmp_path / "bead.nc")))


def test_a_bead_that_separates_is_told_of_its_front():
    """The front's times are those of the sharp bead on a finer mesh, in seconds; red stays red."""
    from gelpump.separation import energy, sharp

    step = {"gel": "HHT", "critical_temperature": "305.5 K", "heating_step": "3 K"}
    found, data = solved("bead", BEAD, **step)
    gel, start = found.material.gel, found.material.own_start
    run = sharp.solve(
        energy.Nonlinear(gel, 308.5), start, np.linspace(0.0, 0.5, 11), (80, 40), tolerance=1e-6
    )
    R_dry, mu = 150e-6 * start ** (1 / 3), found.material.pressure_unit / gel.Omega
    second = 0.89e-3 * R_dry**2 / (5e-18 * mu)
    there, doubt = data.drying_front_time, float(data.drying_front_time_uncertainty)
    assert abs(float(there) - second * run.completion_t) < doubt < 0.03 * float(there)
    assert float(data.separation_time) == run.birth_t == 0.0
    assert float(data.drying_front_speed) == pytest.approx(150e-6 / float(there))
    assert int(data.light_one_phase) == 2
    assert "response_time" not in data
    assert front.BEAD_NOTE in sheet.notes(data)


def test_a_tube_that_separates_is_told_of_a_bead_as_thick_as_its_wall(tmp_path):
    """From a design's file to its sheet: wall over front speed, and nothing more of the tube."""
    step = {"gel": "HHT", "critical_temperature": "305.5 K", "heating_step": "3 K"}
    found, data = solved("microtube", TUBE, **step)
    same = {"radius": "25 um", "permeability": "1e-15 m^2"}
    bead = description.read(PROJECT / "config/designs/bead.yaml") | step | same
    expected, _ = front.front_of(description.checked("bead", bead, GELS))
    assert [each.key for each in expected] == [
        "separation_time", "drying_front_time", "drying_front_speed"
    ]  # fmt: skip
    for each in expected:
        assert float(data[each.key]) == pytest.approx(each.value, rel=1e-9)
    wall = float(data.wall)
    assert wall == pytest.approx(found.si("a_1") - found.si("a_0"))
    travel = float(data.drying_front_time - data.separation_time)
    assert float(data.drying_front_speed) == pytest.approx(0.5 * wall / travel)
    for claimed in ("response_time", "recovery_time", "final_pumped_volume_conserving"):
        assert claimed not in data
    assert int(data.light_one_phase) == 2
    assert front.TUBE_NOTE in sheet.notes(data)
    assert front.NO_TUBE in sheet.html(data, "<svg/>")
    with style.styled():
        style.save(drawing.page(data), [tmp_path / "sheet.pdf"])
    netcdf.write(data, tmp_path / "tube.nc", "a tube that separates", {})
    assert list(dataset.csv_rows(netcdf.read(tmp_path / "tube.nc")))


def test_a_front_that_is_not_solved_is_no_number():
    step = {"gel": "HHT", "critical_temperature": "305.5 K", "heating_step": "2.5 K"}
    block = description.read(PROJECT / "config/designs/bead.yaml") | step
    told, said = front.front_of(description.checked("bead", block, GELS))
    assert told == []
    assert said.startswith("Phases part, but no front is told: at t = ")


def test_no_front_where_phases_do_not_part(bead, tube):
    for _, data in (bead, tube):
        assert "drying_front_time" not in data
        assert "front_note" not in data.attrs
