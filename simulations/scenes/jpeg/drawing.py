"""The drawings of the JPEG scene: the place of the block, the grid of blocks, and the codes over
their patterns."""

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from simulations.engine.drawing import Point, dot, path, rectangle, text
from simulations.engine.frame import format_number
from simulations.models.compression.blocks import BLOCK
from simulations.models.compression.zigzag import RANK, ZIGZAG
from simulations.pictures.balloon import WIDTH as COLUMNS_PX

WIDTH, HEIGHT = 400.0, 320.0
CLOSE_ROWS, CLOSE_COLUMNS = 24, 30
"""Pixels of the close-up."""
SIDE = BLOCK * WIDTH / COLUMNS_PX
"""Width of a block in the picture."""
CLOSE_SIDE = BLOCK * WIDTH / CLOSE_COLUMNS
"""Width of a block in the close-up."""
CELL_WIDTH, CELL_HEIGHT = WIDTH / BLOCK, HEIGHT / BLOCK
"""Sides of a cell of the table of coefficients."""
KNOB_INSIDE = 14.0
"""Least distance of the handle from the lower edge of the table, which would cut its ring."""


def block_in_picture(row: int, column: int) -> str:
    """A frame around the block."""
    corner = (column * SIDE, row * SIDE)
    return "".join(rectangle(corner, SIDE, SIDE, style) for style in ("casing", "image bold"))


def block_grid(top: int, left: int) -> str:
    """Borders of the blocks in the close-up; the block itself starts at (``top``, ``left``)."""
    unit = WIDTH / CLOSE_COLUMNS
    columns = range(left % BLOCK, CLOSE_COLUMNS + 1, BLOCK)
    rows = range(top % BLOCK, CLOSE_ROWS + 1, BLOCK)
    grid = [[(c * unit, 0.0), (c * unit, HEIGHT)] for c in columns]
    grid += [[(0.0, r * unit), (WIDTH, r * unit)] for r in rows]
    corner = (left * unit, top * unit)
    frame = [rectangle(corner, CLOSE_SIDE, CLOSE_SIDE, s) for s in ("casing", "image bold")]
    return path(grid, "camera thin faint") + "".join(frame)


def code_table(codes: NDArray[np.integer], first: int) -> str:
    """The codes (8, 8) that are not zero and among the ``first``, and the last of those."""
    return "".join((*_numbers(codes, first), *_last(first)))


def knob(first: int) -> tuple[float, float]:
    """Handle in the middle of the lower edge of the last coefficient's cell, below its number."""
    row, column = divmod(int(ZIGZAG[first - 1]), BLOCK)
    x, y = _corner(row, column)
    return (x + CELL_WIDTH / 2, min(y + CELL_HEIGHT - 1, HEIGHT - KNOB_INSIDE))


def cell_at(place: Point) -> tuple[int, int]:
    """Row and column of the table at a place, also beyond its borders."""
    return math.floor(place[1] / CELL_HEIGHT), math.floor(place[0] / CELL_WIDTH)


def _corner(row: int, column: int) -> tuple[float, float]:
    return (column * CELL_WIDTH, row * CELL_HEIGHT)


def _numbers(codes: NDArray[np.integer], first: int) -> Iterator[str]:
    for (row, column), code in np.ndenumerate(codes):
        if code and RANK[row, column] < first:
            x, y = _corner(row, column)
            place = (x + CELL_WIDTH / 2, y + CELL_HEIGHT / 2 + 5)
            yield text(place, format_number(float(code), 0), "image strong ground", "middle")


def _last(first: int) -> Iterator[str]:
    """The border of the last coefficient in use, and its handle."""
    row, column = divmod(int(ZIGZAG[first - 1]), BLOCK)
    x, y = _corner(row, column)
    for style in ("casing", "ray bold"):
        yield rectangle((x + 1, y + 1), CELL_WIDTH - 2, CELL_HEIGHT - 2, style)
    yield dot(knob(first), "ray", 5)
