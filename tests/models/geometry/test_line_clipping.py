"""The part of a line that lies in a rectangle, whatever its direction."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.models.geometry.line_clipping import line_in_rectangle
from simulations.models.geometry.transforms import clip_half_plane

LOWEST, HIGHEST = (-1.0, 0.0), (3.0, 2.0)


@pytest.mark.parametrize(
    ("line", "ends"),
    [
        ((0, 1, -1.5), [(-1, 1.5), (3, 1.5)]),
        ((-2, 0, 1), [(0.5, 0), (0.5, 2)]),
        ((1, 1, -2), [(0, 2), (2, 0)]),
        ((0, 3, 0), [(-1, 0), (3, 0)]),
        ((1, 0, -3), [(3, 0), (3, 2)]),
        ((1, -2, 1), [(-1, 0), (3, 2)]),
    ],
    ids=["level", "upright", "slanted", "lower side", "right side", "diagonal"],
)
@pytest.mark.parametrize("factor", [1.0, -1.0, 1e-200, -3e150])
def test_a_line_of_any_direction_and_scale_ends_on_the_border(
    line: tuple[float, ...], ends: list[tuple[float, float]], factor: float
) -> None:
    found = line_in_rectangle(np.multiply(line, factor), LOWEST, HIGHEST)
    assert found == pytest.approx(np.array(ends, float), abs=1e-12)


@pytest.mark.parametrize(
    "line",
    [(0, 1, -2.5), (1, 0, 2), (1, 1, 1), (0, 0, 1), (0, 0, 0), (1, math.nan, 0), (math.inf, 1, 0)],
    ids=["above", "beside", "touching a corner", "at infinity", "zeros", "nan", "inf"],
)
def test_nothing_is_left_of_a_line_that_misses_or_is_none(line: tuple[float, ...]) -> None:
    assert line_in_rectangle(line, LOWEST, HIGHEST).shape == (0, 2)


@given(st.floats(-math.pi, math.pi), st.floats(-0.9, 2.9), st.floats(0.1, 1.9))
def test_it_agrees_with_a_long_segment_cut_side_by_side(angle: float, x: float, y: float) -> None:
    """Through a point inside, cut by the four half planes in turn."""
    along = np.array([math.cos(angle), math.sin(angle)])
    segment = np.array([(x, y) - 9.0 * along, (x, y) + 9.0 * along])
    for side in ((1, 0, 1), (-1, 0, 3), (0, 1, 0), (0, -1, 2)):
        segment = clip_half_plane(segment, side, closed=False)
    a, b = -along[1], along[0]
    found = line_in_rectangle((a, b, -a * x - b * y), LOWEST, HIGHEST)
    assert min(np.abs(found - segment).max(), np.abs(found[::-1] - segment).max()) < 1e-9
