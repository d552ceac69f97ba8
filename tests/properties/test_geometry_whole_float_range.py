"""Transformations, rotations and projection for any floats at all.

No warning (pytest turns them into errors), no exception but a `ValueError` with a reason, and
nothing that is not a number unless the mask says so.
"""

import numpy as np
from hypothesis import given
from support.float_range import any_float, arrays, ask, assert_finite_where_valid, finite_float

from simulations.models.arrays import Floats
from simulations.models.geometry import (
    euler,
    homography_algebra,
    homography_estimation,
    lines_and_planes,
    quaternions,
    rotations,
    transforms,
)
from simulations.models.projection import affine_cameras, pinhole, vanishing

K = pinhole.intrinsics((800.0, 790.0), (320.0, 240.0), 0.5)
P = pinhole.camera_matrix(K, pinhole.look_at([1.0, 2.0, -3.0], [0, 0, 0], [0, 1, 0]))


def is_rotation(R: Floats, tolerance: float = 1e-9) -> bool:
    return np.allclose(R @ np.swapaxes(R, -1, -2), np.eye(3), atol=tolerance)


@given(arrays(4, 3))
def test_projected_points_are_finite_where_valid_and_nan_elsewhere(points: Floats) -> None:
    pixels, valid = pinhole.project(points, K)
    assert_finite_where_valid((pixels, valid))
    assert np.isnan(pixels[~valid]).all()
    assert (points[valid, 2] > 0).all()


@given(arrays(4, 4))
def test_homogeneous_points_project_to_finite_pixels_or_none(points: Floats) -> None:
    pixels, valid = pinhole.project_homogeneous(points, P)
    assert_finite_where_valid((pixels, valid))
    assert np.isnan(pixels[~valid]).all()


@given(arrays(5))
def test_intrinsics_are_finite_or_refused(v: Floats) -> None:
    matrix = ask(pinhole.intrinsics, (v[0], v[1]), (v[2], v[3]), v[4])
    assert matrix is None or np.isfinite(matrix).all()


@given(any_float, any_float)
def test_field_of_view_is_an_angle(focal_mm: float, sensor_mm: float) -> None:
    angle = ask(pinhole.field_of_view_rad, focal_mm, sensor_mm)
    assert angle is None or 0.0 <= angle <= np.pi


@given(arrays(3), arrays(3), arrays(3))
def test_a_camera_looks_somewhere_or_is_refused(eye: Floats, target: Floats, up: Floats) -> None:
    pose = ask(pinhole.look_at, eye, target, up)
    assert pose is None or (is_rotation(pose[:3, :3]) and np.isfinite(pose).all())


@given(arrays(4, 3), arrays(3), any_float)
def test_parallel_cameras_give_finite_pixels_or_are_refused(
    points: Floats, reference: Floats, scale: float
) -> None:
    for camera in (
        ask(affine_cameras.paraperspective_camera, K, reference),
        ask(affine_cameras.orthographic_camera, scale, (reference[0], reference[1])),
    ):
        if camera is not None:
            pixels, valid = affine_cameras.project_affine(points, camera)
            assert_finite_where_valid((pixels, valid))
            assert np.isnan(pixels[~valid]).all()


@given(arrays(2, 3))
def test_vanishing_points_are_finite_where_valid(directions: Floats) -> None:
    assert_finite_where_valid(vanishing.vanishing_point(directions, K))


@given(arrays(3))
def test_horizons_are_finite_where_valid(normal: Floats) -> None:
    assert_finite_where_valid(vanishing.horizon(normal, K))


@given(arrays(2, 2), arrays(2, 3))
def test_lines_and_planes_are_finite_where_valid(points: Floats, corners: Floats) -> None:
    assert_finite_where_valid(lines_and_planes.line_through(*points))
    assert_finite_where_valid(
        lines_and_planes.plane_through(corners[0], corners[1], [0.0, 1.0, 0.0])
    )


@given(arrays(2, 3), arrays(2))
def test_lines_meet_in_finite_points_or_nowhere(lines: Floats, point: Floats) -> None:
    meet, valid = lines_and_planes.intersection(*lines)
    assert_finite_where_valid((meet, valid))
    assert valid or np.isnan(meet).all()
    assert lines_and_planes.signed_distance(point, lines).shape == (2,)


