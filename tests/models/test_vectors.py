"""What all models do alike with stacks of vectors, with none, with ∞, and with a wrong length."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, as_array, as_colours, as_floats, as_vectors
from simulations.models.color import cie
from simulations.models.color.chromatic_adaptation import adapt
from simulations.models.color.chromaticity import ILLUMINANT_A_XY, xyz_to_xyy
from simulations.models.color.cie import D65_XY
from simulations.models.color.white_balance import white_balance
from simulations.models.distortion import fisheye, lens_model
from simulations.models.geometry import (
    euler,
    lines_and_planes,
    quaternions,
    rotations,
    transforms,
    transforms_3d,
)
from simulations.models.geometry.quaternions import cross_polynomial
from simulations.models.light import edge_coverage
from simulations.models.projection import affine_cameras, pinhole, vanishing
from simulations.models.sampling import resampling

K = pinhole.intrinsics(800.0, (320.0, 240.0))
POSE = pinhole.rigid_pose(rotations.exponential([0.1, 0.2, 0.3]), [1.0, 2.0, 3.0])
LENS = lens_model.Distortion(k1=-0.1, p1=0.01)
AFFINE = affine_cameras.orthographic_camera(100.0)
Q = [1.0, 0.0, 0.0, 0.0]

FUNCTIONS = [
    ("points", 2, lambda v: transforms.apply_homography(np.eye(3), v)),
    ("points_camera", 3, lambda v: pinhole.project(v, K)),
    ("points", 4, lambda v: pinhole.project_homogeneous(v, K @ POSE[:3])),
    ("points", 3, lambda v: pinhole.world_to_camera(v, POSE)),
    ("points", 3, lambda v: pinhole.relative_to_camera(v, POSE[:3, :3], [1.0, 2.0, 3.0])),
    ("points", 3, lambda v: affine_cameras.project_affine(v, AFFINE)),
    ("directions", 3, lambda v: vanishing.vanishing_point(v, K)),
    ("xy", 2, lambda v: lens_model.distort(v, LENS)),
    ("xy", 2, lambda v: lens_model.undistort(v, LENS)),
    ("xy", 2, lambda v: lens_model.jacobian(v, LENS)),
    ("directions", 3, lambda v: fisheye.project_fisheye(v, fisheye.Fisheye())),
    ("xy", 2, lambda v: fisheye.unproject_ideal(v, "equidistant")),
    ("p", 2, lambda v: lines_and_planes.line_through(v, [3.0, 4.0])),
    ("q", 2, lambda v: lines_and_planes.line_through([3.0, 4.0], v)),
    ("lines", 3, lambda v: lines_and_planes.intersection(v, [1.0, 2.0, 3.0])),
    ("others", 3, lambda v: lines_and_planes.intersection([1.0, 2.0, 3.0], v)),
    ("p", 3, lambda v: lines_and_planes.plane_through(v, [1.0, 0.0, 0.0], [0.0, 2.0, 0.0])),
    ("r", 3, lambda v: lines_and_planes.plane_through([1.0, 0.0, 0.0], [0.0, 2.0, 0.0], v)),
    ("points", 3, lambda v: lines_and_planes.signed_distance(v, [1.0, 2.0, 3.0, 4.0])),
    ("vector", 3, lambda v: cross_polynomial(v, 0.3, 0.2)),
    ("angles_rad", 3, lambda v: euler.to_matrix("ZYX", v)),
    ("rotation_vector", 3, rotations.exponential),
    ("axis", 3, lambda v: rotations.from_axis_angle(v, 0.3)),
    ("quaternion", 4, quaternions.normalise),
    ("second", 4, lambda v: quaternions.multiply(v, Q)),
    ("first", 4, lambda v: quaternions.multiply(Q, v)),
    ("vectors", 3, lambda v: quaternions.rotate(Q, v)),
    ("quaternion", 4, lambda v: quaternions.rotate(v, [1.0, 2.0, 3.0])),
    ("rotation_vector", 3, quaternions.from_rotation_vector),
    ("quaternion", 4, quaternions.to_matrix),
    ("quaternion", 4, quaternions.to_rotation_vector),
    ("quaternion", 4, lambda v: rotations.slerp(v, [0.5, 0.5, -0.5, 0.5], 0.3)),
    ("quaternion", 4, lambda v: rotations.nlerp([0.5, 0.5, -0.5, 0.5], v, 0.3)),
    ("points", 3, lambda v: transforms_3d.apply_transform(np.eye(4), v)),
    ("directions", 3, lambda v: fisheye.project_ideal(v, "equidistant")),
    ("xy", 2, lambda v: fisheye.unproject_fisheye(v, fisheye.Fisheye(0.1))),
    ("colours", 3, lambda v: adapt(v, D65_XY, ILLUMINANT_A_XY)),
    ("colours", 3, xyz_to_xyy),
    ("colours", 3, cie.xyz_to_lab),
    ("colours", 3, lambda v: white_balance(v, (0.5, 1.0, 0.7))),
    ("normal", 2, lambda v: edge_coverage.straight_edge_coverage(0.1, v)),
    ("xy_px", 2, lambda v: resampling.sample(np.ones((4, 5, 3)), v)),
]


def parts(answer: Any) -> tuple[Any, ...]:
    """Values and mask, or the one array."""
    return answer if isinstance(answer, tuple) else (answer,)


EACH = pytest.mark.parametrize(("length", "function"), [entry[1:] for entry in FUNCTIONS])


@pytest.mark.parametrize(("name", "length", "function"), FUNCTIONS)
def test_vectors_of_another_length_are_refused_by_name(
    name: str, length: int, function: Callable[[ArrayLike], Any]
) -> None:
    for wrong in (0.5, np.ones(length - 1), np.ones((7, length + 1))):
        shape = str(np.shape(wrong)).replace("(", r"\(").replace(")", r"\)")
        with pytest.raises(
            ValueError, match=rf"^{name} of shape {shape}; legal: \(\.\.\., {length}"
        ):
            function(wrong)


@EACH
def test_of_no_vectors_there_are_no_answers(
    length: int, function: Callable[[ArrayLike], Any]
) -> None:
    one, none = function(np.ones((2, 1, length))), function(np.ones((2, 0, length)))
    for some, nothing in zip(parts(one), parts(none), strict=True):
        assert nothing.shape == (2, 0, *some.shape[2:])
        assert nothing.dtype == some.dtype


@pytest.mark.parametrize("polygon", [[], np.empty((0, 2)), np.empty((0, 5))])
def test_of_no_polygon_nothing_is_left(polygon: ArrayLike) -> None:
    assert transforms.clip_half_plane(polygon, (1.0, 0.0, 0.0)).shape == (0, 2)
    assert transforms.clip_to_visible(np.eye(3), polygon).shape == (0, 2)


@pytest.mark.parametrize("polygon", [np.ones((4, 3)), np.ones(4)])
def test_a_polygon_has_corners_in_the_plane(polygon: Floats) -> None:
    with pytest.raises(ValueError, match=r"^polygon of shape"):
        transforms.clip_half_plane(polygon, (1.0, 0.0, 0.0))


def test_vectors_become_double_precision_and_keep_their_shape() -> None:
    vectors = as_vectors("x", np.ones((2, 3), np.float32), 3)
    assert vectors.dtype == np.float64
    assert vectors.shape == (2, 3)


def test_pictures_stay_single_and_half_precision_becomes_single() -> None:
    kinds = {"f2": "f4", "f4": "f4", "f8": "f8", "u1": "f8", "?": "f8"}
    for given, kept in kinds.items():
        assert as_floats(np.ones(2, given)).dtype == kept


@pytest.mark.parametrize("given", [[1j], np.array([1.0 + 0j])])
def test_complex_numbers_are_refused_and_not_cut(
    given: NDArray[np.complex128] | list[complex],
) -> None:
    with pytest.raises(ValueError, match="complex128; legal: real"):
        as_floats(given)
    with pytest.raises(ValueError, match="x of type complex128; legal: real"):
        as_vectors("x", given, 1)
    with pytest.raises(ValueError, match="x of type complex128; legal: real"):
        as_array("x", given, 1)


@pytest.mark.parametrize("shape", [(), (3,), (3, 2), (4, 4), (9,)])
def test_what_is_no_stack_of_matrices_is_refused_by_name(shape: tuple[int, ...]) -> None:
    for function in (quaternions.from_matrix, rotations.logarithm):
        with pytest.raises(ValueError, match=r"^R of shape .+; legal: \(\.\.\., 3, 3\)"):
            function(np.ones(shape))


@EACH
def test_a_stack_is_answered_as_each_of_its_vectors_alone(
    length: int, function: Callable[[ArrayLike], Any]
) -> None:
    stack = np.random.default_rng(8).uniform(0.1, 0.9, (2, 3, length))
    together = parts(function(stack))
    for place in np.ndindex(2, 3):
        for many, alone in zip(together, parts(function(stack[place])), strict=True):
            np.testing.assert_allclose(many[place], alone, rtol=1e-13, atol=1e-15)


HUGE = [1e200, -1e308, np.inf, -np.inf, np.nan]


@EACH
def test_one_wild_vector_neither_warns_nor_spoils_its_neighbours(
    length: int, function: Callable[[ArrayLike], Any]
) -> None:
    calm = np.full((3, length), 0.25)
    expected = parts(function(calm))
    for huge in HUGE:
        wild = calm.copy()
        wild[1] = huge
        try:
            answer = function(wild)
        except ValueError:
            continue
        for ours, theirs in zip(parts(answer), expected, strict=True):
            np.testing.assert_array_equal(ours[[0, 2]], theirs[[0, 2]], str(huge))


@pytest.mark.parametrize(
    "focal", [np.float32(800.0), np.int64(800), np.array(800.0), [800.0, 800.0]]
)
def test_a_focal_length_may_be_any_kind_of_number(focal: Any) -> None:
    np.testing.assert_array_equal(pinhole.intrinsics(focal, (320.0, 240.0)), K)


@pytest.mark.parametrize("shape", [(3,), (1, 3), (4, 2, 3), (0, 3)])
def test_colours_have_three_components_in_any_layout(shape: tuple[int, ...]) -> None:
    colours = np.ones(shape, np.float32)
    assert as_colours(colours).shape == shape
    assert as_colours(colours).dtype == np.float32


@pytest.mark.parametrize("shape", [(), (4,), (2,), (3, 4), (3, 1), (0,)])
def test_grey_levels_and_colours_with_alpha_are_not_taken_for_colours(
    shape: tuple[int, ...],
) -> None:
    with pytest.raises(ValueError, match=r"colours of shape .*; legal: \(\.\.\., 3\)"):
        as_colours(np.ones(shape))
