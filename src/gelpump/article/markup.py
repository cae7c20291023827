"""From the runs of `gelpump.report.notation` to what Typst sets: text, and Typst's mathematics.

Only the LaTeX that `notation` writes is known here; anything else is refused, not guessed.
"""

import re

from gelpump.report.notation import LITERAL, MATH, TEXT, Run, Text, with_mathematics

SYMBOLS = {
    "phi": "φ",
    "Phi": "Φ",
    "Pi": "Π",
    "tau": "τ",
    "ell": "ℓ",
    "varepsilon": "ε",
    "mu": "μ",
    "chi": "χ",
    "Omega": "Ω",
    "kappa": "κ",
    "infty": "∞",
    "times": "×",
}
TOKEN = re.compile(
    r"\\mathrm\{(?P<upright>[^{}]*)\}|\\(?P<name>[A-Za-z]+)|(?P<word>[A-Za-z]+|\d[\d.]*)"
    r"|(?P<brace>[{}])|(?P<mark>[-−+*/^_()=<>,| ])"
)
ESCAPED = {"/": r"\/", "*": "∗", "-": "−", "|": r"\|", ",": r"\,", "(": r"\(", ")": r"\)"}


def mathematics(latex: str) -> str:
    r"""LaTeX of the kind that `notation` writes, as Typst's mathematics.

    ``\Phi_{1}^{-1/3}`` becomes ``Φ_(1)^(−1\/3)``.  ValueError for a command that is not known.
    """
    parts, end = [], 0
    for found in TOKEN.finditer(latex):
        if found.start() != end:
            break
        end = found.end()
        parts.append(_part(found))
    if end != len(latex):
        raise ValueError(f"mathematics that the article cannot set: {latex!r}")
    return "".join(parts)


def _part(found):
    if found["upright"] is not None:
        return f'upright("{found["upright"]}")'
    if found["name"] == "tilde":
        return "tilde"
    if found["name"]:
        if found["name"] not in SYMBOLS:
            raise ValueError(f"mathematics that the article cannot set: \\{found['name']}")
        return SYMBOLS[found["name"]]
    if found["word"]:
        word = found["word"]
        return word if len(word) == 1 or word[0].isdigit() else f'italic("{word}")'
    if found["brace"]:
        return "(" if found["brace"] == "{" else ")"
    return ESCAPED.get(found["mark"], found["mark"])


def typographic(text: str) -> str:
    """Straight quotation marks and apostrophes as a printer sets them."""
    return re.sub(r'"([^"]*)"', "“\\1”", text).replace("'", "’")


def runs(text: Text) -> list[list[str]]:
    """The runs as pairs of kind and content, their mathematics Typst's."""
    return [_run(run) for run in text]


def caption(text: Text) -> list[list[str]]:
    """The runs of a caption, with the mathematics of its plain text where Typst can set it."""
    pairs = []
    for run in text:
        try:
            pairs += runs(with_mathematics([run]))
        except ValueError:  # letters that stand in no formula can be read as they are
            pairs += runs([run])
    return pairs


def _run(run: Run):
    if run.kind == MATH:
        return [MATH, mathematics(run.text)]
    return [run.kind, run.text if run.kind == LITERAL else typographic(run.text)]


def plain(text: str) -> list[list[str]]:
    """A string without markup as runs."""
    return [[TEXT, typographic(text)]]
