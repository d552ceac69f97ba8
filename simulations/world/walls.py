"""The colours of the room's six walls: rectangles, and the star of the chart."""

from collections.abc import Iterator
from functools import cache

import numpy as np

from simulations.models.arrays import Floats, Planes
from simulations.pictures.patterns import band, siemens_star
from simulations.pictures.rectangles import Bounds, Rectangles, painted
from simulations.world.furniture import (
    BEAM,
    BEAMS_M,
    DOOR,
    DOORWAY,
    FRAME,
    HIGH,
    LIME,
    LOW,
    PICTURES,
    PLASTER,
    SLATE,
    WINDOW,
    WOOD,
)
from simulations.world.surfaces import (
    CHART,
    FLOOR_DARK,
    FLOOR_LIGHT,
    GROOVE,
    INK,
    PANEL,
    PAPER,
    SKIRTING,
    TILE,
    TILE_CENTRE,
    WALL,
)

type Painting = Iterator[tuple[Bounds, Floats]]

EVERYWHERE = (-99.0, 99.0)
"""Extent of a band from one end of the wall to the other."""
PERIOD_M = {4: 2 * TILE, 5: BEAMS_M}
"""Of the patterns of floor and ceiling along v, which go on behind the entrance."""
BEHIND_M = 1.5
"""How far the patterns are painted beyond the room."""
STAR_M, SPOKES = 0.52, 18
"""Radius and pairs of spokes of the chart's star."""
ALONG = ((1, 2), (1, 2), (0, 2), (0, 2), (0, 1), (0, 1))
"""For each wall, the world axes of u and v."""


@cache
def colours(wall: int) -> Rectangles:
    """The wall of that index; the left one has the share of sky, in its panes, as a fourth
    channel."""
    u, v = ((LOW[axis] - BEHIND_M, HIGH[axis] + BEHIND_M) for axis in ALONG[wall])
    ground, painting = (
        (np.append(PLASTER, 0.0), _window_wall()),
        (PLASTER, _door_wall()),
        (PLASTER, _near_wall()),
        (WALL, _chart_wall()),
        (FLOOR_DARK, _tiles()),
        (LIME, _beams()),
    )[wall]
    return painted(u, v, ground, painting)


def albedo(wall: int, u: Floats, v: Floats, wide: Floats, high: Floats) -> Planes:
    """(3 or 4, n) the mean of a wall's colours over footprints about places, metres."""
    period, entrance = PERIOD_M.get(wall), LOW[1]
    if period and (behind := np.minimum(v - np.float32(entrance), 0)).any():
        v = v - np.float32(period) * np.floor(behind * np.float32(1 / period))
    means = colours(wall).means(u, v, wide, high)
    if wall == ALONG.index((0, 2), 3):
        _draw_star(means, u - np.float32(CHART[0]), v - np.float32(CHART[1]), wide, high)
    return means


def _draw_star(means: Planes, x: Floats, z: Floats, wide: Floats, high: Floats) -> None:
    """Put the star's dark spokes into the colours of the chart, in place."""
    near = np.flatnonzero((np.abs(x) < STAR_M + wide) & (np.abs(z) < STAR_M + high))
    if not near.size:
        return
    x, z = x[near], z[near]
    pixel = np.float32(0.5) * (wide[near] + high[near])
    disc = band(np.hypot(x, z), -STAR_M, STAR_M, pixel)
    ink = (disc * siemens_star(x, z, SPOKES, pixel)).astype(np.float32)
    for plane, colour in zip(means, INK.astype(np.float32), strict=True):
        paper = plane[near]
        plane[near] = paper + (colour - paper) * ink


def _chart_wall() -> Painting:
    """Panels with grooves, and a framed sheet with bars on both sides of the star."""
    half = 0.0125 * 2
    for nearest in np.arange(-9, 10) * PANEL:
        yield (nearest - half, nearest + half, *EVERYWHERE), GROOVE
        yield (*EVERYWHERE, nearest + 0.15 - half, nearest + 0.15 + half), GROOVE
    yield (*EVERYWHERE, -0.15, 0.15), SKIRTING
    x, z, wide, high = CHART
    sheet = (x - wide / 2, x + wide / 2, z - high / 2, z + high / 2)
    yield _wider(sheet, 0.05), INK
    yield sheet, PAPER
    for column in (x - 0.74, x + 0.74):
        for bar in np.arange(-3, 4) * 0.16 - 0.04:
            low, top = max(bar - 0.04, -0.48), min(bar + 0.04, 0.48)
            yield (column - 0.13, column + 0.13, z + low, z + top), INK


def _framed(bounds: Bounds, pictures: int) -> Painting:
    """Skirting, the first ``pictures``, and the frame of an opening."""
    yield (*EVERYWHERE, -0.15, 0.15), SKIRTING
    for edges, sky, land in PICTURES[:pictures]:
        left, right, bottom, top = edges
        yield _wider(edges, 0.07), np.array(WOOD)
        yield edges, np.array(sky)
        yield (left, right, bottom, bottom + 0.4 * (top - bottom)), np.array(land)
    yield _wider(bounds, 0.09), FRAME


def _wider(bounds: Bounds, by: float) -> Bounds:
    left, right, bottom, top = bounds
    return left - by, right + by, bottom - by, top + by


def _window_wall() -> Painting:
    yield from ((bounds, np.append(colour, 0.0)) for bounds, colour in _framed(WINDOW, 3))
    left, right, bottom, top = WINDOW
    middle, sill = (left + right) / 2, 0.6 * top + 0.4 * bottom
    for side in ((left, middle - 0.03), (middle + 0.03, right)):
        for pane in ((bottom, sill - 0.03), (sill + 0.03, top)):
            yield (*side, *pane), np.array([0.0, 0.0, 0.0, 1.0])


def _door_wall() -> Painting:
    left, right, top = DOORWAY
    bounds = (left, right, 0.0, top)
    yield from _framed(bounds, 4)
    yield bounds, DOOR
    for low, high in ((0.2, 0.9), (1.05, 1.85)):
        yield (left + 0.14, right - 0.14, low, high), 0.7 * DOOR


def _near_wall() -> Painting:
    """Behind the first camera: a slate, and pictures as on the side walls."""
    yield from _framed(SLATE, 3)
    yield SLATE, 0.5 * DOOR


def _tiles() -> Painting:
    (x, y), half = TILE_CENTRE, TILE / 2
    for row in range(-12, 18):
        for column in range(-12 + row % 2, 12, 2):
            u, v = x + column * TILE, y + row * TILE
            yield (u - half, u + half, v - half, v + half), FLOOR_LIGHT


def _beams() -> Painting:
    """White between beams."""
    for middle in np.arange(-5, 8) * BEAMS_M:
        yield (*EVERYWHERE, middle - 0.1, middle + 0.1), BEAM
