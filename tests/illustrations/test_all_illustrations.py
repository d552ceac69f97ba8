"""Every illustration: shapes inside its box, labels clear of each other, a plain description."""

import re
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import pytest
from support.label_boxes import labels
from support.places import illustrations

from simulations.engine.plotting.labels import Rectangle
from site_builder.output.style_sheets import colour_rules

ROOT = Path(__file__).resolve().parents[2]
DRAWN = {name: draw() for name, draw in illustrations().items()}
EACH = pytest.mark.parametrize("name", DRAWN)
WIDTHS = {190, 300, 320, 400}
STROKE = 3.0
"""Half the widest line, plus rounding."""


def corners(overlay: str) -> Iterator[tuple[float, float]]:
    """Extreme points of the shapes of an overlay."""
    for element in ElementTree.fromstring(f"<svg>{overlay}</svg>").iter():

        def at(name: str, element: ElementTree.Element = element) -> float:
            return float(element.get(name, ""))

        match element.tag:
            case "line":
                yield at("x1"), at("y1")
                yield at("x2"), at("y2")
            case "circle":
                yield at("cx") - at("r"), at("cy") - at("r")
                yield at("cx") + at("r"), at("cy") + at("r")
            case "rect" if "ground" not in (element.get("class") or ""):  # of a label
                yield at("x"), at("y")
                yield at("x") + at("width"), at("y") + at("height")
            case "polyline" | "polygon" | "path":
                text = element.get("points") or element.get("d") or ""
                values = [float(value) for value in re.findall(r"-?\d+\.?\d*", text)]
                yield from zip(values[::2], values[1::2], strict=True)


@EACH
def test_shapes_lie_inside_the_view_box(name: str) -> None:
    for panel in DRAWN[name].panels:
        for x, y in corners(panel.overlay):
            assert -STROKE <= x <= panel.width + STROKE, (panel.name, x, y)
            assert -STROKE <= y <= panel.height + STROKE, (panel.name, x, y)


@EACH
def test_labels_lie_inside_the_view_box_and_do_not_overlap(name: str) -> None:
    for panel in DRAWN[name].panels:
        frame = Rectangle(-1.0, -1.0, panel.width + 1.0, panel.height + 1.0)
        shown = labels(panel.overlay)
        assert [label.text for label in shown if label.box.sticks_out_of(frame) > 0] == []
        pairs = combinations(shown, 2)
        assert [(a.text, b.text) for a, b in pairs if a.box.shared(b.box) > 0] == []


@EACH
def test_widths_fit_a_phone_and_descriptions_have_no_markup(name: str) -> None:
    """A phone's column is 358 px wide and holds one drawing or two (illustrations.css)."""
    (width,) = {panel.width for panel in DRAWN[name].panels}
    assert width in WIDTHS
    assert re.fullmatch(r"[^<>{}$^_]+\.", DRAWN[name].description)


def test_every_class_of_a_drawing_has_a_style() -> None:
    sheets = "".join(file.read_text("utf-8") for file in (ROOT / "static" / "css").glob("*.css"))
    sheets += colour_rules({})
    found = {
        name
        for illustration in DRAWN.values()
        for panel in illustration.panels
        for style in re.findall(r'class="([^"]*)"', panel.overlay)
        for name in style.split()
    }
    assert {name for name in found if f".{name}" not in sheets} == set()


def test_every_illustration_is_shown_by_one_chapter() -> None:
    chapters = [file.read_text("utf-8") for file in (ROOT / "content").glob("*.md")]
    shown = [
        name for text in chapters for name in re.findall(r"^:::\{illustration\} (\S+)", text, re.M)
    ]
    assert sorted(shown) == sorted(illustrations())
