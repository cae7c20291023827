"""One entry of the ledger, whose number decides whether there is a disagreement at all."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Entry:
    """What the paper prints, what follows instead, and the number between them.

    size: the difference, as ``measured`` says, a number or one for each case.  allowed: what
    reading, rounding and numerical error could make of it.  code: the function that computed it.
    """

    id: str
    where: str
    printed: str
    follows: str
    size: float | list[float]
    measured: str
    allowed: float | list[float]
    code: Callable[..., Any]
    evidence: str

    @property
    def disagrees(self) -> bool:
        """Whether the difference is larger than what is allowed, anywhere."""
        return bool(np.any(np.abs(self.size) > np.asarray(self.allowed)))

    def record(self) -> dict[str, Any]:
        """The entry of ``ledger.json``; ValueError if its number is not finite."""
        if not (np.all(np.isfinite(self.size)) and np.all(np.isfinite(self.allowed))):
            raise ValueError(f"ledger {self.id}: {self.size}, {self.allowed} is not finite")
        return {
            "id": self.id,
            "where": self.where,
            "printed": self.printed,
            "follows": self.follows,
            "size": np.asarray(self.size, dtype=float).tolist(),
            "measured": self.measured,
            "allowed": np.asarray(self.allowed, dtype=float).tolist(),
            "verdict": "disagreement" if self.disagrees else "no disagreement found",
            "code": f"{self.code.__module__}.{self.code.__qualname__}",
            "evidence": self.evidence,
        }
