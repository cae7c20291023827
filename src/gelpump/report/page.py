"""The report as one HTML page, which needs neither a network nor a server.

Templates, styles and scripts are the files of ``templates``; everything that varies is content.
"""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gelpump.figures import style
from gelpump.report import markup, notation
from gelpump.report.records import Content

if TYPE_CHECKING:
    import jinja2

TEMPLATES = Path(__file__).parent / "templates"
ENGINE = ("wave", "pulse", "material", "heat", "device")  # of the designer, without any page
SCRIPTS = (
    *("theme", "tables", "arrays", "plot", "explorer", "tube", "bead", "gel"),
    *ENGINE,
    *("scan", "designer"),
    "start",
)
SHADES = 64
STATUS_MEANING = {
    "reproduced": "within the printed digits and our uncertainty",
    "deviates": "not within them",
    "inconsistent-in-paper": "the paper gives two values, and ours is one of them",
    "qualitative": "nothing that a number could decide was published",
    "identity": "follows from how the number is made",
    "misprint": "a printed line that differs from its own derivation",
}


def colours() -> dict[str, Any]:
    """The colours of the figures, for what scripts draw."""
    import matplotlib

    polymer = matplotlib.colormaps[style.POLYMER_FRACTION].resampled(SHADES)
    return {
        "polymer": [style.to_hex(polymer(share)) for share in range(SHADES)],
        "lens": style.LENS,
        "nonlinear": style.NONLINEAR,
        "cases": [style.SWELLING, style.DRYING, style.SEPARATING],
        "grey": style.GREY,
    }


def render(content: Content, explorers: Mapping[str, Any], folder: Path) -> str:
    """The page, for a file in ``folder``, to which its links are relative.

    explorers: "tube", "beads" and "gels", as of ``embedded``; "design", as of ``designer``.
    """
    return (
        environment(folder)
        .get_template("page.html")
        .render(
            content=content,
            status_meaning=STATUS_MEANING,
            explorers=explorers,
            designer=explorers["design"],
            data=as_it_is(embed({"colours": colours(), **explorers})),
            script=as_it_is(scripts(SCRIPTS)),
            style=as_it_is((TEMPLATES / "page.css").read_text(encoding="utf-8")),
        )
    )


def environment(folder: Path) -> "jinja2.Environment":
    """Templates with the filters that turn content into markup, for a file in ``folder``."""
    import jinja2

    found = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    found.filters |= {
        "html": lambda text: as_it_is(markup.html(text)),
        "caption": lambda paragraphs: as_it_is(markup.caption(paragraphs)),
        "math": lambda latex: as_it_is(markup.mathml(latex)),
        "beside": lambda path: Path(path).relative_to(folder).as_posix(),
        "stem": lambda path: Path(path).stem,
        "svg_address": lambda path: as_it_is(markup.svg_address(path)),
        "svg_size": markup.svg_size,
        "kilobytes": lambda size: f"{size / 1000:,.0f} kB",
        "scientific": scientific,
        "number": markup.number,
        "source": source,
        "plain_text": lambda text: as_it_is(markup.html(notation.from_plain(text))),
    }
    return found


def scripts(names: Iterable[str]) -> str:
    """Scripts of the page, one after the other."""
    return "\n".join((TEMPLATES / f"{name}.js").read_text(encoding="utf-8") for name in names)


def as_it_is(text: str):
    """``text`` as it is: it is markup already."""
    from markupsafe import Markup

    return Markup(text)


def embed(data: Any) -> str:
    """Data as JSON inside a script element, which no text in it can end."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c")


def scientific(value: float) -> str:
    """A small number to two digits: 1.3×10⁻⁴; zero and numbers near one as they are."""
    near = value == 0 or 0.01 <= abs(value) < 1000
    return markup.number(f"{value:.2g}" if near else f"{value:.1e}")


def source(code: str) -> str:
    """The source of a statement's function, by its full name."""
    import inspect

    from gelpump.statements import beads, flows, heat, materials, tubes

    module, _, function = code.rpartition(".")
    found = {each.__name__: each for each in (beads, flows, heat, materials, tubes)}[module]
    return inspect.getsource(getattr(found, function)).rstrip()
