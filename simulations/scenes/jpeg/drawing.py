"""The drawings of the JPEG scene: the place of the block, the grid of blocks, the table of
codes."""

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from simulations.engine.drawing import Point, arrow, dot, path, rectangle, text
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
TABLE_LEFT, TABLE_TOP, CELL_WIDTH, CELL_HEIGHT = 44.0, 32.0, 43.0, 35.0


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
    """The 64 whole numbers; zeros, and those not among the ``first``, are faint."""
    return "".join((*_axes(), *_cells(codes, first), *_order(first)))


def knob(first: int) -> tuple[float, float]:
    """Handle in a corner of the last coefficient's cell, below its number."""
    row, column = divmod(int(ZIGZAG[first - 1]), BLOCK)
    x, y = _corner(row, column)
    return (x + 6, y + CELL_HEIGHT - 5)


def cell_at(place: Point) -> tuple[int, int]:
    """Row and column of the table at a place, also beyond its borders."""
    row, column = (place[1] - TABLE_TOP) / CELL_HEIGHT, (place[0] - TABLE_LEFT) / CELL_WIDTH
    return math.floor(row), math.floor(column)


def _corner(row: int, column: int) -> tuple[float, float]:
    return (TABLE_LEFT + column * CELL_WIDTH, TABLE_TOP + row * CELL_HEIGHT)


def _axes() -> Iterator[str]:
    right, bottom = TABLE_LEFT + BLOCK * CELL_WIDTH, TABLE_TOP + BLOCK * CELL_HEIGHT
    yield text((TABLE_LEFT, 20), "finer from left to right", "muted small")
    yield arrow((TABLE_LEFT + 132, 16), (right, 16), "muted thin", 7)
    yield text((6, TABLE_TOP + 14), "mean", "muted small")
    yield text((6, TABLE_TOP + 62), "finer", "muted small")
    yield text((6, TABLE_TOP + 76), "down", "muted small")
    yield arrow((20, TABLE_TOP + 88), (20, bottom), "muted thin", 7)


def _cells(codes: NDArray[np.integer], first: int) -> Iterator[str]:
    for (row, column), code in np.ndenumerate(codes):
        x, y = _corner(row, column)
        place = (x + CELL_WIDTH / 2, y + CELL_HEIGHT / 2 + 5)
        used = RANK[row, column] < first
        box = "image fill thin" if code and used else "muted thin faint"
        number = "image strong" if code and used else "muted faint"
        yield rectangle((x + 1, y + 1), CELL_WIDTH - 2, CELL_HEIGHT - 2, box)
        yield text(place, format_number(float(code), 0), number, "middle")


def _order(first: int) -> Iterator[str]:
    """The border of the coefficients in use."""
    row, column = divmod(int(ZIGZAG[first - 1]), BLOCK)
    yield rectangle(_corner(row, column), CELL_WIDTH, CELL_HEIGHT, "ray bold")
    yield dot(knob(first), "ray", 5)
