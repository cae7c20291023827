"""Numbers that a page tells, against what they are told of."""

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

NUMBER = r"([+−-]?\d+\.?\d*(?:e-?\d+)?)"


class Page:
    """A page of docs as one line."""

    def __init__(self, path: Path):
        self.text = " ".join(path.read_text(encoding="utf-8").split())

    def tells(self, passage: str, expected: Sequence[float]) -> int:
        """How many numbers; AssertionError unless the passage, whose numbers are {}, stands there
        once, and each is what is expected, to half a unit of its last digit."""
        there = re.findall(re.escape(passage).replace(re.escape("{}"), NUMBER), self.text)
        assert len(there) == 1, f"not one passage: {passage}"
        told = [there[0]] if isinstance(there[0], str) else there[0]
        for text, value in zip(told, np.ravel([float(each) for each in expected]), strict=True):
            plain = text.replace("−", "-")
            digits, _, power = plain.partition("e")
            unit = 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))
            assert abs(float(plain) - value) <= 0.51 * unit, f"{passage}: {text}, not {value:.5g}"
        return len(told)
