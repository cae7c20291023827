"""What the sheet of a design says, as rows of text, and the sheet in HTML."""

from __future__ import annotations

from importlib.resources import files
from typing import TYPE_CHECKING, NamedTuple

from gelpump.design import dataset, units
from gelpump.design.result import LIGHTS

if TYPE_CHECKING:
    import xarray as xr

MARKS = {"green": "●", "amber": "▲", "red": "■"}  # told apart without colours


class LightRow(NamedTuple):
    """A light, its mark, what it is about, why, and its limits with their source."""

    light: str
    mark: str
    text: str
    reason: str
    limits: str
    source: str


def shown(value: float, unit: str) -> tuple[float, str]:
    """A number and a unit as they are read."""
    number, chosen = units.shown(value, unit)
    return number, units.readable(chosen)


def said(value: float, unit: str, digits: int = 4) -> str:
    """A number with its unit."""
    number, chosen = shown(value, unit)
    return f"{units.told(number, digits)} {chosen}".strip()


def subtitle(data: xr.Dataset) -> str:
    """Which gel, and where its numbers come from."""
    return data.attrs["material"]


def number_rows(data: xr.Dataset) -> list[tuple[str, str, str, str]]:
    """Meaning, value, uncertainty and source of each number."""
    rows = []
    for key in dataset.numbers(data):
        each = data[key]
        errors = [
            f"{of} {units.told(100 * abs(float(data[error]) / float(each)), 2)} %"
            for of, error in (("±", f"{key}_uncertainty"), ("gel ±", f"{key}_gel_error"))
            if error in data and float(each)
        ]
        rows.append(
            (each.long_name, said(float(each), each.units), ", ".join(errors), each.source_equation)
        )
    return rows


def notes(data: xr.Dataset) -> list[str]:
    """What has to be said beside the numbers."""
    keys = ("gel_warnings", "front_note", "pump_note", "own_gel_note", "cycle_note", "gel_note")
    found = [data.attrs[key] for key in keys if key in data.attrs]
    if "wanted_response_time" in data and "response_time" not in data:
        why = data.attrs.get("unsolved") or (
            "the bead did not make 99 % of its change of radius ("
            f"{data.attrs.get('stopped') or 'it is slower than we waited for'})"
        )
        found.append(f"There is no response time to compare with the one wanted: {why}.")
    if dataset.answers(data):
        said = "Ranges are of one parameter at a time, the others as designed"
        if data.attrs["kind"] == "tube":
            said += (
                "; heat, closeness and the lumen's pressure and flow are judged by building the "
                "change. Their time is that of the wall resolved in r, the longer of the two told: "
                f"with Φ = Φ₀ on its surfaces {_slower(data, 'resolved')} times that printed, with "
                f"no force on them {_slower(data, 'forceless')} times"
            )
        found.append(f"{said}.")
    return found


def _slower(data, which):
    return units.told(float(data[f"response_time_{which}"] / data.response_time), 2)


def light_rows(data: xr.Dataset) -> list[LightRow]:
    """Each light with its reason."""
    rows = []
    for key in dataset.lights(data):
        each, light = data[key], LIGHTS[int(data[key])]
        rows.append(LightRow(light, MARKS[light], each.long_name, each.reason,
                             f"{each.judged_by.split(' = ')[0]}: {each.limits}",
                             each.source_equation))  # fmt: skip
    return rows


def question(data: xr.Dataset) -> str:
    """What was wanted."""
    return f"What responds within {said(float(data.wanted_response_time), 's')}?"


def answer_rows(data: xr.Dataset) -> list[tuple[str, str, str]]:
    """Parameter, the range with no light red and what sets it, the range with all green."""
    rows = []
    for key in dataset.answers(data):
        each = data[key]
        text = []
        for row in range(2):
            low, high = map(float, each[row])
            text.append(_span(low, high, each.units) if low <= high else "none")
        below, above = each.set_by.split("; ")
        loose = (
            f"none, whatever it is ({below})"
            if below == above
            else f"{text[0]} (set by: {below}; {above})"
        )
        rows.append((each.long_name, loose, f"all green: {text[1]}"))
    return rows


def _span(low, high, unit):
    numbers, chosen = zip(*(shown(end, unit) for end in (low, high)), strict=True)
    ends = [units.told(number, 3) for number in numbers]
    if chosen[0] == chosen[1]:
        return f"{ends[0]} to {ends[1]} {chosen[1]}".strip()
    return f"{ends[0]} {chosen[0]} to {ends[1]} {chosen[1]}"


def html(data: xr.Dataset, svg: str) -> str:
    """The sheet as a page that needs no other file."""
    import jinja2

    template = files("gelpump.design").joinpath("sheet.html.j2").read_text(encoding="utf-8")
    environment = jinja2.Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True)
    return environment.from_string(template).render(
        title=data.attrs["design_title"],
        subtitle=subtitle(data),
        numbers=number_rows(data),
        lights=light_rows(data),
        question=question(data) if "wanted_response_time" in data else "",
        answers=answer_rows(data),
        notes=notes(data),
        svg=svg[svg.index("<svg") :],
    )
