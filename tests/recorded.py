"""What a script saw, as a table in a file that is kept."""

from collections.abc import Iterable, Sequence
from pathlib import Path

LONGEST = 160  # characters of a cell


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """As Markdown; cells are cut where they are long."""

    def cell(text):
        text = " ".join(text.split())
        text = text if len(text) <= LONGEST else f"{text[:LONGEST]}…"
        return text.replace("|", "\\|").replace("<", "&lt;")

    lines = [heads, ["---"] * len(heads), *([cell(each) for each in row] for row in rows)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def record(file: Path, name: str, *paragraphs: str) -> None:
    """Put paragraphs between the marks of that name; ValueError if they are not there."""
    start, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
    text = file.read_text(encoding="utf-8")
    if start not in text or end not in text:
        raise ValueError(f"{file} has no {start.strip()} and {end}")
    before, _, rest = text.partition(start)
    file.write_text(
        before + start + "\n" + "\n\n".join(paragraphs) + "\n\n" + end + rest.partition(end)[2],
        encoding="utf-8",
    )
