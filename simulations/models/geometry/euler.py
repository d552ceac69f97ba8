"""Euler angles in any of the twelve sequences, about fixed or moving axes.

A sequence is three letters, neighbours different. Upper case is intrinsic: each turn is about an
axis of the turned frame, and ``"ZYX"`` with (yaw, pitch, roll) is R = Rz(yaw) Ry(pitch) Rx(roll).
Lower case is extrinsic: each turn is about an axis that stays, and ``"xyz"`` with (roll, pitch,
yaw) is that same matrix.

Gimbal lock: at a middle angle of ±π/2 (three different axes) or 0 and π (first and third the
same) only the sum or difference of the other two angles is determined. The third is then set to
zero and ``locked`` is True. It is True near the lock as well, where the three angles together
still give the rotation back, but each of the outer ones alone is known to fewer and fewer digits.

Source: Szeliski, Computer Vision, 2nd ed., §2.1.3; Diebel, Representing attitude, 2006.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_vectors
from simulations.models.geometry import quaternions
from simulations.models.geometry.rotations import from_axis_angle

LOCK_RAD = 1e-7
"""Distance of the middle angle from the locked position below which it counts as locked: the outer
angles then have nine digits at most."""
ROUNDING_RAD = 4e-15
"""Distance below which they have no digits, and the third is set to zero."""


def to_matrix(sequence: str, angles_rad: ArrayLike) -> Floats:
    """Rotation matrices (..., 3, 3) of three turns each.

    ``angles_rad`` (..., 3), finite, in the order of the letters.
    """
    angles = as_vectors("angles_rad", angles_rad, 3)
    turns = [from_axis_angle(axis, angles[..., at]) for at, axis in enumerate(axes(sequence))]
    first, second, third = turns if sequence.isupper() else reversed(turns)
    return first @ second @ third


def from_matrix(R: ArrayLike, sequence: str) -> tuple[Floats, Mask]:
    """The three angles of rotation matrices, and whether they are locked.

    Computed from the quaternion, in the same way for all sequences (Bernardes and Viollet, PLOS ONE
    2022).

    Parameters
    ----------
    R : (..., 3, 3)
    sequence : such as "ZYX" or "xyz"

    Returns
    -------
    angles_rad : (..., 3), in the order of the letters. The middle one is in [−π/2, π/2] for three
        different axes, else in [0, π]; the others are in (−π, π].
    locked : (...,) bool, within `LOCK_RAD` of the lock. The angles still give R to rounding; within
        `ROUNDING_RAD` the third is zero.

    Raises
    ------
    ValueError
        If R is not a rotation, or the sequence is invalid.
    """
    letters = _indices(sequence)
    intrinsic = sequence.isupper()
    i, j, k = reversed(letters) if intrinsic else letters
    proper = i == k
    k = 3 - i - j if proper else k
    sign = (i - j) * (j - k) * (k - i) // 2
    q = quaternions.from_matrix(R)
    w, qi, qj, qk = q[..., 0], q[..., 1 + i], q[..., 1 + j], q[..., 1 + k] * sign
    a, b, c, d = (w, qi, qj, qk) if proper else (w - qj, qi + qk, qj + w, qk - qi)
    middle = 2.0 * np.arctan2(np.hypot(c, d), np.hypot(a, b))
    half_sum, half_difference = np.arctan2(b, a), np.arctan2(d, c)
    from_lock = np.minimum(middle, math.pi - middle)
    lost = from_lock < ROUNDING_RAD
    low = middle < 1.0
    known = 2.0 * np.where(low, half_sum, half_difference)
    lone = (0.0, known) if intrinsic else (np.where(low, known, -known), 0.0)
    first = np.where(lost, lone[0], half_sum - half_difference)
    third = np.where(lost, lone[1], half_sum + half_difference)
    if not proper:
        third, middle = third * sign, middle - math.pi / 2.0
    first, third = (third, first) if intrinsic else (first, third)
    return np.stack([_wrapped(first), middle, _wrapped(third)], axis=-1), from_lock < LOCK_RAD


def axes(sequence: str) -> Floats:
    """Unit vectors (3, 3) of the three axes, one a row, in the order of the letters."""
    return np.eye(3)[_indices(sequence)]


def _indices(sequence: str) -> list[int]:
    letters = sequence.lower()
    distinct = len(letters) == 3 and letters[0] != letters[1] != letters[2]
    if not distinct or set(letters) - set("xyz") or not (sequence.isupper() or sequence.islower()):
        raise ValueError(
            f"sequence {sequence!r}; legal: three of x, y, z, neighbours different, "
            "all upper case (moving axes) or all lower case (fixed axes)"
        )
    return ["xyz".index(letter) for letter in letters]


def _wrapped(angle_rad: Floats) -> Floats:
    """The same direction in (−π, π]; angles of less than two turns lose nothing."""
    wrapped = angle_rad - 2.0 * math.pi * np.rint(angle_rad / (2.0 * math.pi))
    return np.where(wrapped == -math.pi, math.pi, wrapped)
