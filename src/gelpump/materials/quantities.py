"""What is measured of a swollen gel, its units, and the polymer fraction that it tells.

    polymer_fraction            phi
    volume_ratio     V/V_ref    phi = phi_ref/(V/V_ref)
    diameter_ratio   d/d_ref    phi = phi_ref/(d/d_ref)^3         (any length that swells alike)
    diameter         d          the same, with d_ref
    mass_ratio       m/m_dry    phi = 1/[1 + (m/m_dry - 1) rho_p/rho_s]
    uptake  (m - m_dry)/m_dry   phi = 1/[1 + uptake rho_p/rho_s]

with phi_ref the polymer fraction of the reference state (1: dry), rho_p and rho_s the densities of
polymer and solvent.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Any

LENGTHS = {"diameter"}
QUANTITIES = (
    "polymer_fraction", "volume_ratio", "diameter_ratio", "diameter", "mass_ratio", "uptake",
)  # fmt: skip
BRACKETS = re.compile(r".*[\[(]([^\[\]()]*)[\])]")
SLASH = re.compile(r".+/\s*([^/\[\]()]+)")
NO_UNIT = {"", "-", "–", "1"}
Convert = Callable[[float], float]


def conversion(quantity: str, reference: Mapping[str, Any]) -> tuple[Convert, Convert]:
    """phi of what was measured (nan where there is none), and its slope. ValueError."""
    needed = {
        "polymer_fraction": (),
        "volume_ratio": ("polymer_fraction",),
        "diameter_ratio": ("polymer_fraction",),
        "diameter": ("polymer_fraction", "diameter"),
        "mass_ratio": ("polymer_density", "solvent_density"),
        "uptake": ("polymer_density", "solvent_density"),
    }[quantity]
    if set(reference) != set(needed):
        raise ValueError(f"{quantity}: reference has {sorted(reference)}: must have {list(needed)}")
    given = {key: _reference(key, reference[key]) for key in needed}
    if quantity == "polymer_fraction":
        return (lambda x: x), (lambda x: 1.0)
    if quantity in ("mass_ratio", "uptake"):
        density = given["polymer_density"] / given["solvent_density"]
        dry = 1.0 if quantity == "mass_ratio" else 0.0
        return (lambda x: 1 / (1 + (x - dry) * density) if x > dry else math.nan), (
            lambda x: density / (1 + (x - dry) * density) ** 2
        )
    phi_ref, d_ref = given["polymer_fraction"], given.get("diameter", 1.0)
    power = 1 if quantity == "volume_ratio" else 3
    return (lambda x: phi_ref * (d_ref / x) ** power if x > 0 else math.nan), (
        lambda x: power * phi_ref * (d_ref / x) ** power / x
    )


def _reference(key, value):
    if key == "polymer_fraction":
        number = isinstance(value, int | float) and not isinstance(value, bool)
        if not number or not 0 < value <= 1:
            raise ValueError(f"reference.{key} = {value!r}: must be greater than 0 and at most 1")
        return float(value)
    from gelpump.design import units

    unit = "m" if key == "diameter" else "kg/m^3"
    try:
        found = units.parsed(value if isinstance(value, str) else "", unit).magnitude
    except ValueError as problem:
        told = f"reference.{key} = {value!r}: {problem}; must be in {unit} or the like"
        raise ValueError(told) from problem
    if not found > 0:
        raise ValueError(f"reference.{key} = {value!r}: must be greater than 0")
    return float(found)


def converter(role: str, error: bool, heading: str, cell: str, units: Mapping[str, Any]) -> Convert:
    """What turns a number of the column of ``role``, or of its error, into K, m or 1.

    heading: of the column; cell: of a row of units; units: those that are told, by role.
    ValueError where no unit is told, or two.
    """
    ratio = role in QUANTITIES and role not in LENGTHS
    told = [_text_of(match) for match in [BRACKETS.fullmatch(heading)] if match]
    if not told and not ratio:
        told = [_text_of(match) for match in [SLASH.fullmatch(heading)] if match]
    name = f"{role}_error" if error else role
    given = units.get(name)
    told = [str(given)] if given is not None else [each for each in (*told, cell) if each]
    if ratio:
        return _ratio_unit(name, told)
    if not told and error and role in units:
        told = [str(units[role])]
    if not told and heading == role and role.startswith("temperature"):
        return lambda value: value  # kelvin, as these names have always been read
    if not told:
        raise ValueError(
            f"{name}: its unit is told neither by the heading {heading!r} nor by a row of units: "
            f"say units: {{{name}: ...}}"
        )
    unit = "m" if role in LENGTHS else "K"
    return _converter(name, told, unit, difference=role == "temperature_error")


def _ratio_unit(name, told):
    kinds = {"%" if each in ("%", "percent") else "1" if each in NO_UNIT else each
             for each in told}  # fmt: skip
    if len(kinds) > 1 or not kinds <= {"%", "1"}:
        raise ValueError(f"{name}: the unit is told as {sorted(told)}: must be 1 or %; say units")
    return (lambda value: value / 100) if kinds == {"%"} else (lambda value: value)


def _converter(name, told, unit, difference):
    from gelpump.design import units

    registry = units.registry()
    found = []
    for text in told:
        try:
            parsed = registry.parse_units(text.replace("º", "°").strip())
            if parsed.dimensionality != registry.parse_units(unit).dimensionality:
                raise ValueError
        except Exception as problem:  # pint raises many things at what it does not know
            told = f"{name}: the unit {text!r} is none of {unit}'s kind; say units"
            raise ValueError(told) from problem
        found.append(parsed)
    if len(set(found)) > 1:
        raise ValueError(f"{name}: the unit is told as {told}: say units")
    if difference:
        size = registry.Quantity(1.0, found[0]) - registry.Quantity(0.0, found[0])
        factor = float(size.to("delta_degC" if unit == "K" else unit).magnitude)
        return lambda value: value * factor
    return lambda value: float(registry.Quantity(value, found[0]).to(unit).magnitude)


def _text_of(match) -> str:
    return match[1].strip()
