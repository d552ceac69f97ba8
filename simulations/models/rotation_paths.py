"""Ways from one orientation to another, and how well three Euler angles can steer.

Slerp lives in `simulations.models.rotations`; here are the two ways that it is compared with,
and the measure of the comparison. Source: Szeliski, Computer Vision, 2nd ed., §2.1.3.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from simulations.models import euler, quaternions
from simulations.models.rotations import Floats


def euler_blend(
    sequence: str, start_rad: Sequence[float], end_rad: Sequence[float], share: float
) -> Floats:
    """The rotation (3, 3) whose three angles are each ``share`` of the way from start to end."""
    pairs = zip(start_rad, end_rad, strict=True)
    return euler.to_matrix(sequence, [(1.0 - share) * a + share * b for a, b in pairs])


def matrix_blend(start: ArrayLike, end: ArrayLike, share: float) -> Floats:
    """The weighted mean of two rotation matrices (3, 3), entry by entry: in general no rotation.

    With θ the angle between the two, what lies across the axis shrinks to |cos θ/2| halfway.
    """
    blend: Floats = (1.0 - share) * np.asarray(start, float) + share * np.asarray(end, float)
    return blend


def off_great_circle(quaternion: ArrayLike, start: ArrayLike, end: ArrayLike) -> float:
    """Angle in radians by which a rotation misses the shortest way from ``start`` to ``end``.

    The shortest way is the great circle through the two unit quaternions; an arc between unit
    quaternions is half the angle of the rotation between them. Where start and end are the same
    rotation there is no circle: then the angle from that rotation.
    """
    q, q0, q1 = (quaternions.normalise(each) for each in (quaternion, start, end))
    across = q1 - (q0 @ q1) * q0
    length = float(np.linalg.norm(across))
    along = [q0, across / length] if length > 1e-12 else [q0]
    inside = [float(q @ axis) for axis in along]
    outside = q - sum(part * axis for part, axis in zip(inside, along, strict=True))
    return float(2.0 * np.arctan2(np.linalg.norm(outside), np.linalg.norm(inside)))


def rate_axes(sequence: str, angles_rad: Sequence[float]) -> Floats:
    """Jacobian (3, 3) from the rates of the three angles to the angular velocity ω in the world.

    Column i is the axis about which a change of angle i turns the body, so that
    ω = J (ȧ₁, ȧ₂, ȧ₃) in radians per second. ``sequence`` is of moving axes, as ``"ZYX"``.
    """
    if not sequence.isupper():
        raise ValueError(f"sequence: {sequence!r}; legal: upper case, moving axes")
    alone = [_without_others(angles_rad, index) for index in range(3)]
    turns = [euler.to_matrix(sequence, angles) for angles in alone]
    axes = [np.eye(3)["XYZ".index(letter)] for letter in sequence]
    columns = [axes[0], turns[0] @ axes[1], turns[0] @ turns[1] @ axes[2]]
    return np.stack(columns, axis=-1)


def _without_others(angles_rad: Sequence[float], index: int) -> list[float]:
    return [angle if place == index else 0.0 for place, angle in enumerate(angles_rad)]
