"""Quaternions against SciPy and Hamilton: products, signs, lengths, and digits of small turns."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support.quaternions import same_up_to_sign, wxyz

from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions, rotations

RNG = np.random.default_rng(1)
RANDOM = Rotation.random(200, rng=RNG)


def test_quaternions_agree_with_scipy_both_ways() -> None:
    q = quaternions.from_matrix(RANDOM.as_matrix())
    assert same_up_to_sign(q, wxyz(RANDOM)).max() < 1e-15
    assert quaternions.to_matrix(wxyz(RANDOM)) == pytest.approx(RANDOM.as_matrix(), abs=1e-15)


@pytest.mark.parametrize("axis", np.eye(3))
def test_half_turns_keep_every_digit_of_their_quaternion(axis: Floats) -> None:
    R = rotations.from_axis_angle(axis, math.pi)
    assert quaternions.from_matrix(R) == pytest.approx((0, *axis), abs=1e-15)


@pytest.mark.parametrize("axis", np.eye(3))
def test_an_exact_half_turn_has_no_other_component(axis: Floats) -> None:
    assert quaternions.from_matrix(np.diag(2 * axis - 1)).tolist() == [0, *axis]


def test_the_quaternion_product_composes_like_matrices() -> None:
    a, b = wxyz(RANDOM[:100]), wxyz(RANDOM[100:])
    expected = (RANDOM[:100] * RANDOM[100:]).as_matrix()
    assert quaternions.to_matrix(quaternions.multiply(a, b)) == pytest.approx(expected, abs=1e-14)


def test_rotating_by_quaternion_and_by_matrix_is_the_same_and_the_conjugate_undoes_it() -> None:
    q, v = wxyz(RANDOM), RNG.normal(size=(200, 3))
    turned = quaternions.rotate(q, v)
    assert turned == pytest.approx(RANDOM.apply(v), abs=1e-14)
    assert quaternions.rotate(quaternions.conjugate(q), turned) == pytest.approx(v, abs=1e-14)


def test_q_and_minus_q_are_the_same_rotation() -> None:
    q = wxyz(RANDOM)
    assert np.array_equal(quaternions.to_matrix(q), quaternions.to_matrix(-q))
    assert np.array_equal(quaternions.to_rotation_vector(q), quaternions.to_rotation_vector(-q))


@pytest.mark.parametrize("size", [1e-320, 1e-300, 1.0, 1e300])
def test_normalising_survives_tiny_and_huge_quaternions(size: float) -> None:
    unit = quaternions.normalise(np.array([1.0, -1.0, 1.0, 1.0]) * size)
    assert unit == pytest.approx((0.5, -0.5, 0.5, 0.5))


@pytest.mark.parametrize("q", [(0, 0, 0, 0), (math.nan, 0, 0, 1), (math.inf, 0, 0, 0)])
def test_a_quaternion_without_direction_is_refused(q: Sequence[float]) -> None:
    with pytest.raises(ValueError, match="quaternion"):
        quaternions.normalise(q)


def test_hamiltons_units_multiply_as_he_carved_them() -> None:
    w, i, j, k = np.eye(4)
    assert quaternions.multiply(i, j).tolist() == k.tolist()
    assert quaternions.multiply(j, k).tolist() == i.tolist()
    assert quaternions.multiply(k, i).tolist() == j.tolist()
    for unit in (i, j, k):
        assert quaternions.multiply(unit, unit).tolist() == (-w).tolist()
        assert quaternions.conjugate(unit).tolist() == (-unit).tolist()


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
    for bad in ([1.7e308, 1.7e308, 0], [0, math.inf, 0]):
        with pytest.raises(ValueError, match="rotation_vector"):
            quaternions.angle_and_axis([[0.0, 0, 1], bad])


def test_tiny_turns_keep_their_digits_through_the_quaternion() -> None:
    v = np.array([[1e-200, -2e-200, 0], [1e-9, 0, 1e-10], [0, 0, 0]])
    q = quaternions.from_rotation_vector(v)
    np.testing.assert_allclose(q[:, 1:], v / 2, rtol=1e-14)
    np.testing.assert_allclose(quaternions.to_rotation_vector(q), v, rtol=1e-14)


@pytest.mark.parametrize("bad", [[math.nan, 1, 0, 0], [0.0, 0, 0, 0]])
def test_one_bad_quaternion_spoils_the_field(bad: list[float]) -> None:
    with pytest.raises(ValueError, match="quaternion"):
        quaternions.normalise([[1.0, 0, 0, 0], bad])
    with pytest.raises(ValueError, match="axis"):
        rotations.from_axis_angle([[1.0, 0, 0], bad[1:] if bad[1] == 0 else [math.nan, 0, 0]], 0.1)
