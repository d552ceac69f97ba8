"""The edge near a place in a picture, and a rectangle that holds a clean piece of it."""

from collections.abc import Callable

import numpy as np

from simulations.models.arrays import Floats

NEAR = 0.12
"""Share of the picture's width within which an edge is looked for."""
LEAST_SLOPE = 0.02
"""Least change of light from pixel to pixel that is an edge, with 1 for white."""
GONE, ANOTHER = 0.4, 0.3
"""Shares of the slope at which the edge has ended, and at which another one begins beside it."""
FAR_FROM_ENDS = 0.8
"""Share of the edge between its ends that is used."""
WIDEST = 0.5
"""Half of the rectangle's width, as a share of its height, at most."""

type SlopeAt = Callable[[Floats], float]
"""The slope of the light across an edge at a place; negative outside the picture."""
type Rectangle = tuple[float, float, float, float]
"""Middle (x, y) and size (width, height), in pixels."""


def edge_near(light: Floats, x: float, y: float) -> Rectangle | None:
    """The strongest edge near (x, y) in a picture (H, W), followed to its ends, if there is one."""
    height, width = light.shape
    down, across = (np.asarray(part, float) for part in np.gradient(light))
    slope = np.hypot(across, down)
    rows, columns = np.indices(light.shape)
    reach = NEAR * width
    weight = np.exp(-(np.square(rows - y) + np.square(columns - x)) / (0.5 * reach**2))
    row, column = np.unravel_index(int(np.argmax(slope * weight)), light.shape)
    steepest = float(slope[row, column])
    if steepest < LEAST_SLOPE or np.hypot(row - y, column - x) > 2 * reach:
        return None
    normal = np.array([across[row, column], down[row, column]]) / steepest
    along = np.array([-normal[1], normal[0]])
    across_it = np.abs(normal[0] * across + normal[1] * down)

    def at(place: Floats) -> float:
        u, v = np.rint(place).astype(int)
        return float(across_it[v, u]) if 0 <= u < width and 0 <= v < height else -1.0

    start = np.array([float(column), float(row)])
    ends = [_followed(start, side * along, normal, at, GONE * steepest) for side in (-1.0, 1.0)]
    middle, length = 0.5 * (ends[0] + ends[1]), float(np.hypot(*(ends[1] - ends[0])))
    clear = min(_clear(middle, side * normal, at, steepest, length) for side in (-1.0, 1.0))
    drawn = FAR_FROM_ENDS * np.abs(ends[1] - ends[0])
    beside = 2.0 * FAR_FROM_ENDS * clear
    upright = drawn[1] >= drawn[0]
    size = drawn + (np.array([beside, 0.0]) if upright else np.array([0.0, beside]))
    return float(middle[0]), float(middle[1]), float(size[0]), float(size[1])


def _followed(start: Floats, along: Floats, normal: Floats, at: SlopeAt, least: float) -> Floats:
    """The end of an edge from a place on it, in steps of a pixel that may drift sideways."""
    place = start
    while True:
        beside = [place + along + shift * normal for shift in (0.0, -1.0, 1.0)]
        slopes = [at(each) for each in beside]
        if max(slopes) < least:
            return place
        place = beside[int(np.argmax(slopes))]


def _clear(middle: Floats, normal: Floats, at: SlopeAt, steepest: float, length: float) -> float:
    """How far the light beside an edge is even."""
    slopes = np.array([at(middle + step * normal) for step in range(int(WIDEST * length) + 2)])
    calm = np.flatnonzero(slopes < ANOTHER * steepest)
    first = int(calm[0]) if calm.size else len(slopes)
    after = np.flatnonzero((slopes[first:] > ANOTHER * steepest) | (slopes[first:] < 0.0))
    return float(first + after[0]) if after.size else float(len(slopes) - 1)
