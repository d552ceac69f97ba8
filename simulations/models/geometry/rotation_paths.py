"""Paths from one orientation to another, and the rates of Euler angles.

Slerp is in `simulations.models.geometry.rotations`; this module has two other paths and a measure
to compare them. Source: Szeliski, Computer Vision, 2nd ed., §2.1.3.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_array
from simulations.models.geometry import euler, quaternions
from simulations.models.geometry.rotations import checked_share, from_axis_angle
from simulations.models.require import require

LARGEST_RAD = 1e300
"""Largest angle, so that its products with the share of a path are finite."""


def euler_blend(
    sequence: str, start_rad: Sequence[float], end_rad: Sequence[float], share: ArrayLike
) -> Floats:
    """Rotations (..., 3, 3) whose three angles are interpolated by ``share`` (...)."""
    start, end = _angles("start_rad", start_rad), _angles("end_rad", end_rad)
    s = checked_share(share)[..., None]
    return euler.to_matrix(sequence, (1.0 - s) * start + s * end)


def matrix_blend(start: ArrayLike, end: ArrayLike, share: ArrayLike) -> Floats:
    """Weighted means (..., 3, 3) of two rotation matrices, entry by entry: in general no rotations.

    With θ the angle between the two, lengths across the axis shrink to |cos θ/2| halfway.
    """
    s = checked_share(share)[..., None, None]
    return (1.0 - s) * as_array("start", start, 3, 3) + s * as_array("end", end, 3, 3)


def off_great_circle(quaternion: ArrayLike, start: ArrayLike, end: ArrayLike) -> float:
    """Angle in radians between a rotation and the shortest path from ``start`` to ``end``.

    The shortest path is the great circle through the two unit quaternions; an arc between unit
    quaternions is half the angle of the rotation between them. If start and end are the same
    rotation, it is the angle from that rotation.
    """
    q, q0, q1 = (
        quaternions.normalise(as_array(name, each, 4))
        for name, each in (("quaternion", quaternion), ("start", start), ("end", end))
    )
    across = q1 - (q0 @ q1) * q0
    length = float(np.linalg.norm(across))
    along = [q0, across / length] if length > 1e-12 else [q0]
    inside = [float(q @ axis) for axis in along]
    outside = q - sum(part * axis for part, axis in zip(inside, along, strict=True))
    return float(2.0 * np.arctan2(np.linalg.norm(outside), np.linalg.norm(inside)))


def rate_axes(sequence: str, angles_rad: Sequence[float]) -> Floats:
    """Jacobian (3, 3) from the rates of the three angles to the angular velocity ω in the world.

    Column i is the axis about which a change of angle i turns the body, so that
    ω = J (ȧ₁, ȧ₂, ȧ₃) in radians per second.
    """
    require("sequence", sequence, sequence.isupper(), "of moving axes, all upper case")
    first, second, third = euler.axes(sequence)
    angles = _angles("angles_rad", angles_rad)
    turn = from_axis_angle(first, angles[0])
    both = turn @ from_axis_angle(second, angles[1])
    return np.stack([first, turn @ second, both @ third], axis=-1)


def _angles(name: str, angles_rad: ArrayLike) -> Floats:
    angles: Floats = as_array(name, angles_rad, 3)
    require(name, angles, (np.abs(angles) <= LARGEST_RAD).all(), f"at most {LARGEST_RAD:g} in size")
    return angles
