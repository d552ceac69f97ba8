"""The view of the camera.

The lens is one of medium format that does not breathe: the picture keeps its size as the focus
moves, so that only the discs of confusion change.
"""

import numpy as np

from simulations.models.arrays import Floats
from simulations.scenes._still_life_camera.focus_plane import floor_tangent

WIDTH, HEIGHT = 800.0, 400.0
"""View box of the picture."""
FOCAL_MM, FILM_WIDTH_MM = 80.0, 76.0
UNITS_PER_TANGENT = WIDTH * FOCAL_MM / FILM_WIDTH_MM
"""View box units per tangent of the angle from the axis."""


def tangents(place: tuple[float, float]) -> tuple[float, float]:
    """Tangents to the right and down of a place of the view box."""
    return (place[0] - WIDTH / 2) / UNITS_PER_TANGENT, (place[1] - HEIGHT / 2) / UNITS_PER_TANGENT


def floor_row(depth: float) -> float:
    """Row of the view box in which the floor is ``depth`` metres away."""
    return HEIGHT / 2 + UNITS_PER_TANGENT * floor_tangent(depth)


def disc_width(aperture: float, focus: float, depth: Floats | float) -> Floats:
    """Width of the disc of confusion of points ``depth`` metres away, in widths of the picture."""
    opening_m = FOCAL_MM / aperture / 1000.0
    return opening_m * FOCAL_MM / FILM_WIDTH_MM * np.abs(1.0 / np.asarray(depth) - 1.0 / focus)
