"""Euler angles in all sequences, and gimbal lock."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from simulations.models.geometry import euler
from simulations.models.geometry.rotations import from_axis_angle

X, Y, Z = np.eye(3)


def test_yaw_pitch_roll_is_the_product_of_the_three_turns() -> None:
    yaw, pitch, roll = 0.4, -0.3, 0.2
    expected = from_axis_angle(Z, yaw) @ from_axis_angle(Y, pitch) @ from_axis_angle(X, roll)
    assert euler.to_matrix("ZYX", (yaw, pitch, roll)) == pytest.approx(expected)
    assert euler.to_matrix("xyz", (roll, pitch, yaw)) == pytest.approx(expected)


PROPER = ["xyx", "xzx", "yxy", "yzy", "zxz", "zyz"]
TAIT_BRYAN = ["xyz", "xzy", "yxz", "yzx", "zxy", "zyx"]
SEQUENCES = [letters for s in PROPER + TAIT_BRYAN for letters in (s, s.upper())]


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_both_directions_agree_with_scipy(sequence: str) -> None:
    rotations = Rotation.random(24, rng=np.random.default_rng(3))
    matrices = rotations.as_matrix().reshape(4, 6, 3, 3)
    angles, locked = euler.from_matrix(matrices, sequence)
    assert not locked.any()
    np.testing.assert_allclose(angles.reshape(24, 3), rotations.as_euler(sequence), atol=1e-12)
    np.testing.assert_allclose(euler.to_matrix(sequence, angles), matrices, atol=1e-14)
    np.testing.assert_array_equal(angles[2, 3], euler.from_matrix(matrices[2, 3], sequence)[0])


@pytest.mark.parametrize("sequence", SEQUENCES)
@pytest.mark.parametrize("upper_end", [False, True])
def test_the_matrix_comes_back_however_near_the_lock_which_is_told_from_1e_minus_7_on(
    sequence: str, upper_end: bool
) -> None:
    off = np.array([0.0, *10.0 ** -np.arange(4, 13), 3e-8, 3e-7])
    turns = np.full((off.size, 3), [0.5, 0.0, 0.2])
    if sequence.lower() in PROPER:
        turns[:, 1] = math.pi - off if upper_end else off
    else:
        turns[:, 1] = math.pi / 2 - off if upper_end else off - math.pi / 2
    R = euler.to_matrix(sequence, turns)
    angles, locked = euler.from_matrix(R, sequence)
    np.testing.assert_allclose(euler.to_matrix(sequence, angles), R, atol=1e-14, rtol=0)
    clear = off != 1e-7
    assert locked[clear].tolist() == (off < 1e-7)[clear].tolist()
    assert angles[0, 2] == pytest.approx(0.0, abs=1e-15)


def test_a_half_turn_is_plus_a_half_turn() -> None:
    angles, _ = euler.from_matrix(np.diag([-1.0, -1.0, 1.0]), "ZYX")
    assert angles.tolist() == [np.pi, 0.0, 0.0]
