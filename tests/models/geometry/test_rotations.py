"""Rotations: matrices, axis and angle, and what is none."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions, rotations
from simulations.models.geometry.cross_products import cross_polynomial

RNG = np.random.default_rng(1)
RANDOM = Rotation.random(200, rng=RNG)
components = st.floats(-1.0, 1.0, allow_subnormal=False)
vectors = st.tuples(components, components, components)
TINY_TO_TURN = [0.0, 1e-300, 1e-9, 1e-4, 1.0, math.pi - 1e-9, math.pi]


def test_a_third_of_a_turn_about_the_diagonal_permutes_the_axes() -> None:
    R = rotations.from_axis_angle((1, 1, 1), 2 * math.pi / 3)
    assert pytest.approx(np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]]), abs=1e-15) == R
    assert quaternions.from_matrix(R) == pytest.approx([0.5] * 4)


def test_polynomials_of_the_cross_product_are_what_cross_products_make_of_a_vector() -> None:
    a, b = RNG.normal(size=(2, 50, 3))
    linear, square = RNG.normal(size=(2, 50))
    once = np.cross(a, b)
    expected = b + linear[:, None] * once + square[:, None] * np.cross(a, once)
    found = cross_polynomial(a, linear, square)
    np.testing.assert_allclose((found @ b[..., None])[..., 0], expected, atol=1e-13)
    np.testing.assert_array_equal(cross_polynomial(a[3], linear[3], square[3]), found[3])
    assert cross_polynomial(a[:4, None], linear[:5], 0.5).shape == (4, 5, 3, 3)


def test_exponential_and_logarithm_agree_with_scipy() -> None:
    v = RANDOM.as_rotvec()
    assert rotations.exponential(v) == pytest.approx(RANDOM.as_matrix(), abs=1e-14)
    assert rotations.logarithm(RANDOM.as_matrix()) == pytest.approx(v, abs=1e-13)


@given(vectors, st.floats(0.0, 1e6))
def test_the_exponential_is_a_rotation(axis: tuple[float, float, float], size: float) -> None:
    R = rotations.exponential(np.array(axis) * size)
    assert pytest.approx(np.eye(3), abs=1e-14) == R.T @ R
    assert np.linalg.det(R) == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize("angle", TINY_TO_TURN)
def test_the_logarithm_undoes_the_exponential_from_tiny_angles_to_half_a_turn(angle: float) -> None:
    v = np.array([2.0, -1.0, 2.0]) / 3.0 * angle
    assert rotations.logarithm(rotations.exponential(v)) == pytest.approx(v, abs=1e-14, rel=1e-14)


def test_the_logarithm_of_an_exact_half_turn_has_a_positive_first_entry() -> None:
    R = np.diag([1.0, -1.0, -1.0])
    assert rotations.logarithm(R) == pytest.approx((math.pi, 0, 0))


def test_whole_turns_vanish() -> None:
    v = np.array([0.3, -0.2, 0.1])
    # 6283 rad is known to about 1e-12 rad.
    turns = v * (1 + 2 * math.pi * 1000 / np.linalg.norm(v))
    assert rotations.exponential(turns) == pytest.approx(rotations.exponential(v), abs=5e-12)


def test_the_length_of_an_axis_does_not_matter() -> None:
    for size in (1e-300, 1.0, 1e300):
        R = rotations.from_axis_angle(np.array([1.0, 2.0, 2.0]) * size, 0.7)
        assert pytest.approx(rotations.exponential([0.7 / 3, 1.4 / 3, 1.4 / 3]), abs=1e-15) == R


def test_each_axis_of_a_field_is_scaled_on_its_own_whatever_its_signs() -> None:
    axes = np.array([[-1.0, -2, -2], [1e-200, 0, -1e-100], [0, 5e100, 0]])
    turns = rotations.from_axis_angle(axes, 0.7)
    for axis, turn in zip(axes, turns, strict=True):
        exact = axis / np.abs(axis).max()
        exact /= np.linalg.norm(exact)
        assert turn == pytest.approx(Rotation.from_rotvec(0.7 * exact).as_matrix(), abs=1e-15)


@pytest.mark.parametrize("axis", [(0, 0, 0), (math.nan, 0, 1), (math.inf, 0, 0)])
def test_an_axis_without_direction_is_refused(axis: Sequence[float]) -> None:
    with pytest.raises(ValueError, match="axis"):
        rotations.from_axis_angle(axis, 1.0)


@pytest.mark.parametrize(
    ("matrix", "complaint"),
    [
        (np.diag([1.0, 1.0, -1.0]), "reflection"),
        (np.diag([1.0, 1.0, 0.0]), "differs from I"),
        (np.eye(3) * 1.001, "differs from I"),
        (np.full((3, 3), math.nan), "differs from I"),
        (np.eye(2), "shape"),
    ],
)
def test_what_is_no_rotation_has_no_logarithm(matrix: Floats, complaint: str) -> None:
    with pytest.raises(ValueError, match=complaint):
        rotations.logarithm(matrix)


def test_the_nearest_rotation_repairs_a_drifted_matrix() -> None:
    R = RANDOM[0].as_matrix()
    drifted = R + 1e-3 * RNG.normal(size=(3, 3))
    repaired = rotations.nearest_rotation(drifted)
    assert repaired == pytest.approx(Rotation.from_matrix(drifted).as_matrix(), abs=1e-5)
    assert repaired.T @ repaired == pytest.approx(np.eye(3), abs=1e-14)
    others = rotations.exponential(1e-3 * RNG.normal(size=(50, 3))) @ repaired
    distances = np.linalg.norm(others - drifted, axis=(-2, -1))
    assert (distances > np.linalg.norm(repaired - drifted)).all()


@pytest.mark.parametrize("matrix", [-np.eye(3), np.diag([1.0, 0, 0]), np.zeros((3, 3))])
def test_a_matrix_with_many_nearest_rotations_is_refused(matrix: Floats) -> None:
    with pytest.raises(ValueError, match="no single nearest rotation"):
        rotations.nearest_rotation(matrix)


def test_not_a_number_is_no_rotation_vector() -> None:
    for convert in (rotations.exponential, quaternions.from_rotation_vector):
        with pytest.raises(ValueError, match="rotation_vector"):
            convert((math.nan, 0, 0))


def test_fields_of_rotations_keep_their_shape() -> None:
    v = RNG.normal(size=(4, 5, 3))
    matrices = rotations.exponential(v)
    assert matrices.shape == (4, 5, 3, 3)
    assert matrices[2, 3] == pytest.approx(Rotation.from_rotvec(v[2, 3]).as_matrix())
    q = quaternions.from_matrix(matrices)
    assert q.shape == (4, 5, 4)
    assert q == pytest.approx(quaternions.from_matrix(matrices.reshape(-1, 3, 3)).reshape(q.shape))
    assert quaternions.to_matrix(q) == pytest.approx(matrices)
    assert rotations.logarithm(matrices)[1, 2] == pytest.approx(rotations.logarithm(matrices[1, 2]))
    assert quaternions.rotate(q, v)[3, 4] == pytest.approx(v[3, 4])  # the axis stays
    turned = rotations.from_axis_angle([0, 0, 1.0], np.array([[0.1, 0.2], [0.3, 0.4]]))
    assert turned.shape == (2, 2, 3, 3)
    assert np.arctan2(turned[..., 1, 0], turned[..., 0, 0]) == pytest.approx(
        np.array([[0.1, 0.2], [0.3, 0.4]])
    )


def test_an_infinite_angle_is_refused() -> None:
    for angle in (math.inf, math.nan):
        with pytest.raises(ValueError, match="angle_rad"):
            rotations.from_axis_angle((0, 0, 1), [0.1, angle])


@pytest.mark.parametrize(("drift", "legal"), [(0.9e-6, True), (1.1e-6, False), (-1.1e-6, False)])
def test_a_rotation_may_have_drifted_by_a_millionth(drift: float, legal: bool) -> None:
    matrix = np.eye(3)
    matrix[0, 1] = drift  # enters RᵀR once
    if legal:
        assert rotations.check_rotation(matrix) is matrix
        return
    with pytest.raises(ValueError, match="differs from I"):
        rotations.check_rotation(matrix)


def test_drift_is_counted_between_the_columns() -> None:
    """RᵀR = I + S with entries of 0.9e-6 at most; R Rᵀ has one of 2.7e-6."""
    to_x = rotations.nearest_rotation([[1.0, 1, 1], [-1.0, 1, 0], [-1.0, -1, 2]])
    drifted = to_x @ (np.eye(3) + 0.45e-6 * np.ones((3, 3)))
    assert np.abs(drifted @ drifted.T - np.eye(3)).max() > 1.1e-6
    assert rotations.check_rotation(drifted) is drifted


def test_one_reflection_or_one_drifted_matrix_spoils_the_field() -> None:
    for bad in (np.diag([1.0, 1, -1]), np.eye(3) * 1.1):
        with pytest.raises(ValueError, match="R: "):
            rotations.check_rotation([np.eye(3), bad])
    for shape in ((3, 2), (2, 3), (9,), (4, 4)):
        with pytest.raises(ValueError, match="shape"):
            rotations.check_rotation(np.ones(shape))


def test_the_nearest_rotation_of_a_scaled_or_mirrored_one_is_known() -> None:
    R = RANDOM[3].as_matrix()
    for size in (1e-200, 1e-3, 1.0, 1e200):
        assert rotations.nearest_rotation(size * R) == pytest.approx(R, abs=1e-14)
    mirrored = np.diag([3.0, 2.0, -1.0])
    assert rotations.nearest_rotation(mirrored) == pytest.approx(np.eye(3))
    one_unknown = np.eye(3)
    one_unknown[1, 2] = math.nan
    for bad in (np.full((3, 3), math.nan), one_unknown, np.eye(4), np.eye(3)[:2]):
        with pytest.raises(ValueError, match="legal"):
            rotations.nearest_rotation(bad)
    flat = np.diag([1.0, 1.0, 0.0])
    assert rotations.nearest_rotation(flat) == pytest.approx(np.eye(3))


@pytest.mark.parametrize(
    "matrix", [np.eye(3), np.array([[-3.0, -1, -2], [-1, -3, -1], [-1, -1, -4]])]
)
def test_the_nearest_rotation_does_not_depend_on_the_unit(matrix: Floats) -> None:
    R = rotations.nearest_rotation(matrix)
    assert rotations.nearest_rotation(1e200 * matrix) == pytest.approx(R)


@pytest.mark.parametrize(("least", "legal"), [(1e-11, True), (1e-13, False)])
def test_a_matrix_of_rank_two_to_rounding_has_a_nearest_rotation(least: float, legal: bool) -> None:
    matrix = np.diag([1.0, least, 0.0])
    if legal:
        assert rotations.nearest_rotation(matrix) == pytest.approx(np.eye(3))
        return
    with pytest.raises(ValueError, match="no single nearest rotation"):
        rotations.nearest_rotation(matrix)
