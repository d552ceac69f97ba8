"""A camera that shows its orientation, drawn back to front from flat faces; and places on rings.

World and camera axes are x right, y down, z forward. The camera's axes are the columns of C =
Ry(pan) Rx(tilt) Rz(roll): pan to the right, tilt upwards, roll to the right.
"""

import math
from functools import cache

import numpy as np

from simulations.engine.handles import Point
from simulations.engine.space.solids import Face, draw_solids, shaded
from simulations.engine.space.view import View, orbit_axes
from simulations.models.arrays import Floats

_TOWARDS_LIGHT = np.array([0.25, -0.86, 0.45])
"""Unit vector in the world: above and a little ahead."""
_LENS_SIDES, _LENS_RADIUS, _LENS_END = 10, 0.3, 0.82
CLOSE = 3.0
"""Distance within which two places of a ring, seen nearly edge on, count as equal."""


def view_from(azimuth: float, elevation: float) -> Floats:
    """World to view (3, 3) of a distant eye: x right, y down, z away.

    Azimuth and elevation of the eye are in degrees, from straight ahead to the right, and upwards.
    """
    return orbit_axes(azimuth, elevation, z_down=True)[:, [1, 2, 0]]


def _box(low: tuple[float, float, float], high: tuple[float, float, float]) -> list[Floats]:
    """Six faces (4, 3) between two corners."""
    faces = []
    for axis in range(3):
        across, along = (other for other in range(3) if other != axis)
        for level in (low[axis], high[axis]):
            face = np.full((4, 3), level)
            face[:, across] = [low[across], high[across], high[across], low[across]]
            face[:, along] = [low[along], low[along], high[along], high[along]]
            faces.append(face)
    return faces


def _lens() -> tuple[list[Floats], Floats]:
    """The sides (4, 3) of the barrel, and the glass at its end."""
    turns = 2 * math.pi * np.arange(_LENS_SIDES + 1) / _LENS_SIDES
    near, far = (
        np.stack([_LENS_RADIUS * np.cos(turns), _LENS_RADIUS * np.sin(turns), 0 * turns + z], -1)
        for z in (0.3, _LENS_END)
    )
    sides = [np.array([near[i], near[i + 1], far[i + 1], far[i]]) for i in range(_LENS_SIDES)]
    return sides, far[:-1]


BARREL, GLASS = _lens()
VIEWFINDER = _box((-0.22, -0.56, -0.18), (0.22, -0.36, 0.26))  # this side is up
BUTTON = _box((0.4, -0.44, -0.05), (0.54, -0.36, 0.13))  # this side is right
BODY: tuple[Floats, ...] = (
    *_box((-0.62, -0.36, -0.22), (0.62, 0.4, 0.3)),
    *VIEWFINDER,
    *BUTTON,
    *BARREL,
)
"""Corners (n, 3) of each face in camera axes; half the width of the body is 0.62."""


def draw_body(C: Floats, view: Floats, centre: tuple[float, float], unit: float) -> str:
    """SVG markup of the camera whose axes are the columns of ``C`` (3, 3), of a length ``unit``.

    C may be any matrix: a blend that is not a rotation shows as a distorted camera.
    """
    look = View(view, centre, unit)
    roles = [*((face, "camera") for face in BODY), (GLASS, "image")]
    turned = [(face @ C.T, role) for face, role in roles]
    faces = [Face(face, role, shaded(face, look, _TOWARDS_LIGHT)) for face, role in turned]
    return draw_solids(faces, look)


@cache
def body_from_above(place: Point, aim: Point, unit: float) -> str:
    """The camera at a place of a plan, turned to another."""
    length = math.dist(place, aim)
    across, along = (aim[0] - place[0]) / length, (aim[1] - place[1]) / length
    C = np.array([(-along, 0.0, across), (across, 0.0, along), (0.0, 1.0, 0.0)])
    return draw_body(C, np.eye(3), place, unit)


def nearest(track: Floats, place: Point, distances: Floats) -> int:
    """The index of the nearest place of a track (n, 2…); of equal ones, that with the least
    ``distances``.

    The front and the back of a ring seen edge on have the same places; the handle does not jump
    from one to the other.
    """
    off = np.hypot(track[:, 0] - place[0], track[:, 1] - place[1])
    close = np.flatnonzero(off <= off.min() + CLOSE)
    index = int(close[np.argmin(distances[close])])
    while True:
        around = range(max(index - 1, 0), min(index + 2, len(off)))
        best = min(around, key=lambda i: float(off[i]))
        if off[best] >= off[index]:
            return index
        index = best
