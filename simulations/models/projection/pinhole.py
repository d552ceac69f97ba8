"""Pinhole projection: from 3D points in metres to pixels, and from pixels back to rays.

Camera frame: x right, y down, z forward along the optical axis; right-handed. Pixel (0, 0) is
centred at (0, 0). Poses are (4, 4) matrices ``world_to_camera`` = [R t; 0 1].

A point is imaged only if it is in front of the camera, Z > 0. On the plane Z = 0 the ray is
parallel to the image; behind it the equation x = f X / Z still yields a number, but no light takes
that path. Such points are NaN with ``valid`` False, so that a forgotten mask is noticed.

Source: Szeliski, Computer Vision, 2nd ed., §2.1.4–2.1.5.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_vectors, last_axis_first
from simulations.models.require import require


def intrinsics(
    focal_px: float | tuple[float, float], principal_point: tuple[float, float], skew: float = 0.0
) -> Floats:
    """The calibration matrix K = [[fx, s, cx], [0, fy, cy], [0, 0, 1]].

    Parameters
    ----------
    focal_px : distance from the centre of projection to the image plane in pixels, or (fx, fy)
        where pixels are not square. It equals a lens's focal length only for a focus at infinity;
        see `thin_lens.principal_distance_mm`.
    principal_point : (cx, cy), where the optical axis meets the image, in pixels.
    skew : pixels that x gains per unit of normalised y; 0 where the pixel axes are orthogonal.

    Raises
    ------
    ValueError
        If a focal length is not positive and finite, or another entry is not finite.
    """
    fx, fy = map(float, np.broadcast_to(focal_px, 2))
    require("focal_px", focal_px, 0.0 < fx < math.inf and 0.0 < fy < math.inf, "above 0, finite")
    cx, cy = principal_point
    if not all(map(math.isfinite, (cx, cy, skew))):
        raise ValueError(f"principal_point {principal_point}, skew {skew}; legal: finite")
    return np.array([[fx, skew, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])


def project(points_camera: ArrayLike, K: ArrayLike) -> tuple[Floats, Mask]:
    """Pixels of points in the camera frame: x = fx X/Z + s Y/Z + cx, y = fy Y/Z + cy.

    Parameters
    ----------
    points_camera : (..., 3), X right, Y down, Z forward, any one unit of length.
    K : (3, 3) from `intrinsics`.

    Returns
    -------
    pixels : (..., 2), NaN where invalid.
    valid : (...,) bool. False where Z ≤ 0, where a coordinate is NaN, and where the quotient is
        not a finite number. A finite point at Z = ∞ is valid: its image is the principal point. For
        points at infinity in other directions, use `project_homogeneous`.
    """
    X, Y, Z = last_axis_first(as_vectors("points_camera", points_camera, 3))
    matrix = np.asarray(K, float)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        x, y = X / Z, Y / Z
        u = matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2]
        v = matrix[1, 1] * y + matrix[1, 2]
    pixels = np.stack([u, v], axis=-1)
    valid = (Z > 0.0) & np.isfinite(pixels).all(axis=-1)
    return np.where(valid[..., None], pixels, np.nan), valid


def project_homogeneous(points: ArrayLike, camera_matrix: ArrayLike) -> tuple[Floats, Mask]:
    """Pixels of homogeneous world points (X, Y, Z, W) through P = K [R | t], or any c P, c ≠ 0.

    With W = 0 the point lies at infinity in direction (X, Y, Z): its pixel is where parallel lines
    of that direction meet. (X, Y, Z, W) and its negative are the same point when W ≠ 0, but
    opposite directions when W = 0, and only the one in front of the camera is seen.

    Parameters
    ----------
    points : (..., 4)
    camera_matrix : (3, 4) from `camera_matrix`, whose last row measures depth, or a multiple c P;
        the sign of c is that of det(K R).

    Returns
    -------
    pixels : (..., 2), NaN where invalid.
    valid : (...,) bool, False on and behind the camera plane, for (0, 0, 0, 0), and where a
        coordinate is not finite: a point at infinity is one with W = 0.
    """
    homogeneous = as_vectors("points", points, 4)
    finite = np.isfinite(homogeneous).all(axis=-1, keepdims=True)
    homogeneous = np.where(finite, homogeneous, 0.0)
    largest = np.abs(homogeneous).max(axis=-1, keepdims=True)
    scaled = homogeneous / np.where(largest > 0.0, largest, 1.0)  # products cannot overflow
    oriented = np.where(scaled[..., 3:] < 0.0, -scaled, scaled)
    P = np.asarray(camera_matrix, float)
    size = max(float(np.abs(P).max()), 1e-300)
    image = oriented @ (-P if np.linalg.det(P[:, :3] / size) < 0.0 else P).T
    depth = image[..., 2:]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        pixels = image[..., :2] / depth
    valid = (depth[..., 0] > 0.0) & np.isfinite(pixels).all(axis=-1)
    return np.where(valid[..., None], pixels, np.nan), valid


def camera_matrix(K: ArrayLike, pose: ArrayLike) -> Floats:
    """P = K [R | t], (3, 4): world points in homogeneous coordinates to the image."""
    return np.asarray(K, float) @ np.asarray(pose, float)[:3]


def look_at(eye: ArrayLike, target: ArrayLike, up: ArrayLike) -> Floats:
    """The pose ``world_to_camera`` (4, 4) of a camera at ``eye`` that looks at ``target``.

    ``up`` is a world direction that points up in the image, such as (0, 1, 0).

    Raises
    ------
    ValueError
        If eye and target coincide, up is parallel to the line of sight or no direction at all,
        or a number is not finite.
    """
    centre = as_vectors("eye", eye, 3)
    with np.errstate(over="ignore", invalid="ignore"):
        distance, forward = _length_and_direction(np.asarray(target, float) - centre)
    if not 0.0 < distance < math.inf:
        raise ValueError(
            f"target: {target!r} is {distance} from eye {eye!r}; legal: positive, finite"
        )
    height, upward = _length_and_direction(np.asarray(up, float))
    require("up", up, 0.0 < height < math.inf, "finite, not zero")
    sine, right = _length_and_direction(np.cross(forward, upward))
    if not sine > 1e-9:
        raise ValueError(f"up: {up!r} is parallel to the line of sight {forward.tolist()}")
    R = np.stack([right, np.cross(forward, right), forward])
    with np.errstate(over="ignore", invalid="ignore"):
        t = -R @ centre
    require("eye", eye, np.isfinite(t).all(), "nearer to the origin than the largest number")
    return rigid_pose(R, t)


def _length_and_direction(vector: Floats) -> tuple[float, Floats]:
    """Length and unit vector; the largest entry is divided out, so that no square overflows.

    Vectors that are zero or not finite are returned unchanged, with the length 0, ∞ or NaN.
    """
    largest = float(np.abs(vector).max())
    if not 0.0 < largest < math.inf:
        return largest, vector
    scaled = vector / largest
    norm = float(np.linalg.norm(scaled))
    return largest * norm, scaled / norm


def rigid_pose(R: ArrayLike, t: ArrayLike) -> Floats:
    """[R t; 0 1], (4, 4): p' = R p + t."""
    pose = np.eye(4)
    pose[:3, :3] = np.asarray(R, float)
    pose[:3, 3] = np.asarray(t, float)
    return pose


