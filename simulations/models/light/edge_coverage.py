"""Share of a pixel that a shape covers, from the distance of its edge alone.

Pixels are unit squares. Distances are signed, positive where the pixel's centre lies inside the
shape; normals are unit vectors, of either sign. Szeliski, 2nd ed., section 2.3.1 (area sampling).
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_vectors


def ramp_coverage(distance_px: ArrayLike) -> Floats:
    """Distance plus one half, between 0 and 1: exact for edges along an axis of the grid."""
    return np.clip(0.5 + np.asarray(distance_px, float), 0.0, 1.0)


def straight_edge_coverage(distance_px: ArrayLike, normal: ArrayLike) -> Floats:
    """Exact share (...) of a pixel on the inner side of a straight edge of any direction.

    The pixel's projection along the ``normal`` (..., 2) is a trapezium: flat in the middle, falling
    linearly where the edge cuts off a corner. The coverage is its integral.
    """
    distance = np.asarray(distance_px, float)
    longer, shorter = _projected_sides(normal)
    reach = np.clip((longer + shorter) / 2 - np.abs(distance), 0.0, None)
    # Area outside the edge: a triangle at the corner, then a strip of full width.
    corner = np.minimum(reach, shorter)
    triangle = corner**2 / (2.0 * np.maximum(longer * shorter, 1e-300))
    strip = (reach - corner) / np.maximum(longer, 1e-300)
    outside = triangle + strip
    return np.where(distance >= 0.0, 1.0 - outside, outside)


def curved_edge_coverage(
    distance_px: ArrayLike, normal: ArrayLike, curvature_per_px: ArrayLike
) -> Floats:
    """Share (...) of a pixel within an edge of the given curvature, positive for a disc.

    The tangent's coverage minus the area between tangent and edge: ``κ L³/24`` for an edge of
    length L within the pixel.
    """
    length = chord_length(distance_px, normal)
    with np.errstate(over="ignore"):  # more than a pixel is clipped below
        bulge = np.asarray(curvature_per_px, float) * length**3 / 24.0
    tangent = straight_edge_coverage(distance_px, normal)
    return np.clip(tangent - bulge, 0.0, 1.0)


def chord_length(distance_px: ArrayLike, normal: ArrayLike) -> Floats:
    """Length (...) of a line within the pixel: how fast its coverage changes with distance."""
    distance = np.asarray(distance_px, float)
    longer, shorter = _projected_sides(normal)
    reach = np.clip((longer + shorter) / 2 - np.abs(distance), 0.0, None)
    width = np.minimum(reach, shorter)
    return np.where(
        width < shorter,
        width / np.maximum(longer * shorter, 1e-300),
        (reach > 0.0) / np.maximum(longer, 1e-300),
    )


def _projected_sides(normal: ArrayLike) -> tuple[Floats, Floats]:
    """The pixel's two sides seen along the edge: the longer and the shorter."""
    sides = np.minimum(np.abs(as_vectors("normal", normal, 2)), 1.0)
    return np.maximum(sides[..., 0], sides[..., 1]), np.minimum(sides[..., 0], sides[..., 1])
