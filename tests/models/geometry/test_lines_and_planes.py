"""Join, meet and distance against null spaces, linear systems and the vanishing points."""

import numpy as np
import pytest
import skimage.measure
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.geometry.lines_and_planes import (
    intersection,
    line_through,
    plane_through,
    signed_distance,
)
from simulations.models.projection.pinhole import intrinsics
from simulations.models.projection.vanishing import horizon, vanishing_point

coordinate = st.floats(-100.0, 100.0)
point = st.tuples(coordinate, coordinate)
RNG = np.random.default_rng(0)


def null_space(rows: ArrayLike) -> Floats:
    """The direction (n + 1,) that all homogeneous points (N, n) are orthogonal to."""
    points = np.asarray(rows, float)
    return np.linalg.svd(np.column_stack([points, np.ones(len(points))]))[2][-1]


def same(ours: Floats, theirs: Floats) -> bool:
    """Equal up to scale and sign."""
    theirs = theirs / np.linalg.norm(theirs[:-1])
    return np.allclose(ours, theirs * np.sign(theirs[:-1] @ ours[:-1]), atol=1e-9)


@given(point, point)
def test_a_line_is_the_null_space_of_its_points(
    p: tuple[float, float], q: tuple[float, float]
) -> None:
    assume(np.hypot(p[0] - q[0], p[1] - q[1]) > 1e-3)
    line, valid = line_through(p, q)
    assert valid
    assert np.hypot(*line[:2]) == pytest.approx(1.0, abs=1e-15)
    np.testing.assert_allclose(np.array([p, q]) @ line[:2] + line[2], 0.0, atol=1e-12)
    assert same(line, null_space([p, q]))


def test_the_cross_product_gives_the_same_line_with_the_same_sign() -> None:
    p, q = np.array([2.0, 1.0]), np.array([5.0, 5.0])
    plain = np.cross([*p, 1.0], [*q, 1.0])
    np.testing.assert_allclose(line_through(p, q)[0], plain / 5.0, rtol=1e-15)


@given(point, point, point, point)
def test_lines_meet_where_the_linear_system_says(
    p: tuple[float, float], q: tuple[float, float], r: tuple[float, float], s: tuple[float, float]
) -> None:
    """Both ends of an angle that is not too flat."""
    steps = np.subtract(q, p), np.subtract(s, r)
    lengths = [np.linalg.norm(step) for step in steps]
    assume(min(lengths) > 0.1)
    assume(abs(np.linalg.det(steps)) > 1e-3 * lengths[0] * lengths[1])
    (first, second), _ = line_through([p, r], [q, s])
    meet, valid = intersection(first, second)
    assert valid
    share = np.linalg.solve(np.column_stack([steps[0], -steps[1]]), np.subtract(r, p))[0]
    np.testing.assert_allclose(meet, np.asarray(p) + share * steps[0], rtol=1e-8, atol=1e-7)


def test_the_rails_of_the_book_meet_above_the_middle() -> None:
    rails, _ = line_through([[100, 480], [540, 480]], [[250, 300], [390, 300]])
    np.testing.assert_allclose(rails[0] / rails[0][0], np.array([6, 5, -3000]) / 6)
    np.testing.assert_allclose(rails[1] / rails[1][0], np.array([6, -5, -840]) / 6)
    np.testing.assert_allclose(intersection(*rails)[0], [320.0, 216.0])
    level = intrinsics(800.0, (320.0, 240.0))
    np.testing.assert_allclose(vanishing_point([0.0, -0.03, 1.0], level)[0], [320.0, 216.0])


def test_the_horizon_joins_the_vanishing_points_of_its_plane() -> None:
    K = intrinsics((800.0, 780.0), (320.0, 240.0), 2.0)
    normal = np.array([0.1, 1.0, 0.3])
    directions = np.cross(normal, [[1.0, 0.2, 0.0], [0.3, -0.4, 1.0]])
    p, q = vanishing_point(directions, K)[0]
    line, _ = horizon(normal, K)
    assert same(line_through(p, q)[0], line)


def test_distances_are_those_of_scikit_image() -> None:
    p, q = np.array([3.0, -2.0]), np.array([7.0, 9.0])
    points = RNG.uniform(-20, 20, (30, 2))
    model = skimage.measure.LineModelND(p, (q - p) / np.linalg.norm(q - p))
    line, _ = line_through(p, q)
    np.testing.assert_allclose(np.abs(signed_distance(points, line)), model.residuals(points))


def test_the_sign_tells_the_side() -> None:
    line, _ = line_through([0.0, 0.0], [2.0, 0.0])
    assert signed_distance([[5.0, 3.0], [5.0, -3.0]], line).tolist() == [3.0, -3.0]
    plane, _ = plane_through([0.0, 0, 0], [1, 0, 0], [0, 1, 0])
    assert signed_distance([[5.0, 3.0, 2.0], [5.0, 3.0, -2.0]], plane).tolist() == [2.0, -2.0]


def test_planes_are_the_null_spaces_of_their_points() -> None:
    for corners in RNG.uniform(-5, 5, (20, 3, 3)):
        plane, valid = plane_through(*corners)
        assert valid
        assert same(plane, null_space(corners))


