"""The images of lines, of the horizon and of the box by the camera over the tiled floor."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.projection.level_ground import height_by_horizon, pose_above_ground
from simulations.models.projection.pinhole import intrinsics, project, world_to_camera
from simulations.models.projection.vanishing import horizon, vanishing_point
from simulations.pictures.tiled_floor import Box
from simulations.scenes.tiled_floor.settings import Settings

WIDTH_PX, HEIGHT_PX = 400, 300
MIDDLE = (200.0, 150.0)
"""The principal point before its shift."""
AXES = np.array([(0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])
"""Directions of the tiles' rows, of those across, and of vertical lines, with the vanishing points
v₁, v₂, v₃.
"""
AT_INFINITY_PX = 1e5
"""Vanishing points farther off count as infinite, as rounding keeps them from being exactly so."""
BOX_WIDTH_M = 1.0


@dataclass(frozen=True)  # without slots, for cached properties
class Camera:
    """A camera above the floor."""

    K: Floats
    pose: Floats
    """World to camera, (4, 4)."""
    height: float
    """Metres."""

    @cached_property
    def directions(self) -> Floats:
        """The three axes of the floor (3, 3) in the camera frame, one a row."""
        return AXES @ self.pose[:3, :3].T

    @cached_property
    def vanishing(self) -> tuple[Floats, Mask]:
        """Their vanishing points (3, 2) in pixels, and which of them are not at infinity."""
        pixels, valid = vanishing_point(self.directions, self.K)
        valid &= (np.abs(np.where(valid[:, None], pixels, 0.0)) < AT_INFINITY_PX).all(axis=1)
        return np.where(valid[:, None], pixels, np.nan), valid

    @cached_property
    def horizon(self) -> Floats:
        """Its line (3,), a² + b² = 1, positive below it."""
        line, _ = horizon(-self.directions[2], self.K)
        return line

    def image(self, points: Floats) -> tuple[Floats, Mask]:
        """Pixels (..., 2) of points of the world, and which of them are in front."""
        return project(world_to_camera(points, self.pose), self.K)


@lru_cache(maxsize=4)  # handles, overlays and readouts call it several times a frame
def camera(
    pitch: float,
    yaw: float,
    height: float,
    focal_length: float,
    roll: float,
    principal_x: float,
    principal_y: float,
) -> Camera:
    """The camera of these settings."""
    return Camera(
        K=intrinsics(focal_length, (MIDDLE[0] + principal_x, MIDDLE[1] + principal_y)),
        pose=pose_above_ground(height, *(math.radians(angle) for angle in (yaw, pitch, roll))),
        height=height,
    )


def camera_of(settings: Settings) -> Camera:
    return camera(
        settings.pitch,
        settings.yaw,
        settings.height,
        settings.focal_length,
        settings.roll,
        settings.principal_x,
        settings.principal_y,
    )


def box_of(settings: Settings) -> Box:
    return Box(settings.box_x, settings.box_y, BOX_WIDTH_M, settings.box_height)


def near_upright(box: Box) -> Floats:
    """Foot and top (2, 3) of the edge of the box that is nearest to the camera."""
    xs, ys, (low, top) = box.spans
    x, y = (min(ends, key=abs) for ends in (xs, ys))
    return np.array([(x, y, low), (x, y, top)])


def height_in_picture(view: Camera, box: Box) -> float | None:
    """Height of the box, metres, from its image and the height of the camera; None if
    undetermined."""
    (foot, top), seen = view.image(near_upright(box))
    ratio, valid = height_by_horizon(foot, top, view.horizon, view.K @ view.directions[2])
    return float(ratio) * view.height if seen.all() and valid else None


def visible_edges(box: Box, height: float, axis: int) -> Iterator[Floats]:
    """Edges (2, 3) along one of `AXES` of the sides that a camera at that height sees."""
    drawn = set()
    for name in box.seen_from((0.0, 0.0, height)):
        corners = box.side(name)
        for edge in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            start, end = sorted(tuple(corner) for corner in edge)
            if abs(np.subtract(end, start) @ AXES[axis]) > 0.0 and start not in drawn:
                drawn.add(start)
                yield np.array([start, end])
