"""Rectangles and lines."""

import pytest

from site_builder.charts.boxes import Box


@pytest.mark.parametrize(
    ("segment", "length"),
    [
        (((-5.0, 5.0), (15.0, 5.0)), 10.0),
        (((2.0, 5.0), (4.0, 5.0)), 2.0),
        (((5.0, -5.0), (5.0, 5.0)), 5.0),
        (((-5.0, 20.0), (15.0, 20.0)), 0.0),
        (((0.0, -10.0), (20.0, 10.0)), 0.0),
        (((-5.0, -5.0), (15.0, 15.0)), 10.0 * 2**0.5),
    ],
)
def test_a_box_tells_how_much_of_a_line_it_hides(
    segment: tuple[tuple[float, float], tuple[float, float]], length: float
) -> None:
    assert Box(0, 0, 10, 10).length_inside(segment) == pytest.approx(length)