def test_distances_to_a_plane_are_heights() -> None:
    corners = RNG.uniform(-5, 5, (3, 3))
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    normal /= np.linalg.norm(normal)
    foot = corners.T @ [0.2, 0.5, 0.3]
    plane, _ = plane_through(*corners)
    heights = np.array([-2.0, 0.0, 1.5])
    np.testing.assert_allclose(
        signed_distance(foot + heights[:, None] * normal, plane), heights, atol=1e-14
    )


def test_any_multiple_is_the_same_line() -> None:
    line, other = np.array([3.0, 4.0, 10.0]), np.array([1.0, -1.0, 0.0])
    for factor in (1e-300, 1e300, -7.0):
        np.testing.assert_allclose(
            intersection(factor * line / 10, other)[0], intersection(line, other)[0]
        )
        assert abs(signed_distance([0.0, 0.0], factor * line / 10)) == pytest.approx(2.0)


def test_many_lines_at_once() -> None:
    p, q = RNG.uniform(-5, 5, (2, 4, 6, 2))
    lines, valid = line_through(p, q)
    assert lines.shape == (4, 6, 3)
    assert valid.all()
    assert intersection(lines[:, :1], lines[:, 1:])[0].shape == (4, 5, 2)
    assert signed_distance(p, lines).shape == (4, 6)
    planes, valid = plane_through(*RNG.uniform(-5, 5, (3, 4, 6, 3)))
    assert planes.shape == (4, 6, 4)
    assert valid.shape == (4, 6)


def test_far_from_the_origin_a_line_keeps_its_direction() -> None:
    """The cross product loses it: both products are near 1e24, and their difference is not."""
    line, _ = line_through([1e12, 1e12], [1e12 + 3.0, 1e12 + 4.0])
    np.testing.assert_allclose(line[:2], [-0.8, 0.6], rtol=1e-15)


@pytest.mark.parametrize("q", [[1.0, 2.0], [np.nan, 0.0], [np.inf, 0.0]])
def test_one_point_makes_no_line(q: list[float]) -> None:
    line, valid = line_through([1.0, 2.0], q)
    assert not valid
    assert np.isnan(line).all()


@pytest.mark.parametrize(
    "other",
    [
        pytest.param([3.0, 4.0, -8.0], id="parallel"),
        pytest.param([3.0, 4.0, 5.0], id="itself"),
        pytest.param([3.0, 4.0 * (1 + 2e-15), 5.0], id="parallel-but-for-rounding"),
        pytest.param([0.0, 0.0, 1.0], id="at-infinity"),
        pytest.param([0.0, 0.0, 0.0], id="none"),
        pytest.param([np.nan, 1.0, 1.0], id="undefined"),
        pytest.param([0.0, 1e-300, 1e300], id="beyond-all-numbers"),
        pytest.param([3.0, 4.0 + 1e-5, 1e308], id="beyond-all-numbers-on-one-axis"),
    ],
)
def test_lines_that_meet_nowhere(other: list[float]) -> None:
    meet, valid = intersection([3.0, 4.0, 5.0], other)
    assert not valid
    assert np.isnan(meet).all()


def test_lines_that_are_nearly_parallel_meet_far_away() -> None:
    meet, valid = intersection([0.0, 1.0, 0.0], [1e-12, 1.0, -1.0])
    assert valid
    np.testing.assert_allclose(meet, [1e12, 0.0], rtol=1e-12)


@pytest.mark.parametrize("r", [[2.0, 2.0, 2.0], [0.0, 0.0, 0.0], [np.inf, 0.0, 1.0]])
def test_points_on_one_line_span_no_plane(r: list[float]) -> None:
    plane, valid = plane_through([0.0, 0.0, 0.0], [1.0, 1.0, 1.0], r)
    assert not valid
    assert np.isnan(plane).all()


def test_a_line_without_a_normal_has_no_distance() -> None:
    assert np.isnan(signed_distance([1.0, 2.0], [0.0, 0.0, 1.0]))


def test_among_many_points_only_those_on_one_line_span_no_plane() -> None:
    third = [[0.0, 1.0, 0.0], [2.0, 0.0, 0.0]]
    planes, valid = plane_through([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], third)
    assert valid.tolist() == [True, False]
    assert planes[0].tolist() == [0.0, 0.0, 1.0, 0.0]


@pytest.mark.parametrize("size", [1e-200, 1e200])
def test_neither_tiny_nor_huge_points_lose_their_line(size: float) -> None:
    line, valid = line_through([0.0, 0.0], [3 * size, 4 * size])
    assert valid
    np.testing.assert_allclose(line, [-0.8, 0.6, 0.0], rtol=1e-15)


def test_a_line_further_off_than_all_numbers_is_none() -> None:
    line, valid = line_through([-1.7e308, 1.7e308], [-1.69e308, 1.71e308])
    assert not valid
    assert np.isnan(line).all()


def test_a_meeting_point_further_off_than_all_numbers_in_one_coordinate_is_none() -> None:
    meet, valid = intersection([0.0, 1.0, 0.0], [1e-5, 1.0, -1e306])
    assert not valid
    assert np.isnan(meet).all()


def test_lines_that_meet_beyond_all_numbers_along_one_axis_alone_do_not_meet() -> None:
    """y = 1 and a line that rises by 1e-13 a unit towards it from 1e300 below."""
    assert not intersection((0.0, 1.0, -1.0), (1e-13, -1.0, -1e300))[1]
