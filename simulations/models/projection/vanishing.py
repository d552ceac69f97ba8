"""Vanishing points of parallel lines, and horizons of planes.

Camera frame as in `simulations.models.projection.pinhole`. Source: Szeliski, 2nd ed., §2.1.4 and
§7.4.3.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_vectors


def vanishing_point(direction_camera: ArrayLike, K: ArrayLike) -> tuple[Floats, Mask]:
    """Pixel in which all lines of one direction meet: K d, dehomogenised.

    Parameters
    ----------
    direction_camera : (..., 3) in the camera frame, of any length; d and −d are the same line.
    K : (3, 3)

    Returns
    -------
    pixels : (..., 2), NaN where invalid.
    valid : (...,) bool, False for lines parallel to the image plane, which stay parallel in the
        picture, for the zero vector, and where a component is not finite.
    """
    image = _scaled(direction_camera) @ np.asarray(K, float).T
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        pixels = image[..., :2] / image[..., 2:]
    valid = np.isfinite(pixels).all(axis=-1)
    return np.where(valid[..., None], pixels, np.nan), valid


def horizon(normal_camera: ArrayLike, K: ArrayLike) -> tuple[Floats, bool]:
    """Image line a x + b y + c = 0 on which all directions of a plane vanish: K⁻ᵀ n.

    Parameters
    ----------
    normal_camera : (3,) normal of the plane in the camera frame.
    K : (3, 3)

    Returns
    -------
    line : (3,) scaled to a² + b² = 1, so that a x + b y + c is a distance in pixels.
    valid : False for a plane parallel to the image, whose horizon is at infinity, and for a
        normal that is zero or not finite.
    """
    line = np.linalg.solve(np.asarray(K, float).T, _scaled(normal_camera))
    length = float(np.hypot(line[0], line[1]))
    if not length > 1e-12 * float(np.abs(line).max()):
        return np.full(3, np.nan), False
    return line / length, True


def angle_between(points: ArrayLike, others: ArrayLike, K: ArrayLike) -> Floats:
    """Angle in space (...) between the lines that vanish in two image points, radians, 0 to π/2.

    It is that of the rays K⁻¹ v, as d and −d vanish in the same point.

    Parameters
    ----------
    points, others : (..., 3) homogeneous pixels: (x, y, 1), or (x, y, 0) for a point at infinity.
    K : (3, 3)

    Returns
    -------
    angle : NaN for (0, 0, 0), which is not a point, and if an entry is not finite.
    """
    inverse = np.linalg.inv(np.asarray(K, float))
    first, second = (_scaled(_scaled(these) @ inverse.T) for these in (points, others))
    across, along = np.linalg.norm(np.cross(first, second), axis=-1), (first * second).sum(axis=-1)
    angle = np.arctan2(across, np.abs(along))
    return np.where(first.any(axis=-1) & second.any(axis=-1), angle, np.nan)


def _scaled(directions: ArrayLike) -> Floats:
    """Directions (..., 3) divided by their largest component, so that products cannot overflow;
    zero if that is not finite."""
    vectors = as_vectors("directions", directions, 3)
    largest = np.abs(vectors).max(axis=-1, keepdims=True)
    usable = (largest > 0.0) & np.isfinite(largest)
    return np.where(usable, vectors, 0.0) / np.where(usable, largest, 1.0)
