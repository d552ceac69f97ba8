"""Rotations of space: matrices, axis and angle, and the paths between two orientations.

Rotations are active and right-handed: p' = R p turns counter-clockwise when the axis points at
the viewer. Source: Szeliski, Computer Vision, 2nd ed., §2.1.3.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_array, as_vectors
from simulations.models.geometry import quaternions
from simulations.models.geometry.quaternions import cross_polynomial
from simulations.models.require import require

LARGEST_SHARE = 1e6
"""Largest share of an extrapolation; beyond it only rounding is left."""


def exponential(rotation_vector: ArrayLike) -> Floats:
    """Rodrigues' formula: axis times angle (..., 3) to rotation matrices (..., 3, 3).

    R = I + sin θ [n]ₓ + (1 − cos θ) [n]ₓ² with v = θ n; at θ = 0 no axis is needed. Any finite
    angle is legal; beyond 2π it wraps. Beyond about 1e8 the rounding of θ limits the accuracy, but
    the result is still a rotation.
    """
    angle, axis = quaternions.angle_and_axis(rotation_vector)
    return _turn(axis, angle[..., 0])


def _turn(axis: Floats, angle_rad: Floats) -> Floats:
    """The rotation about a unit axis (..., 3).

    Sine and 1 − cosine are computed from the same half angle, so that R is orthogonal despite
    rounding of the angle. And 2 sin²(θ/2) does not cancel near θ = 0, where 1 − cos θ does.
    """
    sine, cosine = np.sin(0.5 * angle_rad), np.cos(0.5 * angle_rad)
    return cross_polynomial(axis, 2.0 * sine * cosine, 2.0 * sine * sine)


def from_axis_angle(axis: ArrayLike, angle_rad: ArrayLike) -> Floats:
    """The turn by ``angle_rad`` (...), finite, about ``axis`` (..., 3) of any length but zero."""
    direction, angle = as_vectors("axis", axis, 3), np.asarray(angle_rad, float)
    largest = np.abs(direction).max(axis=-1, keepdims=True)
    require(
        "axis", direction, ((largest > 0.0) & np.isfinite(largest)).all(), "finite and not zero"
    )
    require("angle_rad", angle, np.isfinite(angle).all(), "finite")
    scaled = direction / largest
    return _turn(scaled / np.linalg.norm(scaled, axis=-1, keepdims=True), angle)


def logarithm(R: ArrayLike) -> Floats:
    """Axis times angle (..., 3) of rotation matrices (..., 3, 3), angle in [0, π].

    Goes through the quaternion and atan2: acos((trace − 1)/2) has no accuracy near 0 and π. At
    exactly π both signs of the axis are right; the one whose first non-zero entry is positive is
    returned. Raises `ValueError` if R is not a rotation.
    """
    return quaternions.to_rotation_vector(quaternions.from_matrix(R))


def nearest_rotation(matrix: ArrayLike) -> Floats:
    """The rotation closest to a (3, 3) matrix in the Frobenius norm: U diag(1, 1, ±1) Vᵀ.

    Raises `ValueError` if several rotations are equally close: for a rank below 2, or a matrix such
    as −I.
    """
    M = as_array("matrix", matrix, 3, 3)
    require("matrix", M, np.isfinite(M).all(), "(3, 3), finite")
    U, sizes, Vt = np.linalg.svd(M / max(float(np.abs(M).max()), np.finfo(float).tiny))
    handedness = 1.0 if np.linalg.det(U @ Vt) > 0.0 else -1.0
    if not sizes[1] + handedness * sizes[2] > 1e-12 * sizes[0]:
        raise ValueError(f"matrix: singular values {sizes.tolist()}; no single nearest rotation")
    return (U * [1.0, 1.0, handedness]) @ Vt


def slerp(start: ArrayLike, end: ArrayLike, share: ArrayLike) -> Floats:
    """Spherical linear interpolation between quaternions (..., 4): constant angular speed.

    Takes the shorter path, since q and −q are the same rotation. Orientations half a turn apart
    have two paths of equal length; the signs of the quaternions then decide. ``share`` (...) runs
    from 0 to 1; other values, up to `LARGEST_SHARE`, go on along the same great circle.
    """
    q0, q1 = _ends_of_shorter_arc(start, end)
    s = checked_share(share)[..., None]
    apart = np.linalg.norm(q1 - q0, axis=-1, keepdims=True)
    together = np.linalg.norm(q1 + q0, axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(apart, together)  # accurate where acos(q0 · q1) is not
    # sin(sΩ)/sin Ω with sinc is fine at Ω = 0, and Ω ≤ π/2 keeps its divisor above 0.63.
    whole = np.sinc(angle / np.pi)
    weight0 = (1.0 - s) * np.sinc((1.0 - s) * angle / np.pi) / whole
    weight1 = s * np.sinc(s * angle / np.pi) / whole
    return quaternions.normalise(weight0 * q0 + weight1 * q1)


def nlerp(start: ArrayLike, end: ArrayLike, share: ArrayLike) -> Floats:
    """Normalised linear interpolation: slerp's path at an uneven speed, without sines."""
    q0, q1 = _ends_of_shorter_arc(start, end)
    s = checked_share(share)[..., None]
    return quaternions.normalise((1.0 - s) * q0 + s * q1)


def checked_share(
    share: ArrayLike, low: float = -LARGEST_SHARE, high: float = LARGEST_SHARE
) -> Floats:
    """Shares (...) of a path, if all are between two limits; else, and for NaN, `ValueError`."""
    s = np.asarray(share, float)
    require("share", s, np.all((s >= low) & (s <= high)), f"{low:g} to {high:g}")
    return s


def _ends_of_shorter_arc(start: ArrayLike, end: ArrayLike) -> tuple[Floats, Floats]:
    q0, q1 = quaternions.normalise(start), quaternions.normalise(end)
    opposed = (q0 * q1).sum(axis=-1, keepdims=True) < 0.0
    return q0, np.where(opposed, -q1, q1)
