"""Polygons and lines cut to what a homography shows."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.models.geometry import transforms
from simulations.models.geometry.transforms import (
    apply_homography,
    clip_half_plane,
    clip_to_visible,
)

TILTED = transforms.projective([1, 0, 0, 0, 1, 0, 1, 0, 1])
"""w = 1 + x: the line x = −1 goes to infinity."""
SQUARE = np.array([(-2.0, 0.0), (2.0, 0.0), (2.0, 1.0), (-2.0, 1.0)])


def test_clipping_keeps_just_the_part_in_front() -> None:
    visible = clip_to_visible(TILTED, SQUARE, w_minimum=0.1)
    # The largest sum of terms is 3, at x = ±2, so the cut lies at w = 0.3.
    expected = {(-0.7, 0), (2, 0), (2, 1), (-0.7, 1)}
    assert set(map(tuple, visible.round(12))) == expected
    assert apply_homography(TILTED, visible)[1].all()


def test_clipping_leaves_a_visible_polygon_alone_and_nothing_of_a_hidden_one() -> None:
    assert np.array_equal(clip_to_visible(TILTED, SQUARE + 5), SQUARE + 5)
    assert clip_to_visible(TILTED, SQUARE - [5, 0]).shape == (0, 2)
    assert clip_to_visible(TILTED, np.empty((0, 2))).shape == (0, 2)


@given(st.lists(st.floats(-1, 1), min_size=9, max_size=9))
def test_whatever_survives_clipping_has_an_image_and_lies_with_the_point_that_is_seen(
    entries: list[float],
) -> None:
    H = np.array(entries).reshape(3, 3)
    if abs(H[2, 2]) > 1e-3:
        kept = clip_to_visible(H, SQUARE)
        assert apply_homography(H, kept)[1].all()
        assert (transforms.sign_of_w(H, kept) == np.sign(H[2, 2])).all()


def test_the_two_sides_of_the_line_make_up_the_figure() -> None:
    origin_s, beyond = (
        clip_to_visible(TILTED, SQUARE),
        clip_to_visible(TILTED, SQUARE, seen=(-5, 0)),
    )
    assert origin_s[:, 0].min() == pytest.approx(-1, abs=1e-5)
    assert beyond[:, 0].max() == pytest.approx(-1, abs=1e-5)
    assert {(2, 0), (2, 1)} < set(map(tuple, origin_s))
    assert {(-2, 0), (-2, 1)} < set(map(tuple, beyond))


def test_clipping_a_polygon_by_any_line_leaves_the_area_that_is_known() -> None:
    """The unit square, cut by x + y ≤ 3/2, loses a triangle with legs of 1/2."""
    square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    kept = clip_half_plane(square, (-1.0, -1.0, 1.5))
    assert {tuple(p) for p in kept} == {(0, 0), (1, 0), (1, 0.5), (0.5, 1), (0, 1)}
    x, y = kept.T
    assert (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2 == pytest.approx(7 / 8)


def test_vertices_on_the_line_itself_stay() -> None:
    square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    assert clip_half_plane(square, (1, 0, 0)).tolist() == [list(p) for p in square]
    assert set(map(tuple, clip_half_plane(square, (-1, 0, 0)))) == {(0, 0), (0, 1)}


def test_a_polyline_keeps_its_order_and_its_parts_in_front() -> None:
    line = [(-1.0, 0.0), (1.0, 2.0), (3.0, 2.0), (-1.0, -2.0)]
    kept = clip_half_plane(line, (1, 0, 0), closed=False)
    assert kept.tolist() == [[0, 1], [1, 2], [3, 2], [0, -1]]
    assert clip_half_plane(line, (1, 0, 0)).tolist() == [[0, 1], [1, 2], [3, 2], [0, -1]]
    triangle = [(1.0, 0.0), (1.0, 2.0), (-1.0, 2.0)]
    assert len(clip_half_plane(triangle, (1, 0, 0))) == 4
    assert len(clip_half_plane(triangle, (1, 0, 0), closed=False)) == 3


def test_the_usual_margin_is_a_millionth() -> None:
    kept = clip_to_visible(TILTED, SQUARE)
    assert kept[:, 0].min() == pytest.approx(-1 + 3e-6, abs=1e-9)
    open_line = clip_to_visible(TILTED, SQUARE[[1, 2, 3]], closed=False)
    assert open_line == pytest.approx(np.array([(2, 0), (2, 1), (-1 + 3e-6, 1)]))


def test_the_margin_of_clipping_is_a_share_of_the_largest_terms_hidden_ones_too() -> None:
    """At x = −5 the terms of w = 1 + x add up to 6 in size, so that the cut lies at w = 0.6."""
    visible = clip_to_visible(TILTED, [(-5.0, 0), (1, 0), (1, 1), (-5, 1)], w_minimum=0.1)
    assert visible[:, 0].min() == pytest.approx(-0.4)
