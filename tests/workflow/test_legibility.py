"""Figures at the width at which the journal prints them: size and place of every text."""

import io
import itertools
import re
from xml.etree import ElementTree

import numpy as np

from gelpump.figures import style

LEAST = 7.0  # points
# Matplotlib writes each text as a group of glyphs, scaled by its size in hundredths of a point
TEXT = re.compile(
    r'<g id="text_\d+">\s*(?:<g clip-path="[^"]*">\s*)?<!-- (?P<said>.*?) -->\s*'
    r'<g (?:style="[^"]*" )?transform="translate\((?P<x>[-\d.]+) (?P<y>[-\d.]+)\)'
    r"(?: rotate\([-\d.]+\))? scale\((?P<scale>[\d.]+) ",
    re.S,
)


SVG, HREF = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}href"
TOUCHING = 0.5  # points by which the boxes of two texts may overlap


def matrix(transform: str) -> np.ndarray:
    """An SVG transform as a matrix of homogeneous coordinates."""
    product = np.eye(3)
    for name, numbers in re.findall(r"(\w+)\(([^)]*)\)", transform):
        values = [float(each) for each in re.split(r"[ ,]+", numbers.strip())]
        step = np.eye(3)
        if name == "translate":
            step[:2, 2] = [*values, 0.0][:2]
        elif name == "scale":
            step[0, 0], step[1, 1] = values[0], values[-1]
        elif name == "rotate":
            angle = np.deg2rad(values[0])
            step[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        else:
            raise ValueError(transform)
        product = product @ step
    return product


def boxes(svg: str):
    """Each text of a drawing with the box of its glyphs: left, top, right, bottom in points."""
    root = ElementTree.fromstring(svg)
    glyphs = {}
    for path in root.iter(f"{SVG}path"):
        if path.get("id", "").startswith(("STIX", "DejaVu")):  # after their fonts
            outline = np.array(re.findall(r"-?[\d.]+", path.get("d", "")), float).reshape(-1, 2)
            placed = matrix(path.get("transform", "")) @ np.c_[outline, np.ones(len(outline))].T
            glyphs[path.get("id")] = placed[:2].T

    def points(element, outer):
        inner = outer @ matrix(element.get("transform", ""))
        if element.tag == f"{SVG}use":
            at = matrix(f"translate({element.get('x', 0)} {element.get('y', 0)})")
            outline = glyphs[element.get(HREF)[1:]]
            yield (inner @ at @ np.c_[outline, np.ones(len(outline))].T)[:2].T
        elif element.tag == f"{SVG}g":
            for child in element:
                yield from points(child, inner)

    # the drawings of Matplotlib transform nothing around their texts
    for group in root.iter(f"{SVG}g"):
        if group.get("id", "").startswith("text_"):
            found = [each for each in points(group, np.eye(3)) if len(each)]
            if found:
                corners = np.concatenate(found)
                yield group.get("id"), *corners.min(axis=0), *corners.max(axis=0)


def test_no_text_overlaps_another(built):
    drawings = sorted((built.path / "results/figures").glob("*.svg"))
    for drawing in drawings:
        svg = drawing.read_text(encoding="utf-8")
        said = dict(re.findall(r'<g id="(text_\d+)">\s*(?:<g[^>]*>\s*)?<!-- (.*?) -->', svg, re.S))
        found = list(boxes(svg))
        assert len(found) > 5, drawing.name
        for one, other in itertools.combinations(found, 2):
            across = min(one[3], other[3]) - max(one[1], other[1])
            down = min(one[4], other[4]) - max(one[2], other[2])
            assert min(across, down) < TOUCHING, (
                f"{drawing.name}: {said.get(one[0])!r} and {said.get(other[0])!r} overlap"
            )


def test_overlapping_texts_are_found():
    fig = style.figure(height=2.0)
    ax = fig.subplots()
    ax.text(0.5, 0.5, "one text")
    ax.text(0.52, 0.52, "$other$ text")
    stream = io.StringIO()
    with style.styled():
        fig.savefig(stream, format="svg")
    found = {name: box for name, *box in boxes(stream.getvalue())}
    inside = [box for box in found.values() if box[0] > 100 and box[2] - box[0] > 20]
    assert len(inside) == 2
    one, other = sorted(inside)
    assert other[0] < one[2] - TOUCHING
    assert other[1] < one[3] - TOUCHING


def texts(svg: str):
    """Each text of a drawing with its size in points and where it begins."""
    for found in TEXT.finditer(svg):
        yield found["said"], 100 * float(found["scale"]), float(found["x"]), float(found["y"])


def test_text_is_large_enough_and_within_the_page(built):
    drawings = sorted((built.path / "results/figures").glob("*.svg"))
    assert len(drawings) == 22
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
