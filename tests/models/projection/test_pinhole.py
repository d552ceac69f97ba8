"""Pinhole projection, poses and rays."""

import math
from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from simulations.models.geometry import rotations
from simulations.models.projection import pinhole

K = pinhole.intrinsics((400.0, 410.0), (320.0, 240.0), skew=2.0)
POSE = pinhole.look_at((3.0, -2.0, -6.0), (0.5, 0.2, 1.0), (0.0, -1.0, 0.0))
RNG = np.random.default_rng(2)


def test_the_example_of_the_book_projects_to_16_px() -> None:
    pixels, valid = pinhole.project((1.0, 0.5, 5.0), pinhole.intrinsics(80, (0, 0)))
    assert valid
    assert pixels == pytest.approx((16.0, 8.0))


def test_projection_agrees_with_opencv() -> None:
    no_skew = pinhole.intrinsics((400.0, 410.0), (320.0, 240.0))
    points = RNG.uniform(-2, 2, (100, 3))
    expected, _ = cv2.projectPoints(
        points, cv2.Rodrigues(POSE[:3, :3])[0], POSE[:3, 3], no_skew, None
    )
    pixels, valid = pinhole.project(pinhole.world_to_camera(points, POSE), no_skew)
    assert valid.all()
    assert pixels == pytest.approx(expected[:, 0], abs=1e-9)


def test_the_camera_matrix_projects_like_pose_and_intrinsics() -> None:
    points = RNG.uniform(-2, 2, (50, 3))
    homogeneous = np.column_stack([points, np.ones(50)]) * RNG.choice([-3.0, 1.0, 7.0], (50, 1))
    P = pinhole.camera_matrix(K, POSE)
    pixels, valid = pinhole.project_homogeneous(homogeneous, P)
    assert valid.all()
    assert pixels == pytest.approx(pinhole.project(pinhole.world_to_camera(points, POSE), K)[0])


@pytest.mark.parametrize("Z", [0.0, -0.0, -1e-300, -5.0, -math.inf, math.nan])
def test_points_on_and_behind_the_camera_plane_have_no_image(Z: float) -> None:
    pixels, valid = pinhole.project((1.0, 1.0, Z), K)
    assert not valid
    assert np.isnan(pixels).all()


@pytest.mark.parametrize("Z", [1e300, math.inf])
def test_what_is_infinitely_far_straight_ahead_meets_the_principal_point(Z: float) -> None:
    pixels, valid = pinhole.project((1.0, 1.0, Z), K)
    assert valid
    assert pixels == pytest.approx((320.0, 240.0))


def test_an_image_too_far_off_to_be_a_number_is_invalid() -> None:
    assert not pinhole.project((1e300, 0.0, 1e-300), K)[1]
    assert pinhole.project((1e300, 0.0, 1.0), K)[1]


def test_a_mask_goes_point_by_point() -> None:
    points = np.array([[[0, 0, 1.0], [0, 0, -1.0]], [[0, 0, 0.0], [0, 0, 2.0]]])
    pixels, valid = pinhole.project(points, K)
    assert pixels.shape == (2, 2, 2)
    assert valid.tolist() == [[True, False], [False, True]]


def test_a_point_at_infinity_is_seen_only_in_front() -> None:
    P = pinhole.camera_matrix(K, np.eye(4)[:, :])
    pixels, valid = pinhole.project_homogeneous([(1, 0, 2, 0), (-1, 0, -2, 0), (0, 0, 0, 0)], P)
    assert valid.tolist() == [True, False, False]
    assert pixels[0] == pytest.approx((320 + 200, 240))


@given(st.floats(-2, 2), st.floats(-2, 2), st.floats(0.1, 50), st.floats(1e-3, 1e3))
def test_scaling_the_scene_leaves_the_picture_unchanged(
    X: float, Y: float, Z: float, scale: float
) -> None:
    point = np.array([X, Y, Z])
    assert pinhole.project(point * scale, K)[0] == pytest.approx(pinhole.project(point, K)[0])


