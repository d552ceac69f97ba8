"""Quaternions against SciPy and Hamilton: products, signs, lengths, and digits of small turns."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.quaternions import wxyz

from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions

RNG = np.random.default_rng(1)
RANDOM = Rotation.random(200, rng=RNG)


@pytest.mark.parametrize("axis", np.eye(3))
def test_an_exact_half_turn_has_no_other_component(axis: Floats) -> None:
    assert quaternions.from_matrix(np.diag(2 * axis - 1)).tolist() == [0, *axis]


def test_the_quaternion_product_composes_like_matrices() -> None:
    a, b = wxyz(RANDOM[:100]), wxyz(RANDOM[100:])
    expected = (RANDOM[:100] * RANDOM[100:]).as_matrix()
    assert quaternions.to_matrix(quaternions.multiply(a, b)) == pytest.approx(expected, abs=1e-14)


def test_hamiltons_units_multiply_as_he_carved_them() -> None:
    w, i, j, k = np.eye(4)
    assert quaternions.multiply(i, j).tolist() == k.tolist()
    assert quaternions.multiply(j, k).tolist() == i.tolist()
    assert quaternions.multiply(k, i).tolist() == j.tolist()
    for unit in (i, j, k):
        assert quaternions.multiply(unit, unit).tolist() == (-w).tolist()


def test_the_canonical_quaternion_has_its_first_entry_that_is_not_zero_positive() -> None:
    for q in ([-0.5, 0.5, 0.5, 0.5], [0.0, -1.0, 0, 0], [0.0, 0, 0, -1.0], [0.0, 0, -0.6, 0.8]):
        assert quaternions.canonical(q) == pytest.approx(-np.array(q))
        assert quaternions.canonical(-np.array(q)) == pytest.approx(-np.array(q))
    assert quaternions.canonical([[-2.0, 0, 0, 0], [0, 3.0, 0, 0]]).tolist() == [
        [1, 0, 0, 0],
        [0, 1, 0, 0],
    ]


def test_no_turn_has_the_angle_zero_and_no_axis() -> None:
    angle, axis = quaternions.angle_and_axis([[0.0, 0, 0], [0, 3.0, -4.0], [1e-300, 0, 0]])
    assert angle[:, 0].tolist() == pytest.approx([0, 5, 1e-300])
    assert axis == pytest.approx(np.array([[0, 0, 0], [0, 0.6, -0.8], [1, 0, 0]]))


def test_tiny_turns_keep_their_digits_through_the_quaternion() -> None:
    v = np.array([[1e-200, -2e-200, 0], [1e-9, 0, 1e-10], [0, 0, 0]])
    q = quaternions.from_rotation_vector(v)
    np.testing.assert_allclose(q[:, 1:], v / 2, rtol=1e-14)
    np.testing.assert_allclose(quaternions.to_rotation_vector(q), v, rtol=1e-14)
