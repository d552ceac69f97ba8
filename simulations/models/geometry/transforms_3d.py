"""The ladder of 3D transformations as (4, 4) matrices on homogeneous points (X, Y, Z, 1).

Translation (3 degrees of freedom), rigid (6), similarity (7), affine (12), projective (15). They
compose as matrices do, ``second @ first``. As in the plane
(`simulations.models.geometry.transforms`), the points with w = 0 form a plane that is mapped to
infinity, and H and c H are the same map, c ≠ 0.

Source: Szeliski, Computer Vision, 2nd ed., §2.1.3, table 2.2; §8.1.5 for the estimate (Umeyama,
Least-squares estimation of transformation parameters, 1991).

Reference: the book explains it; no figure and no ladder runs it.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_array, as_vectors
from simulations.models.geometry.rotations import check_rotation
from simulations.models.geometry.transforms import W_MINIMUM
from simulations.models.require import require, require_positive

DEGENERATE = 1e-9
"""Singular values below this share of the largest count as zero."""

LARGEST = 1e100
"""Largest coordinate of points to be aligned, so that squares of distances are finite."""


def translation(offset: ArrayLike) -> Floats:
    """Move by (tx, ty, tz). Keeps orientation, lengths, angles."""
    return affine(np.eye(3), offset)


def rigid(R: ArrayLike, offset: ArrayLike) -> Floats:
    """Rotate about the origin by R (3, 3), then move. Keeps lengths and angles.

    Raises `ValueError` if R is not a rotation; see `rotations.check_rotation`.
    """
    return similarity(1.0, R, offset)


def similarity(scale: float, R: ArrayLike, offset: ArrayLike) -> Floats:
    """Scale and rotate about the origin, then move. Keeps angles and ratios of lengths.

    Raises `ValueError` unless the scale is positive and finite and R a rotation.
    """
    require_positive("scale", scale)
    return affine(scale * check_rotation(as_array("R", R, 3, 3)), offset)


def affine(matrix: ArrayLike, offset: ArrayLike) -> Floats:
    """X' = A X + t with any (3, 3) matrix A, singular ones included. Keeps parallels."""
    H = np.eye(4)
    H[:3, :3] = as_array("matrix", matrix, 3, 3)
    H[:3, 3] = as_array("offset", offset, 3)
    require("transformation", H, np.isfinite(H).all(), "finite entries")
    return H


def apply_transform(H: ArrayLike, points: ArrayLike) -> tuple[Floats, Mask]:
    """Images of points (..., 3) under any (4, 4) matrix H; c H has the same for every c ≠ 0.

    Returns
    -------
    images : (..., 3), NaN where invalid.
    valid : (...,) bool, False where |w| ≤ W_MINIMUM · Σ|terms of w|: on the plane that is mapped to
        infinity. Also False if a number is not finite, or the image overflows.
    """
    matrix = as_array("H", H, 4, 4)
    place = as_vectors("points", points, 3)
    with np.errstate(over="ignore", invalid="ignore"):
        w = place @ matrix[3, :3] + matrix[3, 3]
        size = np.abs(place) @ np.abs(matrix[3, :3]) + np.abs(matrix[3, 3])
        valid = np.asarray(np.abs(w) > W_MINIMUM * size)  # false for NaN
        moved = place @ matrix[:3, :3].T + matrix[:3, 3]
        images = moved / np.where(valid, w, 1.0)[..., None]
        valid &= np.isfinite(images).all(axis=-1)
    return np.where(valid[..., None], images, np.nan), valid


def estimate_similarity(
    source: ArrayLike, target: ArrayLike, *, scaled: bool = True
) -> tuple[Floats, bool]:
    """Rotation, translation and, if ``scaled``, scale that best align points with others.

    The sum of squared distances is least. A mirror image is never used.

    Parameters
    ----------
    source, target : (N, 3), N ≥ 3, pairs in the same order.

    Returns
    -------
    H : (4, 4), NaN where invalid.
    valid : False if the points do not determine a rotation: on a line, or mirrored so that several
        rotations are equally near. Also False if the scale or the translation is not finite.
    """
    before, after = _points("source", source), _points("target", target)
    if before.shape != after.shape:
        raise ValueError(f"source {before.shape} and target {after.shape}; legal: equal")
    (a, size_a), (b, size_b) = _spread(before), _spread(after)
    U, sizes, Vt = np.linalg.svd(b.T @ a)
    signs = np.array([1.0, 1.0, math.copysign(1.0, float(np.linalg.det(U @ Vt)))])
    if not sizes[1] + signs[2] * sizes[2] > DEGENERATE * sizes[0]:
        return np.full((4, 4), np.nan), False
    R = (U * signs) @ Vt
    scale = float((sizes * signs).sum() / (a * a).sum()) if scaled else 1.0
    with np.errstate(over="ignore", invalid="ignore"):
        scale = scale * size_b / size_a if scaled else 1.0
        offset = after.mean(axis=0) - scale * R @ before.mean(axis=0)
    if not (0.0 < scale < math.inf and np.isfinite(offset).all()):
        return np.full((4, 4), np.nan), False
    return similarity(scale, R, offset), True


def _spread(points: Floats) -> tuple[Floats, float]:
    """Points about their mean, divided by the largest coordinate, and that coordinate.

    Their squares can then neither overflow nor vanish.
    """
    centred = points - points.mean(axis=0)
    largest = float(np.abs(centred).max())
    return centred / largest if largest > 0.0 else centred, largest


def _points(name: str, points: ArrayLike) -> Floats:
    found = as_vectors(name, points, 3)
    if found.ndim != 2 or len(found) < 3 or not np.all(np.abs(found) <= LARGEST):
        raise ValueError(
            f"{name} of shape {found.shape}; legal: (N, 3), N at least 3, to {LARGEST:g} in size"
        )
    return found
