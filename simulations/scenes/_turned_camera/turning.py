"""Handles on a curve in space, and rotation of the view by dragging the background.

The view rotates like a globe: near points follow the pointer.
"""

from collections.abc import Callable, Mapping
from typing import Protocol

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.models.arrays import Floats

UNITS_PER_DEGREE = 2.0
"""Drag of the background per degree, in view box units."""
CLOSE = 3.0
"""Distance within which two places of a ring, seen nearly edge on, count as equal."""


class ViewSettings(Protocol):
    """Settings with the direction of the eye, in degrees."""

    @property
    def azimuth(self) -> float: ...
    @property
    def elevation(self) -> float: ...


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


def pair(place: Floats) -> Point:
    """View box x and y of a place (2…,)."""
    return float(place[0]), float(place[1])


def _eye(settings: ViewSettings, _outputs: object) -> Point:
    return UNITS_PER_DEGREE * settings.azimuth, UNITS_PER_DEGREE * settings.elevation


def _eye_pulled(_settings: ViewSettings, place: Point) -> Mapping[str, Value]:
    turn, tilt = (value / UNITS_PER_DEGREE for value in place)
    return {"azimuth": (turn + 180.0) % 360.0 - 180.0, "elevation": tilt}


def background[S: ViewSettings](panel: str) -> Handle[S]:
    """The handle that turns the view of a panel."""
    at: Callable[..., Point] = _eye
    pull: Callable[..., Mapping[str, Value]] = _eye_pulled
    drives = ("azimuth", "elevation")
    return Handle("view", panel, "View", drives, at, pull, reach="drag", reversed=("elevation",))
