"""What is said of a design: numbers with unit, uncertainty and source, and traffic lights."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from gelpump.design import units


@dataclass(frozen=True)
class Result:
    """A number in its SI unit; ``uncertainty`` is numerical, None where the formula is exact."""

    key: str
    text: str
    symbol: str
    value: float
    unit: str
    source: str
    uncertainty: float | None = None

    @property
    def quantity(self) -> Any:
        """The number as pint knows it."""
        return units.quantity(self.value, self.unit)


GREEN, AMBER, RED = "green", "amber", "red"
LIGHTS = (GREEN, AMBER, RED)
ROUNDING = 1e-9  # eps = 0.1 is green, although its square is more than 0.01 to a computer


@dataclass(frozen=True)
class Criterion:
    """A number of the model that has to be small (or large): limits of green and of amber."""

    key: str
    text: str
    symbol: str
    green: float
    amber: float
    source: str
    large: bool = False

    def light(self, value: float) -> str:
        """Green, amber or red."""
        for light, limit in ((GREEN, self.green), (AMBER, self.amber)):
            if self.large and value >= limit * (1 - ROUNDING):
                return light
            if not self.large and value <= limit * (1 + ROUNDING):
                return light
        return RED


@dataclass(frozen=True)
class Light:
    """An assumption, the number it was judged by, and why; amber where that is not known."""

    criterion: Criterion
    value: float
    reason: str
    unknown: bool = False

    @property
    def light(self) -> str:
        """Green, amber or red."""
        return AMBER if self.unknown else self.criterion.light(self.value)
