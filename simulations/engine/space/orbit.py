"""A space that a reader turns like a globe: two settings, and the handle of the panel's ground.

    azimuth: float = slider("View azimuth", 51, -180, 180, 1, unit="°")
    elevation: float = slider("View elevation", 28, -90, 90, 1, unit="°")
    ...
    handles=(turning("space"),)

A scene draws with `view.orbit(settings.azimuth, settings.elevation)`.
"""

from collections.abc import Callable, Mapping
from typing import Protocol

from simulations.engine.handles import Handle, Point

UNITS_PER_DEGREE = 2.0
"""Drag, in view box units."""


class ViewSettings(Protocol):
    """Settings with the direction of the eye, in degrees."""

    @property
    def azimuth(self) -> float: ...
    @property
    def elevation(self) -> float: ...


def turning[S: ViewSettings](panel: str) -> Handle[S]:
    """The handle of a panel's ground, by mouse, finger and arrow keys: near points follow."""

    def eye(settings: ViewSettings, _outputs: object) -> Point:
        return UNITS_PER_DEGREE * settings.azimuth, UNITS_PER_DEGREE * settings.elevation

    def eye_pulled(_settings: ViewSettings, place: Point) -> Mapping[str, float]:
        turn, tilt = (value / UNITS_PER_DEGREE for value in place)
        return {"azimuth": (turn + 180.0) % 360.0 - 180.0, "elevation": tilt}

    at: Callable[..., Point] = eye
    pull: Callable[..., Mapping[str, float]] = eye_pulled
    drives = ("azimuth", "elevation")
    return Handle("view", panel, "View", drives, at, pull, reach="drag", reversed=("elevation",))
