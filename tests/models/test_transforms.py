"""The ladder of 2D transformations: what each keeps, and where the division by w fails."""

import math

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.models import preservation, transforms
from simulations.models.preservation import measure_preservation
from simulations.models.transforms import apply_homography, clip_half_plane, clip_to_visible

RNG = np.random.default_rng(5)
TILTED = transforms.projective([1, 0, 0, 0, 1, 0, 1, 0, 1])
"""w = 1 + x: the line x = −1 goes to infinity."""
SQUARE = np.array([(-2.0, 0.0), (2.0, 0.0), (2.0, 1.0), (-2.0, 1.0)])
SEGMENTS = np.array(
    [[(0, 0), (1, 0)], [(0, 1), (1, 1)], [(0, 0), (0, 1)], [(1, 0), (1, 1)], [(0, 0), (1, 1)]],
    dtype=float,
)
angles = st.floats(-10, 10)
offsets = st.floats(-1e3, 1e3)


def test_each_rung_moves_a_point_as_its_equation_says():
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


@given(angles, offsets, offsets)
def test_rigid_motions_compose_by_adding_angles(angle, tx, ty):
    H = transforms.rigid(angle, tx, ty) @ transforms.rigid(0.3, 0, 0)
    assert transforms.rigid(angle + 0.3, tx, ty) == pytest.approx(H, abs=1e-12)


def test_points_are_mapped_as_by_opencv():
    H = transforms.projective([[1.1, 0.2, 30], [-0.1, 0.9, 5], [1e-3, 2e-3, 1]])
    points = RNG.uniform(0, 100, (50, 2))
    images, valid = apply_homography(H, points)
    assert valid.all()
    assert images == pytest.approx(cv2.perspectiveTransform(points[:, None], H)[:, 0])


def test_nothing_on_or_beyond_the_line_sent_to_infinity_has_an_image():
    images, valid = apply_homography(TILTED, [(-1 + 1e-9, 0), (-1, 0), (-1 - 1e-16, 0), (-2, 0)])
    assert valid.tolist() == [True, False, False, False]
    assert np.isnan(images[1:]).all()


@pytest.mark.parametrize("factor", [1e-200, 1e-9, 1.0, 1e200])
def test_a_positive_factor_of_the_matrix_changes_nothing(factor):
    images, valid = apply_homography(TILTED * factor, SQUARE)
    assert valid.tolist() == [False, True, True, False]
    assert images[1:3] == pytest.approx(apply_homography(TILTED, SQUARE)[0][1:3])


def test_points_that_are_not_finite_are_invalid():
    _, valid = apply_homography(np.eye(3), [(math.nan, 0), (math.inf, 0), (1, 1)])
    assert valid.tolist() == [False, False, True]


def test_the_visible_side_is_that_of_the_origin():
    assert np.array_equal(transforms.projective(-TILTED), TILTED)


def test_a_homography_that_sends_the_origin_to_infinity_is_legal():
    H = transforms.projective([[1, 0, 0], [0, 0, 1], [0, -2, 0]])
    assert np.linalg.norm(H) == pytest.approx(1)
    assert apply_homography(H, [(0, 0), (0, 1)])[1].tolist() == [False, True]


@pytest.mark.parametrize("h", [np.zeros(9), [*[1.0] * 8, math.nan], [*[1.0] * 8, math.inf]])
def test_a_matrix_that_is_no_transformation_is_refused(h):
    with pytest.raises(ValueError, match="legal"):
        transforms.projective(h)


@pytest.mark.parametrize("scale", [0.0, -1.0, math.nan, math.inf])
def test_a_scale_must_be_positive(scale):
    with pytest.raises(ValueError, match="scale"):
        transforms.similarity(scale, 0, 0, 0)


def test_clipping_keeps_just_the_part_in_front():
    visible = clip_to_visible(TILTED, SQUARE, w_minimum=0.1)
    # The largest sum of terms is 3, at x = ±2, so the cut lies at w = 0.3.
    expected = {(-0.7, 0), (2, 0), (2, 1), (-0.7, 1)}
    assert set(map(tuple, visible.round(12))) == expected
    assert apply_homography(TILTED, visible)[1].all()


def test_clipping_leaves_a_visible_polygon_alone_and_nothing_of_a_hidden_one():
    assert np.array_equal(clip_to_visible(TILTED, SQUARE + 5), SQUARE + 5)
    assert clip_to_visible(TILTED, SQUARE - [5, 0]).shape == (0, 2)
    assert clip_to_visible(TILTED, np.empty((0, 2))).shape == (0, 2)


