"""The ladder of 2D transformations as (3, 3) matrices on homogeneous points (x, y, 1).

Translation (2 degrees of freedom), rigid (3), similarity (4), affine (6), projective (8). Angles
turn the x axis towards the y axis: counter-clockwise where y points up, clockwise where it points
down.

A projective matrix divides by w, and w may vanish: the points with w = 0 form a line that is mapped
to infinity. H and c H are the same map for every c ≠ 0, so the sign of w alone is meaningless. If
two points have w of different sign, the line separates them and the image of the segment between
them is not connected. `clip_to_visible` therefore takes a point on the visible side. The sign
itself is meaningful only for matrices from two cameras; see
`simulations.models.projection.view_homographies`.

Source: Szeliski, Computer Vision, 2nd ed., §2.1.1–2.1.2, table 2.1.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_array, as_vectors
from simulations.models.require import require, require_positive

CLIP_RANGE = 1e150
"""Largest coordinate that can be clipped: beyond, differences and products would overflow."""

FEW = 32
"""Numbers up to which Python compares them sooner than NumPy."""

W_MINIMUM = 1e-12
"""Smallest usable w, relative to the terms whose sum it is."""


def translation(tx: float, ty: float) -> Floats:
    """Move by (tx, ty). Keeps orientation, lengths, angles."""
    return affine(np.eye(2), (tx, ty))


def rigid(angle_rad: float, tx: float, ty: float) -> Floats:
    """Rotate about the origin, then move. Keeps lengths and angles."""
    return similarity(1.0, angle_rad, tx, ty)


def similarity(scale: float, angle_rad: float, tx: float, ty: float) -> Floats:
    """Scale and rotate about the origin, then move. Keeps angles and ratios of lengths.

    Raises `ValueError` unless the scale is positive and all numbers are finite.
    """
    require_positive("scale", scale)
    require("angle_rad", angle_rad, math.isfinite(angle_rad), "finite")
    c, s = scale * math.cos(angle_rad), scale * math.sin(angle_rad)
    return affine([[c, -s], [s, c]], (tx, ty))


def affine(matrix: ArrayLike, offset: ArrayLike) -> Floats:
    """x' = A x + t with any (2, 2) matrix A, singular ones included. Keeps parallel lines."""
    H = np.eye(3)
    H[:2, :2] = np.asarray(matrix, float)
    H[:2, 2] = np.asarray(offset, float)
    return _finite(H)


def projective(h: ArrayLike) -> Floats:
    """Any homography, from its (3, 3) matrix or its nine entries. Keeps straight lines only.

    The result is scaled to h₃₃ = 1, so that w > 0 on the side of the origin; if h₃₃ is zero
    relative to the other entries, to unit norm with the first non-zero entry of the last row
    positive. Raises `ValueError` for the zero matrix and for entries that are not finite.
    """
    H = _finite(np.array(h, dtype=float).reshape(3, 3))
    largest = float(np.abs(H).max())
    if largest == 0.0:
        raise ValueError("h: all entries are zero; legal: any other matrix")
    H = H / largest
    leading = next((float(entry) for entry in H[2] if entry != 0.0), 1.0)
    norm = math.copysign(float(np.linalg.norm(H)), leading)
    divisor = float(H[2, 2]) if abs(H[2, 2]) > W_MINIMUM else norm
    return _finite(H / divisor)


def _finite(H: Floats) -> Floats:
    require("transformation", H, np.isfinite(H).all(), "finite entries")
    return H


def apply_homography(H: ArrayLike, points: ArrayLike) -> tuple[Floats, Mask]:
    """Images of points (..., 2) under H; c H has the same for every c ≠ 0.

    Returns
    -------
    images : (..., 2), NaN where invalid. Points on both sides of the line that is mapped to
        infinity have images, but the image of a figure that crosses the line is not connected.
    valid : (...,) bool, False on that line, where |w| ≤ W_MINIMUM · (|h₃₁ x| + |h₃₂ y| + |h₃₃|):
        there w is only rounding. Also False if an entry of H or of the point is not finite, or the
        image overflows.
    """
    matrix = _scaled(H)
    xy = as_vectors("points", points, 2)
    finite = np.isfinite(xy).all(axis=-1)
    xy = np.where(finite[..., None], xy, 0.0)
    with np.errstate(over="ignore", invalid="ignore"):
        w, size = _divisor(matrix, xy)
        valid = finite & (np.abs(w) > W_MINIMUM * size)
        numerator = xy @ matrix[:2, :2].T + matrix[:2, 2]
        images = numerator / np.where(valid, w, 1.0)[..., None]
    valid &= np.isfinite(images).all(axis=-1)
    return np.where(valid[..., None], images, np.nan), valid


def sign_of_w(H: ArrayLike, points: ArrayLike) -> Floats:
    """The side of points (..., 2) of the line that H maps to infinity: −1, 0 or 1, (...).

    Also 0 where w is only rounding or not finite. −H has the opposite signs.
    """
    xy = as_vectors("points", points, 2)
    with np.errstate(over="ignore", invalid="ignore"):
        w, size = _divisor(_scaled(H), xy)
        beside = np.isfinite(w) & (np.abs(w) > W_MINIMUM * size)
    return np.where(beside, np.sign(w), 0.0)


