"""Everything known of a design in one dataset, from which the sheet and the CSV are made."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import xarray as xr

from gelpump.design import units, validity
from gelpump.design.description import Design, DesignError
from gelpump.design.device import results
from gelpump.design.gel_errors import gel_note
from gelpump.design.inverse import ranges
from gelpump.design.result import AMBER, GREEN, LIGHTS
from gelpump.design.solve import solve

if TYPE_CHECKING:
    from gelpump.materials.measured import Fit


ONE_PHASE_ONLY = "tau_99", "response_time", "recovery_time"


def assemble(
    design: Design,
    numerics: Mapping[str, Any],
    gel_errors: Mapping[str, float] | DesignError | None = None,
    fit: "Fit | None" = None,
) -> xr.Dataset:
    """The solved device with scalars for each number, light_* for each assumption and range_* for
    each answer to what is wanted (dims ``lights``: no light red, all green; ``end``).

    ``gel_errors`` are those of a measured gel (`gelpump.design.gel_errors`), or why there are none;
    ``fit`` is its fit, whose warnings are said.
    """
    data, measured = solve(design, numerics)
    # a tube that is not solved has no times of a gel in one phase either
    left_out = ONE_PHASE_ONLY if "unsolved" in data.attrs else ()
    found = [each for each in results(design) if each.key not in left_out] + measured
    lights = [
        *([validity.fitted(fit)] if fit else []),
        *validity.before_solving(design),
        *validity.after_solving(design, data),
    ]
    measured_error = validity.measured_linearity({each.key: each for each in measured})
    lights = [
        measured_error if measured_error and each.criterion is validity.LINEAR else each
        for each in lights
    ]
    if data.attrs.get("stopped"):
        lights = [
            validity.Light(each.criterion, -1.0, data.attrs["stopped"])
            if each.criterion is validity.ONE_PHASE
            else each
            for each in lights
        ]
    extra = {}
    for each in found:
        extra[each.key] = _scalar(
            each.value, each.unit, each.text, source_equation=each.source, symbol=each.symbol
        )
        if each.uncertainty is not None:
            extra[f"{each.key}_uncertainty"] = _scalar(
                each.uncertainty, each.unit, f"numerical uncertainty: {each.text}"
            )
        if isinstance(gel_errors, Mapping) and gel_errors.get(each.key):
            extra[f"{each.key}_gel_error"] = _scalar(
                gel_errors[each.key], each.unit, f"standard error of the measured gel: {each.text}"
            )
    for each in lights:
        extra[f"light_{each.criterion.key}"] = (
            (),
            LIGHTS.index(each.light),
            {
                "long_name": each.criterion.text,
                "flag_values": [0, 1, 2],
                "flag_meanings": " ".join(LIGHTS),
                "reason": each.reason,
                "judged_by": f"{each.criterion.symbol} = {each.value:.6g}",
                "limits": _limits(each.criterion),
                "source_equation": each.criterion.source,
            },
        )
    if design.wanted:
        wanted = units.si(design.wanted["response_time"], "s")
        now = {each.key: each.value for each in found}.get("response_time")
        extra["wanted_response_time"] = _scalar(wanted, "s", "longest response time wanted")
        if now is not None:
            asked = [ranges(design, wanted, now, lights) for lights in (AMBER, GREEN)]
            for loose, strict in zip(*asked, strict=True):
                extra[f"range_{loose.key}"] = (
                    ("lights", "end"),
                    [[loose.low, loose.high], [strict.low, strict.high]],
                    {
                        "units": loose.unit,
                        "long_name": loose.text,
                        "now": loose.now,
                        "set_by": f"{loose.low_by}; {loose.high_by}",
                        "set_by_green": f"{strict.low_by}; {strict.high_by}",
                        "comment": "from low to high for no light red, then for all green; "
                        "empty if low > high",
                    },
                )
    return data.assign(extra).assign_attrs(
        design=design.name,
        kind=design.kind,
        design_title=design.title,
        material=f"{design.material.name}: {design.material.derived}",
        **({} if gel_errors is None else {"gel_note": gel_note(gel_errors)}),
        **(
            {"gel_warnings": f"Of the gel’s fit: {'; '.join(fit.warnings)}."}
            if fit and fit.warnings
            else {}
        ),
    )


def _limits(criterion) -> str:
    sign = "≥" if criterion.large else "≤"
    amber = f"{criterion.amber:g}" if criterion.amber > 1e-9 else "0"
    return f"green {sign} {criterion.green:g}, amber {sign} {amber}"


def _scalar(value, unit, text, **attributes):
    return (), float(value), {"units": unit, "long_name": text} | attributes


def numbers(data: xr.Dataset) -> list[str]:
    """The keys of the numbers, in their order."""
    return [name for name, each in data.data_vars.items() if "symbol" in each.attrs]


def lights(data: xr.Dataset) -> list[str]:
    """The keys of the lights."""
    return [name for name in data.data_vars if str(name).startswith("light_")]


def answers(data: xr.Dataset) -> list[str]:
    """The keys of the ranges."""
    return [name for name in data.data_vars if str(name).startswith("range_")]


def csv_rows(data: xr.Dataset) -> Iterator[tuple[str, ...]]:
    """Rows of key, meaning, value, unit, numerical uncertainty, standard error of the measured gel,
    source, one a number, light or range end; what to beware of in a measured gel comes first."""
    if "gel_warnings" in data.attrs:
        yield "gel_warnings", data.attrs["gel_warnings"], "", "", "", "", "measured equilibria"
    for key in numbers(data):
        each = data[key]
        errors = [
            f"{float(data[error]):.3g}" if error in data else ""
            for error in (f"{key}_uncertainty", f"{key}_gel_error")
        ]
        yield key, each.long_name, f"{float(each):.10g}", each.units, *errors, each.source_equation
    for key in lights(data):
        each = data[key]
        yield key, each.long_name, LIGHTS[int(each)], "", "", "", f"{each.judged_by}; {each.limits}"
    for key in answers(data):
        each = data[key]
        for row, asked in enumerate(("no light red", "all green")):
            for column, end in enumerate(("low", "high")):
                yield (f"{key}_{end}", f"{each.long_name}, {asked}",
                       f"{float(each[row, column]):.10g}", each.units, "", "",
                       (each.set_by, each.set_by_green)[row].split("; ")[column])  # fmt: skip
