"""Refusals that name the key, the value and what is allowed."""

from __future__ import annotations

import sys
from numbers import Real
from typing import Any


def real_number(key: str, value: Any) -> float:
    """Return `value` as a float; ValueError when it is not a finite real number."""
    plain = isinstance(value, Real) and not isinstance(value, bool)
    if not (plain and abs(value) <= sys.float_info.max):
        raise ValueError(f"{key} = {value!r}: must be a finite number")
    return float(value)


def positive(key: str, value: Any) -> float:
    """Return `value` as a float; ValueError when it is not a finite number above zero."""
    if (number := real_number(key, value)) <= 0:
        raise ValueError(f"{key} = {value!r}: must be greater than 0")
    return number


def non_negative(key: str, value: Any) -> float:
    """Return `value` as a float; ValueError when it is not a finite number, zero or above."""
    if (number := real_number(key, value)) < 0:
        raise ValueError(f"{key} = {value!r}: must be 0 or greater")
    return number
