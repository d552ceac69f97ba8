"""A camera and a board, seen from outside: the example of the chapter, drawn in space.

Points are in camera coordinates, in squares of the board; the camera's image plane is drawn
enlarged, at the distance `FOCAL`.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from simulations.engine.drawing import line, polygon
from simulations.models.arrays import Floats
from simulations.models.projection.pinhole import intrinsics, look_at, project, world_to_camera

FOCAL_PX = 600.0
COLUMNS = np.array([(1200.0, -600.0, 2.0), (-600.0, 1200.0, 2.0)])
"""h₁ and h₂, in pixels from the principal point, as in the chapter's example."""
ALONG = COLUMNS / (FOCAL_PX, FOCAL_PX, 1.0)
"""K⁻¹h₁ and K⁻¹h₂."""
R1, R2 = ALONG / np.linalg.norm(ALONG, axis=1, keepdims=True)
ORIGIN = np.array([-0.6, -0.9, 3.6])
"""t: the corner of the board from which squares are counted."""
SQUARES, FOCAL = 3, 2.0
CENTRE = np.zeros(3)
OUTSIDE = look_at((8.0, 5.0, -3.5), (-0.2, 0.0, 3.0), (0.0, -1.0, 0.0))
LENSES = intrinsics(560.0, (200.0, 124.0))


def at(point: ArrayLike) -> Floats:
    """Where a point (3,) is drawn."""
    return project(world_to_camera(np.asarray(point, float), OUTSIDE), LENSES)[0]


def offset_from(point: ArrayLike, right: float, down: float) -> Floats:
    """So far from there, in units of the drawing."""
    return at(point) + np.array([right, down])


def corner(across: float, down: float) -> Floats:
    """X r₁ + Y r₂ + t."""
    return ORIGIN + across * R1 + down * R2


def pierced(direction: Floats) -> Floats:
    """Where a line from the centre meets the image plane."""
    return np.asarray(direction * FOCAL / direction[2], float)


def board() -> Iterator[str]:
    for k in range(SQUARES + 1):
        yield line(at(corner(k, 0)), at(corner(k, SQUARES)), "world thin")
        yield line(at(corner(0, k)), at(corner(SQUARES, k)), "world thin")


def image_plane(low: tuple[float, float], high: tuple[float, float]) -> str:
    (left, top), (right, bottom) = low, high
    frame = ((left, top), (right, top), (right, bottom), (left, bottom))
    return polygon([at((x, y, FOCAL)) for x, y in frame], "image fill thin")
