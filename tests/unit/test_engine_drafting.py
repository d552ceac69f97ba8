"""Marks of the drawing board: they end where they say, and plots put values in their places."""

import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest

from simulations.engine import drafting
from simulations.engine.drawing import line
from simulations.engine.frame import Panel
from simulations.engine.illustration import Illustration


def points(markup: str) -> list[tuple[float, float]]:
    """All points of a polyline or a path."""
    element = ElementTree.fromstring(markup)
    data = element.get("points") or element.get("d") or ""
    values = [float(value) for value in re.findall(r"-?[\d.]+", data)]
    return list(zip(values[::2], values[1::2], strict=True))


@pytest.mark.parametrize(
    ("content", "spans"),
    [
        ("plain < text", [(None, "plain < text")]),
        ("z_s", [(None, "z"), ("sub", "s")]),
        ("10^{−4} m", [(None, "10"), ("super", "−4"), ("on line", " m")]),
        ("r_d = k_1", [(None, "r"), ("sub", "d"), ("on line", " = k"), ("sub", "1")]),
    ],
)
def test_scripts_leave_the_line_and_the_rest_returns_to_it(
    content: str, spans: list[tuple[str | None, str]]
) -> None:
    text = ElementTree.fromstring(drafting.label((0, 0), content))
    found: list[tuple[str | None, str]] = [(None, text.text or "")]
    found += [(span.get("class") or "on line", span.text or "") for span in text]
    assert found == spans


@pytest.mark.parametrize("content", ["a_b", "a^b", "a_b c", "a_b^c d"])
def test_the_steps_off_the_line_add_up_to_none(content: str) -> None:
    size = {"sub": 0.74, "super": 0.74, None: 1.0}  # an em is the size of the span's own letters
    text = ElementTree.fromstring(drafting.label((0, 0), f"{content}!"))
    steps = [size[s.get("class")] * float((s.get("dy") or "").removesuffix("em")) for s in text]
    assert sum(steps) == pytest.approx(0, abs=0.01)


def test_a_computed_colour_is_held_to_what_a_screen_shows() -> None:
    mark = ElementTree.fromstring(drafting.swatch((1, 2), 3, 4, (1.2, 0.5, -0.1)))
    assert mark.get("fill") == "#ff8000"


def test_angles_of_an_arc_count_upwards_from_the_right() -> None:
    places = points(drafting.arc((10, 20), 5, 0, math.pi / 2))
    assert places[0] == (15, 20)
    assert places[-1] == (10, 15)
    assert [math.hypot(x - 10, y - 20) for x, y in places] == pytest.approx(
        [5] * len(places), abs=0.01
    )


def test_a_lens_is_as_high_and_as_thick_as_asked() -> None:
    places = np.array(points(drafting.glass((50, 60), 30, 8)))
    assert np.ptp(places, axis=0) == pytest.approx([16, 60], abs=0.02)


@pytest.mark.parametrize(
    ("panels", "description", "fault"),
    [
        ((), "Shows.", "without panels"),
        ((Panel("a", "", 400, 300),), " ", "without a description"),
        ((Panel("a", "", 1, 1, raster=np.zeros((1, 1, 4), np.uint8)),), "Shows.", "a raster"),
    ],
)
def test_an_illustration_is_refused_that_no_page_could_show(
    panels: tuple[Panel, ...], description: str, fault: str
) -> None:
    with pytest.raises(ValueError, match=fault):
        Illustration(panels, description)


def test_drawings_in_a_computed_colour_inherit_it() -> None:
    drawn = drafting.tinted([line((0, 0), (1, 1), "thin")], (1.0, 0.5, 0.0))
    assert drawn == '<g color="#ff8000"><line class="thin" x1="0" y1="0" x2="1" y2="1"/></g>'
