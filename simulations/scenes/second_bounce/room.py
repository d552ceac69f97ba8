"""The room of the second-bounce figure: floor, wall, a ball on the floor, and a camera.

The axis x runs along the floor from the edge, y upwards, and z along the edge. Lengths are in
widths of a plane. The planes are infinitely long; the picture shows a part.
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from simulations.engine.drawing import Point
from simulations.models.arrays import Floats, Mask

WIDTH, HEIGHT = 400, 320
DRAFT = "coarse"
"""The draft while lamp, opening or albedo is dragged."""
FINE, DRAFT_FINE = 1.4, 0.7
"""Raster pixels per unit of the view box."""
RADIUS = 0.17
CENTRE: Floats = np.array([0.5, RADIUS, -0.15], np.float32)
"""The ball. Neither it nor its shadow touches the line of the curves."""
LINE = 0.3
"""The z of the line on which the curves and the chosen point are."""
BACK, FRONT = -1.35, 0.8
"""The z of the ends of what is visible of the planes."""
EYE: Floats = np.array([2.2, 1.0, 1.75], np.float32)
TARGET: Floats = np.array([0.42, 0.37, -0.1], np.float32)
FOCAL = 420.0
"""Focal length in units of the view box."""
LAMP = (1.12, -0.7)
"""Drawn distance of the lamp from the edge, which it has in a vertical plane, and its z."""
PARTS = 800
"""Steps along a plane in a table of brightness."""
NOTHING = 2 * (PARTS + 1)
"""Index in such a table of what is neither floor nor wall."""


@dataclass(frozen=True, slots=True)
class Surface:
    """Places on floor and wall."""

    index: NDArray[np.intp]
    """(...) indices into tables: of the floor, of the wall, then `NOTHING`."""
    floor: Mask
    """(...) whether they are on the floor, or beyond its end."""
    places: Floats
    """(..., 3) where they are; anything where there is nothing."""


@cache
def _axes() -> Floats:
    """(3, 3) right, up and forward of the camera, in rows."""
    forward = (TARGET - EYE) / np.linalg.norm(TARGET - EYE)
    right = np.cross(forward, (0.0, 1.0, 0.0))
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(right, forward), forward])


def project(place: tuple[float, float, float]) -> tuple[float, float]:
    """The place in the picture of a place in the room."""
    right, up, depth = (_axes() @ (np.array(place) - EYE)).tolist()
    return WIDTH / 2 + FOCAL * right / depth, HEIGHT / 2 - FOCAL * up / depth


def on_floor(place: float) -> tuple[float, float]:
    """The chosen point."""
    return project((place, 0.0, LINE))


def lamp_at(angle_deg: float) -> tuple[float, float]:
    """The lamp above the floor; it is far away."""
    turn = math.radians(angle_deg)
    return project((LAMP[0] * math.cos(turn), LAMP[0] * math.sin(turn), LAMP[1]))


def nearest_place(point: Point) -> float:
    """The chosen point whose picture is nearest to a place of the panel."""
    places = np.linspace(0.0, 1.0, 201).tolist()
    return min(places, key=lambda place: math.dist(on_floor(place), point))


def nearest_angle(point: Point) -> float:
    """The angle of the lamp whose picture is nearest to a place of the panel."""
    return float(min(range(181), key=lambda angle: math.dist(lamp_at(angle), point)))


@cache
def rays(fine: float) -> Floats:
    """(H, W, 3) unit vectors from the camera through the pixels, ``fine`` to a unit."""
    high, wide = round(HEIGHT * fine), round(WIDTH * fine)
    across = (np.arange(wide) + 0.5) / fine - WIDTH / 2
    up = HEIGHT / 2 - (np.arange(high) + 0.5) / fine
    right_axis, up_axis, forward = _axes()
    found = FOCAL * forward + across[:, None] * right_axis + up[:, None, None] * up_axis
    return np.asarray(found / np.linalg.norm(found, axis=-1, keepdims=True), np.float32)


def wall_axes(opening_rad: float) -> tuple[Floats, Floats]:
    """Unit vectors up the wall, and from it towards the floor."""
    along = np.array([math.cos(opening_rad), math.sin(opening_rad), 0.0], np.float32)
    return along, np.array([along[1], -along[0], 0.0], np.float32)


def struck(starts: Floats, ways: Floats, opening_rad: float) -> Surface:
    """What rays (..., 3) from places between floor and wall, or on these, meet first."""
    along, off = wall_axes(opening_rad)
    with np.errstate(divide="ignore", invalid="ignore"):
        down, aside = ways[..., 1], ways @ off
        to_floor = np.where(down < 0, -starts[..., 1] / down, np.float32(np.inf))
        to_wall = np.where(aside < 0, -(starts @ off) / aside, np.float32(np.inf))
    floor = to_floor <= to_wall
    way = np.minimum(to_floor, to_wall)
    places = starts + np.where(np.isfinite(way), way, np.float32(0.0))[..., None] * ways
    share = np.where(floor, places[..., 0], places @ along)
    index = np.rint(PARTS * np.clip(share, 0.0, 1.0)).astype(np.intp)
    index += np.where(floor, 0, PARTS + 1)
    return Surface(np.where(np.isfinite(way) & (share <= 1.0), index, NOTHING), floor, places)


def shaded(places: Floats, light_rad: float, softness: float = 0.004) -> Floats:
    """Share (...) of the lamp's light that the ball keeps from places (..., 3)."""
    light = np.array([math.cos(light_rad), math.sin(light_rad), 0.0], np.float32)
    away = CENTRE - places
    ahead = away @ light
    off = np.sqrt(np.maximum((away * away).sum(axis=-1) - ahead * ahead, 0.0))
    return np.clip((RADIUS - off) / softness + 0.5, 0.0, 1.0) * (ahead > 0)


def behind_wall(places: Floats, light_rad: float, opening_rad: float) -> Mask:
    """Whether the wall stands between places (..., 3) in front of it and the lamp."""
    light = np.array([math.cos(light_rad), math.sin(light_rad), 0.0])
    along, off = wall_axes(opening_rad)
    towards = float(light @ off)
    if towards >= 0.0:
        return np.zeros(places.shape[:-1], bool)
    up = (places - (places @ off / towards)[..., None] * light) @ along
    return np.asarray(up < 1.0)
