"""Are the numbers those of the reference, within what the numerics leave open?

A quantity is a variable at given coordinates (by value, or by index along a dimension without
coordinates), averaged over the other dimensions.  Its tolerance is SAFETY times its numerical
uncertainty, which comes from

- a dataset that holds ``NAME_uncertainty`` for the variable NAME,
- another variable ``{dataset, variable}`` with such an uncertainty, which bounds the relative one
  (in both, ``{dataset}`` in a name stands for the quantity's own),
- or a number: the relative uncertainty of what is computed without meshes or steps.

Two builds that are both within their uncertainty differ by at most twice that.
"""

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gelpump.integrity.problem import Problem

if TYPE_CHECKING:
    import xarray as xr

SAFETY = 2.5
ROUND_OFF = 1e-10  # relative, of the value
UNREADABLE = (KeyError, ValueError, IndexError)

Datasets = Mapping[str, "xr.Dataset"]
Values = dict[str, dict[str, float]]


class Row(NamedTuple):
    """A number here beside the reference's."""

    quantity: str
    reference: float
    here: float
    tolerance: float

    @property
    def difference(self) -> float:
        """Here less reference."""
        return self.here - self.reference

    @property
    def agrees(self) -> bool:
        """Whether the difference is within the tolerance; not a number never is."""
        return bool(abs(self.difference) <= self.tolerance)


def quantities(listed: Sequence[Mapping[str, Any]]) -> Iterator[tuple[str, str, str, dict, Any]]:
    """Name, dataset, variable, coordinates and kind of uncertainty of each quantity."""
    for entry in listed:
        at = entry.get("at", {})
        for dataset, name in product(entry["datasets"], entry["variables"]):
            for values in product(*at.values()):
                where = dict(zip(at, values, strict=True))
                text = ", ".join(f"{dim}={value:g}" for dim, value in where.items())
                label = f"{dataset}: {name}" + (f"({text})" if text else "")
                match entry["uncertainty"]:
                    case str(of):
                        yield label, dataset, name, where, of.format(dataset=dataset)
                    case {"dataset": of, "variable": other}:
                        yield label, dataset, name, where, (of.format(dataset=dataset), other)
                    case relative:
                        yield label, dataset, name, where, relative


def evaluated(listed: Sequence[Mapping[str, Any]], data: Datasets) -> tuple[Values, list[Problem]]:
    """Value and tolerance of each quantity, and those that could not be had."""
    values, problems = {}, []
    for label, dataset, name, where, kind in quantities(listed):
        try:
            value = _mean(data[dataset][name], where)
            tolerance = SAFETY * _uncertainty(data, name, where, kind, value)
        except UNREADABLE as failure:
            problems.append(Problem(label, "not there", f"{type(failure).__name__}: {failure}"))
            continue
        values[label] = _entry(value, tolerance)
    return values, problems


def of_figures(rows: Iterable[Mapping[str, Any]]) -> Values:
    """Value and tolerance of each number of ``figure_numbers.json``."""
    values = {}
    for row in rows:
        numbers = np.atleast_1d(row["value"])
        doubts = np.broadcast_to(row["uncertainty"], numbers.shape)
        for i, (value, doubt) in enumerate(zip(numbers, doubts, strict=True), start=1):
            rank = f", {i} of {numbers.size}" if numbers.size > 1 else ""
            values[f"{row['figure']}: {row['quantity']}{rank}"] = _entry(value, SAFETY * doubt)
    return values


def _entry(value: float, tolerance: float) -> dict[str, float]:
    return {
        "value": float(f"{value:.12g}"),
        "tolerance": float(f"{tolerance + ROUND_OFF * abs(value):.2g}"),
    }


def as_text(record: Mapping[str, Any]) -> str:
    """JSON with one number, its value and tolerance, a line."""
    text = json.dumps(record, indent=1, allow_nan=False, ensure_ascii=False)
    return re.sub(r'{\n +("value": .*)\n +("tolerance": .*)\n +}', r"{\1 \2}", text) + "\n"


def compared(reference: Values, here: Values) -> tuple[list[Row], list[Problem]]:
    """Each number beside the reference's, and what disagrees or stands on one side only."""
    rows = [
        Row(label, old["value"], here[label]["value"], old["tolerance"])
        for label, old in reference.items()
        if label in here
    ]
    problems = [
        Problem(
            row.quantity,
            "differs",
            f"{row.here:.10g}, reference {row.reference:.10g} ± {row.tolerance:.2g}",
        )
        for row in rows
        if not row.agrees
    ]
    for label in sorted(set(here) - set(reference)):
        problems.append(Problem(label, "no reference", "renew it: snakemake renew_reference"))
    for label in sorted(set(reference) - set(here)):
        problems.append(Problem(label, "not compared", "the reference has it, this build has not"))
    return rows, problems


def changes(old: Values, new: Values) -> list[str]:
    """What a renewal changes, one line each: old, new, difference in tolerances."""
    lines = []
    for label in sorted(set(old) | set(new)):
        if label not in old:
            lines.append(f"{label}: new, {new[label]['value']:.10g}")
        elif label not in new:
            lines.append(f"{label}: dropped, was {old[label]['value']:.10g}")
        elif old[label] != new[label]:
            (before, wide), (after, now_wide) = old[label].values(), new[label].values()
            shift = (after - before) / wide if wide else np.inf if after != before else 0.0
            lines.append(
                f"{label}: {before:.10g} -> {after:.10g} ({shift:+.2g} tolerances); "
                f"tolerance {wide:.2g} -> {now_wide:.2g}"
            )
    return lines


def _selected(variable: "xr.DataArray", where: Mapping[str, float]) -> "xr.DataArray":
    """``variable`` at ``where``, where it has such dimensions; ValueError if outside of them."""
    for dim, value in where.items():
        if dim not in variable.dims:
            continue
        if dim not in variable.coords:
            variable = variable.isel({dim: int(value)})
            continue
        coordinate = variable[dim].values
        nearest = int(np.argmin(np.abs(coordinate - value)))
        if np.isclose(coordinate[nearest], value, rtol=1e-9, atol=0.0):
            variable = variable.isel({dim: nearest})
        elif coordinate.min() < value < coordinate.max():
            variable = variable.interp({dim: value})
        else:
            raise ValueError(f"{dim} = {value} is outside the dataset")
    return variable


def _mean(variable: "xr.DataArray", where: Mapping[str, float]) -> float:
    absent = set(where) - set(variable.dims)
    if absent:
        raise KeyError(f"{variable.name} has no {sorted(absent)}")
    value = float(_selected(variable, where).mean(skipna=False))
    if not np.isfinite(value):
        raise ValueError(f"{variable.name} is not finite")
    return value


def _uncertainty(data: Datasets, name: str, where: Mapping[str, float], kind, value) -> float:
    """The largest over what is averaged."""
    match kind:
        case str():
            return float(_selected(data[kind][f"{name}_uncertainty"], where).max())
        case (dataset, other):
            values = data[dataset][other]
            values = values.isel(level=0) if "level" in values.dims else values
            relative = data[dataset][f"{other}_uncertainty"] / abs(values)
            return float(_selected(relative, where).max()) * abs(value)
        case _:
            return kind * abs(value)
