"""Figures at the width at which the journal prints them: size and place of every text."""

import re

import pytest

from gelpump.figures import style

pytestmark = pytest.mark.xdist_group("workflow")

LEAST = 7.0  # points
# Matplotlib writes each text as a group of glyphs, scaled by its size in hundredths of a point
TEXT = re.compile(
    r'<g id="text_\d+">\s*(?:<g clip-path="[^"]*">\s*)?<!-- (?P<said>.*?) -->\s*'
    r'<g (?:style="[^"]*" )?transform="translate\((?P<x>[-\d.]+) (?P<y>[-\d.]+)\)'
    r"(?: rotate\([-\d.]+\))? scale\((?P<scale>[\d.]+) ",
    re.S,
)


def texts(svg: str):
    """Each text of a drawing with its size in points and where it begins."""
    for found in TEXT.finditer(svg):
        yield found["said"], 100 * float(found["scale"]), float(found["x"]), float(found["y"])


def test_text_is_large_enough_and_within_the_page(built):
    drawings = sorted((built.path / "results/figures").glob("*.svg"))
    assert len(drawings) == 15
    for drawing in drawings:
        svg = drawing.read_text(encoding="utf-8")
        width, height = map(float, re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg).groups())
        assert width <= 72 * style.WIDTH + 0.5, "it would be printed smaller than it is drawn"
        found = list(texts(svg))
        assert len(found) == svg.count('<g id="text_') > 5, drawing.name
        for said, size, x, y in found:
            assert size >= LEAST - 0.01, f"{drawing.name}: {said!r} has {size:.1f} points"
            assert 0 <= x <= width, f"{drawing.name}: {said!r} begins outside"
            assert 0 <= y <= height, f"{drawing.name}: {said!r} begins outside"


def test_series_have_colours_that_colour_blind_readers_tell_apart():
    okabe_ito = {"#000000", "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00"}
    series = {style.LENS, style.NONLINEAR, style.PUBLISHED}
    series |= {style.SWELLING, style.DRYING, style.SEPARATING}
    assert series <= okabe_ito
