"""Euler angles in any of the twelve sequences, about fixed or moving axes.

A sequence is three letters, neighbours different. Upper case is intrinsic: each turn is about an
axis of the turned frame, and ``"ZYX"`` with (yaw, pitch, roll) is R = Rz(yaw) Ry(pitch) Rx(roll).
Lower case is extrinsic: each turn is about an axis that stays, and ``"xyz"`` with (roll, pitch,
yaw) is that same matrix.

Gimbal lock: at a middle angle of ±π/2 (three different axes) or 0 and π (first and third the
same) only the sum or difference of the other two angles is determined. The third is then set to
zero and ``locked`` is True.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from simulations.models import quaternions
from simulations.models.rotations import Floats, check_rotation, from_axis_angle

LOCK_RAD = 1e-7
"""Distance of the middle angle from the locked position below which the outer angles are noise."""


def to_matrix(sequence: str, angles_rad: Sequence[float]) -> Floats:
    """Rotation matrix (3, 3) of three turns, ``angles_rad`` in the order of the letters."""
    axes = _axes(sequence)
    turns = [
        from_axis_angle(np.eye(3)[a], angle) for a, angle in zip(axes, angles_rad, strict=True)
    ]
    first, second, third = turns if sequence.isupper() else reversed(turns)
    R: Floats = first @ second @ third
    return R


def from_matrix(R: ArrayLike, sequence: str) -> tuple[tuple[float, float, float], bool]:
    """The three angles in radians of a rotation matrix (3, 3), and whether they are locked.

    The middle angle is in [−π/2, π/2] for three different axes, else in [0, π]; the others are
    in (−π, π]. Goes through the quaternion (Bernardes and Viollet, PLOS ONE 2022), which treats
    all sequences alike. Raises `ValueError` where R is no rotation.
    """
    axes = _axes(sequence)
    intrinsic = sequence.isupper()
    i, j, k = reversed(axes) if intrinsic else axes
    proper = i == k
    k = 3 - i - j if proper else k
    sign = (i - j) * (j - k) * (k - i) // 2
    q = quaternions.from_matrix(check_rotation(R))
    w, qi, qj, qk = float(q[0]), float(q[1 + i]), float(q[1 + j]), float(q[1 + k]) * sign
    a, b, c, d = (w, qi, qj, qk) if proper else (w - qj, qi + qk, qj + w, qk - qi)
    middle = 2.0 * math.atan2(math.hypot(c, d), math.hypot(a, b))
    half_sum, half_difference = math.atan2(b, a), math.atan2(d, c)
    first, third = half_sum - half_difference, half_sum + half_difference
    locked = min(middle, math.pi - middle) < LOCK_RAD
    if locked:
        known = 2.0 * half_sum if middle < 1.0 else 2.0 * half_difference
        first_known = known if middle < 1.0 else -known
        first, third = (0.0, known) if intrinsic else (first_known, 0.0)
    if not proper:
        third, middle = third * sign, middle - math.pi / 2.0
    first, third = (third, first) if intrinsic else (first, third)
    return (_wrapped(first), middle, _wrapped(third)), locked


def _axes(sequence: str) -> list[int]:
    letters = sequence.lower()
    distinct = len(letters) == 3 and letters[0] != letters[1] != letters[2]
    if not distinct or set(letters) - set("xyz") or not (sequence.isupper() or sequence.islower()):
        raise ValueError(
            f"sequence: {sequence!r}; legal: three of x, y, z, neighbours different, "
            "all upper case (moving axes) or all lower case (fixed axes)"
        )
    return ["xyz".index(letter) for letter in letters]


def _wrapped(angle_rad: float) -> float:
    wrapped = math.remainder(angle_rad, 2.0 * math.pi)
    return math.pi if wrapped == -math.pi else wrapped
