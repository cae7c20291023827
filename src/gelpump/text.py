"""Text and JSON files that are whole or not there."""

import json
from pathlib import Path
from typing import Any

from gelpump.files import whole


def write_text(text: str, path: str | Path) -> None:
    """Write ``text`` to ``path`` as UTF-8, under its name only when complete."""
    with whole(path) as partial:
        partial.write_text(text, encoding="utf-8", newline="\n")


def write_json(value: Any, path: str | Path) -> None:
    """Write ``value`` as indented JSON; ValueError if it holds a number that is not finite."""
    write_text(json.dumps(value, indent=1, allow_nan=False, ensure_ascii=False) + "\n", path)