@given(st.lists(st.floats(-1, 1), min_size=9, max_size=9))
def test_whatever_survives_clipping_has_an_image(entries):
    H = np.array(entries).reshape(3, 3)
    if np.abs(H[2]).max() > 1e-3:
        assert apply_homography(H, clip_to_visible(H, SQUARE))[1].all()


def test_the_margin_of_clipping_must_be_a_small_share():
    with pytest.raises(ValueError, match="w_minimum"):
        clip_to_visible(TILTED, SQUARE, w_minimum=0.0)


def test_an_open_line_is_not_joined_at_its_ends():
    ends = clip_half_plane([(-1, 0), (1, 0)], (1, 0, 0), closed=False)
    assert ends == pytest.approx(np.array([(0, 0), (1, 0)]))


RUNGS = {
    "translation": (transforms.translation(3, 1), set()),
    "rigid": (transforms.rigid(0.4, 3, 1), {"turn_rad"}),
    "similarity": (transforms.similarity(1.5, 0.4, 3, 1), {"turn_rad", "length"}),
    "affine": (
        transforms.affine([[1.2, 0.3], [0.1, 0.8]], (3, 1)),
        {"turn_rad", "length", "angle_rad"},
    ),
    "projective": (TILTED, {"turn_rad", "length", "angle_rad", "parallel_rad"}),
}


@pytest.mark.parametrize("rung", RUNGS)
def test_every_rung_gives_up_one_more_property(rung):
    H, lost = RUNGS[rung]
    measured = measure_preservation(H, SEGMENTS)
    changed = {name for name in measured.__slots__ if getattr(measured, name) > 1e-12}
    assert changed == lost


def test_the_measures_are_the_known_amounts():
    measured = measure_preservation(transforms.similarity(1.5, 0.4, 3, 1), SEGMENTS)
    assert (measured.turn_rad, measured.length) == pytest.approx((0.4, 0.5))
    sheared = measure_preservation(transforms.affine([[1, 1], [0, 1]], (0, 0)), SEGMENTS)
    assert sheared.angle_rad == pytest.approx(math.pi / 4)
    assert sheared.length == pytest.approx(math.sqrt(5 / 2) - 1)


@pytest.mark.parametrize("size", [1e-100, 1e100])
def test_the_measures_do_not_depend_on_the_unit_of_length(size):
    sheared = transforms.affine([[1, 1], [0, 1]], (0, 0))
    measured = measure_preservation(sheared, SEGMENTS * size)
    assert measured.angle_rad == pytest.approx(math.pi / 4)
    assert measured.turn_rad == pytest.approx(math.pi / 4)


def test_a_mirror_keeps_lengths_and_angles():
    measured = measure_preservation(transforms.affine([[-1, 0], [0, 1]], (0, 0)), SEGMENTS)
    assert (measured.length, measured.angle_rad) == (0.0, 0.0)


def test_lengths_change_without_bound_where_the_figure_is_cut():
    measured = measure_preservation(TILTED, SEGMENTS - [0.5 + 1, 0])
    assert measured.length == math.inf
    assert measured.bend < 1e-9


def test_a_figure_out_of_sight_cannot_be_measured():
    with pytest.raises(ValueError, match="segments: 0 of 5 visible"):
        measure_preservation(TILTED, SEGMENTS - [9, 0])


