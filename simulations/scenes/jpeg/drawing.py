"""The drawings of the JPEG scene: where the block lies, the grid of blocks, the table of codes."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from simulations.engine.drawing import arrow, path, rectangle, text
from simulations.engine.frame import format_number
from simulations.models.compression.blocks import BLOCK

WIDTH, HEIGHT = 400.0, 320.0
CLOSE_ROWS, CLOSE_COLUMNS = 24, 30
"""Pixels of the close-up."""
TABLE_LEFT, TABLE_TOP, CELL_WIDTH, CELL_HEIGHT = 44.0, 32.0, 43.0, 35.0


def block_in_picture(row: int, column: int, pixel: float) -> str:
    """A frame around the block, ``pixel`` units to the pixel."""
    corner, side = (BLOCK * column * pixel, BLOCK * row * pixel), BLOCK * pixel
    return "".join(rectangle(corner, side, side, style) for style in ("casing", "image bold"))


def block_grid(top: int, left: int) -> str:
    """Borders of the blocks in the close-up; the block itself starts at (``top``, ``left``)."""
    unit = WIDTH / CLOSE_COLUMNS
    columns = range(left % BLOCK, CLOSE_COLUMNS + 1, BLOCK)
    rows = range(top % BLOCK, CLOSE_ROWS + 1, BLOCK)
    grid = [[(c * unit, 0.0), (c * unit, HEIGHT)] for c in columns]
    grid += [[(0.0, r * unit), (WIDTH, r * unit)] for r in rows]
    corner, side = (left * unit, top * unit), BLOCK * unit
    frame = [rectangle(corner, side, side, style) for style in ("casing", "image bold")]
    return path(grid, "camera thin faint") + "".join(frame)


def code_table(codes: NDArray[np.integer]) -> str:
    """The 64 whole numbers; what became 0 is faint."""
    return "".join((*_axes(), *_cells(codes)))


def _axes() -> Iterator[str]:
    right, bottom = TABLE_LEFT + BLOCK * CELL_WIDTH, TABLE_TOP + BLOCK * CELL_HEIGHT
    yield text((TABLE_LEFT, 20), "finer from left to right", "muted small")
    yield arrow((TABLE_LEFT + 132, 16), (right, 16), "muted thin", 7)
    yield text((6, TABLE_TOP + 14), "mean", "muted small")
    yield text((6, TABLE_TOP + 62), "finer", "muted small")
    yield text((6, TABLE_TOP + 76), "down", "muted small")
    yield arrow((20, TABLE_TOP + 88), (20, bottom), "muted thin", 7)


def _cells(codes: NDArray[np.integer]) -> Iterator[str]:
    for (row, column), code in np.ndenumerate(codes):
        corner = (TABLE_LEFT + column * CELL_WIDTH, TABLE_TOP + row * CELL_HEIGHT)
        place = (corner[0] + CELL_WIDTH / 2, corner[1] + CELL_HEIGHT / 2 + 5)
        inner = (corner[0] + 1, corner[1] + 1)
        if code:
            yield rectangle(inner, CELL_WIDTH - 2, CELL_HEIGHT - 2, "image fill thin")
            yield text(place, format_number(float(code), 0), "image strong", "middle")
        else:
            yield rectangle(inner, CELL_WIDTH - 2, CELL_HEIGHT - 2, "muted thin faint")
            yield text(place, "0", "muted faint", "middle")
