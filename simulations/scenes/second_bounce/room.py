"""The room of the second-bounce figure: a closed cube with a white ball and a lamp that turns.

The axis x runs to the right, y upwards and z towards the camera, from 0 to 1. The camera stands
outside and looks through the near wall, which reflects light like the others. The ball is small:
it is left out of the light between the walls, but gets light from them, and hides some from them.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.light.interreflection import CELLS

SIZE = 340  # of the picture, in view box units
EYE: Floats = np.array([0.5, 0.56, 2.3])  # the near wall fills the picture
LAMP: Floats = np.array([0.5, 0.9, 0.5])
RADIUS = 0.15
CENTRE: Floats = np.array([0.64, RADIUS, 0.36])
LINE = 0.74  # the z of the line on which the curves and the chosen point are
BRIGHT, DARK = math.cos(math.radians(15)), math.cos(math.radians(24))
"""Within the first angle around its axis the lamp has its full light, beyond the second none."""
SAMPLES = 4  # along a patch's side, for the mean of the lamp's light, or of the ball's view
FINER = 72  # steps along a wall between which the walls' own light is not interpolated


@dataclass(frozen=True, slots=True)
class Places:
    """Points of walls or ball, and the lamp's light there."""

    lit: Floats  # (N,) irradiance by the lamp if it pointed at them
    ways: Floats  # (N, 3) unit vectors from the lamp

    def by_lamp(self, light_angle: float) -> Floats:
        """(N,) irradiance by the lamp: 1 at a distance of 1, for a surface that faces it."""
        turn = math.radians(light_angle)
        inward = self.ways[:, :2] @ np.array([-math.cos(turn), -math.sin(turn)], np.float32)
        share = np.clip((inward - DARK) / (BRIGHT - DARK), 0.0, 1.0)
        return np.asarray(self.lit * share * share * (3.0 - 2.0 * share))


@dataclass(frozen=True, slots=True)
class View:
    """What the camera sees in each pixel."""

    places: Places
    wall: NDArray[np.intp]  # (N,) number of the wall; 6 for the ball
    index: NDArray[np.intp]  # (N,) of the place in the finer tables of the walls
    hidden: Floats  # (N,) form factor of the ball
    ball: NDArray[np.intp]  # the pixels of the ball
    basis: Floats  # (M, 9) polynomial of their normals
    borders: NDArray[np.intp]  # the pixels between two walls, or at the ball's rim
    around: NDArray[np.intp]  # (5, borders) these and their neighbours


def places_of(points: Floats, normals: Floats) -> Places:
    """The ball's shadow is part of it: the lamp turns, but stays in its place."""
    ways = points - LAMP
    distance = np.linalg.norm(ways, axis=-1)
    ways /= distance[:, None]
    facing = -np.einsum("ni,ni->n", ways, normals)
    middle = CENTRE - LAMP
    ahead = ways @ middle
    off = np.sqrt(np.maximum(middle @ middle - ahead * ahead, 0.0))
    past = distance > ahead + 1e-9  # on the far side of the ball, or on its own dark side
    shadow = np.clip((RADIUS - off) / 0.006 + 0.5, 0.0, 1.0) * past
    lit = np.maximum(facing, 0.0) / (distance * distance) * (1.0 - shadow)
    return Places(lit.astype(np.float32), ways.astype(np.float32))


def of_wall(wall: int, first: Floats, second: Floats) -> tuple[Floats, Floats]:
    """Points (N, 3) of a wall at two coordinates, and its normals."""
    axis, end = divmod(wall, 2)
    points = np.insert(np.stack([first, second], axis=-1), axis, float(end), axis=-1)
    return points, np.tile(np.eye(3)[axis] * (1 - 2 * end), (len(points), 1))


@cache
def samples(side: int) -> tuple[Floats, Floats]:
    """Midpoints (6 · side², 3) of ``side``² squares on each wall, and the normals there."""
    middles = (np.arange(side) + 0.5) / side
    first, second = (each.ravel() for each in np.meshgrid(middles, middles, indexing="ij"))
    walls = [of_wall(wall, first, second) for wall in range(6)]
    points, normals = zip(*walls, strict=True)
    return np.concatenate(points), np.concatenate(normals)


@cache
def sampled() -> Places:
    """`SAMPLES`² points of each patch."""
    return places_of(*samples(CELLS * SAMPLES))


@cache
def line(count: int) -> tuple[Places, NDArray[np.intp]]:
    """Down the left wall and along the floor at `LINE`, and their indices in the finer tables."""
    along = np.linspace(0.0, 1.0, count)
    depth = np.full(count, LINE)
    ends = ((0, along[::-1]), (2, along))  # the wall, by y and z; the floor, by x and z
    walls = [of_wall(wall, place, depth) for wall, place in ends]
    points, normals = (np.concatenate(each) for each in zip(*walls, strict=True))
    return places_of(points, normals), np.concatenate([index_of(w, p, depth) for w, p in ends])


def index_of(wall: int | NDArray[np.intp], first: Floats, second: Floats) -> NDArray[np.intp]:
    """Index of a place of a wall in the finer tables (6 · (FINER + 1)²)."""
    row, column = (np.rint(FINER * each).astype(np.intp) for each in (first, second))
    return np.asarray((wall * (FINER + 1) + row) * (FINER + 1) + column)


