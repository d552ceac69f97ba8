"""Plan of the room: its outlines and objects from above."""

import math
from collections.abc import Callable, Iterator
from functools import cache
from itertools import accumulate

import numpy as np

from simulations.engine import drawing
from simulations.engine.drafting import swatch_polygon
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.geometry.transforms import clip_to_rectangle
from simulations.models.light.raycasting import Sphere
from simulations.world.furniture import DOORWAY, HIGH, LOW, ROOM
from simulations.world.still_life import SceneObject
from simulations.world.surfaces import CHART

WALLS = np.array([LOW[:2], (HIGH[0], LOW[1]), HIGH[:2], (LOW[0], HIGH[1])])
"""Corners (4, 2) of the floor, metres: x and y."""
DOOR = np.array([(HIGH[0], DOORWAY[0]), (HIGH[0], DOORWAY[1])])
CHART_EDGE = np.array([(CHART[0] + side * CHART[2], HIGH[1]) for side in (-0.5, 0.5)])


def plan_markup(place: Callable[[Floats], Floats], low: drawing.Point, high: drawing.Point) -> str:
    """Walls, chart, and objects in their colours.

    ``place`` takes places (n, 2) to the view box, of which the part from ``low`` to ``high`` is
    drawn.
    """
    parts = [
        swatch_polygon(outline, colour)
        for outline, colour in zip(outlines(place, low, high), _colours(), strict=True)
        if len(outline) > 2
    ]
    for line, style in ((WALLS[[0, 3, 2, 1]], "world thin"), (CHART_EDGE, "world bold")):
        points = clip_to_rectangle(place(line), low, high, closed=False)
        if len(points) > 1:
            parts.append(drawing.polyline(points, style))
    return "".join(parts)


def outlines(
    place: Callable[[Floats], Floats], low: drawing.Point, high: drawing.Point
) -> Iterator[Floats]:
    """Outlines (n, 2) of the objects from above in the view box, clipped to ``low`` and ``high``;
    ``place`` takes places (n, 2) to the view box."""
    corners, starts = _corners()
    points = place(corners)
    inside = ((points >= low) & (points <= high)).all(axis=1)
    whole = np.logical_and.reduceat(inside, starts).tolist()
    for start, end, complete in zip(starts, [*starts[1:], len(points)], whole, strict=True):
        outline = points[start:end]
        yield outline if complete else clip_to_rectangle(outline, low, high, closed=True)


@cache
def _corners() -> tuple[Floats, list[int]]:
    """The corners (n, 2) of all objects from above, metres: x and y, and where each begins."""
    outlines = [footprint(item) for item in ROOM]
    return np.concatenate(outlines), [0, *accumulate(map(len, outlines[:-1]))]


@cache
def _colours() -> list[list[float]]:
    """sRGB of all objects."""
    return [encode_srgb(item.albedo).tolist() for item in ROOM]


@cache
def footprint(item: SceneObject) -> Floats:
    """Corners (n, 2) of an object from above, metres: x and y."""
    centre = np.asarray(item.solid.centre[:2])
    if isinstance(item.solid, Sphere):
        turns = np.arange(24) * (math.tau / 24)
        return centre + item.solid.radius * np.stack([np.cos(turns), np.sin(turns)], -1)
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * np.asarray(item.solid.size[:2]) / 2
    return centre + corners @ item.solid.world_to_box[:2, :2]
