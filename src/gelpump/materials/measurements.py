"""Measured equilibria as people keep them: a table of any columns, read right or refused in words.

Nothing is guessed: separator, decimal sign and units are those that leave one
reading of the whole table, or are told; else the table is refused.

Longer than 300 lines: each refusal of a table stands where it is read.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .quantities import QUANTITIES, conversion, converter

BRANCHES = ("heating", "cooling")
KEYS = {"columns", "units", "reference", "branches", "separator", "decimal"}
FEWEST, MOST = 6, 10_000
COLDEST, HOTTEST = 200.0, 500.0  # K: outside, the column is hardly in kelvin
USUAL_ERROR = {"temperature_error": 0.1, "polymer_fraction_error": 0.01}  # second one relative
NUMBER = re.compile(r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d{1,3})?")
THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+")


@dataclass(frozen=True)
class Points:
    """Measured T (K) and phi_0 with their errors; whether these were given; heating, cooling or
    neither of each point; and what of the table was not used."""

    T: NDArray
    phi: NDArray
    T_error: NDArray
    phi_error: NDArray
    errors_given: bool
    branch: NDArray | None = None
    notes: tuple[str, ...] = ()

    def on(self, branch: str) -> NDArray:
        """Which points were measured on a branch."""
        return np.zeros(len(self.T), bool) if self.branch is None else self.branch == branch


def read(path: str | Path, how: Mapping[str, Any] | None = None) -> Points:
    """The points of a table; ``how`` has those of KEYS that the table needs.

    ``columns`` names the heading of each role: temperature, one of QUANTITIES, perhaps
    temperature_error, QUANTITY_error and branch; a quantity may have two, {heating: , cooling: }.
    Without it headings are the roles' own names, and the temperature is in kelvin. ``units`` by
    role; ``reference`` has polymer_fraction, diameter, polymer_density, solvent_density;
    ``branches`` what stands for heating and cooling. ValueError, with the line.
    """
    return _Table(path, dict(how or {})).points()


class _Table:
    def __init__(self, path: str | Path, how: dict[str, Any]) -> None:
        self.path, self.how = path, how
        for key in set(how) - KEYS:
            self.refuse(f"{key} = {how[key]!r}: unknown key; must be one of {sorted(KEYS)}")
        for key in ("columns", "units", "reference", "branches"):
            if not isinstance(how.get(key, {}), Mapping):
                self.refuse(f"{key} = {how[key]!r}: must be a mapping")
        if how.get("decimal", ".") not in (".", ","):
            self.refuse(f"decimal = {how['decimal']!r}: must be '.' or ','")
        if how.get("separator", ";") not in (";", ",", "\t"):
            self.refuse(f"separator = {how['separator']!r}: must be ';', ',' or a tab")
        self.text = self._text()
        self.heading = 0

    def refuse(self, why: str, line: int | None = None):
        raise ValueError(f"{self.path}{f', line {line}' if line else ''}: {why}")

    def _text(self) -> str:
        try:
            with open(self.path, "rb") as stream:
                raw = stream.read(10_000_001)
        except OSError as problem:
            self.refuse(f"cannot be read: {problem}")
        if len(raw) > 10_000_000:
            self.refuse("is larger than 10 MB")
        wide = raw[:2] in (b"\xff\xfe", b"\xfe\xff")
        try:
            return raw.decode("utf-16" if wide else "utf-8-sig")
        except UnicodeError:
            self.refuse("cannot be read: it is not in UTF-8; save it as CSV UTF-8")

    def points(self) -> Points:
        if not self.text.strip():
            self.refuse("is empty; must begin with the columns temperature, polymer_fraction")
        lines, wanted = self._lines()
        header = [_tidy(cell) for cell in lines[self.heading][1]]
        where = {}
        for role, name in wanted.items():
            if header.count(name) > 1:
                self.refuse(f"the column {name!r} is there twice", lines[self.heading][0])
            where[role] = header.index(name)
        data = lines[self.heading + 1 :]
        units_row = {}
        if data and self._is_units_row(data[0][1], where):
            units_row = {role: _cell(data[0][1], i).strip("[]()") for role, i in where.items()}
            data = data[1:]
        comma = self._decimal_comma(data, where)
        self.quantity = next(role for role, _ in where if role in QUANTITIES)
        converters = {role: self._converter(role, name, units_row.get(role, ""))
                      for role, name in wanted.items() if role[0] != "branch"}  # fmt: skip
        return self._assembled(data, where, len(header), comma, converters)

    def _lines(self):
        """Rows with their line numbers, split by the one separator that gives the columns."""
        given = self.how.get("separator")
        found, broken = {}, []
        for separator in [given] if given else [";", "\t", ","]:
            try:
                rows = self._split(separator)
            except ValueError as refusal:
                broken.append(refusal)
                continue
            for wanted in self._wanted(rows):
                headings = [
                    i for i, (_, row) in enumerate(rows)
                    if set(wanted.values()) <= {_tidy(cell) for cell in row}
                ]  # fmt: skip
                if len(headings) > 1:
                    self.refuse(f"columns {list(wanted.values())} stand in lines "
                                f"{[rows[i][0] for i in headings]}: must be in one")  # fmt: skip
                if headings:
                    found[separator] = rows, wanted, headings[0]
        if len(found) > 1:
            self.refuse(f"can be split by each of {list(found)}: say separator")
        if not found and broken:
            raise broken[0]
        if not found:
            rows = self._split(given or (";" if ";" in self.text else ","))
            number, row = rows[0] if rows else (1, [])
            wanted = self.how.get("columns") or (
                "temperature, one of " + ", ".join(QUANTITIES) + ", and perhaps temperature_error,"
                " the quantity's own _error, and branch"
            )
            self.refuse(f"columns {[_tidy(cell) for cell in row]}: must be {wanted}", number)
        [(rows, wanted, self.heading)] = found.values()
        return rows, wanted

    def _split(self, separator):
        reader = csv.reader(io.StringIO(self.text, newline=""), delimiter=separator, strict=True)
        rows = []
        try:
            for row in reader:
                if any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#"):
                    rows.append((reader.line_num, row))
        except csv.Error as problem:
            self.refuse(f"cannot be read: {problem}", reader.line_num)
        return rows

    def _wanted(self, rows):
        """Heading by role: as told, or the roles' own names in a row that has nothing else."""
        if "columns" in self.how:
            return [self._told()]
        known = {"temperature", "temperature_error", "branch"}
        known |= {f"{each}{end}" for each in QUANTITIES for end in ("", "_error")}
        for _, row in rows[:1]:
            names = [_tidy(cell) for cell in row]
            quantities = [each for each in QUANTITIES if each in names]
            fits = "temperature" in names and len(quantities) == 1 and set(names) <= known
            if fits and len(set(names)) == len(names):
                return [{self._role(name, quantities[0]): name for name in names}]
        return []

    @staticmethod
    def _role(name, quantity):
        if name in ("temperature", "temperature_error", "branch"):
            return name, ""
        return ("error" if name.endswith("_error") else quantity), ""

    def _told(self):
        """(role, branch) -> heading, of the columns that are told."""
        columns, found = self.how["columns"], {}
        quantities = [each for each in QUANTITIES if each in columns]
        if "temperature" not in columns or len(quantities) != 1:
            self.refuse(f"columns = {dict(columns)!r}: must name temperature and one of "
                        f"{list(QUANTITIES)}")  # fmt: skip
        [quantity] = quantities
        roles = {"temperature": "temperature", "temperature_error": "temperature_error",
                 "branch": "branch", quantity: quantity, f"{quantity}_error": "error"}  # fmt: skip
        for key, value in columns.items():
            if key not in roles:
                self.refuse(f"columns.{key} = {value!r}: unknown; must be one of {list(roles)}")
            parts = value if isinstance(value, Mapping) else {"": value}
            if set(parts) != {""} and not set(parts) <= set(BRANCHES):
                self.refuse(f"columns.{key} = {value!r}: must be a heading, or one each for "
                            f"{list(BRANCHES)}")  # fmt: skip
            for branch, name in parts.items():
                if not isinstance(name, str) or not name.strip():
                    self.refuse(f"columns.{key} = {value!r}: must be a heading")
                found[roles[key], branch] = _tidy(name)
        if len(set(found.values())) != len(found):
            self.refuse(f"columns = {dict(columns)!r}: two of them are the same")
        branched = {branch for role, branch in found if role == quantity}
        if ("branch", "") in found and branched != {""}:
            self.refuse("columns: has branch, and a column each for heating and cooling")
        for role, branch in found:
            if branch and branch not in branched:
                self.refuse(f"columns: {role} has {branch}, but {quantity} has not")
        return found

    def _is_units_row(self, row, where) -> bool:
        cells = [_cell(row, i) for (role, _), i in where.items() if role != "branch"]
        return any(cells) and not any(NUMBER.fullmatch(cell) for cell in cells)

    def _decimal_comma(self, data, where) -> bool:
        cells = [_cell(row, i) for _, row in data
                 for (role, _), i in where.items() if role != "branch"]  # fmt: skip
        commas = [cell for cell in cells if "," in cell]
        if "decimal" in self.how or not commas:
            return self.how.get("decimal") == ","
        if any("." in cell for cell in cells):
            self.refuse(f"has both decimal commas ({commas[0]!r}) and points: say decimal")
        if all(THOUSANDS.fullmatch(cell) for cell in commas):
            self.refuse(f"{commas[0]!r} may have a decimal comma or thousands: say decimal")
        return True

    def _converter(self, key, heading, cell):
        """What turns a number of the column into K, m or 1."""
        role = self.quantity if key[0] == "error" else key[0]
        try:
            return converter(role, key[0] == "error", heading, cell, self.how.get("units", {}))
        except ValueError as refusal:
            self.refuse(str(refusal))

    def _assembled(self, data, where, width, comma, converters):
        branches = sorted({branch for role, branch in where if role in QUANTITIES})
        quantity = self.quantity
        try:
            to_phi, slope = conversion(quantity, self.how.get("reference", {}))
        except ValueError as refusal:
            self.refuse(str(refusal))
        given = all(
            any(role == each for role, _ in where) for each in ("temperature_error", "error")
        )
        rows, blank = [], []
        for line, row in data:
            if any(cell.strip() for cell in row[width:]) or len(row) <= max(where.values()):
                self.refuse(f"{len(row)} values: must be {width}", line)
            for branch in branches:
                value = self._row(line, row, where, branch, quantity, comma, converters)
                if value is None:
                    blank += [line] if branch == branches[-1] or len(branches) == 1 else []
                    continue
                T, x, T_error, x_error, side = value
                phi = to_phi(x)
                if not 0 < phi < 1:
                    self.refuse(
                        f"{quantity} = {x:g}" + ("" if quantity == "polymer_fraction" else
                        f": a polymer fraction of {phi:.4g}") + ": must be greater than 0 and less "
                        "than 1", line)  # fmt: skip
                error = abs(slope(x)) * x_error if x_error else USUAL_ERROR[
                    "polymer_fraction_error"] * phi  # fmt: skip
                rows.append((T, phi, T_error or USUAL_ERROR["temperature_error"], error, side))
        if not FEWEST <= len(rows) <= MOST:
            self.refuse(f"{len(rows)} points: must be {FEWEST} to {MOST}")
        *numbers, side = zip(*rows, strict=True)
        lines = ", ".join(map(str, blank[:9])) + (" ..." if len(blank) > 9 else "")
        notes = (f"{quantity} is blank and left out in line {lines}",) if blank else ()
        branch = np.array(side) if any(side) else None
        return Points(*(np.array(each, float) for each in numbers), given, branch, notes)

    def _row(self, line, row, where, branch, quantity, comma, converters):
        """T, x, their errors and the branch of one point; None if x is blank."""

        def number(role):
            key = (role, branch) if (role, branch) in where else (role, "")
            if key not in where:
                return None
            cell = _cell(row, where[key])
            name = {"error": f"{quantity}_error"}.get(role, role)
            if not cell:
                if role == quantity:
                    return None
                self.refuse(f"{name} is blank", line)
            return converters[key](self._number(line, name, cell, comma))

        x = number(quantity)
        if x is None:
            return None
        if (T := number("temperature")) is None or not COLDEST <= T <= HOTTEST:
            text = _cell(row, where["temperature", ""])
            self.refuse(f"temperature = {text[:40]!r}: must be kelvin, {COLDEST:g} to {HOTTEST:g}"
                        + f", not {T:g} K" * ("columns" in self.how), line)  # fmt: skip
        errors = [number("temperature_error"), number("error")]
        for name, each in zip(("temperature_error", f"{quantity}_error"), errors, strict=True):
            if each is not None and not 0 < each < math.inf:
                self.refuse(f"{name} = {each:g}: must be a number greater than 0", line)
        side = branch
        if ("branch", "") in where:
            words = {str(self.how.get("branches", {}).get(each, each)): each for each in BRANCHES}
            text = _cell(row, where["branch", ""])
            if text not in words:
                self.refuse(f"branch = {text[:40]!r}: must be one of {list(words)}; say branches",
                            line)  # fmt: skip
            side = words[text]
        return T, x, *errors, side

    def _number(self, line, name, cell, comma):
        wrong = "." if comma else ","
        plain = NUMBER.fullmatch(cell) and wrong not in cell
        value = float(cell.replace(",", ".")) if plain else math.nan
        if not math.isfinite(value):
            kind = {"temperature": f"kelvin, {COLDEST:g} to {HOTTEST:g}"}.get(name, "a number")
            self.refuse(f"{name} = {cell[:40]!r}: must be {kind}", line)
        return value


def _tidy(cell: str) -> str:
    return " ".join(cell.split())


def _cell(row, i) -> str:
    return _tidy(row[i]) if i < len(row) else ""
