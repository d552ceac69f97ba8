"""The room of the second-bounce figure: floor, wall, a ball on the floor, and a camera.

The axis x runs along the floor from the edge, y upwards, and z along the edge. Lengths are in
widths of a plane. The planes are infinitely long; the picture shows a part. The ball is small, so
it is left out of the light between the planes; the light that it keeps from these or adds to them
is computed from its form factors.
"""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats, Mask

WIDTH, HEIGHT = 400, 320
RADIUS = 0.17
CENTRE: Floats = np.array([0.5, RADIUS, -0.15], np.float32)
"""The ball. Neither it nor its shadow touches the line of the curves."""
LINE = 0.3  # the z of the line on which the curves and the chosen point are
BACK, FRONT = -1.35, 0.8  # the z of the ends of what is visible of the planes
EYE: Floats = np.array([2.2, 1.0, 1.75], np.float32)
TARGET: Floats = np.array([0.42, 0.37, -0.1], np.float32)
FOCAL = 420.0  # in units of the view box
PARTS = 800  # steps along a plane in a table of brightness
NOTHING = 2 * (PARTS + 1)  # index in such a table of what is neither floor nor wall
NORMALS = 240  # of the ball
WAYS = 8  # directions per normal: `WAYS` squared
DEGREE = 5  # in x, y and z, of the polynomial that is fitted to the light of the normals


@dataclass(frozen=True, slots=True)
class Surface:
    """Places on floor and wall."""

    index: NDArray[np.intp]  # (...) indices into tables: of the floor, of the wall, then `NOTHING`
    floor: Mask  # (...) whether they are on the floor, or beyond its end
    places: Floats  # (..., 3) where they are; anything where there is nothing


@cache
def camera_axes() -> Floats:
    """(3, 3) right, up and forward of the camera, in rows."""
    forward = (TARGET - EYE) / np.linalg.norm(TARGET - EYE)
    right = np.cross(forward, (0.0, 1.0, 0.0))
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(right, forward), forward])


def project(place: tuple[float, float, float]) -> tuple[float, float]:
    """The place in the picture of a place in the room."""
    right, up, depth = (camera_axes() @ (np.array(place) - EYE)).tolist()
    return WIDTH / 2 + FOCAL * right / depth, HEIGHT / 2 - FOCAL * up / depth


@cache
def rays(fine: float) -> Floats:
    """(H, W, 3) unit vectors from the camera through the pixels, ``fine`` to a unit."""
    high, wide = round(HEIGHT * fine), round(WIDTH * fine)
    across = (np.arange(wide) + 0.5) / fine - WIDTH / 2
    up = HEIGHT / 2 - (np.arange(high) + 0.5) / fine
    right_axis, up_axis, forward = camera_axes()
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


@cache
def ball_normals() -> Floats:
    """(NORMALS, 3) unit vectors, evenly over the sphere."""
    step = np.arange(NORMALS) + 0.5
    up, turn = 1.0 - 2.0 * step / NORMALS, math.pi * (1.0 + math.sqrt(5.0)) * step
    flat = np.sqrt(1.0 - up * up)
    return np.stack([flat * np.cos(turn), up, flat * np.sin(turn)], axis=-1).astype(np.float32)


@cache
def ball_ways() -> Floats:
    """(NORMALS, WAYS², 3) directions from each point, weighted by the cosine to its normal."""
    share = (np.arange(WAYS) + 0.5) / WAYS
    square, turn = (each.ravel() for each in np.meshgrid(share, 2.0 * math.pi * share))
    flat, up = np.sqrt(square), np.sqrt(1.0 - square)
    normal = ball_normals()[:, None]
    aside = np.cross(normal, np.where(np.abs(normal[..., 1:2]) < 0.9, [0.0, 1, 0], [1.0, 0, 0]))
    aside /= np.linalg.norm(aside, axis=-1, keepdims=True)
    over = np.cross(normal, aside)
    turned = np.cos(turn)[:, None] * aside + np.sin(turn)[:, None] * over
    return np.asarray(flat[:, None] * turned + up[:, None] * normal, np.float32)


def surroundings(opening: float) -> Surface:
    """(NORMALS, WAYS²) what the points of the ball see."""
    starts = np.broadcast_to((CENTRE + RADIUS * ball_normals())[:, None], ball_ways().shape)
    return struck(starts, ball_ways(), math.radians(opening))


def lamp_on_ball(normal: Floats, light_rad: float, opening_rad: float) -> Floats:
    """(...) irradiance by the lamp of the points with normals (..., 3)."""
    cosine = normal[..., 0] * math.cos(light_rad) + normal[..., 1] * math.sin(light_rad)
    hidden = behind_wall(CENTRE + RADIUS * normal, light_rad, opening_rad)
    return np.where(hidden, 0.0, np.maximum(cosine, 0.0))


def polynomial_basis(normal: Floats) -> Floats:
    """(..., terms) the powers of x, y and z up to `DEGREE`."""
    x, y, z = np.moveaxis(normal, -1, 0)
    return np.stack(
        [
            x**i * y**j * z**k
            for i in range(DEGREE + 1)
            for j in range(DEGREE + 1 - i)
            for k in range(min(2, DEGREE + 1 - i - j))  # z² is 1 − x² − y²
        ],
        axis=-1,
    )


@cache
def polynomial_fit() -> Floats:
    """(terms, NORMALS) from light at the normals to its polynomial."""
    return np.linalg.pinv(polynomial_basis(ball_normals()))


def ball_form_factor(places: Floats, off: Floats) -> Floats:
    """(...) share of the view from places (..., 3) that the ball fills.

    ``off`` is the normal there; the ball lies wholly above the horizon.
    """
    away = CENTRE - places
    square = (away * away).sum(axis=-1)
    return np.asarray(np.minimum(RADIUS**2 * (away @ off) / square**1.5, 1.0))


def through_ball(places: Floats) -> Floats:
    """(N, 16, 3) unit vectors from places (N, 3) to points inside the ball."""
    inside = CENTRE + 0.85 * RADIUS * ball_normals()[:: NORMALS // 16]
    away = inside - places[:, None]
    return np.asarray(away / np.linalg.norm(away, axis=-1, keepdims=True))


def seen_side(places: Floats) -> Floats:
    """(N, NORMALS) weights of the points of the ball in its view from places (N, 3)."""
    away = places - CENTRE
    distance = np.linalg.norm(away, axis=-1, keepdims=True)
    weights = np.maximum(away @ ball_normals().T / distance - 0.95 * RADIUS / distance, 0.0)
    return np.asarray(weights / weights.sum(axis=-1, keepdims=True))
