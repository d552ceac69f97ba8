"""Rotations: matrices, axis and angle, and what is none."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from simulations.models.arrays import Floats
from simulations.models.geometry import rotations
from simulations.models.geometry.cross_products import cross_polynomial

RNG = np.random.default_rng(1)
RANDOM = Rotation.random(200, rng=RNG)
TINY_TO_TURN = [0.0, 1e-300, 1e-9, 1e-4, 1.0, math.pi - 1e-9, math.pi]


def test_polynomials_of_the_cross_product_are_what_cross_products_make_of_a_vector() -> None:
    a, b = RNG.normal(size=(2, 50, 3))
    linear, square = RNG.normal(size=(2, 50))
    once = np.cross(a, b)
    expected = b + linear[:, None] * once + square[:, None] * np.cross(a, once)
    found = cross_polynomial(a, linear, square)
    np.testing.assert_allclose((found @ b[..., None])[..., 0], expected, atol=1e-13)
    np.testing.assert_array_equal(cross_polynomial(a[3], linear[3], square[3]), found[3])
    assert cross_polynomial(a[:4, None], linear[:5], 0.5).shape == (4, 5, 3, 3)


@pytest.mark.parametrize("angle", TINY_TO_TURN)
def test_the_logarithm_undoes_the_exponential_from_tiny_angles_to_half_a_turn(angle: float) -> None:
    v = np.array([2.0, -1.0, 2.0]) / 3.0 * angle
    assert rotations.logarithm(rotations.exponential(v)) == pytest.approx(v, abs=1e-14, rel=1e-14)


def test_each_axis_of_a_field_is_scaled_on_its_own_whatever_its_signs() -> None:
    axes = np.array([[-1.0, -2, -2], [1e-200, 0, -1e-100], [0, 5e100, 0]])
    turns = rotations.from_axis_angle(axes, 0.7)
    for axis, turn in zip(axes, turns, strict=True):
        exact = axis / np.abs(axis).max()
        exact /= np.linalg.norm(exact)
        assert turn == pytest.approx(Rotation.from_rotvec(0.7 * exact).as_matrix(), abs=1e-15)


def test_the_nearest_rotation_repairs_a_drifted_matrix() -> None:
    R = RANDOM[0].as_matrix()
    drifted = R + 1e-3 * RNG.normal(size=(3, 3))
    repaired = rotations.nearest_rotation(drifted)
    assert repaired == pytest.approx(Rotation.from_matrix(drifted).as_matrix(), abs=1e-5)
    assert repaired.T @ repaired == pytest.approx(np.eye(3), abs=1e-14)
    others = rotations.exponential(1e-3 * RNG.normal(size=(50, 3))) @ repaired
    distances = np.linalg.norm(others - drifted, axis=(-2, -1))
    assert (distances > np.linalg.norm(repaired - drifted)).all()


def test_a_rotation_may_have_drifted_by_a_millionth() -> None:
    matrix = np.eye(3)
    matrix[0, 1] = 0.9e-6  # enters RᵀR once
    assert rotations.check_rotation(matrix) is matrix


def test_drift_is_counted_between_the_columns() -> None:
    """RᵀR = I + S with entries of 0.9e-6 at most; R Rᵀ has one of 2.7e-6."""
    to_x = rotations.nearest_rotation([[1.0, 1, 1], [-1.0, 1, 0], [-1.0, -1, 2]])
    drifted = to_x @ (np.eye(3) + 0.45e-6 * np.ones((3, 3)))
    assert np.abs(drifted @ drifted.T - np.eye(3)).max() > 1.1e-6
    assert rotations.check_rotation(drifted) is drifted


@pytest.mark.parametrize("size", [1e-200, 1e-3, 1.0, 1e200])
@pytest.mark.parametrize(
    "matrix",
    [np.eye(3), np.diag([3.0, 2.0, -1.0]), np.diag([1.0, 1.0, 0.0]), np.diag([1.0, 1e-11, 0.0])],
    ids=["a rotation", "mirrored", "flat", "of rank two to rounding"],
)
def test_the_nearest_rotation_of_a_known_matrix_at_any_scale(matrix: Floats, size: float) -> None:
    R = RANDOM[3].as_matrix()
    assert rotations.nearest_rotation(size * R @ matrix) == pytest.approx(R, abs=1e-5)
