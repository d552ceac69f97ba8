"""Cameras that do not divide by the depth of each point: orthographic to para-perspective.

If a scene is shallow relative to its distance, the division by depth is nearly the same for all its
points. These cameras divide once, by the depth of a reference. The rest is linear: parallel lines
stay parallel, and the camera is a (3, 4) matrix whose last row is (0, 0, 0, 1).

The centre of such a camera is infinitely far away, and its rays are parallel. There is nothing
behind it, so that every finite point has an image.

Frames and units as in `simulations.models.projection.pinhole`. Source: Szeliski, 2nd ed., §2.1.4;
Poelman and Kanade, A paraperspective factorization method, 1997.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_vectors
from simulations.models.require import require, require_positive


def orthographic_camera(
    pixels_per_unit: float, principal_point: tuple[float, float] = (0.0, 0.0)
) -> Floats:
    """x = a X + cx, y = a Y + cy: the depth is dropped.

    Parameters
    ----------
    pixels_per_unit : a, such as pixels per metre; the same at every depth.
    principal_point : (cx, cy), the pixel of the optical axis.

    Returns
    -------
    camera : (3, 4), from homogeneous points of the camera frame to homogeneous pixels.

    Raises
    ------
    ValueError
        If the scale is not positive, or an entry not finite.
    """
    require_positive("pixels_per_unit", pixels_per_unit)
    return _affine(pixels_per_unit * np.eye(2, 3), np.asarray(principal_point, float))


def scaled_orthographic_camera(K: ArrayLike, depth: float) -> Floats:
    """Weak perspective: x = fx X/Z₀ + s Y/Z₀ + cx, all points taken to be at one depth Z₀.

    In two steps, each point moves parallel to the optical axis to the plane Z = Z₀, which is then
    seen in perspective. Exact on that plane; elsewhere the error is the share (Z − Z₀)/Z₀ of the
    distance between the true image and the principal point.

    Parameters
    ----------
    K : (3, 3) from `pinhole.intrinsics`.
    depth : Z₀, positive and finite, in the unit of the points.

    Returns
    -------
    camera : (3, 4)
    """
    return paraperspective_camera(K, (0.0, 0.0, depth))


def paraperspective_camera(K: ArrayLike, reference: ArrayLike) -> Floats:
    """The linear camera that agrees with perspective to first order at a reference point.

    Each point moves parallel to the line of sight to the reference, instead of to the axis, to
    the reference's plane; that plane is seen in perspective. The error grows with the square of the
    distance from the reference.

    Parameters
    ----------
    K : (3, 3) from `pinhole.intrinsics`.
    reference : (3,) in the camera frame, such as the centre of an object; in front of the camera.

    Returns
    -------
    camera : (3, 4)

    Raises
    ------
    ValueError
        If the reference is not in front of the camera, or so near to its plane or so far to the
        side that an entry is not finite.
    """
    matrix, point = np.asarray(K, float), as_vectors("reference", reference, 3)
    depth = float(point[2])
    require("reference at depth", depth, 0.0 < depth < math.inf, "in front of the camera, finite")
    with np.errstate(over="ignore", invalid="ignore"):
        image = matrix[:2] @ (point / depth)
        slope = (matrix[:2] - np.outer(image, [0.0, 0.0, 1.0])) / depth
    return _affine(slope, image)


def _affine(slope: Floats, offset: Floats) -> Floats:
    """[slope | offset] over (0, 0, 0, 1)."""
    camera = np.zeros((3, 4))
    camera[:2, :3], camera[:2, 3], camera[2, 3] = slope, offset, 1.0
    require("camera", camera[:2], np.isfinite(camera).all(), "finite entries")
    return camera


def project_affine(points: ArrayLike, camera: ArrayLike) -> tuple[Floats, Mask]:
    """Pixels of points (..., 3) through a camera (3, 4) whose last row is (0, 0, 0, 1).

    Multiply the camera by a pose, ``camera @ world_to_camera``, to give world points.

    Returns
    -------
    pixels : (..., 2), NaN where invalid.
    valid : (...,) bool, False if a coordinate is not finite or the pixel overflows. Finite points
        have an image at any depth, even a negative one.

    Raises
    ------
    ValueError
        If the last row is different: such a camera divides by depth.
    """
    matrix = np.asarray(camera, float)
    if matrix.shape != (3, 4) or matrix[2].tolist() != [0.0, 0.0, 0.0, 1.0]:
        raise ValueError(f"camera {matrix.tolist()}; legal: (3, 4) with last row 0, 0, 0, 1")
    with np.errstate(over="ignore", invalid="ignore"):
        pixels = as_vectors("points", points, 3) @ matrix[:2, :3].T + matrix[:2, 3]
    valid = np.isfinite(pixels).all(axis=-1)
    return np.where(valid[..., None], pixels, np.nan), valid
