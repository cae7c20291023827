"""The article as a PDF, by Typst: equal data give equal bytes."""

import json
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

from gelpump.files import whole


def typeset(told: Mapping[str, Any], drawings: Mapping[str, Path], path: str | Path) -> None:
    """Write the article to ``path``; a file is whole or not there.

    told: as `telling` gives it.  drawings: the SVG of each figure by its name.  Only fonts that
    come with Typst are used, and the time in the PDF is fixed.
    """
    import typst

    here = files("gelpump.article")
    sources = {
        "main": (here / "article.typ").read_bytes(),
        "references.yml": (here / "references.yml").read_bytes(),
        "told.json": json.dumps(told, ensure_ascii=False).encode(),
        **{f"{name}.svg": Path(file).read_bytes() for name, file in drawings.items()},
    }
    pdf = typst.compile(sources, format="pdf", ignore_system_fonts=True, timestamp=0)
    with whole(path) as partial:
        partial.write_bytes(pdf)
