"""Lines along three axes and points on the floor, in the image of a known camera."""

import math

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.pinhole import intrinsics, invert_pose, project, world_to_camera

SIZE = (800.0, 600.0)
CENTRE = (399.5, 299.5)
FOCAL = 560.0
K = intrinsics(FOCAL, CENTRE)
HEIGHT = 1.5


def random_pose(rng: np.random.Generator) -> Floats:
    """A camera with three finite vanishing points: pan 20 to 70°, tilt 9 to 34° down, and a small
    roll."""
    return pose_above_ground(
        HEIGHT, rng.uniform(0.35, 1.2), rng.uniform(0.15, 0.6), rng.uniform(-0.1, 0.1)
    )


def lines_along_axes(
    pose: Floats,
    rng: np.random.Generator,
    counts: tuple[int, int, int] = (4, 4, 4),
    shortest: float = 150.0,
    K: Floats = K,
    off_square: float = 0.0,
) -> tuple[Floats, Floats]:
    """The ends (N, 2, 2) in pixels of lines in the image, without noise, and their axes (N,); the
    first axis is turned by ``off_square``, in radians, towards the second."""
    directions = np.eye(3)
    directions[0] = math.cos(off_square), math.sin(off_square), 0.0
    ends, axes = [], []
    for axis, count in enumerate(counts):
        found = 0
        while found < count:
            pixel, depth = rng.uniform((0.0, 0.0), SIZE), rng.uniform(2.0, 8.0)
            start = invert_pose(pose) @ [*(depth * np.linalg.inv(K) @ [*pixel, 1.0]), 1.0]
            along = directions[axis] * rng.uniform(0.5, 3.0)
            line = image_of(np.array([start[:3], start[:3] + along]), pose, K)
            if (line >= 0.0).all() and (line < SIZE).all() and math.dist(*line) > shortest:
                ends.append(line)
                axes.append(axis)
                found += 1
    return np.array(ends), np.array(axes)


def image_of(points: Floats, pose: Floats, K: Floats = K) -> Floats:
    """Pixels (..., 2); NaN behind the camera."""
    return project(world_to_camera(points, pose), K)[0]


def floor_point(pose: Floats, rng: np.random.Generator) -> Floats:
    """A point (3,) on the floor, in metres, well below the horizon of the image."""
    while True:
        ray = pose[:3, :3].T @ np.linalg.inv(K) @ [*rng.uniform((0.0, 0.0), SIZE), 1.0]
        if ray[2] < -0.2:
            return np.array([0.0, 0.0, HEIGHT]) - ray * (HEIGHT / ray[2])


def above(foot: Floats, height: float) -> Floats:
    """The point (3,) at this height over a point (3,) of the floor."""
    return foot + np.array([0.0, 0.0, height])
