"""A camera above level ground: its pose, its map of the ground, and heights by the horizon.

World frame as in `simulations.models.light.raycasting`: x right, y away, z up, in metres, with the
ground at z = 0. Camera frame and pixels as in `simulations.models.projection.pinhole`.

Source: Szeliski, Computer Vision, 2nd ed., §2.1.4; Criminisi, Reid and Zisserman, Single view
metrology, IJCV 2000.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_array, as_vectors
from simulations.models.geometry.quaternions import cross
from simulations.models.projection.pinhole import camera_matrix, look_at, rigid_pose
from simulations.models.require import require, require_positive

STEEPEST_RAD = 1.5
"""Largest pitch, up or down: straight down, yaw and roll are the same."""


def pose_above_ground(height: float, yaw: float, pitch: float, roll: float = 0.0) -> Floats:
    """The pose ``world_to_camera`` (4, 4) of a camera ``height`` metres above the origin.

    It looks along y, is turned by ``yaw`` to the right, then by ``pitch`` downwards, then leans by
    ``roll`` to its right; all in radians.

    Raises `ValueError` unless the height is positive, the pitch within `STEEPEST_RAD` and all are
    finite.
    """
    require_positive("height", height)
    require("pitch", pitch, abs(pitch) <= STEEPEST_RAD, f"at most {STEEPEST_RAD} in size")
    require("yaw, roll", (yaw, roll), math.isfinite(yaw) and math.isfinite(roll), "finite")
    level = math.cos(pitch)
    forward = np.array([level * math.sin(yaw), level * math.cos(yaw), -math.sin(pitch)])
    upright = look_at([0.0, 0.0, 0.0], forward, [0.0, 0.0, 1.0])[:3, :3]
    cos, sin = math.cos(roll), math.sin(roll)
    R = np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]) @ upright
    return rigid_pose(R, -R @ [0.0, 0.0, height])


def ground_to_image(pose: ArrayLike, K: ArrayLike) -> Floats:
    """H = K [r₁ r₂ t], (3, 3): points (X, Y, 1) of the ground to pixels.

    Scaled so that w is the depth before the camera. Its first two columns are the vanishing points
    of the ground's axes.
    """
    return camera_matrix(K, pose)[:, [0, 1, 3]]


def height_by_horizon(
    foot: ArrayLike, top: ArrayLike, horizon: ArrayLike, vertical: ArrayLike
) -> tuple[Floats, Mask]:
    """Height of things on the ground, in heights of the camera, from their image alone.

    The horizon is the image of all points as high as the camera, and vertical lines meet in one
    vanishing point. The four points of a vertical line (foot, top, horizon, vanishing point) have
    the cross-ratio height : height of the camera. For a level camera, that is foot to top over foot
    to horizon.

    Parameters
    ----------
    foot, top : (..., 2) pixels
    horizon : (3,) line, of any scale.
    vertical : (3,) homogeneous vanishing point of vertical lines; (x, y, 0) if they are parallel.

    Returns
    -------
    ratio : (...), NaN where invalid.
    valid : (...,) bool, False for a foot on the horizon, a top in the vanishing point, or a number
        that is not finite.
    """
    line = as_array("horizon", horizon, 3)
    vanishing = as_array("vertical", vertical, 3)
    b, t = (_homogeneous(name, points) for name, points in (("foot", foot), ("top", top)))
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        upwards, rest = cross(b, t), cross(vanishing, t)
        below = (b @ line) * (rest * rest).sum(axis=-1)
        ratio = (vanishing @ line) * (upwards * rest).sum(axis=-1) / below
    valid = np.isfinite(ratio)
    return np.where(valid, ratio, np.nan), valid


def _homogeneous(name: str, pixels: ArrayLike) -> Floats:
    points = as_vectors(name, pixels, 2)
    return np.concatenate([points, np.ones((*points.shape[:-1], 1))], axis=-1)
