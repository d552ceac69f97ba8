"""Marks of the drawing board: they end where they say, and plots put values in their places."""

import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest

from simulations.engine import drafting
from simulations.engine.drafting import Axis, Plot
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
    ("axis", "value", "place"),
    [
        (Axis(0, 10, 100, 200), 2.5, 125),
        (Axis(0, 10, 200, 100), 2.5, 175),
        (Axis(1, 1e4, 0, 100, log=True), 100, 50),
    ],
)
def test_an_axis_puts_a_value_in_its_place(axis: Axis, value: float, place: float) -> None:
    assert float(axis.position(value)) == pytest.approx(place)


def test_a_logarithmic_axis_has_no_place_for_zero() -> None:
    assert np.isnan(Axis(1, 10, 0, 100, log=True).position([0.0, -1.0])).all()


def test_a_curve_is_broken_where_it_leaves_the_plot_or_is_undefined() -> None:
    plot = Plot(Axis(0, 8, 0, 80), Axis(0, 1, 10, 0))
    heights = [0.5, 0.5, 2.0, 0.5, 0.5, np.nan, 0.5, 0.5, 0.5]
    runs = plot.pieces(range(9), heights)
    assert [[x for x, _ in run] for run in runs] == [[0, 10], [30, 40], [60, 70, 80]]


def test_an_area_stands_on_the_foot_of_the_plot() -> None:
    plot = Plot(Axis(0, 1, 0, 100), Axis(0, 1, 50, 0))
    assert points(plot.area([0.2, 0.6], [1.0, 0.5])) == [(20, 50), (20, 0), (60, 25), (60, 50)]


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
