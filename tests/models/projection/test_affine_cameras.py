"""Parallel cameras as limits and derivatives of the perspective one."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.projection.affine_cameras import (
    orthographic_camera,
    paraperspective_camera,
    project_affine,
    scaled_orthographic_camera,
)
from simulations.models.projection.pinhole import intrinsics, look_at, project, world_to_camera

K = intrinsics((800.0, 820.0), (320.0, 240.0), skew=3.0)
POINTS = np.random.default_rng(0).uniform([-2, -2, 4], [2, 2, 9], (40, 3))
coordinate = st.floats(-10.0, 10.0)


def by_opencv(points: Floats, matrix: Floats) -> Floats:
    pixels, _ = cv2.projectPoints(
        np.asarray(points)[:, None], np.zeros(3), np.zeros(3), matrix, None
    )
    return pixels[:, 0]


def test_orthography_is_perspective_from_far_away_through_a_long_lens() -> None:
    """OpenCV's camera at a million metres whose focal length makes 50 px of every metre."""
    far = 1e6
    telescope = intrinsics(50.0 * far, (320.0, 240.0))
    theirs = by_opencv(POINTS + np.array([0.0, 0.0, far]), telescope)
    ours, valid = project_affine(POINTS, orthographic_camera(50.0, (320.0, 240.0)))
    assert valid.all()
    np.testing.assert_allclose(ours, theirs, atol=100 * 9 / far * 1.01)


def test_orthography_by_hand_and_whatever_the_depth() -> None:
    camera = orthographic_camera(30.0, (5.0, 7.0))
    for depth in (-4.0, 0.0, 1e9):
        assert project_affine([2.0, -1.0, depth], camera)[0].tolist() == [65.0, -23.0]


def test_scaled_orthography_is_opencvs_perspective_of_points_moved_to_the_plane() -> None:
    flat = POINTS.copy()
    flat[:, 2] = 6.0
    ours, _ = project_affine(POINTS, scaled_orthographic_camera(K, 6.0))
    upright = intrinsics((800.0, 820.0), (320.0, 240.0))  # OpenCV knows no skew
    theirs = by_opencv(flat, upright) + np.outer(flat[:, 1], [3.0 / 6.0, 0.0])
    np.testing.assert_allclose(ours, theirs, rtol=1e-12)


def test_scaled_orthography_is_off_by_the_share_of_depth_that_it_neglects() -> None:
    ours, _ = project_affine(POINTS, scaled_orthographic_camera(K, 6.0))
    true, _ = project(POINTS, K)
    share = (POINTS[:, 2:] - 6.0) / 6.0
    np.testing.assert_allclose(ours - true, share * (true - [320.0, 240.0]), atol=1e-10)


def test_paraperspective_moves_points_along_the_line_of_sight_to_the_reference() -> None:
    reference = np.array([1.0, -0.5, 6.0])
    steps = (6.0 - POINTS[:, 2:]) / 6.0
    moved = POINTS + steps * reference
    np.testing.assert_allclose(moved[:, 2], 6.0)
    ours, _ = project_affine(POINTS, paraperspective_camera(K, reference))
    np.testing.assert_allclose(ours, project(moved, K)[0], rtol=1e-12)


def test_paraperspective_has_the_value_and_the_slope_of_perspective_at_the_reference() -> None:
    reference, h = np.array([1.0, -0.5, 6.0]), 1e-5
    camera = paraperspective_camera(K, reference)
    np.testing.assert_allclose(project_affine(reference, camera)[0], project(reference, K)[0])
    ends = reference + h * np.concatenate([np.eye(3), -np.eye(3)])
    pixels = project(ends, K)[0]
    slope = (pixels[:3] - pixels[3:]).T / (2 * h)
    np.testing.assert_allclose(camera[:2, :3], slope, rtol=1e-7, atol=1e-6)


def test_on_the_axis_both_approximations_are_the_same() -> None:
    np.testing.assert_array_equal(
        paraperspective_camera(K, [0.0, 0.0, 3.0]), scaled_orthographic_camera(K, 3.0)
    )
    assert not scaled_orthographic_camera(K, 3.0)[:, 2].any()


