"""A room with a few things in it, and a camera.

World axes are right, down and ahead, in metres; the camera stays level, at the height of the
world's origin.
"""

import math
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.geometry.rotations import from_axis_angle
from simulations.models.geometry.transforms import clip_half_plane
from simulations.models.projection.pinhole import invert_pose, rigid_pose, world_to_camera

LAMP = np.array([2.0, -1.0, 5.0])
"""1 m above the camera."""
WALLS = np.array([(-1.0, 0.0, -3.0), (13.0, 0.0, -3.0), (13.0, 0.0, 7.0), (-1.0, 0.0, 7.0)])
TABLE = np.array([(5.0, 0.0, 4.0), (8.0, 0.0, 4.0), (8.0, 0.0, 5.5), (5.0, 0.0, 5.5)])
FIELD_RAD = math.radians(60.0)
"""The camera's field of view."""
DOOR = np.array([(5.0, 0.0, 7.0), (6.5, 0.0, 7.0)])
"""The door in the far wall."""
AXIS_M = 2.5
"""Drawn length of axes."""


@dataclass(frozen=True, slots=True)
class Standpoint:
    """A level camera in the room."""

    pose: Floats
    """World to camera, (4, 4)."""

    @property
    def rotation(self) -> Floats:
        """World to camera, (3, 3): the camera's axes as rows."""
        return self.pose[:3, :3]

    @property
    def t(self) -> Floats:
        """(3,) metres: the world's origin in camera coordinates."""
        return self.pose[:3, 3]

    @property
    def centre(self) -> Floats:
        """(3,) metres, in the world."""
        return invert_pose(self.pose)[:3, 3]

    @property
    def field(self) -> Floats:
        """(n, 3) metres, in the world: the part of the floor within a field of view of 60°."""
        depth = 20.0
        aside = depth * math.tan(FIELD_RAD / 2.0)
        wedge = np.array([(0.0, 0.0, 0.0), (-aside, 0.0, depth), (aside, 0.0, depth)])
        plan: Floats = ((wedge - self.t) @ self.rotation)[:, [0, 2]]
        (left, _, near), (right, _, far) = WALLS[0], WALLS[2]
        for wall in ((1, 0, -left), (-1, 0, right), (0, 1, -near), (0, -1, far)):
            plan = clip_half_plane(plan, wall)
        return np.insert(plan, 1, 0.0, axis=1)

    def seen(self, points: Floats) -> Floats:
        """World points (..., 3) in camera coordinates."""
        return world_to_camera(points, self.pose)


def standpoint(pan: float, camera_x: float, camera_z: float) -> Standpoint:
    """A camera at (camera_x, 0, camera_z), panned by so many degrees to the right."""
    R = from_axis_angle((0.0, 1.0, 0.0), math.radians(pan)).T
    return Standpoint(rigid_pose(R, -R @ np.array([camera_x, 0.0, camera_z])))
