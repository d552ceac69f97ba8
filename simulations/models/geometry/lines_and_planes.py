"""Lines of the plane and planes of space in homogeneous coordinates: join, meet, distance.

A line is (a, b, c) with a x + b y + c = 0, a plane (a, b, c, d) with a X + b Y + c Z + d = 0. Any
multiple is the same line or plane. The functions return normals of length 1, so that the left side
is a signed distance in the unit of the points.

Source: Szeliski, Computer Vision, 2nd ed., §2.1.1.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_vectors

PARALLEL = 1e-14
"""Sine of the angle below which two directions count as parallel."""


def line_through(p: ArrayLike, q: ArrayLike) -> tuple[Floats, Mask]:
    """The line that joins two points: the cross product (p, 1) × (q, 1).

    Taken from their difference, which is exact for neighbours far from the origin, where the
    products of the plain formula cancel.

    Parameters
    ----------
    p, q : (..., 2)

    Returns
    -------
    lines : (..., 3) with a² + b² = 1; positive to the left of the direction from p to q if y points
        up, to its right if y points down. NaN where invalid.
    valid : (...,) bool, False where the points coincide or are not finite.
    """
    start, end = np.broadcast_arrays(as_vectors("p", p, 2), as_vectors("q", q, 2))
    with np.errstate(over="ignore", invalid="ignore"):
        step = end - start
    return _with_normal(np.stack([-step[..., 1], step[..., 0]], axis=-1), start)


def intersection(lines: ArrayLike, others: ArrayLike) -> tuple[Floats, Mask]:
    """The point in which two lines meet: their cross product, dehomogenised.

    Parameters
    ----------
    lines, others : (..., 3), of any scale.

    Returns
    -------
    points : (..., 2), NaN where invalid.
    valid : (...,) bool, False for parallel lines, which meet at infinity, for the line at infinity,
        and for invalid lines.
    """
    first = _unit_normal(as_vectors("lines", lines, 3))
    second = _unit_normal(as_vectors("others", others, 3))
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        meet = np.cross(first, second)
        points = meet[..., :2] / meet[..., 2:]
    valid = (np.abs(meet[..., 2]) > PARALLEL) & np.isfinite(points).all(axis=-1)
    return np.where(valid[..., None], points, np.nan), valid


def plane_through(p: ArrayLike, q: ArrayLike, r: ArrayLike) -> tuple[Floats, Mask]:
    """The plane that three points (..., 3) span.

    Returns
    -------
    planes : (..., 4) with a normal of length 1, to the side from which p, q, r run
        counter-clockwise (in right-handed axes). NaN where invalid.
    valid : (...,) bool, False where the points are on one line or not finite.
    """
    points = np.broadcast_arrays(
        as_vectors("p", p, 3), as_vectors("q", q, 3), as_vectors("r", r, 3)
    )
    with np.errstate(over="ignore", invalid="ignore"):
        along, aside = (_direction(other - points[0]) for other in points[1:])
        normal = np.cross(along, aside)
    slanted = np.linalg.norm(normal, axis=-1, keepdims=True) > PARALLEL
    return _with_normal(np.where(slanted, normal, np.nan), points[0])


def signed_distance(points: ArrayLike, hyperplane: ArrayLike) -> Floats:
    """Distances (...) of points (..., 2) to lines, or of points (..., 3) to planes.

    ``hyperplane`` (..., 3) or (..., 4) may have any scale; a negative one changes the sign of the
    distance, as it reverses the normal. NaN if it has no normal.
    """
    entries = np.asarray(hyperplane, float)
    dimensions = 3 if entries.shape[-1:] == (4,) else 2
    unit = _unit_normal(as_vectors("hyperplane", entries, dimensions + 1))
    position = as_vectors("points", points, dimensions)
    with np.errstate(over="ignore", invalid="ignore"):
        return (unit[..., :-1] * position).sum(axis=-1) + unit[..., -1]


def _with_normal(normal: Floats, point: Floats) -> tuple[Floats, Mask]:
    """The hyperplane through a point with that normal, of any length."""
    unit = _direction(normal)
    with np.errstate(over="ignore", invalid="ignore"):
        offset = -(unit * point).sum(axis=-1, keepdims=True)
    found = np.concatenate([unit, offset], axis=-1)
    valid = np.isfinite(found).all(axis=-1)
    return np.where(valid[..., None], found, np.nan), valid


def _unit_normal(entries: Floats) -> Floats:
    """Scaled so that all entries but the last form a unit vector; NaN if that is impossible."""
    largest = np.abs(entries[..., :-1]).max(axis=-1, keepdims=True)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        scaled = entries / largest
        return scaled / np.linalg.norm(scaled[..., :-1], axis=-1, keepdims=True)


def _direction(vectors: Floats) -> Floats:
    """Vectors (..., n) scaled to length 1; NaN for zero and for entries that are not finite."""
    largest = np.abs(vectors).max(axis=-1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        scaled = vectors / largest  # squares can neither overflow nor vanish
        return scaled / np.linalg.norm(scaled, axis=-1, keepdims=True)
