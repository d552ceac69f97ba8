"""Transformations, rotations and projection for any floats at all.

No warning (pytest turns them into errors), no exception but a `ValueError` with a reason, and
nothing that is not a number unless the mask says so.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
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

type Rows = dict[str, tuple[Callable[[Any], Any], tuple[int, ...]]]
"""Functions of an array, and its shape."""

K = pinhole.intrinsics((800.0, 790.0), (320.0, 240.0), 0.5)
P = pinhole.camera_matrix(K, pinhole.look_at([1.0, 2.0, -3.0], [0, 0, 0], [0, 1, 0]))
ALONG_Y = [0.0, 1.0, 0.0]


def is_rotation(R: Floats, tolerance: float = 1e-9) -> bool:
    return np.allclose(R @ np.swapaxes(R, -1, -2), np.eye(3), atol=tolerance)


def through_parallel_camera(v: Floats) -> Any:
    camera = affine_cameras.paraperspective_camera(K, v[0])
    return affine_cameras.project_affine(v[1:], camera)


def through_orthographic_camera(v: Floats) -> Any:
    camera = affine_cameras.orthographic_camera(v[0, 0], (v[0, 1], v[0, 2]))
    return affine_cameras.project_affine(v[1:], camera)


def of_pairs(estimate: Callable[[Floats, Floats], Any], v: Floats) -> Any:
    return estimate(v[:, :2], v[:, 2:])


MASKED: Rows = {
    "project": (lambda v: pinhole.project(v, K), (4, 3)),
    "project_homogeneous": (lambda v: pinhole.project_homogeneous(v, P), (4, 4)),
    "paraperspective_camera": (through_parallel_camera, (5, 3)),
    "orthographic_camera": (through_orthographic_camera, (5, 3)),
    "vanishing_point": (lambda v: vanishing.vanishing_point(v, K), (2, 3)),
    "horizon": (lambda v: vanishing.horizon(v, K), (3,)),
    "line_through": (lambda v: lines_and_planes.line_through(*v), (2, 2)),
    "plane_through": (lambda v: lines_and_planes.plane_through(v[0], v[1], ALONG_Y), (2, 3)),
    "intersection": (lambda v: lines_and_planes.intersection(*v), (2, 3)),
    "apply_homography": (lambda v: transforms.apply_homography(v[:3], v[3:, :2]), (7, 3)),
    **{
        estimate.__name__: (partial(of_pairs, estimate), (5, 4))
        for estimate in (
            homography_estimation.estimate_homography,
            homography_estimation.estimate_affine,
            homography_estimation.estimate_similarity,
            homography_estimation.estimate_rigid,
        )
    },
}


@pytest.mark.parametrize("name", MASKED)
@given(st.data())
def test_answers_are_finite_where_valid_and_nan_elsewhere(name: str, data: st.DataObject) -> None:
    function, shape = MASKED[name]
    answer = ask(function, data.draw(arrays(*shape)))
    if answer is not None:
        assert_finite_where_valid(answer)


def parts(H: Floats) -> list[float]:
    found = homography_algebra.decompose(H)
    return [found.tx, found.ty, found.scale_x, found.shear]


FINITE: Rows = {
    "intrinsics": (lambda v: pinhole.intrinsics((v[0], v[1]), (v[2], v[3]), v[4]), (5,)),
    "look_at": (lambda v: pinhole.look_at(*v), (3, 3)),
    "projective": (transforms.projective, (3, 3)),
    "similarity": (lambda v: transforms.similarity(*v), (4,)),
    "clip_to_visible": (lambda v: transforms.clip_to_visible(v[:3], v[3:, :2]), (8, 3)),
    "invert": (homography_algebra.invert, (3, 3)),
    "decompose": (parts, (3, 3)),
    "to_rotation_vector": (quaternions.to_rotation_vector, (2, 4)),
    "logarithm": (rotations.logarithm, (3, 3)),
    "euler.from_matrix": (lambda v: euler.from_matrix(v, "ZYX")[0], (3, 3)),
}


@pytest.mark.parametrize("name", FINITE)
@given(st.data())
def test_answers_are_finite_or_refused(name: str, data: st.DataObject) -> None:
    function, shape = FINITE[name]
    answer = ask(function, data.draw(arrays(*shape)))
    assert answer is None or np.isfinite(answer).all()


ROTATIONS: Rows = {
    "look_at": (lambda v: pinhole.look_at(*v)[:3, :3], (3, 3)),
    "quaternions.to_matrix": (quaternions.to_matrix, (2, 4)),
    "exponential": (rotations.exponential, (3,)),
    "from_axis_angle": (lambda v: rotations.from_axis_angle(v[:3], v[3]), (4,)),
    "nearest_rotation": (rotations.nearest_rotation, (3, 3)),
    "euler.to_matrix": (lambda v: euler.to_matrix("zxz", v), (3,)),
}


@pytest.mark.parametrize("name", ROTATIONS)
@given(st.data())
def test_rotations_are_orthogonal_or_refused(name: str, data: st.DataObject) -> None:
    function, shape = ROTATIONS[name]
    R = ask(function, data.draw(arrays(*shape)))
    assert R is None or is_rotation(R)


QUATERNIONS: Rows = {
    "normalise": (quaternions.normalise, (2, 4)),
    "from_rotation_vector": (quaternions.from_rotation_vector, (3,)),
    "slerp": (lambda v: rotations.slerp(v[:4], v[4:8], v[8]), (9,)),
    "nlerp": (lambda v: rotations.nlerp(v[:4], v[4:8], v[8]), (9,)),
}


@pytest.mark.parametrize("name", QUATERNIONS)
@given(st.data())
def test_quaternions_are_of_unit_norm_or_refused(name: str, data: st.DataObject) -> None:
    function, shape = QUATERNIONS[name]
    q = ask(function, data.draw(arrays(*shape)))
    assert q is None or np.allclose(np.linalg.norm(q, axis=-1), 1.0)


@given(any_float, any_float)
def test_field_of_view_is_an_angle(focal_mm: float, sensor_mm: float) -> None:
    angle = ask(pinhole.field_of_view_rad, focal_mm, sensor_mm)
    assert angle is None or 0.0 <= angle <= np.pi


@given(arrays(3, 3))
def test_conditions_are_at_least_one(H: Floats) -> None:
    assert homography_algebra.condition_number(H) >= 1.0 - 1e-9


@given(arrays(3, of=finite_float))
def test_the_camera_centre_is_its_own_origin_wherever_it_is(centre: Floats) -> None:
    assert np.array_equal(pinhole.relative_to_camera(centre, np.eye(3), centre), np.zeros(3))
