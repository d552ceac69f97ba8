"""The patches of the spectrum figure: a column for each surface, a row for each step."""

import numpy as np

from simulations.engine.drawing import Point, rectangle, text
from simulations.engine.frame import Raster
from simulations.scenes.spectrum_to_rgb.settings import SURFACES

WIDTH, HEIGHT = 400, 320
UNIT = 4
"""View box units per pixel."""
LEFT, TOP = 88, 12
CELL, ROW, GAP = 24, 48, 12
"""Width and height of a patch, and the gap below it."""
ROWS = ("raw", "balanced", "sRGB", "eye, here", "eye, by day")


def paint(cells: Raster) -> Raster:
    """Bytes (H, W, 4) of the panel from those of the patches (2 · rows, columns, 4).

    Of each two rows of cells, the first is the upper half of a patch, the second its lower half.
    """
    picture = np.zeros((HEIGHT // UNIT, WIDTH // UNIT, 4), np.uint8)
    halves = cells.repeat(ROW // UNIT // 2, axis=0).repeat(CELL // UNIT, axis=1)
    rows, left = ROW // UNIT, LEFT // UNIT
    for row in range(len(ROWS)):
        top = (TOP + row * (ROW + GAP)) // UNIT
        patches = halves[row * rows : (row + 1) * rows]
        picture[top : top + rows, left : left + patches.shape[1]] = patches
    return picture


def overlay(surface: str) -> str:
    """The names of the steps, and a frame around the chosen surface."""
    column = list(SURFACES).index(surface)
    corner = (LEFT + column * CELL, TOP - 4)
    size = (CELL, len(ROWS) * (ROW + GAP) - GAP + 8)
    names = [
        text((LEFT - 8, TOP + row * (ROW + GAP) + ROW / 2 + 4.5), name, _role(row), "end")
        for row, name in enumerate(ROWS)
    ]
    return "".join((*names, rectangle(corner, *size, "ray bold")))


def surface_at(place: Point) -> str:
    """The surface whose column is nearest to a place of the panel."""
    column = int((float(place[0]) - LEFT) // CELL)
    return list(SURFACES)[min(max(column, 0), len(SURFACES) - 1)]


def middle(surface: str) -> tuple[float, float]:
    """The handle of the column."""
    return LEFT + (list(SURFACES).index(surface) + 0.5) * CELL, HEIGHT / 2


def _role(row: int) -> str:
    return "image" if row < 3 else "world"