def invert_pose(pose: ArrayLike) -> Floats:
    """The inverse rigid motion [Rᵀ, −Rᵀt]; its last column is the camera centre in the world."""
    matrix = np.asarray(pose, float)
    R_inverse = matrix[:3, :3].T
    return rigid_pose(R_inverse, -R_inverse @ matrix[:3, 3])


def world_to_camera(points: ArrayLike, pose: ArrayLike) -> Floats:
    """Camera coordinates R p + t of world points (..., 3), in float64.

    Rounding is about 1e-16 of the distance from the world's origin, not from the camera. Far from
    the origin use `relative_to_camera`. Points that are not finite stay so, or become NaN.
    """
    matrix = np.asarray(pose, float)
    with np.errstate(over="ignore", invalid="ignore"):
        return as_vectors("points", points, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def relative_to_camera(points: ArrayLike, R: ArrayLike, centre: ArrayLike) -> Floats:
    """R (p − c) for world points (..., 3): exact near the camera, at any distance from the origin.

    In R p + t two large numbers cancel. Subtracting first, in float64, loses nothing: the
    difference of two nearby floating-point numbers is exact.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        offset = as_vectors("points", points, 3) - np.asarray(centre, float)
        return offset @ np.asarray(R, float).T


def pixel_rays(K: ArrayLike, width: int, height: int) -> Floats:
    """Directions (height, width, 3) in the camera frame, z = 1, through all pixel centres."""
    matrix = np.asarray(K, float)
    y = (np.arange(height, dtype=float)[:, None] - matrix[1, 2]) / matrix[1, 1]
    x = (np.arange(width, dtype=float)[None, :] - matrix[0, 2] - matrix[0, 1] * y) / matrix[0, 0]
    rays = np.ones((height, width, 3))
    rays[..., 0], rays[..., 1] = x, y
    return rays


def field_of_view_rad(focal_mm: float, sensor_mm: float) -> float:
    """Full angle that a sensor of this width sees: 2 atan(sensor / 2 focal).

    ``focal_mm`` is its distance from the centre of projection, as in `intrinsics`: for a lens that
    is focused, `thin_lens.principal_distance_mm`. Both lengths are in the same unit, such as
    pixels. For an infinite focal length the angle is 0.
    """
    if not (focal_mm > 0.0 and 0.0 < sensor_mm < math.inf):
        raise ValueError(f"focal_mm {focal_mm}, sensor_mm {sensor_mm}; legal: positive")
    return 2.0 * math.atan(float(sensor_mm) / float(focal_mm) / 2.0)
