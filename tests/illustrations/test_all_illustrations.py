"""What holds for every illustration: nothing outside, no label on another, all told in words."""

import re
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import pytest
from support.found import ILLUSTRATIONS
from support.label_boxes import labels

from simulations.engine.plotting.labels import Rectangle

ROOT = Path(__file__).resolve().parents[2]
DRAWN = {name: draw() for name, draw in ILLUSTRATIONS.items()}
PANELS = pytest.mark.parametrize("name", DRAWN)
WIDTHS = {190, 300, 320, 400}
STROKE = 3.0
"""Half the widest line, and a rounding."""


def corners(overlay: str) -> Iterator[tuple[float, float]]:
    """Points that the shapes of an overlay reach."""
    for element in ElementTree.fromstring(f"<svg>{overlay}</svg>").iter():
        number = {key: float(value) for key, value in element.attrib.items() if _is_number(value)}
        match element.tag:
            case "line":
                yield number["x1"], number["y1"]
                yield number["x2"], number["y2"]
            case "circle":
                for sign in (-1, 1):
                    yield number["cx"] + sign * number["r"], number["cy"] + sign * number["r"]
            case "rect" if "ground" not in (element.get("class") or ""):  # of a label
                yield number["x"], number["y"]
                yield number["x"] + number["width"], number["y"] + number["height"]
            case "polyline" | "polygon" | "path":
                text = element.get("points") or element.get("d") or ""
                values = [float(value) for value in re.findall(r"-?\d+\.?\d*", text)]
                yield from zip(values[::2], values[1::2], strict=True)


def _is_number(value: str) -> bool:
    return re.fullmatch(r"-?\d+\.?\d*", value) is not None


@PANELS
def test_nothing_is_drawn_outside_the_view_box(name: str) -> None:
    for panel in DRAWN[name].panels:
        for x, y in corners(panel.overlay):
            assert -STROKE <= x <= panel.width + STROKE, (panel.name, x, y)
            assert -STROKE <= y <= panel.height + STROKE, (panel.name, x, y)


@PANELS
def test_labels_lie_inside_the_view_box_and_none_stands_on_another(name: str) -> None:
    for panel in DRAWN[name].panels:
        frame = Rectangle(-1.0, -1.0, panel.width + 1.0, panel.height + 1.0)
        shown = labels(panel.overlay)
        assert [label.text for label in shown if label.box.sticks_out_of(frame) > 0] == []
        pairs = combinations(shown, 2)
        assert [(a.text, b.text) for a, b in pairs if a.box.shared(b.box) > 0] == []


def test_panels_are_equally_wide_and_a_unit_is_about_a_pixel_on_a_phone() -> None:
    # 358 px of column there, or two drawings in it: illustrations.css.
    widths = {name: {panel.width for panel in one.panels} for name, one in DRAWN.items()}
    odd = {name: wide for name, wide in widths.items() if len(wide) != 1 or wide - WIDTHS}
    assert odd == {}


def test_descriptions_are_sentences_without_markup() -> None:
    said = {name: illustration.description for name, illustration in DRAWN.items()}
    odd = {name for name, text in said.items() if not re.fullmatch(r"[^<>{}$^_]+\.", text)}
    assert odd == set()


def test_every_class_of_a_drawing_is_styled() -> None:
    sheets = "".join(file.read_text("utf-8") for file in (ROOT / "static" / "css").glob("*.css"))
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
    assert sorted(shown) == sorted(ILLUSTRATIONS)
