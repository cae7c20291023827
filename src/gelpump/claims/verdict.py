"""From findings and published values to statuses: the only place where a status is decided.

==================== =============================================================================
reproduced           every computed value is as near to the published one as its printed digits
                     (``resolution``) and our uncertainty allow, or the statement holds as stated
deviates             it is not
inconsistent-in-paper the paper gives two values for the quantity (in the text and in a figure)
                     that differ by more than both can be read to
qualitative          nothing that a number could decide was published
==================== =============================================================================
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from gelpump.claims.finding import Finding


def status(finding: Finding, published: Mapping[str, Any] | None) -> str:
    """Status of a finding, given what the paper prints (``value``, ``resolution``) and draws."""
    if published is None or finding.computed is None:
        return "qualitative"
    value = published["value"]
    if isinstance(value, bool) or isinstance(finding.computed, bool):
        return "reproduced" if finding.computed is value else "deviates"
    if "drawn" in published:
        readable = published["resolution"] + published["drawn_resolution"]
        if abs(value - published["drawn"]) > readable:
            return "inconsistent-in-paper"
    allowed = published["resolution"] + np.abs(finding.uncertainty)
    agrees = np.abs(np.subtract(finding.computed, value)) <= allowed
    return "reproduced" if np.all(agrees) else "deviates"


def relative_difference(finding: Finding, published: Mapping[str, Any] | None) -> float | None:
    """Largest |computed - published| / |published|; None where either is not a number, or the
    latter is zero."""
    if published is None or finding.computed is None or isinstance(finding.computed, bool):
        return None
    value = np.asarray(published["value"], dtype=float)
    if not np.all(value):
        return None
    return float(np.max(np.abs((finding.computed - value) / value)))


def judged(finding: Finding, published: Mapping[str, Any] | None) -> dict[str, Any]:
    """The entry of ``claims.json`` for a finding; ValueError if a number in it is not finite."""
    entry = {
        "id": finding.id,
        "where": finding.where,
        "statement": finding.statement,
        "published": None if published is None else published["value"],
        "published_in_figure": None if published is None else published.get("drawn"),
        "resolution": None if published is None else published.get("resolution"),
        "computed": _plain(finding.computed),
        "uncertainty": _plain(finding.uncertainty),
        "relative_difference": relative_difference(finding, published),
        "measure": _plain(finding.measure),
        "measured": finding.measured,
        "status": status(finding, published),
        "evidence": finding.evidence,
    }
    for key in ("computed", "uncertainty", "measure"):
        if entry[key] is not None and not np.all(np.isfinite(entry[key])):
            raise ValueError(f"claim {finding.id}: {key} = {entry[key]} is not finite")
    return entry


def _plain(value):
    if value is None or isinstance(value, bool):
        return value
    return np.asarray(value, dtype=float).tolist()
