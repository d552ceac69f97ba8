"""Two views of a point or a plane, against projected points and OpenCV."""

import math

import cv2
import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.geometry import rotations
from simulations.models.geometry.transforms import apply_homography
from simulations.models.projection import pinhole
from simulations.models.projection.two_views import (
    depth_error,
    depth_from_disparity,
    depth_of_match,
    epipolar_lines,
    fundamental_matrix,
)
from simulations.models.projection.view_homographies import (
    in_front,
    plane_between_views,
    turned_camera,
)

FIRST = pinhole.intrinsics((800.0, 780.0), (320.0, 240.0), 1.5)
SECOND = pinhole.intrinsics(500.0, (300.0, 200.0))
R = rotations.exponential([0.1, -0.3, 0.05])
T = np.array([-0.4, 0.1, 0.2])
F = fundamental_matrix(FIRST, SECOND, R, T)
RNG = np.random.default_rng(3)
POINTS = RNG.uniform((-1, -1, 3), (1, 1, 9), (40, 3))


def pair() -> tuple[Floats, Floats]:
    left, _ = pinhole.project(POINTS, FIRST)
    right, valid = pinhole.project(POINTS @ R.T + T, SECOND)
    assert valid.all()
    return left, right


def test_epipolar_lines_agree_with_opencv() -> None:
    left, right = pair()
    lines, valid = epipolar_lines(F, left)
    assert valid.all()
    theirs = cv2.computeCorrespondEpilines(left[:, None], 1, F)[:, 0]
    turned = np.sign((lines * theirs).sum(axis=1))[:, None]
    np.testing.assert_allclose(lines, turned * theirs, atol=1e-6)
    np.testing.assert_allclose((lines[:, :2] * right).sum(axis=1) + lines[:, 2], 0.0, atol=1e-9)


def test_depth_of_a_match_agrees_with_truth_and_opencv() -> None:
    left, right = pair()
    depth, valid = depth_of_match(left, right, FIRST, SECOND, R, T)
    assert valid.all()
    np.testing.assert_allclose(depth, POINTS[:, 2], rtol=1e-10)
    cameras = FIRST @ np.eye(3, 4), SECOND @ np.column_stack([R, T])
    theirs = cv2.triangulatePoints(*cameras, left.T, right.T)
    np.testing.assert_allclose(depth, theirs[2] / theirs[3], rtol=1e-6)


def test_depth_is_infinite_at_the_vanishing_point_and_invalid_beyond() -> None:
    K = pinhole.intrinsics(160.0, (0.0, 0.0))
    matches = [(30.0, 0.0), (31.0, 0.0), (10.0, 0.0), (math.nan, 0.0)]
    depth, valid = depth_of_match((30.0, 0.0), matches, K, K, np.eye(3), (-0.5, 0.0, 0.0))
    assert valid.tolist() == [True, False, True, False]
    assert depth[0] == math.inf
    assert depth[2] == pytest.approx(160 * 0.5 / 20)
    assert np.isnan(depth[[1, 3]]).all()


def test_depth_is_focal_length_times_baseline_over_disparity() -> None:
    depth, valid = depth_from_disparity([20.0, 16.0, 0.0, -0.0, -1.0, math.nan], 800.0, 0.1)
    assert valid.tolist() == [True, True, True, True, False, False]
    assert depth[:4] == pytest.approx((4.0, 5.0, math.inf, math.inf))
    assert np.isnan(depth[4:]).all()
    assert depth_error(8.0, 800.0, 0.5, 0.25) == pytest.approx(8.0 - 400 / 50.25, rel=0.01)


def test_depth_error_is_zero_for_exact_disparity_and_infinite_at_infinity() -> None:
    wrong = depth_error([math.inf, 1e200, math.inf, math.nan], 800.0, 0.1, [0.0, 0.0, 0.5, 0.0])
    np.testing.assert_array_equal(wrong, [0.0, 0.0, math.inf, math.nan])


POSE = pinhole.rigid_pose(R, [0.4, -0.1, 0.2])
DRAWS = np.random.default_rng(8)


def image(points: Floats, pose: Floats, K: Floats) -> Floats:
    pixels, valid = pinhole.project(pinhole.world_to_camera(points, pose), K)
    assert valid.all()
    return pixels


def test_turned_camera_moves_pixels_independently_of_depth() -> None:
    points = DRAWS.uniform((-1, -1, 2), (1, 1, 4), (50, 3))
    points *= 10 ** DRAWS.uniform(0, 6, (50, 1))
    moved, valid = apply_homography(
        turned_camera(FIRST, SECOND, R), image(points, np.eye(4), FIRST)
    )
    assert valid.all()
    turned = pinhole.rigid_pose(R, [0.0, 0.0, 0.0])
    np.testing.assert_allclose(moved, image(points, turned, SECOND), atol=1e-9)


def test_in_front_agrees_with_projection_into_the_second_camera() -> None:
    """The floor, 1.5 below a camera that turns sideways: half of the points fall behind it."""
    pose = pinhole.rigid_pose(rotations.exponential([0.0, 1.3, 0.0]), [0.2, 0.1, -3.0])
    points = DRAWS.uniform((-6, 1.5, 0.5), (6, 1.5, 9), (300, 3))
    H = plane_between_views(FIRST, SECOND, pose, [0.0, 1.0, 0.0, -1.5])
    _, before = pinhole.project(pinhole.world_to_camera(points, pose), SECOND)
    assert 0.2 < before.mean() < 0.8
    assert in_front(H, image(points, np.eye(4), FIRST)).tolist() == before.tolist()


@pytest.mark.parametrize("scale", [1.0, -3.0, 1e-6])
@pytest.mark.parametrize("normal", [(0.0, 0.0, 1.0), (0.3, -0.2, 1.0), (1.0, 0.2, 0.1)])
def test_plane_moves_as_its_points_do(normal: tuple[float, float, float], scale: float) -> None:
    """Points anywhere on n·X = 3 |n|², in front of both cameras."""
    n = np.array(normal)
    points = DRAWS.uniform(-0.5, 0.5, (40, 3))
    points += 3 * n - ((points @ n) / (n @ n))[:, None] * n
    points = points[points[:, 2] > 0.2]
    H = plane_between_views(FIRST, SECOND, POSE, scale * np.array([*n, -3 * n @ n]))
    moved, valid = apply_homography(H, image(points, np.eye(4), FIRST))
    expected, before = pinhole.project(pinhole.world_to_camera(points, POSE), SECOND)
    assert len(points) > 5
    assert valid.tolist() == before.tolist()
    np.testing.assert_allclose(moved, expected, atol=1e-8, rtol=1e-11)
