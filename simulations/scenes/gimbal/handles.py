"""Handles of the gimbal: the beads of the rings, and the background."""

import math
from collections.abc import Mapping
from functools import partial

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.scenes._turned_camera.body import view_from
from simulations.scenes._turned_camera.turning import background, nearest, pair
from simulations.scenes.gimbal import rings
from simulations.scenes.gimbal.settings import Settings

TURNS = {"pan": 180, "tilt": 90, "roll": 180}
"""Range of each angle to both sides, in degrees."""


def _bead(index: int, settings: Settings, _outputs: Outputs) -> Point:
    ring = _rings(settings)[index]
    return pair(rings.on_screen(ring.at(ring.angle_rad), _view(settings)))


def _bead_pulled(index: int, settings: Settings, place: Point) -> Mapping[str, Value]:
    ring = _rings(settings)[index]
    limit = TURNS[ring.name]
    degrees = np.arange(-limit, limit + 1)
    track = rings.on_screen(ring.at(np.radians(degrees)), _view(settings))
    present = round(math.degrees(ring.angle_rad))
    distances = np.abs(np.remainder(degrees - present + 180, 360) - 180)
    return {ring.name: float(degrees[nearest(track, place, distances)])}


def _rings(settings: Settings) -> tuple[rings.Ring, rings.Ring, rings.Ring]:
    angles = (math.radians(value) for value in (settings.pan, settings.tilt, settings.roll))
    return rings.rings(*angles)


def _view(settings: Settings) -> Floats:
    return view_from(settings.azimuth, settings.elevation)


def _ring(index: int, name: str, role: str) -> Handle[Settings]:
    at, pull = partial(_bead, index), partial(_bead_pulled, index)
    return Handle(name, "gimbal", f"{name.capitalize()} ring", (name,), at, pull, role=role)


HANDLES: tuple[Handle[Settings], ...] = (
    _ring(1, "tilt", "light"),
    _ring(0, "pan", "world"),
    _ring(2, "roll", "ray"),
    background("gimbal"),
)
