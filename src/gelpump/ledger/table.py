"""The ledger as a Markdown table."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np


def _numbers(values: Any) -> str:
    return ", ".join(f"{value:.4g}" for value in np.atleast_1d(values))


def markdown(entries: Sequence[Mapping[str, Any]]) -> str:
    """A row an entry: what is printed, what follows, how far apart, and the code that shows it."""
    found = sum(entry["verdict"] == "disagreement" for entry in entries)
    lines = [
        "# Ledger of disagreements",
        "",
        f"{found} of {len(entries)} suspected disagreements found.",
        "",
        "| entry | where | the paper | what follows | difference | allowed | verdict | code |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for entry in entries:
        cells = [
            entry["id"],
            entry["where"],
            entry["printed"],
            entry["follows"],
            f"{entry['measured']}: {_numbers(entry['size'])}",
            _numbers(entry["allowed"]),
            entry["verdict"],
            f"`{entry['code']}` on {entry['evidence']}",
        ]
        lines.append("| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"
