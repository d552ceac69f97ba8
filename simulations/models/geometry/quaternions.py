"""Unit quaternions q = (w, x, y, z), scalar first, Hamilton's product: i j = k.

The rotation by θ about the unit axis n is (cos θ/2, sin θ/2 · n); q and −q are the same
rotation. Source: Szeliski, Computer Vision, 2nd ed., §2.1.3.

[v]ₓ is the matrix with [v]ₓ p = v × p; rotations are polynomials of it.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import (
    Floats,
    as_matrices,
    as_vectors,
    first_axis_last,
    last_axis_first,
)
from simulations.models.require import require

ORTHOGONAL = 1e-6
"""Largest entry of RᵀR − I that counts as rounding."""
CYCLES = ((0, 1, 2), (1, 2, 0), (2, 0, 1))


def cross_polynomial(
    vector: ArrayLike, linear: ArrayLike, square: ArrayLike
) -> NDArray[np.float64]:
    """I + linear [v]ₓ + square [v]ₓ², (..., 3, 3), of vectors (..., 3) and coefficients (...).

    Entry by entry, with [v]ₓ² = v vᵀ − |v|² I, which takes fewer products than a product of
    matrices.
    """
    v = np.ascontiguousarray(last_axis_first(as_vectors("vector", vector, 3)))
    shape = np.broadcast_shapes(v.shape[1:], np.shape(linear), np.shape(square))
    R = np.empty((*shape, 3, 3))
    with np.errstate(over="ignore", invalid="ignore"):
        for i, j, k in CYCLES:
            both, aside = square * v[i] * v[j], linear * v[k]
            R[..., i, j] = both - aside
            R[..., j, i] = both + aside
            R[..., k, k] = 1.0 - square * (v[i] * v[i] + v[j] * v[j])
    return R


def cross(first: Floats, second: Floats) -> Floats:
    """v × w (..., 3) of vectors (..., 3), in a third of the time that numpy takes for a few."""
    (a, b, c), (x, y, z) = ((v[..., 0], v[..., 1], v[..., 2]) for v in (first, second))
    return np.stack([b * z - c * y, c * x - a * z, a * y - b * x], axis=-1)


def normalise(quaternion: ArrayLike) -> Floats:
    """Quaternions (..., 4) scaled to unit norm.

    The largest component is divided out first, so that neither 1e−300 nor 1e300 is lost when it is
    squared. Raises `ValueError` for the zero quaternion and for entries that are not finite: they
    represent no rotation.
    """
    q = as_vectors("quaternion", quaternion, 4)
    largest, scaled, norm = _measured(q)
    require(
        "quaternion", q, ((largest > 0.0) & np.isfinite(largest)).all(), "finite and not all zero"
    )
    return first_axis_last(scaled / norm)


def canonical(quaternion: ArrayLike) -> Floats:
    """q or −q (..., 4), scaled to unit norm, with w > 0. Half turns have w = 0: there the first
    component that is not zero is made positive.
    """
    q = normalise(quaternion)
    leading = np.take_along_axis(q, (q != 0.0).argmax(axis=-1)[..., None], axis=-1)
    return np.where(leading < 0.0, -q, q)


def multiply(second: ArrayLike, first: ArrayLike) -> Floats:
    """The rotation ``first`` followed by ``second``, (..., 4)."""
    a, b = as_vectors("second", second, 4), as_vectors("first", first, 4)
    a_w, a_v, b_w, b_v = a[..., :1], a[..., 1:], b[..., :1], b[..., 1:]
    with np.errstate(over="ignore", invalid="ignore"):
        w = a_w * b_w - (a_v * b_v).sum(axis=-1, keepdims=True)
        v = a_w * b_v + b_w * a_v + np.cross(a_v, b_v)
    return np.concatenate([w, v], axis=-1)


def rotate(quaternion: ArrayLike, vectors: ArrayLike) -> Floats:
    """Vectors (..., 3) turned by a unit quaternion: q v q*, without building a matrix."""
    q, v = as_vectors("quaternion", quaternion, 4), as_vectors("vectors", vectors, 3)
    with np.errstate(over="ignore", invalid="ignore"):
        twice = 2.0 * np.cross(q[..., 1:], v)
        return v + q[..., :1] * twice + np.cross(q[..., 1:], twice)


def angle_and_axis(rotation_vector: ArrayLike) -> tuple[Floats, Floats]:
    """Angles (..., 1) and unit axes (..., 3) of rotation vectors; no turn has the axis 0.

    Raises `ValueError` if the angle is not finite.
    """
    v = as_vectors("rotation_vector", rotation_vector, 3)
    largest, scaled, norm = _measured(v)
    require("rotation_vector", v, np.isfinite(largest).all(), "finite")
    with np.errstate(over="ignore"):
        angle = largest * norm
    require("rotation_vector", v, np.isfinite(angle).all(), "of finite length")
    axis = first_axis_last(scaled / np.where(norm > 0.0, norm, 1.0))
    return angle[..., None], axis


def _measured(vectors: Floats) -> tuple[Floats, Floats, Floats]:
    """Largest components (...), vectors (n, ...) in units of these, and their norms (...).

    Components are the first axis: reductions over a short last axis are several times slower. A
    zero vector stays zero.
    """
    parts = np.ascontiguousarray(last_axis_first(vectors))
    largest = np.abs(parts).max(axis=0)
    with np.errstate(over="ignore", invalid="ignore"):
        scaled = parts / np.where(largest > 0.0, largest, 1.0)
        norm = np.sqrt((scaled * scaled).sum(axis=0))
    return largest, scaled, norm


def from_rotation_vector(rotation_vector: ArrayLike) -> Floats:
    """Axis times angle in radians (..., 3) to unit quaternions (..., 4)."""
    angle, axis = angle_and_axis(rotation_vector)
    return np.concatenate([np.cos(0.5 * angle), np.sin(0.5 * angle) * axis], axis=-1)


def to_rotation_vector(quaternion: ArrayLike) -> Floats:
    """Quaternions (..., 4) to axis times angle (..., 3), with the angle in [0, π].

    θ = 2 atan2(|v|, w) is accurate everywhere; acos(w) would lose half the digits near θ = 0.
    """
    q = canonical(quaternion)
    w, v = q[..., :1], q[..., 1:]
    sine = np.linalg.norm(v, axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, w)
    per_sine = angle / np.where(sine > 0.0, sine, 1.0)
    return np.where(sine > 0.0, per_sine, 2.0) * v


def to_matrix(quaternion: ArrayLike) -> Floats:
    """Quaternions (..., 4) of any norm to rotation matrices (..., 3, 3): I + 2w [v]ₓ + 2 [v]ₓ²."""
    q = normalise(quaternion)
    return cross_polynomial(q[..., 1:], 2.0 * q[..., 0], 2.0)


def check_rotation(R: ArrayLike) -> Floats:
    """R as an array, if it is orthogonal to `ORTHOGONAL` and not a reflection; else `ValueError`.

    Use `rotations.nearest_rotation` first for matrices with larger errors.
    """
    matrix = as_matrices("R", R, 3, 3)
    with np.errstate(over="ignore", invalid="ignore"):
        drift = np.abs(np.swapaxes(matrix, -1, -2) @ matrix - np.eye(3)).max(initial=0.0)
    if not drift <= ORTHOGONAL:
        raise ValueError(f"R: RᵀR differs from I by {drift:.2g}; legal: at most {ORTHOGONAL}")
    if not (np.linalg.det(matrix) > 0.0).all():
        raise ValueError("R: determinant −1, a reflection; legal: +1")
    return matrix


def from_matrix(R: ArrayLike) -> Floats:
    """Rotation matrices (..., 3, 3) to quaternions (..., 4) with w ≥ 0.

    The entries of R give all products of two components, 4 q qᵀ. Its row with the largest
    diagonal entry is a multiple of q by at least 1, so nothing cancels (Shepperd 1978). Raises
    `ValueError` if R is not a rotation.
    """
    m = check_rotation(R)
    x, y, z = m[..., 0, 0], m[..., 1, 1], m[..., 2, 2]
    wx, wy, wz = (m[..., j, i] - m[..., i, j] for i, j in ((1, 2), (2, 0), (0, 1)))
    xy, xz, yz = (m[..., j, i] + m[..., i, j] for i, j in ((0, 1), (0, 2), (1, 2)))
    rows = [
        [1.0 + x + y + z, wx, wy, wz],
        [wx, 1.0 + x - y - z, xy, xz],
        [wy, xy, 1.0 - x + y - z, yz],
        [wz, xz, yz, 1.0 - x - y + z],
    ]
    products = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    largest = np.diagonal(products, axis1=-2, axis2=-1).argmax(axis=-1)
    return canonical(np.take_along_axis(products, largest[..., None, None], axis=-2)[..., 0, :])