def test_halving_the_size_of_an_object_quarters_what_paraperspective_gets_wrong() -> None:
    centre = np.array([1.5, 0.5, 8.0])
    camera = paraperspective_camera(K, centre)

    def worst(size: float) -> float:
        points = centre + size * (POINTS - POINTS.mean(axis=0))
        return np.abs(project_affine(points, camera)[0] - project(points, K)[0]).max()

    assert worst(0.01) / worst(0.005) == pytest.approx(4.0, rel=0.02)


@given(st.tuples(coordinate, coordinate, coordinate), st.tuples(coordinate, coordinate, coordinate))
def test_parallel_segments_stay_parallel_and_keep_their_ratio(
    start: tuple[float, float, float], step: tuple[float, float, float]
) -> None:
    camera = paraperspective_camera(K, (1.0, 2.0, 5.0))
    origin, moved = np.array(start), np.array(step)
    ends = np.stack([origin, origin + moved, np.zeros(3), 3 * moved])
    (a, b, c, d), valid = project_affine(ends, camera)
    assert valid.all()
    np.testing.assert_allclose(d - c, 3 * (b - a), atol=1e-8)


def test_a_pose_goes_before_the_camera() -> None:
    pose = look_at([3.0, -2.0, -6.0], [0.0, 0.0, 0.0], [0.0, -1.0, 0.0])
    camera = scaled_orthographic_camera(K, 7.0)
    np.testing.assert_allclose(
        project_affine(POINTS, camera @ pose)[0],
        project_affine(world_to_camera(POINTS, pose), camera)[0],
        rtol=1e-12,
    )


def test_behind_and_beside_the_camera_points_still_have_an_image() -> None:
    camera = scaled_orthographic_camera(K, 5.0)
    pixels, valid = project_affine([[1.0, 0.0, -2.0], [1.0, 0.0, 0.0]], camera)
    assert valid.all()
    assert pixels.tolist() == [[480.0, 240.0]] * 2


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_what_is_nowhere_has_no_image(bad: float, axis: int) -> None:
    points = np.ones((2, 3))
    points[1, axis] = bad
    pixels, valid = project_affine(points, scaled_orthographic_camera(K, 5.0))
    assert valid.tolist() == [True, False]
    assert np.isnan(pixels[1]).all()


def test_an_image_beyond_all_numbers_is_none() -> None:
    points = [[1e300, 0.0, 1.0], [0.0, 1e300, 1.0]]
    pixels, valid = project_affine(points, orthographic_camera(1e10))
    assert not valid.any()
    assert np.isnan(pixels).all()


def test_without_a_principal_point_pixels_count_from_the_axis() -> None:
    assert project_affine([0.0, 0.0, 3.0], orthographic_camera(30.0))[0].tolist() == [0.0, 0.0]


@pytest.mark.parametrize("depth", [0.0, -1.0, np.inf, np.nan])
def test_a_reference_that_is_not_in_front_is_refused(depth: float) -> None:
    with pytest.raises(ValueError, match="in front of the camera"):
        scaled_orthographic_camera(K, depth)
    with pytest.raises(ValueError, match="in front of the camera"):
        paraperspective_camera(K, [1.0, 0.0, depth])


@pytest.mark.parametrize("scale", [0.0, -1.0, np.inf, np.nan])
def test_a_scale_that_is_none_is_refused(scale: float) -> None:
    with pytest.raises(ValueError, match="pixels_per_unit"):
        orthographic_camera(scale)


def test_cameras_with_infinite_entries_are_refused() -> None:
    with pytest.raises(ValueError, match="finite entries"):
        paraperspective_camera(K, [1e300, 0.0, 1e-10])
    with pytest.raises(ValueError, match="finite entries"):
        orthographic_camera(1.0, (np.nan, 0.0))


@pytest.mark.parametrize("camera", [np.eye(3, 4), np.eye(4), np.diag([1, 1, 1, 2])[:3]])
def test_a_camera_that_divides_by_depth_is_refused(camera: ArrayLike) -> None:
    with pytest.raises(ValueError, match="last row 0, 0, 0, 1"):
        project_affine([1.0, 2.0, 3.0], camera)
