"""Pinhole projection, poses, and affine cameras."""

import math
from typing import Any

import cv2
import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.projection import pinhole
from simulations.models.projection.affine_cameras import (
    orthographic_camera,
    paraperspective_camera,
    project_affine,
    scaled_orthographic_camera,
)
from simulations.models.projection.pinhole import intrinsics, project

K = pinhole.intrinsics((400.0, 410.0), (320.0, 240.0), skew=2.0)
POSE = pinhole.look_at((3.0, -2.0, -6.0), (0.5, 0.2, 1.0), (0.0, -1.0, 0.0))
NOWHERE = (math.nan, math.nan)


@pytest.mark.parametrize(
    ("point", "pixel"),
    [
        ((1.0, 0.5, 5.0), (320 + 80 + 2 * 0.1, 240 + 41)),
        ((0.0, 2.0, 4.0), (320 + 2 * 0.5, 240 + 410 * 0.5)),  # skew moves x with y
        *(((1.0, 1.0, Z), NOWHERE) for Z in (0.0, -0.0, -1e-300, -5.0, -math.inf, math.nan)),
        *(((1.0, 1.0, Z), (320.0, 240.0)) for Z in (1e300, math.inf)),
        ((1e300, 0.0, 1e-300), NOWHERE),
        ((1e300, 0.0, 1.0), (4e302, 240.0)),
        *(((size, 0.5 * size, 5 * size, size), (400.2, 281.0)) for size in (1e-300, -1.0, 1e300)),
        *(((size, 0.5 * size, 2 * size, 2.0), (520 + 0.5, 342.5)) for size in (1e306,)),
        ((1, 0, 2, 0), (520.0, 240.0)),  # at infinity, in front
        ((-1, 0, -2, 0), NOWHERE),  # and behind
        ((0, 0, -2, -2), (320.0, 240.0)),
        *((point, NOWHERE) for point in ((0, 0, 0, 0), (0, 0, 1, -1), (1.0, 0.0, 1e-310, 0.0))),
        *((point, NOWHERE) for point in ((math.inf, 0, 1, 1), (0, 0, math.nan, 1))),
    ],
)
def test_only_points_in_front_have_a_pixel(
    point: tuple[float, ...], pixel: tuple[float, ...]
) -> None:
    """Four numbers are homogeneous coordinates."""
    if len(point) == 3:
        found, valid = pinhole.project(point, K)
    else:
        found, valid = pinhole.project_homogeneous(point, pinhole.camera_matrix(K, np.eye(4)))
    assert valid == np.isfinite(pixel).all()
    assert found == pytest.approx(pixel, nan_ok=True)


SLOPING = np.array([[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]])


@pytest.mark.parametrize(
    ("eye", "target", "up", "axes"),
    [
        ((0, 0, 0), (0, 0, 5), (0, -1, 0), np.eye(3)),
        ((0, 0, 0), (0, 0, 1), (0, 1e-8, 1), np.diag([-1, -1, 1])),  # almost along the view
        *(((0, 0, 0), (0, 3 * size, 4 * size), (0, -1, 0), SLOPING) for size in (1e-200, 1e150)),
    ],
)
def test_camera_looks_at_its_target_at_any_distance(
    eye: Any, target: Any, up: Any, axes: Any
) -> None:
    np.testing.assert_allclose(pinhole.look_at(eye, target, up)[:3, :3], axes, atol=1e-12)


def test_inverse_pose_contains_the_camera_centre() -> None:
    back = pinhole.invert_pose(POSE)
    assert back @ POSE == pytest.approx(np.eye(4), abs=1e-14)
    assert back[:3, 3] == pytest.approx((3, -2, -6))


SKEWED = intrinsics((800.0, 820.0), (320.0, 240.0), skew=3.0)
POINTS = np.random.default_rng(0).uniform([-2, -2, 4], [2, 2, 9], (40, 3))


def by_opencv(points: Floats, matrix: Floats) -> Floats:
    pixels, _ = cv2.projectPoints(
        np.asarray(points)[:, None], np.zeros(3), np.zeros(3), matrix, None
    )
    return pixels[:, 0]


def test_orthographic_image_does_not_depend_on_depth() -> None:
    camera = orthographic_camera(30.0, (5.0, 7.0))
    for depth in (-4.0, 0.0, 1e9):
        assert project_affine([2.0, -1.0, depth], camera)[0].tolist() == [65.0, -23.0]
    assert project_affine([0.0, 0.0, 3.0], orthographic_camera(30.0))[0].tolist() == [0.0, 0.0]


def test_scaled_orthography_is_perspective_of_points_moved_to_the_plane() -> None:
    flat = POINTS.copy()
    flat[:, 2] = 6.0
    ours, _ = project_affine(POINTS, scaled_orthographic_camera(SKEWED, 6.0))
    upright = intrinsics((800.0, 820.0), (320.0, 240.0))  # OpenCV knows no skew
    theirs = by_opencv(flat, upright) + np.outer(flat[:, 1], [3.0 / 6.0, 0.0])
    np.testing.assert_allclose(ours, theirs, rtol=1e-12)


def test_paraperspective_moves_points_along_the_reference_line_of_sight() -> None:
    reference = np.array([1.0, -0.5, 6.0])
    steps = (6.0 - POINTS[:, 2:]) / 6.0
    moved = POINTS + steps * reference
    np.testing.assert_allclose(moved[:, 2], 6.0)
    ours, _ = project_affine(POINTS, paraperspective_camera(SKEWED, reference))
    np.testing.assert_allclose(ours, project(moved, SKEWED)[0], rtol=1e-12)