def test_clipping_a_polygon_by_any_line_leaves_the_area_that_is_known():
    """The unit square, cut by x + y ≤ 3/2, loses a triangle with legs of 1/2."""
    square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    kept = clip_half_plane(square, (-1.0, -1.0, 1.5))
    assert {tuple(p) for p in kept} == {(0, 0), (1, 0), (1, 0.5), (0.5, 1), (0, 1)}
    x, y = kept.T
    assert (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2 == pytest.approx(7 / 8)


def test_vertices_on_the_line_itself_stay():
    square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    assert clip_half_plane(square, (1, 0, 0)).tolist() == [list(p) for p in square]
    assert set(map(tuple, clip_half_plane(square, (-1, 0, 0)))) == {(0, 0), (0, 1)}


def test_a_polyline_keeps_its_order_and_its_parts_in_front():
    line = [(-1.0, 0.0), (1.0, 2.0), (3.0, 2.0), (-1.0, -2.0)]
    kept = clip_half_plane(line, (1, 0, 0), closed=False)
    assert kept.tolist() == [[0, 1], [1, 2], [3, 2], [0, -1]]
    assert clip_half_plane(line, (1, 0, 0)).tolist() == [[0, 1], [1, 2], [3, 2], [0, -1]]
    triangle = [(1.0, 0.0), (1.0, 2.0), (-1.0, 2.0)]
    assert len(clip_half_plane(triangle, (1, 0, 0))) == 4
    assert len(clip_half_plane(triangle, (1, 0, 0), closed=False)) == 3


@pytest.mark.parametrize(
    ("polygon", "line"),
    [([(1.1e150, 0)], (1, 0, 0)), ([(math.nan, 0)], (1, 0, 0)), ([(0, 0)], (1, math.inf, 0))],
)
def test_only_coordinates_within_the_range_are_clipped(polygon, line):
    with pytest.raises(ValueError, match="legal: finite, at most 1e"):
        clip_half_plane(polygon, line)
    assert clip_half_plane([(1e150, 0.0)], (1, 0, 0)).tolist() == [[1e150, 0]]


@pytest.mark.parametrize("w_minimum", [1e-12, 1.0, -0.1, math.nan])
def test_the_margin_lies_between_rounding_and_all(w_minimum):
    with pytest.raises(ValueError, match="w_minimum"):
        clip_to_visible(TILTED, SQUARE, w_minimum=w_minimum)


def test_the_usual_margin_is_a_millionth():
    kept = clip_to_visible(TILTED, SQUARE)
    assert kept[:, 0].min() == pytest.approx(-1 + 3e-6, abs=1e-9)
    open_line = clip_to_visible(TILTED, SQUARE[[1, 2, 3]], closed=False)
    assert open_line == pytest.approx(np.array([(2, 0), (2, 1), (-1 + 3e-6, 1)]))


def test_the_smallest_w_that_counts_is_relative_to_its_terms():
    """At x = −1 + ε the terms are of size 1, and w = ε."""
    for far in (1.0, 1e6):
        H = np.array([[1.0, 0, 0], [0, 1, 0], [1 / far, 0, 1]])
        _, valid = apply_homography(H, [(-far * (1 - 3e-12), 0), (-far * (1 - 1e-12), 0)])
        assert valid.tolist() == [True, False]


def test_a_homography_is_scaled_to_its_last_entry_or_else_to_unit_norm():
    assert transforms.projective(2.0 * TILTED) == pytest.approx(TILTED)
    H = transforms.projective([[1, 0, 0], [0, 0, 1], [0, -2, 0]])
    assert H[2, 1] > 0
    assert pytest.approx(np.array([[-1, 0, 0], [0, 0, -1], [0, 2, 0]]) / math.sqrt(6)) == H
    small = transforms.projective([[1, 0, 0], [0, 1, 0], [1, 0, 1e-11]])
    assert small[2, 2] == 1
    tiny = transforms.projective([[1, 0, 0], [0, 1, 0], [-1, 0, 1e-13]])
    assert np.linalg.norm(tiny) == pytest.approx(1)
    assert tiny[2, 0] > 0
    flat = transforms.projective([[1, 0, 0], [0, 1, 0], [0, 0, 0]])  # its last row is zero
    assert flat == pytest.approx(np.diag([1, 1, 0]) / math.sqrt(2))


def test_a_projective_map_is_given_by_nine_entries_or_three_rows():
    assert np.array_equal(
        transforms.projective(np.arange(1.0, 10)),
        transforms.projective(np.arange(1.0, 10).reshape(3, 3)),
    )


def test_an_image_too_far_off_is_invalid_and_spoils_no_other():
    H = np.diag([1e300, 1.0, 1.0])
    images, valid = apply_homography(H, [(1e300, 0), (1e-300, 3), (math.nan, 1)])
    assert valid.tolist() == [False, True, False]
    assert images[1] == pytest.approx((1, 3))
    assert np.isnan(images[[0, 2]]).all()


def test_points_of_any_shape_are_mapped_one_by_one():
    points = RNG.uniform(0, 10, (3, 4, 2))
    images, valid = apply_homography(TILTED, points)
    assert valid.shape == (3, 4)
    for place in np.ndindex(3, 4):
        assert np.array_equal(images[place], apply_homography(TILTED, points[place])[0])


def test_an_infinite_offset_is_no_transformation():
    with pytest.raises(ValueError, match="legal: finite entries"):
        transforms.translation(math.inf, 0)


def test_a_projective_map_changes_what_is_known_of_a_rectangle():
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


def test_a_shear_turns_only_what_does_not_lie_along_it():
    sheared = transforms.affine([[1, 0.5], [0, 1]], (0, 0))
    along, across = SEGMENTS[:2], SEGMENTS[2:4]
    assert measure_preservation(sheared, along).turn_rad == pytest.approx(0)
    assert measure_preservation(sheared, across).turn_rad == pytest.approx(math.atan(0.5))
    assert measure_preservation(sheared, across).length == pytest.approx(math.sqrt(1.25) - 1)


@pytest.mark.parametrize("size", [1e-200, -1e200])
def test_a_homography_of_any_size_is_the_same(size):
    matrix = np.array([[1.0, 2, 3], [0, 1, 4], [1, 0, 2]])
    assert transforms.projective(size * matrix) == pytest.approx(matrix / 2)


def test_huge_negative_entries_are_scaled_as_huge_positive_ones_are():
    H = np.array([[-1e300, 0, 0], [0, -1e300, 0], [-1e300, 0, -1e300]])
    image, valid = apply_homography(H, [-1e10, 5.0])
    assert valid
    assert image == pytest.approx([1e10 / (1e10 - 1), -5 / (1e10 - 1)])


def test_a_figure_is_closed_unless_told_otherwise():
    """Of the three edges of this triangle the second and the closing one reach the line w = 0."""
    triangle = [(0.0, 0.0), (0.0, 1.0), (-3.0, 0.5)]
    assert len(clip_to_visible(TILTED, triangle)) == 4
    assert len(clip_to_visible(TILTED, triangle, closed=False)) == 3


def test_coordinates_beyond_the_range_are_refused_on_either_side():
    for far in (1.1e150, -1.1e150):
        with pytest.raises(ValueError, match="polygon"):
            clip_half_plane([(0.0, 0.0), (far, 0.0)], (1, 0, 0))


def test_one_visible_line_alone_cannot_be_compared_and_two_can():
    two = np.array([[(0, 0), (1, 0)], [(0, 1), (1, 1.5)]], float)
    hidden = [[(-5, 0), (-4, 0)]]
    with pytest.raises(ValueError, match="segments: 1 of 2 visible"):
        measure_preservation(TILTED, np.concatenate([two[:1], hidden]))
    seen = measure_preservation(TILTED, np.concatenate([two, hidden]))
    assert seen.length == math.inf
    assert seen.turn_rad == measure_preservation(TILTED, two).turn_rad


def test_lines_that_are_nearly_parallel_are_not_parallel():
    """1e-6 rad apart: only lines that are parallel to a billionth are judged by that measure."""
    for slant, changed in ((1e-6, False), (1e-10, True)):
        two = np.array([[(0, 0), (1, 0)], [(0, 1), (1, 1 + slant)]], float)
        assert (measure_preservation(TILTED, two).parallel_rad > 0.1) is changed


def test_parallel_lines_may_run_in_opposite_senses():
    """Under w = 1 + y/2 the uprights at x = 0 and x = 1 lean by atan 1/2 towards one another."""
    H = transforms.projective([1, 0, 0, 0, 1, 0, 0, 0.5, 1])
    up = np.array([[(0, 0), (0, 1)], [(1, 0), (1, 1)]], float)
    for two in (up, up[::-1], np.array([up[0], up[1, ::-1]])):
        measured = measure_preservation(H, two)
        assert measured.parallel_rad == pytest.approx(math.atan(0.5))
        assert measured.turn_rad == pytest.approx(math.atan(0.5))


def test_a_bend_is_found_on_either_side():
    """No homography bends a line; images that do are made here from an arc."""
    share = np.linspace(0, 1, 9)
    arc = np.stack([share, 0.1 * 4 * share * (1 - share)], axis=-1)
    for side in (1, -1):
        bend = preservation._bend((arc * [1, side])[None], np.array([[1.0, 0.0]]), np.array([1.0]))
        assert bend == pytest.approx(0.1)
    share = np.linspace(0, 1, 9)[:, None]
    straight, bent = share * [3.0, 0.0], arc * [2.0, 1.0]
    bend = preservation._bend(
        np.array([straight, bent]), np.array([[1.0, 0], [1.0, 0]]), np.array([3.0, 2.0])
    )
    assert bend == pytest.approx(0.1 / 2)
    sampled = preservation._sample(np.array([[[0.0, 0], [8, 4]]]))
    assert sampled[0].tolist() == [[i, i / 2] for i in range(9)]


def test_the_margin_of_clipping_is_a_share_of_the_largest_terms_hidden_ones_too():
    """At x = −5 the terms of w = 1 + x add up to 6 in size, so that the cut lies at w = 0.6."""
    visible = clip_to_visible(TILTED, [(-5.0, 0), (1, 0), (1, 1), (-5, 1)], w_minimum=0.1)
    assert visible[:, 0].min() == pytest.approx(-0.4)


@pytest.mark.parametrize(
    ("H", "segments"),
    [
        (np.eye(3), [[[0, 0], [0, 0]], [[0, 0], [1, 1]]]),
        (np.diag([1.0, 0.0, 1.0]), [[[0, 0], [0, 1]], [[0, 0], [1, 1]]]),
    ],
)
def test_a_point_has_no_direction_to_be_kept(H, segments):
    with pytest.raises(ValueError, match="longer than a point"):
        measure_preservation(H, segments)
