"""The ball on the floor: the light that it gets from the lamp, the floor and the wall.

It is small, so it is left out of the light between the planes; the light that it keeps from these
or adds to them is computed from its form factors.
"""

import math
from functools import cache

import numpy as np

from simulations.models.arrays import Floats
from simulations.scenes.second_bounce.room import CENTRE, RADIUS, Surface, behind_wall, struck

NORMALS = 240
WAYS = 8
"""Directions per normal: `WAYS` squared."""
DEGREE = 5
"""Degree in x, y and z of the polynomial that is fitted to the light of the normals."""


@cache
def normals() -> Floats:
    """(NORMALS, 3) unit vectors, evenly over the sphere."""
    step = np.arange(NORMALS) + 0.5
    up, turn = 1.0 - 2.0 * step / NORMALS, math.pi * (1.0 + math.sqrt(5.0)) * step
    flat = np.sqrt(1.0 - up * up)
    return np.stack([flat * np.cos(turn), up, flat * np.sin(turn)], axis=-1).astype(np.float32)


@cache
def ways() -> Floats:
    """(NORMALS, WAYS², 3) directions from each point, weighted by the cosine to its normal."""
    share = (np.arange(WAYS) + 0.5) / WAYS
    square, turn = (each.ravel() for each in np.meshgrid(share, 2.0 * math.pi * share))
    flat, up = np.sqrt(square), np.sqrt(1.0 - square)
    normal = normals()[:, None]
    aside = np.cross(normal, np.where(np.abs(normal[..., 1:2]) < 0.9, [0.0, 1, 0], [1.0, 0, 0]))
    aside /= np.linalg.norm(aside, axis=-1, keepdims=True)
    over = np.cross(normal, aside)
    turned = np.cos(turn)[:, None] * aside + np.sin(turn)[:, None] * over
    return np.asarray(flat[:, None] * turned + up[:, None] * normal, np.float32)


def surroundings(opening_rad: float) -> Surface:
    """(NORMALS, WAYS²) what the points of the ball see."""
    starts = np.broadcast_to((CENTRE + RADIUS * normals())[:, None], ways().shape)
    return struck(starts, ways(), opening_rad)


def lamp_on(normal: Floats, light_rad: float, opening_rad: float) -> Floats:
    """(...) irradiance by the lamp of the points with normals (..., 3)."""
    cosine = normal[..., 0] * math.cos(light_rad) + normal[..., 1] * math.sin(light_rad)
    hidden = behind_wall(CENTRE + RADIUS * normal, light_rad, opening_rad)
    return np.where(hidden, 0.0, np.maximum(cosine, 0.0))


def basis(normal: Floats) -> Floats:
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
def fit() -> Floats:
    """(terms, NORMALS) from light at the normals to its polynomial."""
    return np.linalg.pinv(basis(normals()))


def form_factor(places: Floats, off: Floats) -> Floats:
    """(...) share of the view from places (..., 3) that the ball fills.

    ``off`` is the normal there; the ball lies wholly above the horizon.
    """
    away = CENTRE - places
    square = (away * away).sum(axis=-1)
    return np.asarray(np.minimum(RADIUS**2 * (away @ off) / square**1.5, 1.0))


def through(places: Floats) -> Floats:
    """(N, 16, 3) unit vectors from places (N, 3) to points inside the ball."""
    inside = CENTRE + 0.85 * RADIUS * normals()[:: NORMALS // 16]
    away = inside - places[:, None]
    return np.asarray(away / np.linalg.norm(away, axis=-1, keepdims=True))


def seen_side(places: Floats) -> Floats:
    """(N, NORMALS) weights of the points of the ball in its view from places (N, 3)."""
    away = places - CENTRE
    distance = np.linalg.norm(away, axis=-1, keepdims=True)
    weights = np.maximum(away @ normals().T / distance - 0.95 * RADIUS / distance, 0.0)
    return np.asarray(weights / weights.sum(axis=-1, keepdims=True))
