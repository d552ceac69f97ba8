"""Rotations as matrices, quaternions and Euler angles, and paths between them, against SciPy."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation, Slerp

from simulations.models.arrays import Floats
from simulations.models.geometry import euler, quaternions, rotation_paths, rotations
from simulations.models.geometry.quaternion_blends import BLENDS, bisected_arc, turn_between_rad


def same_up_to_sign(a: Floats, b: Floats) -> Floats:
    """(...) largest difference of the entries; q and −q are one rotation."""
    return np.minimum(np.abs(a - b).max(axis=-1), np.abs(a + b).max(axis=-1))


RNG = np.random.default_rng(1)
RANDOM = Rotation.random(200, rng=RNG)


@pytest.mark.parametrize("size", [1e-200, 1e-3, 1.0, 1e200])
@pytest.mark.parametrize(
    "matrix",
    [np.eye(3), np.diag([3.0, 2.0, -1.0]), np.diag([1.0, 1.0, 0.0]), np.diag([1.0, 1e-11, 0.0])],
    ids=["a rotation", "mirrored", "flat", "of rank two to rounding"],
)
def test_nearest_rotation_of_a_known_matrix_is_found_at_any_scale(
    matrix: Floats, size: float
) -> None:
    R = RANDOM[3].as_matrix()
    assert rotations.nearest_rotation(size * R @ matrix) == pytest.approx(R, abs=1e-5)


def test_first_nonzero_entry_of_a_canonical_quaternion_is_positive() -> None:
    for q in ([-0.5, 0.5, 0.5, 0.5], [0.0, -1.0, 0, 0], [0.0, 0, 0, -1.0], [0.0, 0, -0.6, 0.8]):
        assert quaternions.canonical(q) == pytest.approx(-np.array(q))
        assert quaternions.canonical(-np.array(q)) == pytest.approx(-np.array(q))
    assert quaternions.canonical([[-2.0, 0, 0, 0], [0, 3.0, 0, 0]]).tolist() == [
        [1, 0, 0, 0],
        [0, 1, 0, 0],
    ]


PROPER = ["xyx", "xzx", "yxy", "yzy", "zxz", "zyz"]
TAIT_BRYAN = ["xyz", "xzy", "yxz", "yzx", "zxy", "zyx"]
SEQUENCES = [letters for s in PROPER + TAIT_BRYAN for letters in (s, s.upper())]


@pytest.mark.parametrize(
    "read",
    [rotations.logarithm, quaternions.from_matrix, lambda R: euler.from_matrix(R, "ZYX")],
    ids=["logarithm", "quaternion", "Euler angles"],
)
def test_reflection_is_refused_by_everything_that_reads_a_matrix(
    read: Callable[[Floats], object],
) -> None:
    mirror = [[0.15514354, -0.98789194, 0.0], [-0.98789194, -0.15514354, 0.0], [0.0, 0.0, 1.0]]
    with pytest.raises(ValueError, match="reflection"):
        read(np.array(mirror))


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_euler_angles_agree_with_scipy_in_both_directions(sequence: str) -> None:
    rotations = Rotation.random(24, rng=np.random.default_rng(3))
    matrices = rotations.as_matrix().reshape(4, 6, 3, 3)
    angles, locked = euler.from_matrix(matrices, sequence)
    assert not locked.any()
    np.testing.assert_allclose(angles.reshape(24, 3), rotations.as_euler(sequence), atol=1e-12)
    np.testing.assert_allclose(euler.to_matrix(sequence, angles), matrices, atol=1e-14)
    np.testing.assert_array_equal(angles[2, 3], euler.from_matrix(matrices[2, 3], sequence)[0])


@pytest.mark.parametrize("sequence", SEQUENCES)
@pytest.mark.parametrize("upper_end", [False, True])
def test_euler_angles_round_trip_near_gimbal_lock_which_is_reported(
    sequence: str, upper_end: bool
) -> None:
    off = np.array([0.0, *10.0 ** -np.arange(4, 13), 3e-8, 9e-8, 1.1e-7, 3e-7])
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


def test_angle_of_a_half_turn_is_positive() -> None:
    angles, _ = euler.from_matrix(np.diag([-1.0, -1.0, 1.0]), "ZYX")
    assert angles.tolist() == [np.pi, 0.0, 0.0]


@pytest.mark.parametrize("blend", [rotations.slerp, rotations.nlerp])
def test_blend_takes_the_shorter_way_and_meets_both_ends(blend: Callable[..., Floats]) -> None:
    start, end = quaternions.from_rotation_vector([(0, 0, 0.1), (0, 0, 0.3)])
    for sign in (1, -1):
        assert quaternions.to_rotation_vector(blend(start, sign * end, 0.5))[2] == pytest.approx(
            0.2
        )
        assert same_up_to_sign(blend(start, sign * end, 1.0), end) < 1e-15
        assert same_up_to_sign(blend(start, sign * end, 0.0), start) < 1e-15


@pytest.mark.parametrize("sign", [1, -1])
def test_signs_decide_between_two_ways_of_equal_length(sign: int) -> None:
    middle = rotations.slerp([1.0, 0, 0, 0], [0, sign * 1.0, 0, 0], 0.5)
    assert middle == pytest.approx(np.array([1, sign, 0, 0]) / math.sqrt(2))


SHARES = np.linspace(0.0, 1.0, 41)
AXIS = np.array([2.0, -1.0, 2.0]) / 3.0


def pair(
    angle_deg: float, first: tuple[float, float, float] = (0.3, -0.5, 0.2)
) -> tuple[Floats, Floats]:
    """Two unit quaternions at this angle, on one hemisphere."""
    start = quaternions.from_rotation_vector(first)
    turn = quaternions.from_rotation_vector(np.radians(angle_deg) * AXIS)
    return start, quaternions.multiply(turn, start)


def scipy_path(start: Floats, end: Floats) -> Rotation:
    ends = Rotation.from_quat(np.stack([start, end]), scalar_first=True)
    return Slerp([0.0, 1.0], ends)(SHARES)


def off_deg(blended: Floats, path: Rotation) -> Floats:
    ours = Rotation.from_quat(np.asarray(blended, float), scalar_first=True)
    return np.degrees((path.inv() * ours).magnitude())


@pytest.mark.parametrize("kind", BLENDS)
@pytest.mark.parametrize("angle_deg", [0, 1, 60, 179])
def test_every_blend_starts_and_ends_at_the_two_orientations(kind: str, angle_deg: float) -> None:
    start, end = pair(angle_deg)
    ends = BLENDS[kind](start, end, [0.0, 0.5, 1.0])
    middle = quaternions.normalise(start + end)
    np.testing.assert_allclose(ends, [start, middle, end], atol=1e-12)


@pytest.mark.parametrize("kind", ["paced-nlerp", "slerp-threshold", "slerp", "bisection"])
def test_blends_follow_the_great_circle_within_their_promise(kind: str) -> None:
    allowed_deg = {"paced-nlerp": 0.05, "slerp-threshold": 1e-4}.get(kind, 1e-12)
    blend = BLENDS.get(kind, bisected_arc)
    for angle_deg in range(0, 180, 3):
        start, end = pair(angle_deg)
        off = off_deg(blend(start, end, SHARES), scipy_path(start, end))
        assert off.max() < allowed_deg


@pytest.mark.parametrize("angle_rad", [0.0, 1e-12, 1e-6, 0.3, 1.5, 3.1])
def test_turn_between_two_orientations_is_their_angle(angle_rad: float) -> None:
    start, end = pair(np.degrees(angle_rad))
    for other in (end, -end):
        assert turn_between_rad(start, other) == pytest.approx(angle_rad, abs=1e-15, rel=1e-4)


ANGLES = st.tuples(*[st.floats(-3.0, 3.0)] * 3)


@pytest.mark.parametrize("sequence", ["ZYX", "XYZ", "ZXZ", "YXZ"])
@given(ANGLES, st.tuples(*[st.floats(-1.0, 1.0)] * 3))
@settings(max_examples=20)
def test_euler_rate_axes_give_the_angular_velocity(
    sequence: str, angles: tuple[float, float, float], rates: tuple[float, float, float]
) -> None:
    step = 1e-6
    before, after = (
        Rotation.from_euler(sequence, np.add(angles, np.multiply(sign * step, rates)))
        for sign in (-1, 1)
    )
    measured = (after * before.inv()).as_rotvec() / (2 * step)
    omega = rotation_paths.rate_axes(sequence, angles) @ rates
    np.testing.assert_allclose(omega, measured, atol=1e-8)


@pytest.mark.parametrize("sequence", ["ZYX", "xyz"])
def test_blended_euler_angles_give_the_matrix_of_the_blend(sequence: str) -> None:
    start, end, shares = (0.1, -0.4, 2.0), (1.3, 0.8, -1.0), np.linspace(0, 1, 5)
    found = rotation_paths.euler_blend(sequence, start, end, shares)
    angles = np.array(start) + shares[:, None] * np.subtract(end, start)
    np.testing.assert_allclose(found, Rotation.from_euler(sequence, angles).as_matrix(), atol=1e-14)


def test_matrices_are_blended_entry_by_entry() -> None:
    start, end = np.arange(9.0).reshape(3, 3), np.ones((3, 3))
    shares = np.array([[0.0, 0.25], [1.0, 2.0]])
    found = rotation_paths.matrix_blend(start, end, shares)
    assert found.shape == (2, 2, 3, 3)
    np.testing.assert_allclose(found[0, 1], 0.75 * start + 0.25)
    np.testing.assert_allclose(found[1, 1], 2 - start)
