"""Pinhole projection, poses and rays."""

import math
from typing import Any

import numpy as np
import pytest

from simulations.models.projection import pinhole

K = pinhole.intrinsics((400.0, 410.0), (320.0, 240.0), skew=2.0)
POSE = pinhole.look_at((3.0, -2.0, -6.0), (0.5, 0.2, 1.0), (0.0, -1.0, 0.0))
RNG = np.random.default_rng(2)


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
    ],
)
def test_points_in_front_have_their_pixel_and_others_none(
    point: tuple[float, ...], pixel: tuple[float, ...]
) -> None:
    found, valid = pinhole.project(point, K)
    assert valid == np.isfinite(pixel).all()
    assert found == pytest.approx(pixel, nan_ok=True)


@pytest.mark.parametrize(
    ("point", "pixel"),
    [
        *(((size, 0.5 * size, 5 * size, size), (400.2, 281.0)) for size in (1e-300, -1.0, 1e300)),
        *(((size, 0.5 * size, 2 * size, 2.0), (520 + 0.5, 342.5)) for size in (1e306,)),
        ((1, 0, 2, 0), (520.0, 240.0)),  # at infinity, in front
        ((-1, 0, -2, 0), NOWHERE),  # and behind
        ((0, 0, -2, -2), (320.0, 240.0)),
        *((point, NOWHERE) for point in ((0, 0, 0, 0), (0, 0, 1, -1), (1.0, 0.0, 1e-310, 0.0))),
        *((point, NOWHERE) for point in ((math.inf, 0, 1, 1), (0, 0, math.nan, 1))),
    ],
)
def test_homogeneous_points_in_front_have_their_pixel_and_others_none(
    point: tuple[float, ...], pixel: tuple[float, ...]
) -> None:
    found, valid = pinhole.project_homogeneous(point, pinhole.camera_matrix(K, np.eye(4)))
    assert valid == np.isfinite(pixel).all()
    assert found == pytest.approx(pixel, nan_ok=True)


def test_the_camera_matrix_projects_like_pose_and_intrinsics() -> None:
    points = RNG.uniform(-2, 2, (50, 3))
    homogeneous = np.column_stack([points, np.ones(50)]) * RNG.choice([-3.0, 1.0, 7.0], (50, 1))
    P = pinhole.camera_matrix(K, POSE)
    pixels, valid = pinhole.project_homogeneous(homogeneous, P)
    assert valid.all()
    assert pixels == pytest.approx(pinhole.project(pinhole.world_to_camera(points, POSE), K)[0])


def test_intrinsics_are_upper_triangular_and_one_focal_length_serves_both_axes() -> None:
    assert pinhole.intrinsics(80, (3, 4)).tolist() == [[80, 0, 3], [0, 80, 4], [0, 0, 1]]
    skewed = pinhole.intrinsics((5.0, 6.0), (3, 4), 2.0)
    assert skewed.tolist() == [[5, 2, 3], [0, 6, 4], [0, 0, 1]]


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
def test_a_field_of_view_is_an_angle_of_similar_triangles(unit: float) -> None:
    angle = pinhole.field_of_view_rad(50.0 * unit, 36.0 * unit)
    assert angle == pytest.approx(2 * math.atan(18 / 50))


def test_a_ray_through_a_pixel_centre_projects_back_to_it() -> None:
    rays = pinhole.pixel_rays(K, 7, 5)
    pixels, valid = pinhole.project(3.0 * rays, K)
    rows, columns = np.mgrid[:5, :7]
    assert valid.all()
    assert pixels == pytest.approx(np.stack([columns, rows], axis=-1), abs=1e-12)


def test_look_at_puts_the_target_on_the_axis_and_up_upwards() -> None:
    assert POSE[:3, :3].T @ POSE[:3, :3] == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(POSE[:3, :3]) == pytest.approx(1.0)
    target = pinhole.world_to_camera((0.5, 0.2, 1.0), POSE)
    assert target[:2] == pytest.approx((0, 0), abs=1e-14)
    assert target[2] == pytest.approx(math.dist((3, -2, -6), (0.5, 0.2, 1)))
    assert (POSE[:3, :3] @ (0.0, -1.0, 0.0))[1] < 0
    assert (POSE[:3, :3] @ (0.0, -1.0, 0.0))[0] == pytest.approx(0, abs=1e-15)


@pytest.mark.parametrize(
    ("eye", "target", "up", "axes"),
    [
        ((0, 0, 0), (0, 0, 5), (0, -1, 0), np.eye(3)),
        ((0, 0, 0), (0, 0, 1), (0, 1e-8, 1), np.diag([-1, -1, 1])),  # a hair beside the sight
        *(
            (
                (0, 0, 0),
                (0, 3 * size, 4 * size),
                (0, -1, 0),
                [[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]],
            )
            for size in (1e-200, 1e150)
        ),
    ],
)
def test_a_camera_is_turned_towards_its_target_at_any_distance(
    eye: Any, target: Any, up: Any, axes: Any
) -> None:
    np.testing.assert_allclose(pinhole.look_at(eye, target, up)[:3, :3], axes, atol=1e-12)


def test_the_inverse_pose_holds_the_camera_centre() -> None:
    back = pinhole.invert_pose(POSE)
    assert back @ POSE == pytest.approx(np.eye(4), abs=1e-14)
    assert back[:3, 3] == pytest.approx((3, -2, -6))
