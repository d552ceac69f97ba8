"""A camera above level ground, against points projected one by one."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import apply_homography
from simulations.models.projection import pinhole, vanishing
from simulations.models.projection.level_ground import (
    ground_to_image,
    height_by_horizon,
    pose_above_ground,
)

K = pinhole.intrinsics((400.0, 410.0), (320.0, 240.0), skew=2.0)
POSE = pose_above_ground(1.7, 0.4, 0.3, -0.2)
RNG = np.random.default_rng(5)
FLOOR = RNG.uniform((-2, 3), (4, 9), (20, 2))


def image(points: Floats, pose: Floats = POSE) -> Floats:
    pixels, valid = pinhole.project(pinhole.world_to_camera(points, pose), K)
    assert valid.all()
    return pixels


def points_at(height: float) -> Floats:
    return np.column_stack([FLOOR, np.full(len(FLOOR), height)])


def test_pose_composes_yaw_pitch_and_roll() -> None:
    """SciPy turns a camera that looks along y about the vertical, its x axis and its z axis."""
    level = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    yaw = Rotation.from_euler("y", -0.4).as_matrix()
    pitch = Rotation.from_euler("x", 0.3).as_matrix()
    roll = Rotation.from_euler("z", 0.2).as_matrix()
    np.testing.assert_allclose(POSE[:3, :3], roll @ pitch @ yaw @ level, atol=1e-12)
    np.testing.assert_allclose(pinhole.invert_pose(POSE)[:3, 3], (0, 0, 1.7), atol=1e-12)


def test_ground_homography_agrees_with_projected_points() -> None:
    mapped, valid = apply_homography(ground_to_image(POSE, K), FLOOR)
    assert valid.all()
    np.testing.assert_allclose(mapped, image(points_at(0.0)), atol=1e-9)


@pytest.mark.parametrize("height", [0.3, 1.7, 2.5, -0.4])
def test_heights_follow_from_the_horizon_in_the_picture(height: float) -> None:
    horizon, _ = vanishing.horizon(POSE[:3, 2], K)
    ratio, valid = height_by_horizon(
        image(points_at(0.0)), image(points_at(height)), horizon, K @ POSE[:3, 2]
    )
    assert valid.all()
    np.testing.assert_allclose(ratio * 1.7, height, rtol=1e-9)


@pytest.mark.parametrize(
    ("foot", "top"),
    [
        ((50, 240), (50, 210)),
        ((3, 240), (9, 999)),
        ((math.nan, 1), (2, 3)),
        ((1, 330), (1, math.inf)),
        ((9, 300), (9, 999)),  # the top in the vanishing point
    ],
)
def test_foot_on_the_horizon_gives_no_height(
    foot: tuple[float, float], top: tuple[float, float]
) -> None:
    ratio, valid = height_by_horizon(foot, top, (0, 1, -240), (9, 999, 1))
    assert not valid
    assert np.isnan(ratio)
