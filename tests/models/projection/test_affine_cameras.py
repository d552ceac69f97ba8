"""Parallel cameras as limits and derivatives of the perspective one."""

import cv2
import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.projection.affine_cameras import (
    orthographic_camera,
    paraperspective_camera,
    project_affine,
    scaled_orthographic_camera,
)
from simulations.models.projection.pinhole import intrinsics, project

K = intrinsics((800.0, 820.0), (320.0, 240.0), skew=3.0)
POINTS = np.random.default_rng(0).uniform([-2, -2, 4], [2, 2, 9], (40, 3))


def by_opencv(points: Floats, matrix: Floats) -> Floats:
    pixels, _ = cv2.projectPoints(
        np.asarray(points)[:, None], np.zeros(3), np.zeros(3), matrix, None
    )
    return pixels[:, 0]


def test_orthography_by_hand_and_whatever_the_depth() -> None:
    camera = orthographic_camera(30.0, (5.0, 7.0))
    for depth in (-4.0, 0.0, 1e9):
        assert project_affine([2.0, -1.0, depth], camera)[0].tolist() == [65.0, -23.0]
    assert project_affine([0.0, 0.0, 3.0], orthographic_camera(30.0))[0].tolist() == [0.0, 0.0]


def test_scaled_orthography_is_opencvs_perspective_of_points_moved_to_the_plane() -> None:
    flat = POINTS.copy()
    flat[:, 2] = 6.0
    ours, _ = project_affine(POINTS, scaled_orthographic_camera(K, 6.0))
    upright = intrinsics((800.0, 820.0), (320.0, 240.0))  # OpenCV knows no skew
    theirs = by_opencv(flat, upright) + np.outer(flat[:, 1], [3.0 / 6.0, 0.0])
    np.testing.assert_allclose(ours, theirs, rtol=1e-12)


def test_paraperspective_moves_points_along_the_line_of_sight_to_the_reference() -> None:
    reference = np.array([1.0, -0.5, 6.0])
    steps = (6.0 - POINTS[:, 2:]) / 6.0
    moved = POINTS + steps * reference
    np.testing.assert_allclose(moved[:, 2], 6.0)
    ours, _ = project_affine(POINTS, paraperspective_camera(K, reference))
    np.testing.assert_allclose(ours, project(moved, K)[0], rtol=1e-12)


def test_on_the_axis_both_approximations_are_the_same() -> None:
    np.testing.assert_array_equal(
        paraperspective_camera(K, [0.0, 0.0, 3.0]), scaled_orthographic_camera(K, 3.0)
    )


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e300])
def test_what_is_nowhere_or_beyond_all_numbers_has_no_image(bad: float, axis: int) -> None:
    points = np.ones((2, 3))
    points[1, axis] = bad
    pixels, valid = project_affine(points, orthographic_camera(1e10))
    assert valid.tolist() == [True, bad == 1e300 and axis == 2]
    assert np.isnan(pixels[~valid]).all()
