"""Transformations of the plane: moved points, clipping, and preserved properties."""

import math

import numpy as np
import pytest

from simulations.models.geometry import transforms
from simulations.models.geometry.preserved_properties import measure_preservation
from simulations.models.geometry.transforms import (
    apply_homography,
    clip_half_plane,
    clip_to_rectangle,
    clip_to_visible,
)

TILTED = transforms.projective([1, 0, 0, 0, 1, 0, 1, 0, 1])
"""w = 1 + x: the line x = −1 goes to infinity."""


def test_each_family_moves_a_point_by_its_equation() -> None:
    quarter = math.pi / 2
    for H, expected in (
        (transforms.translation(3, -1), (5, 0)),
        (transforms.rigid(quarter, 3, -1), (2, 1)),
        (transforms.similarity(2, quarter, 3, -1), (1, 3)),
        (transforms.affine([[2, 1], [0, 3]], (3, -1)), (8, 2)),
        (TILTED, (2 / 3, 1 / 3)),
    ):
        image, valid = apply_homography(H, (2.0, 1.0))
        assert valid
        assert image == pytest.approx(expected)


def test_points_on_the_line_sent_to_infinity_have_no_image() -> None:
    images, valid = apply_homography(TILTED, [(-1 + 1e-9, 0), (-1, 0), (-1 - 1e-16, 0), (-2, 3)])
    assert valid.tolist() == [True, False, False, True]
    assert np.isnan(images[1:3]).all()
    assert images[3] == pytest.approx((2, -3))


def test_sign_of_w_differs_on_both_sides_of_the_line_sent_to_infinity() -> None:
    points = [(0, 0), (-2, 0), (-1, 5), (-1 + 1e-13, 0), (math.inf, 0), (math.nan, 0)]
    assert transforms.sign_of_w(TILTED, points).tolist() == [1, -1, 0, 0, 0, 0]
    assert transforms.sign_of_w(-1e200 * TILTED, points).tolist() == [-1, 1, 0, 0, 0, 0]


SQUARE = np.array([(-2.0, 0.0), (2.0, 0.0), (2.0, 1.0), (-2.0, 1.0)])


def test_clipping_keeps_exactly_the_visible_part() -> None:
    visible = clip_to_visible(TILTED, SQUARE, w_minimum=0.1)
    # The largest sum of terms is 3, at x = ±2, so the cut lies at w = 0.3.
    expected = {(-0.7, 0), (2, 0), (2, 1), (-0.7, 1)}
    assert set(map(tuple, visible.round(12))) == expected
    assert apply_homography(TILTED, visible)[1].all()


def test_square_clipped_by_a_half_plane_has_the_known_area() -> None:
    """The unit square, cut by x + y ≤ 3/2, loses a triangle with legs of 1/2."""
    square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    kept = clip_half_plane(square, (-1.0, -1.0, 1.5))
    assert {tuple(p) for p in kept} == {(0, 0), (1, 0), (1, 0.5), (0.5, 1), (0, 1)}
    x, y = kept.T
    assert (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2 == pytest.approx(7 / 8)


def test_clipped_polyline_keeps_the_order_of_its_parts() -> None:
    line = [(-1.0, 0.0), (1.0, 2.0), (3.0, 2.0), (-1.0, -2.0)]
    kept = clip_half_plane(line, (1, 0, 0), closed=False)
    assert kept.tolist() == [[0, 1], [1, 2], [3, 2], [0, -1]]
    assert clip_half_plane(line, (1, 0, 0)).tolist() == [[0, 1], [1, 2], [3, 2], [0, -1]]
    triangle = [(1.0, 0.0), (1.0, 2.0), (-1.0, 2.0)]
    assert len(clip_half_plane(triangle, (1, 0, 0))) == 4
    assert len(clip_half_plane(triangle, (1, 0, 0), closed=False)) == 3
    around = clip_to_rectangle([(-9.0, -9.0), (30.0, -9.0), (-9.0, 30.0)], (0, 1), (3, 2))
    assert {tuple(corner) for corner in around} == {(0, 1), (3, 1), (3, 2), (0, 2)}


SEGMENTS = np.array(
    [[(0, 0), (1, 0)], [(0, 1), (1, 1)], [(0, 0), (0, 1)], [(1, 0), (1, 1)], [(0, 0), (1, 1)]],
    dtype=float,
)

FAMILIES = {
    "translation": (transforms.translation(3, 1), set()),
    "rigid": (transforms.rigid(0.4, 3, 1), {"turn_rad"}),
    "similarity": (transforms.similarity(1.5, 0.4, 3, 1), {"turn_rad", "length"}),
    "affine": (
        transforms.affine([[1.2, 0.3], [0.1, 0.8]], (3, 1)),
        {"turn_rad", "length", "angle_rad"},
    ),
    "mirror": (transforms.affine([[-1, 0], [0, 1]], (0, 0)), {"turn_rad"}),
    "projective": (TILTED, {"turn_rad", "length", "angle_rad", "parallel_rad"}),
}


@pytest.mark.parametrize("family", FAMILIES)
def test_every_family_changes_exactly_its_lost_properties(family: str) -> None:
    H, lost = FAMILIES[family]
    measured = measure_preservation(H, SEGMENTS)
    changed = {name for name in measured.__slots__ if getattr(measured, name) > 1e-12}
    assert changed == lost


def test_length_change_is_infinite_where_the_figure_is_cut() -> None:
    measured = measure_preservation(TILTED, SEGMENTS - [0.5 + 1, 0])
    assert measured.length == math.inf
    assert measured.bend < 1e-9


def test_projective_map_changes_a_square_by_known_amounts() -> None:
    """Under w = 1 + x the sides of the unit square at x = 0 and 1 become 1 and 1/2 long."""
    square = np.array(
        [[(0, 0), (1, 0)], [(1, 0), (1, 1)], [(0, 1), (1, 1)], [(0, 0), (0, 1)]], float
    )
    measured = measure_preservation(TILTED, square)
    slant = math.hypot(0.5, 0.5)  # the upper side runs from (0, 1) to (1/2, 1/2)
    assert measured.turn_rad == pytest.approx(math.pi / 4)
    assert measured.length == pytest.approx(0.5)
    assert abs(slant - 1) < 0.5
    assert measured.angle_rad == pytest.approx(math.pi / 4)
    assert measured.parallel_rad == pytest.approx(math.pi / 4)
    assert measured.bend == pytest.approx(0, abs=1e-12)
