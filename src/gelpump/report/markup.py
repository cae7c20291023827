"""Content as HTML: texts with their mathematics as MathML, files as data addresses."""

import re
from functools import cache
from html import escape
from pathlib import Path

from gelpump.report import notation
from gelpump.report.notation import Text

TAGS = {notation.LITERAL: "code", notation.EMPHASIS: "em", notation.STRONG: "strong"}


def html(text: Text) -> str:
    """A text's runs; everything in them is escaped."""
    return "".join(map(_run, text))


def caption(paragraphs: list[Text]) -> str:
    """The paragraphs of a caption in one, with the mathematics in its plain text."""

    def told(run):
        plain = run.text.replace("k_BT", "k_B T")  # two letters that are not one subscript
        try:
            return html(notation.from_plain(plain) if run.kind == notation.TEXT else [run])
        except ValueError:  # letters that LaTeX does not know can be read as they are
            return html([run]) if run.kind == notation.TEXT else escape(run.text)

    return " ".join("".join(map(told, paragraph)) for paragraph in paragraphs)


def _run(run):
    if run.kind == notation.MATH:
        return mathml(run.text)
    body = escape(run.text)
    return f"<{TAGS[run.kind]}>{body}</{TAGS[run.kind]}>" if run.kind in TAGS else body


@cache
def mathml(latex: str) -> str:
    """LaTeX as MathML, which browsers typeset without a network; ValueError if it is not LaTeX."""
    from docutils.utils.math import MathError
    from docutils.utils.math.latex2mathml import tex2mathml

    try:
        source = tex2mathml(latex)
    except MathError as refusal:
        raise ValueError(f"not LaTeX: {latex!r}: {refusal}") from refusal
    return re.sub(r">\s+<", "><", source).strip()


def number(text: str) -> str:
    """Printed numbers with signs and powers as they are set: "-2 ± 9e-16" as "−2 ± 9×10⁻¹⁶"."""

    def power(found):
        exponent = str(int(found[2])).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
        return f"{found[1]}×10{exponent}"

    text = re.sub(r"(\d)e([-+]?\d+)", power, text)
    return re.sub(r"(?<!\w)-(?=\d)", "−", text).replace(" ± ", "\u00a0±\u00a0")


def svg_address(path: str | Path) -> str:
    """An SVG file as an address to be put between double quotes."""
    source = Path(path).read_text(encoding="utf-8")
    source = re.sub(r"<metadata>.*?</metadata>", "", source, flags=re.DOTALL)
    source = source[source.index("<svg") :]
    for sign in '%#&"':
        source = source.replace(sign, f"%{ord(sign):02X}")
    return "data:image/svg+xml," + re.sub(r"\s*\n\s*", " ", source)


def svg_size(path: str | Path) -> tuple[float, float]:
    """Width and height of an SVG file in points."""
    head = Path(path).read_text(encoding="utf-8")[:2000]
    width, height = (re.search(rf'{side}="([\d.]+)pt"', head)[1] for side in ("width", "height"))
    return float(width), float(height)
