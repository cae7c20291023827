"""Tables as CSV, Markdown and LaTeX, from the same columns and rows."""

import csv as csv_format
from collections.abc import Callable, Iterable, Mapping, Sequence
from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple

from gelpump.text import write_text

Cell = str | float


class Column(NamedTuple):
    """A column's heading, and the same in LaTeX."""

    heading: str
    latex: str


def printed(cell: Cell) -> str:
    """A string as it is; a number with the digits it needs, and no more."""
    return cell if isinstance(cell, str) else f"{cell:.12g}"


def csv(columns: Sequence[Column], rows: Iterable[Sequence[Cell]]) -> str:
    """Comma-separated values after RFC 4180, with line feeds."""
    text = StringIO()
    lines = [[column.heading for column in columns], *rows]
    csv_format.writer(text, lineterminator="\n").writerows(map(printed, line) for line in lines)
    return text.getvalue()


def markdown(columns: Sequence[Column], rows: Iterable[Sequence[Cell]]) -> str:
    """A GitHub-flavoured table, numbers to the right."""
    rows = list(rows)
    sides = [
        "---" if any(isinstance(row[i], str) for row in rows) else "---:"
        for i in range(len(columns))
    ]
    return _lines([[column.heading for column in columns], sides, *rows])


def _lines(rows: Iterable[Sequence[Cell]]) -> str:
    return "".join(
        "| " + " | ".join(printed(cell).replace("|", r"\|") for cell in row) + " |\n"
        for row in rows
    )


def table(columns: Mapping[str, Callable[[Any], Cell]], of: Iterable) -> str:
    """A Markdown table of text: of each thing, what every column makes of it."""
    rows = [[column(each) for column in columns.values()] for each in of]
    return _lines([columns, ["---"] * len(columns), *rows])


def page(title: str, intro: str, columns: Mapping[str, Callable[[Any], Cell]], of: Iterable) -> str:
    """A Markdown page with one such table."""
    return f"# {title}\n\n{intro}\n\n{table(columns, of)}"


def latex(columns: Sequence[Column], rows: Iterable[Sequence[Cell]]) -> str:
    """A tabular environment; numbers in mathematics, strings escaped."""

    def typeset(cell):
        if not isinstance(cell, str):
            return f"${printed(cell)}$"
        for special in "&%$#_{}":
            cell = cell.replace(special, "\\" + special)
        return cell

    head = " & ".join(column.latex for column in columns)
    body = [" & ".join(map(typeset, row)) + r" \\" for row in rows]
    return "\n".join(
        [
            rf"\begin{{tabular}}{{l{'c' * (len(columns) - 1)}}}",
            rf"  {head} \\ \hline",
            *(f"  {line}" for line in body),
            r"\end{tabular}",
            "",
        ]
    )


FORMATS = {".csv": csv, ".md": markdown, ".tex": latex}


def write(
    paths: Iterable[str | Path], columns: Sequence[Column], rows: Sequence[Sequence[Cell]]
) -> None:
    """Write the table to each path in the format of its suffix."""
    for path in map(Path, paths):
        write_text(FORMATS[path.suffix](columns, rows), path)