def _scaled(H: ArrayLike) -> Floats:
    """H with entries below 1: the same map. A power of two is divided out, without rounding."""
    matrix = np.asarray(H, float)
    _, exponent = np.frexp(np.abs(matrix).max())
    return np.ldexp(matrix, -int(exponent))


def _divisor(H: Floats, xy: Floats) -> tuple[Floats, Floats]:
    """w = h₃₁ x + h₃₂ y + h₃₃ and the sum of the sizes of its terms."""
    terms = H[2] * np.concatenate([xy, np.ones((*xy.shape[:-1], 1))], axis=-1)
    return terms.sum(axis=-1), np.abs(terms).sum(axis=-1)


def clip_half_plane(polygon: ArrayLike, line: ArrayLike, closed: bool = True) -> Floats:
    """The part of a polygon (N, 2) where a x + b y + c ≥ 0, for line = (a, b, c).

    One pass of Sutherland–Hodgman, exact for convex polygons. With ``closed`` False the points are
    an open polyline. Returns (M, 2), M = 0 if nothing is left. Raises `ValueError` for coordinates
    and coefficients that are not within `CLIP_RANGE`.
    """
    vertices = _in_range("polygon", _vertices(polygon))
    return _clipped(vertices, _in_range("line", as_array("line", line, 3)), closed)


def _clipped(vertices: Floats, line: Floats, closed: bool) -> Floats:
    side = (vertices @ line[:2] + line[2]).tolist()
    if min(side, default=0.0) >= 0.0:
        return vertices.copy()
    clipped: list[Floats] = []
    for i in range(len(vertices)):
        previous = i - 1
        crosses = (side[previous] >= 0.0) != (side[i] >= 0.0)
        if crosses and (closed or i > 0):
            share = side[previous] / (side[previous] - side[i])
            clipped.append(vertices[previous] + share * (vertices[i] - vertices[previous]))
        if side[i] >= 0.0:
            clipped.append(vertices[i])
    return np.array(clipped).reshape(-1, 2)


def clip_to_rectangle(
    polygon: ArrayLike, lowest: ArrayLike, highest: ArrayLike, closed: bool = True
) -> Floats:
    """The part of a polygon or polyline (N, 2) inside a rectangle with level and upright sides.

    ``lowest`` and ``highest`` (2,) are its smallest and largest x and y. Returns (M, 2) and raises
    as `clip_half_plane`.
    """
    (left, low), (right, high) = (
        _in_range(name, as_vectors(name, corner, 2)).tolist()
        for name, corner in (("lowest", lowest), ("highest", highest))
    )
    vertices = _in_range("polygon", _vertices(polygon))
    if not len(vertices):
        return vertices.copy()
    (first, top), (last, bottom) = vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist()
    if left <= first and last <= right and low <= top and bottom <= high:
        return vertices.copy()
    if last < left or first > right or bottom < low or top > high:
        return vertices[:0].copy()
    for line in ((1, 0, -left), (-1, 0, right), (0, 1, -low), (0, -1, high)):
        vertices = _clipped(vertices, np.array(line, float), closed)
    return vertices


def clip_to_visible(
    H: ArrayLike,
    polygon: ArrayLike,
    w_minimum: float = 1e-6,
    closed: bool = True,
    *,
    seen: ArrayLike = (0.0, 0.0),
) -> Floats:
    """The visible part of a polygon (N, 2), before the transformation.

    The visible side of the line that H maps to infinity is that of the point ``seen`` (2,).
    Vertices on both sides must not be joined after the division: the edge would pass through
    infinity. Clipping where |w| ≥ ``w_minimum`` times the largest w of the vertices, before the
    division, is exact and leaves only points that `apply_homography` maps. Returns (M, 2), M = 0 if
    no part is visible. Raises `ValueError` if ``seen`` is on that line, and for numbers beyond
    `CLIP_RANGE`.
    """
    require("w_minimum", w_minimum, W_MINIMUM < w_minimum < 1.0, f"{W_MINIMUM} to 1")
    side = float(sign_of_w(_in_range("H", np.asarray(H, float)), seen))
    require("seen", seen, side != 0.0, "off the line that H maps to infinity")
    matrix = side * _scaled(H)
    vertices = _in_range("polygon", _vertices(polygon))
    if not len(vertices):
        return vertices
    near = w_minimum * float(_divisor(matrix, vertices)[1].max())
    return clip_half_plane(vertices, matrix[2] - [0.0, 0.0, near], closed)


def _vertices(polygon: ArrayLike) -> Floats:
    """Points as (N, 2), also for N = 0."""
    return as_vectors("polygon", polygon, 2) if np.size(polygon) else np.empty((0, 2))


def _in_range(name: str, values: Floats) -> Floats:
    if values.size <= FEW:
        legal = all(-CLIP_RANGE <= value <= CLIP_RANGE for value in values.ravel().tolist())
    else:
        legal = bool(np.abs(values).max(initial=0.0) <= CLIP_RANGE)
    require(name, values, legal, f"finite, at most {CLIP_RANGE:g} in size")
    return values