@pytest.mark.parametrize(
    ("focal", "centre", "skew", "complaint"),
    [
        (0.0, (0, 0), 0.0, "focal_px"),
        ((5.0, -1.0), (0, 0), 0.0, "focal_px"),
        (math.nan, (0, 0), 0.0, "focal_px"),
        (math.inf, (0, 0), 0.0, "focal_px"),
        (1.0, (math.nan, 0), 0.0, "principal_point"),
        (1.0, (0, 0), math.inf, "skew"),
    ],
)
def test_meaningless_intrinsics_are_refused(
    focal: float | tuple[float, float], centre: Any, skew: float, complaint: str
) -> None:
    with pytest.raises(ValueError, match=complaint):
        pinhole.intrinsics(focal, centre, skew)


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
    ("target", "up", "complaint"),
    [((1, 2, 3), (0, 1, 0), "target"), ((1, 2, 9), (0, 0, 1), "up"), ((1, 2, 9), (0, 0, 0), "up")],
)
def test_a_camera_needs_a_direction_and_an_up(
    target: tuple[float, float, float],
    up: tuple[float, float, float],
    complaint: str,
) -> None:
    with pytest.raises(ValueError, match=complaint):
        pinhole.look_at((1, 2, 3), target, up)


def test_the_inverse_pose_holds_the_camera_centre() -> None:
    back = pinhole.invert_pose(POSE)
    assert back @ POSE == pytest.approx(np.eye(4), abs=1e-14)
    assert back[:3, 3] == pytest.approx((3, -2, -6))


def test_the_lamp_of_the_book_seen_from_the_side() -> None:
    R = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]
    pose = pinhole.rigid_pose(R, (0, 0, 10))
    assert pinhole.world_to_camera((2, -1, 3), pose) == pytest.approx((3, -1, 8))
    assert pinhole.relative_to_camera((2, -1, 3), R, (10, 0, 0)) == pytest.approx((3, -1, 8))


def test_subtracting_the_centre_first_stays_exact_far_from_the_origin() -> None:
    R = rotations.from_axis_angle((1, 2, 3), 0.7)
    centre = np.array([4e12, -7e12, 1e12])
    offset = np.array([1.5, -0.25, 8.0])  # exact in binary beside the centre
    expected = R @ offset
    subtracted = pinhole.relative_to_camera(centre + offset, R, centre)
    added = pinhole.world_to_camera(centre + offset, pinhole.rigid_pose(R, -R @ centre))
    assert subtracted == pytest.approx(expected, abs=1e-14)
    assert 1e-6 < np.abs(added - expected).max() < 1e-1


def test_fields_of_view() -> None:
    normal_lens_deg = math.degrees(pinhole.field_of_view_rad(50.0, 36.0))
    assert normal_lens_deg == pytest.approx(39.6, abs=0.05)  # as printed on data sheets
    assert pinhole.field_of_view_rad(18.0, 36.0) == pytest.approx(math.pi / 2)
    assert pinhole.field_of_view_rad(math.inf, 36.0) == 0.0
    for focal, sensor in ((0.0, 36.0), (-1.0, 36.0), (50.0, 0.0), (math.nan, 36.0)):
        with pytest.raises(ValueError, match="focal_mm"):
            pinhole.field_of_view_rad(focal, sensor)


def test_one_focal_length_serves_both_axes_and_the_matrix_is_upper_triangular() -> None:
    assert pinhole.intrinsics(80.0, (3, 4)).tolist() == [[80, 0, 3], [0, 80, 4], [0, 0, 1]]
    assert pinhole.intrinsics(80, (3, 4))[1, 1] == 80
    assert pinhole.intrinsics((5.0, 6.0), (3, 4), 2.0).tolist() == [
        [5, 2, 3],
        [0, 6, 4],
        [0, 0, 1],
    ]
    for focal in ((0.0, 5.0), (5.0, 0.0), (math.inf, 5.0), (5.0, math.inf)):
        with pytest.raises(ValueError, match="focal_px"):
            pinhole.intrinsics(focal, (0, 0))
    with pytest.raises(ValueError, match="principal_point"):
        pinhole.intrinsics(1.0, (0, math.inf))


def test_skew_moves_x_with_y() -> None:
    pixels, _ = pinhole.project((0.0, 2.0, 4.0), K)
    assert pixels == pytest.approx((320 + 2 * 0.5, 240 + 410 * 0.5))


def test_a_homogeneous_point_that_is_not_finite_spoils_no_other() -> None:
    P = pinhole.camera_matrix(K, np.eye(4))
    points = [
        (0, 0, 1, 1),
        (math.inf, 0, 1, 1),
        (0, 0, math.nan, 1),
        (0, 0, -2, -2.0),
        (0, 0, 1, -1),
    ]
    pixels, valid = pinhole.project_homogeneous(points, P)
    assert valid.tolist() == [True, False, False, True, False]
    assert pixels[valid] == pytest.approx(np.array([(320, 240)] * 2))
    assert np.isnan(pixels[~valid]).all()


