"""Overlay markup: well formed, escaped, rounded consistently, and refused where it is invalid."""

import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from simulations.engine import drafting, drawing
from simulations.engine.frame import Panel
from simulations.engine.illustration import Illustration
from simulations.engine.letters import width_em

finite = st.floats(-1e4, 1e4)


def points(markup: str) -> np.ndarray:
    """All points (N, 2) of a polyline or a path."""
    element = ElementTree.fromstring(markup)
    data = element.get("points") or element.get("d") or ""
    return np.array([float(value) for value in re.findall(r"-?[\d.]+", data)]).reshape(-1, 2)


@pytest.mark.parametrize(
    ("value", "text"), [(1.0, "1"), (0.5, "0.5"), (1 / 3, "0.33"), (-0.001, "0"), (100.0, "100")]
)
def test_coordinates_are_rounded_to_a_hundredth(value: float, text: str) -> None:
    assert drawing.coordinate(value) == text


@given(st.lists(st.tuples(finite, finite), max_size=5))
@example([(-0.001, 100.0), (0.1, 10.5), (-0.004, -0.006), (-10.0, 1e4)])
def test_array_of_points_is_written_like_a_list_of_points(
    places: list[tuple[float, float]],
) -> None:
    array = np.array(places, float).reshape(-1, 2)
    assert drawing.polyline(array, "ray") == drawing.polyline(places, "ray")


@given(finite, finite, finite, finite)
def test_arrow_is_well_formed_and_ends_at_its_end(
    x1: float, y1: float, x2: float, y2: float
) -> None:
    markup = ElementTree.fromstring(f"<g>{drawing.arrow((x1, y1), (x2, y2), 'ray')}</g>")
    shaft, head = markup.find("line"), markup.find("polygon")
    assert shaft is not None
    end = f"{drawing.coordinate(x2)},{drawing.coordinate(y2)}"
    if head is None:
        assert math.hypot(x2 - x1, y2 - y1) <= 8.0
        assert end == f"{shaft.get('x2')},{shaft.get('y2')}"
    else:
        assert (head.get("points") or "").split()[0] == end


@given(st.text(st.characters(categories=("L", "N", "P", "S"))))
def test_any_text_is_escaped(content: str) -> None:
    label = ElementTree.fromstring(drawing.text((0, 0), content, "strong"))
    assert (label.text or "") == content


@pytest.mark.parametrize(("anchor", "left"), [("start", 0.0), ("middle", 0.5), ("end", 1.0)])
def test_label_over_a_picture_has_a_background_around_its_words(anchor: str, left: float) -> None:
    markup = drawing.text((10, 20), "horizon", "camera small ground", anchor)
    ground, label = ElementTree.fromstring(f"<g>{markup}</g>")
    begins, width = (float((ground.get(name) or "")[:-2]) for name in ("x", "width"))
    words = width_em("horizon")
    assert begins < -left * words < -left * words + words < begins + width
    assert label.text == "horizon"


@pytest.mark.parametrize(
    ("content", "spans"),
    [
        ("plain < text", [(None, "plain < text")]),
        ("z_s", [(None, "z"), ("sub", "s")]),
        ("10^{−4} m", [(None, "10"), ("super", "−4"), ("on line", " m")]),
        ("r_d = k_1", [(None, "r"), ("sub", "d"), ("on line", " = k"), ("sub", "1")]),
        ("a_b^c d", [(None, "a"), ("sub", "b"), ("super", "c"), ("on line", " d")]),
    ],
)
def test_subscripts_and_superscripts_return_to_the_line(
    content: str, spans: list[tuple[str | None, str]]
) -> None:
    text = ElementTree.fromstring(drafting.label((0, 0), content))
    found = [(span.get("class") or "on line", span.text or "") for span in text]
    assert [(None, text.text or ""), *found] == spans
    size = {"sub": 0.74, "super": 0.74, None: 1.0}  # an em is the size of the span's own letters
    after = ElementTree.fromstring(drafting.label((0, 0), f"{content}!"))
    steps = [size[s.get("class")] * float((s.get("dy") or "").removesuffix("em")) for s in after]
    assert sum(steps) == pytest.approx(0, abs=0.01)


def test_arcs_and_lenses_have_the_given_size() -> None:
    arc = points(drafting.arc((10, 20), 5, 0, math.pi / 2))
    assert arc[[0, -1]].tolist() == [[15, 20], [10, 15]]
    assert np.hypot(*(arc - [10, 20]).T) == pytest.approx(5, abs=0.01)
    assert np.ptp(points(drafting.glass((50, 60), 30, 8)), axis=0) == pytest.approx(
        [16, 60], abs=0.02
    )


PANEL = Panel("a", "", 400, 300)
DRAWN = Panel("a", "", 1, 1, raster=np.zeros((1, 1, 4), np.uint8))


@pytest.mark.parametrize(
    ("make", "fault"),
    [
        (lambda: drawing.line((0, 0), (math.nan, 0)), "cannot draw at"),
        (lambda: drawing.line((0, 0), (-math.inf, 0)), "cannot draw at"),
        (lambda: drawing.polyline(np.array([(0.0, 0.0), (1.0, math.inf)])), "cannot draw at inf"),
        (lambda: Illustration((), "Shows."), "without panels"),
        (lambda: Illustration((PANEL,), " "), "without a description"),
        (lambda: Illustration((DRAWN,), "Shows."), "a raster"),
    ],
)
def test_invalid_drawings_are_refused(make: object, fault: str) -> None:
    with pytest.raises(ValueError, match=fault):
        make()  # type: ignore[operator]