@cache
def finer_weights() -> Floats:
    """(FINER + 1, CELLS) from the patches along a wall to its finer steps: quadratic splines."""
    steps = CELLS * np.linspace(0.0, 1.0, FINER + 1)[:, None]
    off = np.abs(steps - 0.5 - np.arange(-1, CELLS + 1))
    weights = np.where(off < 0.5, 0.75 - off**2, 0.5 * np.maximum(1.5 - off, 0.0) ** 2)
    for end, next_one, beyond in ((1, 2, 0), (-2, -3, -1)):  # a straight line beyond the ends
        weights[:, end] += 2.0 * weights[:, beyond]
        weights[:, next_one] -= weights[:, beyond]
    return weights[:, 1:-1]


def project(place: tuple[float, float, float]) -> tuple[float, float]:
    """The place in the picture of a place in the room."""
    share = (EYE[2] - 1.0) / (EYE[2] - place[2])
    x, y = (float(EYE[k] + share * (place[k] - EYE[k])) for k in (0, 1))
    return SIZE * x, SIZE * (1.0 - y)


@cache
def view(side: int) -> View:
    """The picture of ``side`` pixels each way, found once."""
    steps = (np.arange(side) + 0.5) / side
    x, y = (each.ravel() for each in np.meshgrid(steps, 1.0 - steps))
    ways = np.stack([x, y, np.ones_like(x)], axis=-1) - EYE
    with np.errstate(divide="ignore"):
        reach = (np.where(ways < 0, 0.0, 1.0) - EYE) / ways
    reach[:, 2] = EYE[2] / -ways[:, 2]
    axis = reach.argmin(axis=-1)
    points = np.clip(EYE + reach.min(axis=-1)[:, None] * ways, 0.0, 1.0)
    ends = np.take_along_axis(ways, axis[:, None], 1)[:, 0] > 0
    normals = np.eye(3)[axis] * np.where(ends, -1.0, 1.0)[:, None]
    others = np.array([[1, 2], [0, 2], [0, 1]])[axis]
    first, second = np.take_along_axis(points, others, 1).T
    wall = 2 * axis + ends
    index = index_of(wall, first, second)
    ways /= np.linalg.norm(ways, axis=-1, keepdims=True)
    middle = CENTRE - EYE
    along = ways @ middle
    inside = RADIUS**2 - (middle @ middle - along * along)
    ball = np.flatnonzero(inside > 0)
    points[ball] = EYE + (along[ball] - np.sqrt(inside[ball]))[:, None] * ways[ball]
    normals[ball] = (points[ball] - CENTRE) / RADIUS
    wall[ball] = 6
    away = CENTRE - points
    square = np.maximum((away * away).sum(axis=-1), RADIUS**2)
    hidden = RADIUS**2 * np.maximum((away * normals).sum(axis=-1), 0.0) / square**1.5
    hidden[ball] = 0.0
    borders, around = border_of(wall.reshape(side, side))
    return View(
        places_of(points, normals),
        wall,
        index,
        hidden.astype(np.float32),
        ball,
        polynomial(normals[ball]).astype(np.float32),
        borders,
        around,
    )


def border_of(wall: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The pixels with a neighbour on another wall, and each of them with its four neighbours."""
    number = np.pad(np.arange(wall.size).reshape(wall.shape), 1, mode="edge")
    around = np.stack([np.roll(number, step, axis).ravel() for step, axis in neighbours()])
    around = around.reshape(5, *number.shape)[:, 1:-1, 1:-1].reshape(5, -1)
    borders = np.flatnonzero((wall.ravel()[around] != wall.ravel()).any(axis=0))
    return borders, around[:, borders]


def neighbours() -> Iterator[tuple[int, int]]:
    yield from ((0, 0), (1, 0), (-1, 0), (1, 1), (-1, 1))


def polynomial(normals: Floats) -> Floats:
    """(N, 9) the terms of second degree of unit vectors, by which soft light is described."""
    one_and = np.concatenate([np.ones((len(normals), 1)), normals], axis=-1)
    rows, columns = np.triu_indices(4)
    return np.asarray(one_and[:, rows[:-1]] * one_and[:, columns[:-1]])  # z² is 1 − x² − y²


@cache
def light_on_ball() -> Floats:
    """(9, 6 · CELLS²) from the brightness of the patches to the polynomial of its irradiance."""
    points, facing = samples(CELLS * SAMPLES)
    ways = points - CENTRE
    distance = np.linalg.norm(ways, axis=-1)
    ways /= distance[:, None]
    size = np.abs(np.einsum("ni,ni->n", ways, facing)) / (CELLS * SAMPLES * distance) ** 2
    some, _ = samples(4)
    normals = (some - 0.5) / np.linalg.norm(some - 0.5, axis=-1, keepdims=True)
    shares = np.maximum(normals @ ways.T, 0.0) * (size / math.pi)
    patches = shares.reshape(-1, 6, CELLS, SAMPLES, CELLS, SAMPLES).sum(axis=(3, 5))
    return np.linalg.pinv(polynomial(normals)) @ patches.reshape(len(normals), -1)
