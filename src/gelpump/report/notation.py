"""Text with mathematics in it, in a form that any typesetter can take.

A text is a list of runs.  Statements of claims and of the ledger are written in plain ASCII, such
as "Phi_1 at Z_C for ell = 0.1"; `from_plain` finds their mathematics.  `from_rst` takes what
Snakemake's own report takes, so that a caption has one source.
"""

import re
from typing import NamedTuple

TEXT, MATH, LITERAL, EMPHASIS, STRONG = "text", "math", "literal", "emphasis", "strong"


class Run(NamedTuple):
    """A stretch of one kind; the text of mathematics is LaTeX."""

    kind: str
    text: str


Text = list[Run]

GREEK = {
    "phi": r"\phi",
    "Phi": r"\Phi",
    "Pi": r"\Pi",
    "tau": r"\tau",
    "ell": r"\ell",
    "eps": r"\varepsilon",
    "mu": r"\mu",
    "chi": r"\chi",
    "Omega": r"\Omega",
    "kappa": r"\kappa",
}
LETTERS = {"μ": r"\mu", "Φ": r"\Phi"}
SUBSCRIPTS = {
    "∞": r"\infty",
    "inf": r"\infty",
    "max": r"\mathrm{max}",
    "BMJ": r"\mathrm{BMJ}",
    "dry": r"\mathrm{dry}",
}
ATOM = re.compile(
    rf"""
    (?<![\w.:/-])(?P<reference>eqn:\w+)
    | (?<![\w.])(?P<mantissa>\d+(?:\.\d+)?)e(?P<exponent>[-+]?\d+)(?!\w)
    | (?<!\w)(?P<differential>d?)
      (?:(?P<greek>{"|".join(sorted(GREEK, key=len, reverse=True))})(?:_(?P<sub>\w+))?
        | (?P<letter>[A-Za-zμΦ])(?:_(?P<lettersub>\w+|∞)|(?=\^)))
      (?P<tilde>~?)(?:\^(?P<power>\([^()]*\)|-?[\d.]*\d))?(?!\w)
    | \)\^(?P<outer>\([^()]*\)|-?[\d.]*\d)
    """,
    re.VERBOSE,
)
SIGNS = ((" -> ", " → "), ("<<", "≪"), (" - ", " − "), (" ~ ", " ∼ "))


def from_plain(text: str) -> Text:
    """The runs of a plain statement."""
    runs, end = [], 0
    for found in ATOM.finditer(text):
        _append(runs, text[end : found.start()])
        end = found.end()
        runs.append(_run(found))
    _append(runs, text[end:])
    return runs


def _append(runs: Text, text: str) -> None:
    for plain, sign in SIGNS:
        text = text.replace(plain, sign)
    if text:
        runs.append(Run(TEXT, text))


def _run(found: re.Match) -> Run:
    if found["reference"]:
        return Run(LITERAL, found["reference"])
    if found["exponent"]:
        factor = "" if found["mantissa"] == "1" else rf"{found['mantissa']}\times "
        return Run(MATH, f"{factor}10^{{{int(found['exponent'])}}}")
    if found["outer"]:
        return Run(MATH, f")^{{{_power(found['outer'])}}}")
    letter = found["letter"]
    symbol = GREEK.get(found["greek"]) or LETTERS.get(letter, letter)
    if found["tilde"]:
        symbol = rf"\tilde{{{symbol}}}"
    if subscript := found["sub"] or found["lettersub"]:
        symbol = f"{symbol}_{{{SUBSCRIPTS.get(subscript, subscript)}}}"
    if found["power"]:
        symbol = f"{symbol}^{{{_power(found['power'])}}}"
    return Run(MATH, rf"\mathrm{{d}}{symbol}" if found["differential"] else symbol)


def _power(text: str) -> str:
    return text.removeprefix("(").removesuffix(")").replace("−", "-")


def from_rst(source: str) -> list[Text]:
    """The paragraphs of a reStructuredText; ValueError if it is not valid."""
    from docutils import nodes
    from docutils.core import publish_doctree

    quiet = {"report_level": 5, "halt_level": 5, "file_insertion_enabled": False}
    tree = publish_doctree(source, settings_overrides=quiet | {"raw_enabled": False})
    problems = [message.astext() for message in tree.findall(nodes.system_message)]
    if problems:
        raise ValueError("; ".join(problems))
    kinds = {
        nodes.Text: TEXT,
        nodes.math: MATH,
        nodes.literal: LITERAL,
        nodes.emphasis: EMPHASIS,
        nodes.strong: STRONG,
    }
    return [
        [
            Run(kinds.get(type(child), TEXT), child.astext().replace("\n", " "))
            for child in paragraph.children
        ]
        for paragraph in tree.findall(nodes.paragraph)
    ]


def with_mathematics(text: Text) -> Text:
    """The runs of a caption, with the mathematics of its plain text found."""
    return [
        each
        for run in text
        # k_BT: two letters that are not one subscript
        for each in (from_plain(run.text.replace("k_BT", "k_B T")) if run.kind == TEXT else [run])
    ]


def plain(text: Text) -> str:
    """The text without any markup; mathematics stays LaTeX."""
    return "".join(run.text for run in text)
