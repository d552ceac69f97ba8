"""Bare branches with their last leaves, seen from below against a white sky: edges of full contrast
in every direction, where the colours of a lens come apart."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.models.arrays import Floats

SKY, GLOW = (0.62, 0.75, 0.92), (0.98, 0.98, 0.96)
BARK, LEAF = (0.022, 0.016, 0.012), (0.6, 0.2, 0.02)
TREES = (
    # Share of the width and height where a branch enters, direction in degrees, length in heights
    (0.6, 1.06, -38, 0.24),
    (1.03, 0.93, 215, 0.12),
    (1.05, 0.25, 168, 0.3),
    (-0.06, 1.02, -42, 0.36),
    (-0.05, 0.06, 32, 0.3),
    (0.52, -0.09, 96, 0.22),
    (0.94, 1.04, -84, 0.15),
)
THICK = 0.02  # radius of a branch where it enters, in heights
LEVELS, THINNEST_PX = 7, 0.3
GOLDEN = (math.sqrt(5) - 1) / 2

PIECE_PX = 10.0  # branches are drawn in pieces of at most this length
BOX_PX = 24  # side of the square in which a piece is drawn

type Segment = tuple[float, float, float, float, float]
"""x and y of both ends, and the radius, px."""


def twigs(width: int, height: int) -> Floats:
    """(height, width, 3) linear RGB, float32. The same on every machine."""
    x, y = np.arange(width) + 0.5, np.arange(height) + 0.5
    from_middle = np.hypot(x / width - 0.45, (y / height - 0.4)[:, None])
    share = np.clip(1.0 - 1.1 * from_middle, 0.0, 1.0)[..., None]
    light = np.array(SKY) + share * (np.array(GLOW) - np.array(SKY))
    grown = np.array([segment for tree in trees(width, height) for segment in tree])
    for colour, some in ((BARK, grown[:, 4] > 0), (LEAF, grown[:, 4] < 0)):
        cover = coverage(np.abs(grown[some]), width, height)[..., None]
        light += cover * (np.array(colour) - light)
    return light.astype(np.float32)


def trees(width: int, height: int) -> Iterator[Iterator[Segment]]:
    for number, (across, down, degrees, long) in enumerate(TREES, start=1):
        start = (across * width, down * height, math.radians(degrees))
        yield branch(*start, long * height, THICK * height, LEVELS, number)


def branch(
    x: float, y: float, turn: float, long: float, thick: float, level: int, number: int
) -> Iterator[Segment]:
    """A branch in two pieces, and those that it bears; a leaf has a radius below zero."""
    for piece in (1, 2):
        turn += 0.5 * (low_discrepancy(number, piece) - 0.5)
        end = x + long / 2 * math.cos(turn), y + long / 2 * math.sin(turn)
        yield x, y, *end, max(thick, THINNEST_PX)
        x, y = end
        if level > 1:
            side = 1 if low_discrepancy(number, piece + 2) < 0.5 else -1
            bend = side * (0.45 + 0.5 * low_discrepancy(number, piece + 4))
            shorter = long * (0.6 + 0.2 * low_discrepancy(number, piece + 6))
            which = 2 * number + piece
            yield from branch(x, y, turn + bend, shorter, 0.62 * thick, level - 1, which)
            turn -= 0.3 * bend
        thick *= 0.8
    if level == 1 and low_discrepancy(number, 9) < 0.12:
        yield x, y, x + 3.0 * math.cos(turn), y + 3.0 * math.sin(turn), -1.6


def low_discrepancy(number: int, which: int) -> float:
    """In [0, 1), evenly spread over the numbers."""
    return (GOLDEN * (number + 1) * (2 * which + 1) + 0.37 * which) % 1.0


def coverage(segments: Floats, width: int, height: int) -> Floats:
    """(height, width) share of each pixel under round-ended lines (n, 5)."""
    counts = np.ceil(np.hypot(*(segments[:, 2:4] - segments[:, :2]).T) / PIECE_PX).astype(int)
    whole = segments.repeat(counts, axis=0)
    first = np.arange(counts.sum()) - (counts.cumsum() - counts).repeat(counts)
    step = (whole[:, 2:4] - whole[:, :2]) / counts.repeat(counts)[:, None]
    start, radius = whole[:, :2] + first[:, None] * step, whole[:, 4, None, None]
    corner = np.floor(start + step / 2).astype(int) - BOX_PX // 2
    column = corner[:, 0, None, None] + np.arange(BOX_PX)
    row = corner[:, 1, None, None] + np.arange(BOX_PX)[:, None]
    x, y = column + 0.5 - start[:, 0, None, None], row + 0.5 - start[:, 1, None, None]
    dx, dy = step[:, 0, None, None], step[:, 1, None, None]
    along = np.clip((x * dx + y * dy) / (dx * dx + dy * dy), 0.0, 1.0)
    off = np.hypot(x - along * dx, y - along * dy)
    share = np.clip(radius + 0.5 - off, 0.0, np.minimum(1.0, 2.0 * radius))
    inside = (share > 0) & (column >= 0) & (column < width) & (row >= 0) & (row < height)
    cover = np.zeros(height * width)
    np.maximum.at(cover, (row * width + column)[inside], share[inside])
    return cover.reshape(height, width)