@pytest.mark.parametrize("size", [1e-300, 1e300])
def test_the_size_of_homogeneous_coordinates_does_not_matter(size: float) -> None:
    P = pinhole.camera_matrix(K, np.eye(4))
    pixels, valid = pinhole.project_homogeneous(size * np.array([1.0, 0.5, 5.0, 1.0]), P)
    assert valid
    assert pixels == pytest.approx((320 + 80 + 2 * 0.1, 240 + 41))


def test_a_camera_may_be_tiny_steps_or_huge_ones_from_its_target() -> None:
    for size in (1e-200, 1e150):
        pose = pinhole.look_at((0, 0, 0), np.array([0, 3.0, 4.0]) * size, (0, -1, 0))
        assert pose[2, :3] == pytest.approx((0, 0.6, 0.8))


@pytest.mark.parametrize(
    ("eye", "target", "up", "complaint"),
    [
        ((0, 0, 0), (math.inf, 0, 0), (0, 1, 0), "target"),
        ((0, 0, 0), (math.nan, 0, 0), (0, 1, 0), "target"),
        ((0, 0, 0), (0, 0, 1), (0, math.inf, 0), "up"),
        ((0, 0, 0), (0, 0, 1), (0, 1e-10, 1), "up"),
        ((0, 0, 0), (0, 0, 1), (0, 0, -1), "up"),
    ],
)
def test_directions_that_are_none_are_refused(
    eye: tuple[float, float, float],
    target: tuple[float, float, float],
    up: tuple[float, float, float],
    complaint: str,
) -> None:
    with pytest.raises(ValueError, match=complaint):
        pinhole.look_at(eye, target, up)


def test_up_may_be_a_hair_beside_the_line_of_sight() -> None:
    pose = pinhole.look_at((0, 0, 0), (0, 0, 1), (0, 1e-8, 1))
    assert pose[:3, :3] == pytest.approx(np.array([[-1, 0, 0], [0, -1, 0], [0, 0, 1]]), abs=1e-12)


def test_looking_along_the_axis_of_depth_with_y_down_changes_nothing() -> None:
    assert pinhole.look_at((0, 0, 0), (0, 0, 5), (0, -1, 0)) == pytest.approx(np.eye(4))
    assert pinhole.look_at((0, 0, -2), (0, 0, 5), (0, -1, 0))[:3, 3] == pytest.approx((0, 0, 2))


def test_a_field_of_view_needs_a_finite_sensor() -> None:
    for sensor in (-1.0, math.inf, math.nan):
        with pytest.raises(ValueError, match="sensor_mm"):
            pinhole.field_of_view_rad(50.0, sensor)


def test_a_field_of_view_is_the_same_in_any_unit() -> None:
    for unit in (1e-3, 1.0, 1e3):
        angle = pinhole.field_of_view_rad(50.0 * unit, 36.0 * unit)
        assert angle == pytest.approx(2 * math.atan(18 / 50))


@pytest.mark.parametrize("size", [1e306, -1e306])
def test_products_of_huge_homogeneous_coordinates_do_not_overflow(size: float) -> None:
    P = pinhole.camera_matrix(pinhole.intrinsics(400.0, (320, 240)), np.eye(4))
    points = [(size, 0.5 * size, 2 * size, size), (1e306, 0.5e306, 2e306, 1.0)]
    pixels, valid = pinhole.project_homogeneous(points, P)
    assert valid.all()
    assert pixels == pytest.approx(np.array([[520, 340]] * 2))


def test_a_point_with_one_pixel_coordinate_beyond_all_numbers_is_not_seen() -> None:
    P = pinhole.camera_matrix(pinhole.intrinsics(1.0, (0, 0)), np.eye(4))
    assert not pinhole.project_homogeneous((1.0, 0.0, 1e-310, 0.0), P)[1]


@pytest.mark.parametrize(
    ("eye", "target", "up", "message"),
    [
        ((0, 0, 0), (0, 0, 1), (0, 0, 0), "up .* legal: finite, not zero"),
        ((0, 0, 0), (1.7e308, 1.7e308, 0), (0, 0, 1), "target: .* legal: positive, finite"),
        ((1.7e308, 1.7e308, 0), (0.85e308, 0.85e308, 0), (0, 0, 1), "eye .* largest number"),
    ],
)
def test_what_is_wrong_with_a_point_of_view_is_named(
    eye: tuple[float, float, float],
    target: tuple[float, float, float],
    up: tuple[float, float, float],
    message: str,
) -> None:
    with pytest.raises(ValueError, match=message):
        pinhole.look_at(eye, target, up)
