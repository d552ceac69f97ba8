"""Four formulas of the book, each as a textbook writes it and rearranged, in a given format.

Each takes numbers of the format and computes in that format throughout. The reference is
`simulations.scenes.stability.truth`.
"""

import numpy as np

from simulations.models.arrays import Floats

K1 = -0.3
FOLD = float(np.sqrt(-1.0 / (3.0 * K1)))
LARGEST_SEEN = FOLD * 2.0 / 3.0
"""Radius of the barrel lens's fold, and its image radius, in focal lengths."""


def angle_by_arccosine(start: Floats, end: Floats) -> Floats:
    """2 acos |q₀ · q₁| of quaternions (n, 4)."""
    return 2 * np.arccos(np.abs((start * end).sum(axis=-1)))


def angle_by_lengths(start: Floats, end: Floats) -> Floats:
    """4 atan2(|q₁ − q₀|, |q₁ + q₀|), of quaternions (n, 4) on the same side."""
    apart, together = (np.sqrt((q * q).sum(axis=-1)) for q in (end - start, end + start))
    return 4 * np.arctan2(apart, together)


def blur_in_dioptres(scale: Floats, focus: Floats, depth: Floats) -> Floats:
    """The reciprocals are rounded, then subtracted."""
    return scale / (1 - 1 / focus) * np.abs(1 / depth - 1 / focus)


def blur_by_distances(scale: Floats, focus: Floats, depth: Floats) -> Floats:
    """The distances are subtracted first, which is exact if they are close."""
    return scale * np.abs(focus - depth) / ((focus - 1) * depth)


def pixel_from_origin(rows: Floats, point: Floats, centre: Floats) -> Floats:
    """X/Z by R p + t with t = −R c: both terms are as large as the distance from the origin."""
    x, z = (
        _dot(row, point) + offset
        for row, offset in zip(rows, (-_dot(row, centre) for row in rows), strict=True)
    )
    return np.asarray(x / z)


def pixel_from_camera(rows: Floats, point: Floats, centre: Floats) -> Floats:
    """X/Z by R (p − c)."""
    x, z = (_dot(row, point - centre) for row in rows)
    return np.asarray(x / z)


def radius_by_few_steps(seen: Floats) -> Floats:
    """Five Newton steps from the distorted radius."""
    return _newton(seen, 5)


def radius_by_many_steps(seen: Floats) -> Floats:
    """Halvings from 1 to the last bit of a double, and some more."""
    return _newton(seen, 60)


def _newton(seen: Floats, steps: int) -> Floats:
    """r (1 + k₁ r²) = r_d, started on the axis's side, from which no step passes the solution."""
    k, r = seen.dtype.type(K1), seen
    for _ in range(steps):
        square = r * r
        r = r - (r * (1 + k * square) - seen) / (1 + 3 * k * square)
    return r


def _dot(row: Floats, points: Floats) -> Floats:
    """Written out, as a library may fuse or reorder the terms, and the rounding matters."""
    x, y, z = (points[..., axis] for axis in range(3))
    return np.asarray(row[0] * x + row[1] * y + row[2] * z)
