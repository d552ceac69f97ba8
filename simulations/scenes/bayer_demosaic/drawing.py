"""The drawings of the Bayer scene: the loupe, a quad of filters, the worst pixel."""

import math

from simulations.engine.drawing import line, polygon, rectangle, text
from simulations.pictures.balloon import WIDTH as PICTURE_WIDTH
from simulations.scenes.bayer_demosaic.settings import COLUMNS, ROWS

WIDTH, HEIGHT = 400, 320
PIXEL, CELL = WIDTH / PICTURE_WIDTH, WIDTH / COLUMNS
"""Sides of a pixel in the pictures, and under the loupe: large enough for a letter."""
QUAD_COLUMN, QUAD_ROW = 16, 6
"""Place of the quad that is framed, in pixels under the loupe."""
QUAD_CORNER = (QUAD_COLUMN * CELL, QUAD_ROW * CELL)


def loupe(row: int, column: int) -> str:
    """The enlarged part of the picture."""
    corner, size = (column * PIXEL, row * PIXEL), (COLUMNS * PIXEL, ROWS * PIXEL)
    return rectangle(corner, *size, "casing") + rectangle(corner, *size, "camera bold")


def quad(pattern: str) -> str:
    """A frame around one quad of the enlarged mosaic, with the letter of each filter."""
    (x, y), side = QUAD_CORNER, 2 * CELL
    frame = [rectangle(QUAD_CORNER, side, side, style) for style in ("casing", "camera bold")]
    letters = [
        text((x + (k % 2 + 0.5) * CELL, y + (k // 2 + 0.5) * CELL + 4), letter, "ground", "middle")
        for k, letter in enumerate(pattern)
    ]
    return "".join((*frame, *letters))


def worst_pixel(row: int, column: int) -> str:
    """A cross-hair at the pixel of the largest error, with its name on the side with more room."""
    x, y = (column + 0.5) * PIXEL, (row + 0.5) * PIXEL
    right = x < WIDTH / 2
    name = (x + (20 if right else -20), min(max(y + 5, 20), HEIGHT - 8))
    parts = [text(name, "largest error", "error small ground", "start" if right else "end")]
    for style in ("casing", "error"):
        corners = [
            (x + 9 * math.cos(turn * math.pi / 2), y + 9 * math.sin(turn * math.pi / 2))
            for turn in range(4)
        ]
        parts.append(polygon(corners, style))
        parts.append(line((x - 15, y), (x - 9, y), style) + line((x + 9, y), (x + 15, y), style))
    return "".join(parts)
