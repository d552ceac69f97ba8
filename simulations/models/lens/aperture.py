"""Points on a lens for sampling by rays: on a spiral, random, or random within cells.

Szeliski, 2nd ed., section 2.2.3; H. Vogel, *A better way to construct the sunflower head*, 1979;
Cook, Porter and Carpenter, "Distributed ray tracing", SIGGRAPH 1984.
"""

import math

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.require import as_whole

GOLDEN_ANGLE_RAD = np.pi * (3.0 - np.sqrt(5.0))


def fibonacci_disc(count: int) -> Floats:
    """(count, 2) points of a sunflower spiral on the unit disc, each for the same area.

    Raises `ValueError` for a count below 1. A single point is off the centre, at radius √½.
    """
    count = as_whole("count", count, 1)
    index = np.arange(count)
    radius, angle = np.sqrt((index + 0.5) / count), index * GOLDEN_ANGLE_RAD
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)


def random_disc(count: int, shape: tuple[int, ...], rng: np.random.Generator) -> Floats:
    """(count, 2, *shape) points, uniform on the unit disc and independent of one another."""
    count = as_whole("count", count, 1)
    return _on_disc(*(rng.random((count, *shape), dtype=np.float32) for _ in range(2)))


def jittered_disc(
    rings: int, parts: int, shape: tuple[int, ...], rng: np.random.Generator
) -> Floats:
    """(rings × parts, 2, *shape) points on the unit disc: a random one in each cell.

    The cells are rings of equal area, each cut into as many equal parts. Raises `ValueError` for no
    ring or no part.
    """
    rings, parts = as_whole("rings", rings, 1), as_whole("parts", parts, 1)
    ring, part = (
        cell.reshape(-1, *(1 for _ in shape)) for cell in np.indices((rings, parts), np.float32)
    )
    area, turn = rng.random((2, rings * parts, *shape), dtype=np.float32)
    return _on_disc((ring + area) / rings, (part + turn) / parts)


def turned_disc(points: Floats, shape: tuple[int, ...], rng: np.random.Generator) -> Floats:
    """The ``points`` (count, 2) as (count, 2, *shape): rotated together, by a different angle at
    each place of ``shape``."""
    angle = np.float32(2 * np.pi) * rng.random(shape, dtype=np.float32)
    x, y = np.asarray(points, np.float32).T.reshape(2, -1, *(1 for _ in shape))
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.stack([x * cosine - y * sine, x * sine + y * cosine], axis=1)


def _on_disc(area: Floats, turn: Floats) -> Floats:
    """Points (count, 2, ...) at shares (count, ...) of the disc's area, outwards, and of a turn."""
    radius, angle = np.sqrt(area), np.float32(2 * np.pi) * turn
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


type Point = tuple[float, float]
"""(right, down) in the unit disc."""

GOLDEN_RATIO = (1.0 + math.sqrt(5.0)) / 2.0


def aperture_grid(across: int) -> tuple[Point, ...]:
    """The points of an ``across`` by ``across`` grid that lie in the unit disc.

    They are ordered so that any first few of them are spread over the disc. Raises `ValueError` for
    a grid of no points.
    """
    across = as_whole("across", across, 1)
    places = [(2 * index + 1) / across - 1 for index in range(across)]
    inside = [(x, y) for y in places for x in places if x * x + y * y <= 1.0]
    stride = _coprime_near(len(inside) / GOLDEN_RATIO, len(inside))
    return tuple(inside[index * stride % len(inside)] for index in range(len(inside)))


def _coprime_near(wanted: float, modulus: int) -> int:
    candidates = (step for step in range(1, modulus + 1) if math.gcd(step, modulus) == 1)
    return min(candidates, key=lambda step: abs(step - wanted))
