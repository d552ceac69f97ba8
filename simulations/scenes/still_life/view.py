"""The view of the camera, and where its plane of focus cuts the floor.

The lens is one of medium format that does not breathe: the picture keeps its size as the focus
moves, so that only the discs of confusion change.
"""

import numpy as np

from simulations.models.arrays import Floats
from simulations.pictures.still_life import things as still_life

WIDTH, HEIGHT = 800.0, 400.0
"""View box of the picture."""
FOCAL_MM, FILM_WIDTH_MM = 80.0, 76.0
UNITS_PER_TANGENT = WIDTH * FOCAL_MM / FILM_WIDTH_MM
"""View box units per tangent of the angle from the axis."""
HANDLE_TANGENT = 0.095
"""Column of the handle, to the right of the axis: a lane of floor that is free up to the wall."""
UP = still_life.WORLD_TO_CAMERA[:3, 2]
"""The vertical in the camera's frame."""


def tangents(place: tuple[float, float]) -> tuple[float, float]:
    """Tangents to the right and down of a place of the view box."""
    return (place[0] - WIDTH / 2) / UNITS_PER_TANGENT, (place[1] - HEIGHT / 2) / UNITS_PER_TANGENT


def floor_row(depth: float) -> float:
    """Row of the view box in which the floor is ``depth`` metres away."""
    down = -(still_life.EYE[2] / depth + UP[2]) / UP[1]
    return float(HEIGHT / 2 + UNITS_PER_TANGENT * down)


def floor_depth(row: float) -> float:
    """Depth of the floor in a row of the view box, metres; ∞ from the horizon upwards."""
    falling = -UP[1] * (row - HEIGHT / 2) / UNITS_PER_TANGENT - UP[2]
    return float(still_life.EYE[2] / falling) if falling > 0 else np.inf


def disc_width(aperture: float, focus: float, depth: Floats | float) -> Floats:
    """Width of the disc of confusion of points ``depth`` metres away, in widths of the picture."""
    opening_m = FOCAL_MM / aperture / 1000.0
    return opening_m * FOCAL_MM / FILM_WIDTH_MM * np.abs(1.0 / np.asarray(depth) - 1.0 / focus)
