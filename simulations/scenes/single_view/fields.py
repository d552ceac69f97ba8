"""Where pixels of the picture lie in the panels."""

import math
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.projection.single_view import SingleView
from simulations.scenes.single_view.lines import Drawn

WIDTH, HEIGHT = 400.0, 300.0
"""Size of every panel, in units."""
LOUPE_COLUMNS, LOUPE_ROWS = 40, 30
"""Pixels that the loupe shows."""
FARTHEST = 4.0
"""How far from the picture a vanishing point may lie to be in the field, in its longer side."""

type Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Field:
    """A part of the image plane that fills a panel."""

    size: tuple[int, int]
    """Of the picture, in pixels."""
    left: float
    top: float
    """The corner of the panel in pixels from the corner of the picture."""
    scale: float
    """Units to the pixel."""

    def place(self, pixel: Floats) -> Point:
        """Where a pixel lies in the panel."""
        x, y = (float(number) for number in pixel)
        return (x + 0.5 - self.left) * self.scale, (y + 0.5 - self.top) * self.scale

    def pixel(self, place: Point) -> Point:
        return self.pixel_x(place[0]) - 0.5, self.pixel_y(place[1]) - 0.5

    def pixel_x[N: (float, Floats)](self, x: N) -> N:
        """Pixels from the left border of the picture."""
        return x / self.scale + self.left

    def pixel_y[N: (float, Floats)](self, y: N) -> N:
        return y / self.scale + self.top


def whole(size: tuple[int, int]) -> Field:
    """The picture as large as the lead panel allows, in its middle."""
    return _holding(size, (0.0, 0.0), (float(size[0]), float(size[1])))


def around(lines: Drawn, view: SingleView | None) -> Field:
    """The picture and the vanishing points that are not too far from it.

    The borders are at multiples of a quarter of the picture, so that they mostly keep still while
    an end moves.
    """
    width, height = lines.size
    low, high = np.array([0.0, 0.0]), np.array([float(width), float(height)])
    middle, reach = high / 2.0, FARTHEST * max(width, height)
    for axis in range(3) if view is not None else ():
        point = finite_point(view, axis)
        if point is not None and np.abs(point - middle).max() < reach:
            low, high = np.minimum(low, point), np.maximum(high, point)
    quarter = np.array([width, height]) / 4.0
    low, high = np.floor(low / quarter - 0.4) * quarter, np.ceil(high / quarter + 0.4) * quarter
    return _holding(lines.size, (low[0], low[1]), (high[0], high[1]))


def finite_point(view: SingleView | None, axis: int) -> Floats | None:
    """The pixel (2,) of a vanishing point; none for one at infinity or nearly so."""
    if view is None:
        return None
    x, y, w = view.vanishing[axis]
    limit = 1e3 * view.diagonal
    if abs(w) * limit <= math.hypot(x, y):
        return None
    return np.array([x / w, y / w])


def _holding(size: tuple[int, int], low: Point, high: Point) -> Field:
    """The smallest field with the shape of the panel that holds a box of the image plane."""
    scale = min(WIDTH / (high[0] - low[0]), HEIGHT / (high[1] - low[1]))
    left = (low[0] + high[0] - WIDTH / scale) / 2.0
    top = (low[1] + high[1] - HEIGHT / scale) / 2.0
    return Field(size, float(left), float(top), float(scale))
