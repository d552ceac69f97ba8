"""Euler angles in all sequences, and gimbal lock."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from simulations.models.geometry import euler
from simulations.models.geometry.rotations import from_axis_angle

PROPER = ["xyx", "xzx", "yxy", "yzy", "zxz", "zyz"]
TAIT_BRYAN = ["xyz", "xzy", "yxz", "yzx", "zxy", "zyx"]
SEQUENCES = [letters for s in PROPER + TAIT_BRYAN for letters in (s, s.upper())]
X, Y, Z = np.eye(3)


def test_yaw_pitch_roll_is_the_product_of_the_three_turns() -> None:
    yaw, pitch, roll = 0.4, -0.3, 0.2
    expected = from_axis_angle(Z, yaw) @ from_axis_angle(Y, pitch) @ from_axis_angle(X, roll)
    assert euler.to_matrix("ZYX", (yaw, pitch, roll)) == pytest.approx(expected)
    assert euler.to_matrix("xyz", (roll, pitch, yaw)) == pytest.approx(expected)


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_both_directions_agree_with_scipy(sequence: str) -> None:
    for rotation in Rotation.random(20, rng=np.random.default_rng(3)):
        angles, locked = euler.from_matrix(rotation.as_matrix(), sequence)
        assert not locked
        assert angles == pytest.approx(rotation.as_euler(sequence), abs=1e-12)
        matrix = euler.to_matrix(sequence, angles)
        assert matrix == pytest.approx(rotation.as_matrix(), abs=1e-14)


@pytest.mark.parametrize("sequence", SEQUENCES)
@pytest.mark.parametrize("upper_end", [False, True])
def test_gimbal_lock_is_reported_and_the_matrix_still_comes_back(
    sequence: str, upper_end: bool
) -> None:
    proper = sequence.lower() in PROPER
    middle = (
        (math.pi if upper_end else 0.0) if proper else math.copysign(math.pi / 2, upper_end - 0.5)
    )
    R = euler.to_matrix(sequence, (0.5, middle, 0.2))
    angles, locked = euler.from_matrix(R, sequence)
    assert locked
    assert angles[2] == pytest.approx(0.0, abs=1e-15)
    assert euler.to_matrix(sequence, angles) == pytest.approx(R, abs=1e-14)


def test_in_the_lock_40_of_roll_with_10_of_yaw_is_30_of_roll() -> None:
    with_yaw = euler.to_matrix("ZYX", np.radians([10.0, 90.0, 40.0]))
    without = euler.to_matrix("ZYX", np.radians([0.0, 90.0, 30.0]))
    assert with_yaw == pytest.approx(without)


@pytest.mark.parametrize("sequence", ["", "xy", "xxy", "xyy", "xYz", "abc", "xyzx"])
def test_a_sequence_that_is_none_is_refused(sequence: str) -> None:
    with pytest.raises(ValueError, match="legal: three of x, y, z"):
        euler.to_matrix(sequence, (0, 0, 0))


def test_a_reflection_has_no_euler_angles() -> None:
    with pytest.raises(ValueError, match="reflection"):
        euler.from_matrix(np.diag([1.0, 1.0, -1.0]), "ZYX")


@pytest.mark.parametrize("sequence", ["ZYX", "zyx", "ZXZ", "zxz"])
@pytest.mark.parametrize(("off", "locked"), [(3e-8, True), (3e-7, False)])
def test_the_lock_begins_a_ten_millionth_of_a_radian_from_the_end(
    sequence: str, off: float, locked: bool
) -> None:
    middle = off if sequence.lower() == "zxz" else np.pi / 2 - off
    R = euler.to_matrix(sequence, (0.4, middle, 0.3))
    assert euler.from_matrix(R, sequence)[1] == locked


@pytest.mark.parametrize("sequence", SEQUENCES)
@pytest.mark.parametrize("upper_end", [False, True])
def test_the_matrix_comes_back_to_rounding_however_near_the_lock(
    sequence: str, upper_end: bool
) -> None:
    middle = np.full((9, 3), [0.5, 0.0, 0.2])
    off = 10.0 ** -np.arange(4, 13)
    if sequence.lower() in PROPER:
        middle[:, 1] = math.pi - off if upper_end else off
    else:
        middle[:, 1] = math.pi / 2 - off if upper_end else off - math.pi / 2
    R = euler.to_matrix(sequence, middle)
    angles, _ = euler.from_matrix(R, sequence)
    np.testing.assert_allclose(euler.to_matrix(sequence, angles), R, atol=1e-14, rtol=0)


@pytest.mark.parametrize("angle", [-math.pi, math.pi])
def test_half_a_turn_is_counted_as_positive(angle: float) -> None:
    assert euler._wrapped(np.array(angle)) == math.pi
