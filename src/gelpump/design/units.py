"""Quantities with units: read from text without running any of it, and written for readers.

Text is a number and a unit, "150 um" or "1e-15 m^2". Pint would also evaluate arithmetic; here the
number is a plain one and an exponent a single digit, so that no text can keep it busy.
"""

from __future__ import annotations

import math
import re
from functools import cache
from typing import Any

NUMBER = r"[+-]?(?:\d{1,40}(?:\.\d{0,40})?|\.\d{1,40})(?:[eE][+-]?\d{1,3})?"
UNIT = r"[A-Za-zµμ°%][A-Za-zµμ°%_ ]{0,30}(?:\^-?\d|\*\*-?\d|[²³])?"
TEXT = re.compile(rf"\s*({NUMBER})\s*({UNIT}(?:\s*[*/· ]\s*{UNIT}){{0,5}})?\s*")
LONGEST = 120

# what a sheet shows a dimension in: the first unit in which the number is at least one
SHOWN = {
    "s": ["day", "hour", "minute", "s", "ms", "us"],
    "m": ["m", "mm", "um", "nm"],
    "m/s": ["m/s", "mm/s", "um/s", "nm/s"],
    "m^3": ["mL", "uL", "nL", "pL", "fL"],
    "m^3/s": ["mL/s", "uL/s", "nL/s", "pL/s", "fL/s"],
    "Pa": ["GPa", "MPa", "kPa", "Pa", "mPa"],
}


@cache
def registry() -> Any:
    """Pint's registry; offset units such as degC are turned into kelvin."""
    import pint

    return pint.UnitRegistry(autoconvert_offset_to_baseunit=True)


def parsed(text: str, unit: str) -> Any:
    """The quantity that ``text`` says, in ``unit``.

    ValueError, saying what is wrong, if it is no number with a unit or of another dimension.
    """
    import pint

    match = TEXT.fullmatch(text) if len(text) <= LONGEST else None
    if match is None:
        raise ValueError("is not a number with a unit")
    number, written = float(match[1]), (match[2] or "").strip()
    if not math.isfinite(number):
        raise ValueError("is not a finite number")
    ureg = registry()
    try:
        given = ureg.parse_units(written)
        if given.dimensionality != ureg.parse_units(unit).dimensionality:
            raise ValueError(f"is in {written or 'no unit'}")
        value = ureg.Quantity(number, given)
        value = value.to_base_units() if unit == "K" else value
        value = value.to(unit)
    except pint.UndefinedUnitError as unknown:
        raise ValueError(f"is in {written!r}, which is no unit that is known") from unknown
    except (pint.PintError, OverflowError, AttributeError, TypeError, KeyError) as problem:
        raise ValueError(f"is in {written!r}, which cannot be understood") from problem
    if not (math.isfinite(value.magnitude) and abs(value.magnitude) < 1e60):
        raise ValueError("is not a finite number")
    return value


def is_offset(text: str) -> bool:
    """Whether ``text`` gives a temperature on a scale whose zero is not that of kelvin."""
    match = TEXT.fullmatch(text) if len(text) <= LONGEST else None
    if match is None or not match[2]:
        return False
    unit = registry().parse_units(match[2].strip())
    return not registry().Quantity(1.0, unit)._is_multiplicative


def quantity(value: float, unit: str) -> Any:
    """A pint quantity."""
    return registry().Quantity(value, unit)


def si(value: Any, unit: str) -> float:
    """The magnitude of a pint quantity in ``unit``; pint's DimensionalityError if it is another."""
    return float(value.to(unit).magnitude)


def shown(value: float, unit: str) -> tuple[float, str]:
    """The number and unit that a reader is shown of ``value`` in the SI unit ``unit``."""
    choices = SHOWN.get(unit)
    if not choices:
        return value, "" if unit == "1" else unit
    given = quantity(value, unit)
    for choice in choices:
        number = float(given.to(choice).magnitude)
        if abs(number) >= 0.9995:
            break
    return number, choice


RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def told(value: float, digits: int = 3) -> str:
    """A number as it is typeset: with a power of ten where it is very large or small."""
    rounded = float(f"{value:.{digits}g}")
    if rounded == 0 or not math.isfinite(rounded) or 1e-3 <= abs(rounded) < 1e5:
        return f"{rounded:.10g}".replace("-", "−")
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    power = "10" + str(int(exponent)).translate(RAISED)
    signed = {"1": power, "-1": f"−{power}"}
    return signed.get(mantissa, f"{mantissa} × {power}".replace("-", "−"))


def readable(unit: str) -> str:
    """A unit as it is typeset: superscripts for exponents, the Greek letter for micro."""
    text = re.sub(r"^u(?=[A-Za-z])|(?<=[ /])u(?=[A-Za-z])", "µ", unit)
    text = re.sub(r"(?:\^|\*\*)(-?\d)", lambda m: m[1].translate(RAISED), text)
    return {"minute": "min", "hour": "h", "day": "d", "m/s⁰.5": "m/√s"}.get(text, text)
