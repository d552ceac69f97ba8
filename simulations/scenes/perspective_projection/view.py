"""The point and its house, and the camera of the figure, from perspective to orthography.

Full perspective has its centre at depth 0. From there the centre moves back while the focal length
grows, so that the plane at `REFERENCE_DEPTH_M` keeps its size in the picture: a dolly zoom. With
the centre at infinity, the rays are parallel: scaled orthography.

The point is the top of the white ball in the room, through which the camera moves.
"""

import math
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats, Mask
from simulations.models.light.soft_shadows import bounding_radius
from simulations.models.projection.affine_cameras import project_affine, scaled_orthographic_camera
from simulations.models.projection.pinhole import intrinsics, project, rigid_pose, world_to_camera
from simulations.world.furniture import HIGH, LOW
from simulations.world.still_life import OBJECTS
from simulations.world.surfaces import CHART

HALF_WIDTH_PX, HALF_HEIGHT_PX = 100.0, 75.0
"""Half the picture, in pixels from the principal point."""
METRES_PER_PX = 0.03  # size of a pixel of the image plane, as drawn
REFERENCE_DEPTH_M = 5.0
"""Depth of the plane whose image is the same in perspective and in orthography."""

NEAR_M = 0.05
"""Parts nearer than this to the plane of the centre are not drawn: their image is too far off."""

BALL = next(item.solid for item in OBJECTS if item.name == "pearl")
TOP = np.array([*BALL.centre[:2], BALL.centre[2] + bounding_radius(BALL)])
"""The point: the top of the white ball, metres in the room's world."""


@dataclass(frozen=True, slots=True)
class Camera:
    """The camera between perspective and orthography."""

    focal_px: float
    """Focal length of full perspective."""
    perspective: float
    """1 is full perspective, 0 orthography: the depth of the reference plane over its distance from
    the centre."""

    @property
    def parallel(self) -> bool:
        """Whether the rays are parallel."""
        return self.perspective == 0.0

    @property
    def centre_m(self) -> float:
        """Depth of the centre, 0 or negative; −∞ for parallel rays."""
        if self.parallel:
            return -math.inf
        return REFERENCE_DEPTH_M - REFERENCE_DEPTH_M / self.perspective

    @property
    def plane_m(self) -> float:
        """Depth of the image plane; −∞ for parallel rays."""
        if self.parallel:
            return -math.inf
        return self.centre_m + self.focal_px * METRES_PER_PX / self.perspective

    def project(self, points: Floats) -> tuple[Floats, Mask]:
        """Pixels (..., 2) from the principal point of points (..., 3), and which have one."""
        if self.parallel:
            K = intrinsics(self.focal_px, (0.0, 0.0))
            return project_affine(points, scaled_orthographic_camera(K, REFERENCE_DEPTH_M))
        K = intrinsics(self.focal_px / self.perspective, (0.0, 0.0))
        return project(points - np.array([0.0, 0.0, self.centre_m]), K)

    def size_at(self, Z: float) -> float:
        """Pixels per metre at a depth; infinite at the centre itself."""
        if self.centre_m == Z:
            return math.inf
        per_m = self.focal_px / REFERENCE_DEPTH_M
        return per_m / (1.0 + self.perspective * (Z / REFERENCE_DEPTH_M - 1.0))


@dataclass(frozen=True, slots=True, kw_only=True)
class Projection:
    """A point, the camera, and the point's image."""

    X: float
    """Metres to the right."""
    Y: float
    """Metres down."""
    Z: float
    """Metres along the optical axis from the centre of full perspective."""
    camera: Camera
    x: float
    """Pixels right of the principal point; NaN where there is no image."""
    y: float
    """Pixels below the principal point; NaN where there is no image."""
    visible: bool
    """Whether the point has an image."""

    @property
    def full(self) -> bool:
        """Whether the camera is full perspective."""
        return self.camera.perspective == 1.0

    @property
    def in_picture(self) -> bool:
        """Whether the image falls within the edges of the picture."""
        return self.visible and in_picture(self.x, self.y)

    @property
    def formula_only(self) -> tuple[float, float]:
        """x = f X / Z, also for points behind the camera; Z must not be 0."""
        return self.camera.focal_px * self.X / self.Z, self.camera.focal_px * self.Y / self.Z

    @property
    def off_px(self) -> float:
        """Pixels from the image in full perspective; Z must be positive."""
        x, y = self.formula_only
        return math.hypot(self.x - x, self.y - y)


def in_picture(x: float, y: float) -> bool:
    """Whether pixel (x, y), counted from the principal point, lies in the picture."""
    return abs(x) <= HALF_WIDTH_PX and abs(y) <= HALF_HEIGHT_PX


def projection_of(X: float, Y: float, Z: float, camera: Camera) -> Projection:
    """Project the point (X, Y, Z). Depth is rounded to the millimetre, so that Z = 0 is exact."""
    Z = round(Z, 3)
    pixels, valid = camera.project(np.array([X, Y, Z]))
    return Projection(
        X=X, Y=Y, Z=Z, camera=camera, x=float(pixels[0]), y=float(pixels[1]), visible=bool(valid)
    )


def room_axes(view: Projection) -> Floats:
    """The pose (4, 4) of full perspective in the room: it looks straight at the wall, and the
    top of the white ball is at (X, Y, Z)."""
    R = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    return rigid_pose(R, np.array([view.X, view.Y, view.Z]) - R @ TOP)


def outline(view: Projection, camera: Camera) -> list[Floats]:
    """Pixels of the edges of the room and of the chart through another camera: lines (n, 2)."""
    (left, _, floor), (right, wall, ceiling) = LOW, HIGH
    near = TOP[1] - (view.Z - camera.centre_m - NEAR_M)
    corners = [(left, floor), (right, floor), (right, ceiling), (left, ceiling)]
    x, z, wide, high = CHART
    sheet = [(x + a * wide / 2, z + b * high / 2) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    lines = [[(u, near, v), (u, wall, v)] for u, v in corners]
    lines += [[(u, wall, v) for u, v in (*ring, ring[0])] for ring in (corners, sheet)]
    return [camera.project(world_to_camera(line, room_axes(view)))[0] for line in lines]
