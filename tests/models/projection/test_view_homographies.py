"""One homography between two pictures, against points projected into both."""

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.geometry import rotations
from simulations.models.geometry.transforms import apply_homography
from simulations.models.projection import pinhole
from simulations.models.projection.view_homographies import (
    in_front,
    plane_between_views,
    turned_camera,
)

FIRST = pinhole.intrinsics((800.0, 780.0), (320.0, 240.0), 1.5)
SECOND = pinhole.intrinsics(500.0, (300.0, 200.0))
R = rotations.exponential([0.1, -0.3, 0.05])
POSE = pinhole.rigid_pose(R, [0.4, -0.1, 0.2])
RNG = np.random.default_rng(8)


def seen(points: Floats, pose: Floats, K: Floats) -> Floats:
    pixels, valid = pinhole.project(pinhole.world_to_camera(points, pose), K)
    assert valid.all()
    return pixels


def test_a_turned_camera_moves_pixels_alike_at_any_depth() -> None:
    points = RNG.uniform((-1, -1, 2), (1, 1, 4), (50, 3))
    points *= 10 ** RNG.uniform(0, 6, (50, 1))
    moved, valid = apply_homography(turned_camera(FIRST, SECOND, R), seen(points, np.eye(4), FIRST))
    assert valid.all()
    turned = pinhole.rigid_pose(R, [0.0, 0.0, 0.0])
    np.testing.assert_allclose(moved, seen(points, turned, SECOND), atol=1e-9)


def test_in_front_is_where_points_of_the_plane_project_to_in_the_second_camera() -> None:
    """The floor, 1.5 below a camera that is turned sideways: half of what is seen falls behind."""
    pose = pinhole.rigid_pose(rotations.exponential([0.0, 1.3, 0.0]), [0.2, 0.1, -3.0])
    points = RNG.uniform((-6, 1.5, 0.5), (6, 1.5, 9), (300, 3))
    H = plane_between_views(FIRST, SECOND, pose, [0.0, 1.0, 0.0, -1.5])
    _, before = pinhole.project(pinhole.world_to_camera(points, pose), SECOND)
    assert 0.2 < before.mean() < 0.8
    assert in_front(H, seen(points, np.eye(4), FIRST)).tolist() == before.tolist()


@pytest.mark.parametrize("scale", [1.0, -3.0, 1e-6])
@pytest.mark.parametrize("normal", [(0.0, 0.0, 1.0), (0.3, -0.2, 1.0), (1.0, 0.2, 0.1)])
def test_a_plane_moves_as_its_points_do(normal: tuple[float, float, float], scale: float) -> None:
    """Points anywhere on n·X = 3 |n|², in front of both cameras."""
    n = np.array(normal)
    points = RNG.uniform(-0.5, 0.5, (40, 3))
    points += 3 * n - ((points @ n) / (n @ n))[:, None] * n
    points = points[points[:, 2] > 0.2]
    H = plane_between_views(FIRST, SECOND, POSE, scale * np.array([*n, -3 * n @ n]))
    moved, valid = apply_homography(H, seen(points, np.eye(4), FIRST))
    expected, before = pinhole.project(pinhole.world_to_camera(points, POSE), SECOND)
    assert len(points) > 5
    assert valid.tolist() == before.tolist()
    np.testing.assert_allclose(moved, expected, atol=1e-8, rtol=1e-11)


def test_a_plane_infinitely_far_off_moves_as_for_a_camera_that_only_turned() -> None:
    far = plane_between_views(FIRST, SECOND, POSE, [0.0, 0.0, 1.0, -1e300])
    np.testing.assert_allclose(far, turned_camera(FIRST, SECOND, R), rtol=1e-12)
