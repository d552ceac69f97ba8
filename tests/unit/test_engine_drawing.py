"""Overlay markup: well formed, escaped, and the same on machines whose libm differs slightly."""

import math
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from simulations.engine import drawing
from simulations.engine.letters import width_em

finite = st.floats(-1e4, 1e4)


@pytest.mark.parametrize(
    ("value", "text"), [(1.0, "1"), (0.5, "0.5"), (1 / 3, "0.33"), (-0.001, "0"), (100.0, "100")]
)
def test_coordinates_are_rounded_to_a_hundredth(value: float, text: str) -> None:
    assert drawing.coordinate(value) == text


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_no_renderer_can_draw_is_refused(value: float) -> None:
    with pytest.raises(ValueError, match="cannot draw at"):
        drawing.line((0, 0), (value, 0))


@given(st.lists(st.tuples(finite, finite), max_size=5))
@example([(-0.001, 100.0), (0.1, 10.5), (-0.004, -0.006), (-10.0, 1e4)])
def test_an_array_of_points_is_written_as_each_of_them_would_be(
    points: list[tuple[float, float]],
) -> None:
    array = np.array(points, float).reshape(-1, 2)
    assert drawing.polyline(array, "ray") == drawing.polyline(points, "ray")


def test_an_array_with_a_point_that_cannot_be_drawn_is_refused() -> None:
    with pytest.raises(ValueError, match="cannot draw at inf"):
        drawing.polyline(np.array([(0.0, 0.0), (1.0, math.inf)]))


@given(finite, finite, finite, finite)
def test_an_arrow_is_well_formed_and_ends_at_its_end(
    x1: float, y1: float, x2: float, y2: float
) -> None:
    markup = ElementTree.fromstring(f"<g>{drawing.arrow((x1, y1), (x2, y2), 'ray')}</g>")
    shaft = markup.find("line")
    assert shaft is not None
    end = f"{drawing.coordinate(x2)},{drawing.coordinate(y2)}"
    head = markup.find("polygon")
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
def test_a_label_over_a_picture_has_a_ground_around_its_words(anchor: str, left: float) -> None:
    markup = drawing.text((10, 20), "horizon", "camera small ground", anchor)
    ground, label = ElementTree.fromstring(f"<g>{markup}</g>")
    assert ground.get("class") == "ground small"
    begins, width = (float((ground.get(name) or "")[:-2]) for name in ("x", "width"))
    words = width_em("horizon")
    assert begins < -left * words < -left * words + words < begins + width
    assert label.text == "horizon"


def test_shapes_carry_their_classes_and_no_colours() -> None:
    markup = "".join(
        (
            drawing.polyline([(0, 0), (1, 1)], "ray dashed"),
            drawing.polygon([(0, 0), (1, 1), (1, 0)], "world fill"),
            drawing.path([[(0, 0), (1, 1)], [(2, 2), (3, 3)]], "muted"),
            drawing.ellipse((1, 1), (2, 3), "light"),
            drawing.rectangle((0, 0), 4, 3, "image"),
            drawing.dot((1, 1), "camera"),
        )
    )
    group = ElementTree.fromstring(drawing.group([markup], "figure"))
    assert [child.get("class") for child in group] == [
        "ray dashed", "world fill", "muted", "light", "image", "camera solid",
    ]  # fmt: skip
    assert group[2].get("d") == "M0,0L1,1M2,2L3,3"
    assert not {"fill", "stroke", "style"} & {name for child in group for name in child.attrib}