@given(arrays(3, 3), arrays(4, 2))
def test_homographies_map_to_finite_points_or_none(H: Floats, points: Floats) -> None:
    images, valid = transforms.apply_homography(H, points)
    assert_finite_where_valid((images, valid))
    assert np.isnan(images[~valid]).all()


@given(arrays(3, 3))
def test_a_projective_matrix_is_finite_or_refused(h: Floats) -> None:
    H = ask(transforms.projective, h)
    assert H is None or np.isfinite(H).all()


@given(any_float, any_float, any_float, any_float)
def test_similarities_are_finite_or_refused(
    scale: float, angle_rad: float, tx: float, ty: float
) -> None:
    H = ask(transforms.similarity, scale, angle_rad, tx, ty)
    assert H is None or np.isfinite(H).all()


@given(arrays(3, 3), arrays(5, 2))
def test_a_clipped_polygon_is_finite_and_mappable(H: Floats, polygon: Floats) -> None:
    kept = ask(transforms.clip_to_visible, H, polygon)
    if kept is not None:
        assert kept.shape[1:] == (2,)
        assert np.isfinite(kept).all()


@given(arrays(3, 3))
def test_conditions_are_at_least_one(H: Floats) -> None:
    assert homography_algebra.condition_number(H) >= 1.0 - 1e-9


@given(arrays(3, 3))
def test_inverses_and_parts_are_finite_or_refused(H: Floats) -> None:
    inverse = ask(homography_algebra.invert, H)
    assert inverse is None or np.isfinite(inverse).all()
    parts = ask(homography_algebra.decompose, H)
    assert parts is None or np.isfinite([parts.tx, parts.ty, parts.scale_x, parts.shear]).all()


@given(arrays(5, 2), arrays(5, 2))
def test_estimates_are_finite_where_valid(source: Floats, target: Floats) -> None:
    for estimate in (
        homography_estimation.estimate_homography,
        homography_estimation.estimate_affine,
        homography_estimation.estimate_similarity,
        homography_estimation.estimate_rigid,
    ):
        answer = ask(estimate, source, target)
        if answer is not None:
            assert_finite_where_valid(answer)


@given(arrays(2, 4))
def test_quaternions_are_of_unit_norm_or_refused(q: Floats) -> None:
    unit = ask(quaternions.normalise, q)
    if unit is not None:
        assert np.allclose(np.linalg.norm(unit, axis=-1), 1.0)
        assert is_rotation(quaternions.to_matrix(q))
        assert np.isfinite(quaternions.to_rotation_vector(q)).all()


@given(arrays(4), arrays(4), any_float)
def test_paths_between_orientations_stay_on_the_sphere(
    start: Floats, end: Floats, share: float
) -> None:
    for path in (rotations.slerp, rotations.nlerp):
        q = ask(path, start, end, share)
        assert q is None or np.isclose(np.linalg.norm(q), 1.0)


@given(arrays(3), any_float)
def test_exponentials_are_rotations_or_refused(vector: Floats, angle_rad: float) -> None:
    R = ask(rotations.exponential, vector)
    assert R is None or is_rotation(R)
    R = ask(rotations.from_axis_angle, vector, angle_rad)
    assert R is None or is_rotation(R)
    q = ask(quaternions.from_rotation_vector, vector)
    assert q is None or np.isclose(np.linalg.norm(q), 1.0)


@given(arrays(3, 3))
def test_only_rotations_have_logarithms_and_angles(matrix: Floats) -> None:
    vector = ask(rotations.logarithm, matrix)
    assert vector is None or np.isfinite(vector).all()
    answer = ask(euler.from_matrix, matrix, "ZYX")
    assert answer is None or np.isfinite(answer[0]).all()
    R = ask(rotations.nearest_rotation, matrix)
    assert R is None or is_rotation(R)


@given(arrays(3))
def test_three_angles_make_a_rotation_or_are_refused(angles_rad: Floats) -> None:
    R = ask(euler.to_matrix, "zxz", tuple(angles_rad))
    assert R is None or is_rotation(R)


@given(arrays(3, of=finite_float))
def test_the_camera_centre_is_its_own_origin_wherever_it_is(centre: Floats) -> None:
    assert np.array_equal(pinhole.relative_to_camera(centre, np.eye(3), centre), np.zeros(3))
