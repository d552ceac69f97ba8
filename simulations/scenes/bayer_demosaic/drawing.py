"""The drawings of the Bayer scene: the loupe, the letters of the filters, the worst pixel."""

import math
from collections.abc import Iterator

from simulations.engine.drawing import line, polygon, rectangle, text
from simulations.pictures.balloon import WIDTH as PICTURE_WIDTH
from simulations.scenes.bayer_demosaic.settings import COLUMNS, ROWS

WIDTH, HEIGHT = 400, 320
PIXEL, CELL = WIDTH / PICTURE_WIDTH, WIDTH / COLUMNS
"""Sides of a pixel in the pictures, and under the loupe: large enough for a letter."""


def loupe(row: int, column: int) -> str:
    """The enlarged part of the picture."""
    corner, size = (column * PIXEL, row * PIXEL), (COLUMNS * PIXEL, ROWS * PIXEL)
    return rectangle(corner, *size, "casing") + rectangle(corner, *size, "camera bold")


def filter_letters(pattern: str) -> str:
    """The letter of each filter, at the centre of its enlarged pixel; one quad is framed."""
    return "".join(_letters(pattern)) + _quad()


def _letters(pattern: str) -> Iterator[str]:
    for row in range(ROWS):
        for column in range(COLUMNS):
            letter = pattern[2 * (row % 2) + column % 2]
            place = ((column + 0.5) * CELL, (row + 0.5) * CELL + 4)
            yield text(place, letter, "small halo", "middle")


def _quad() -> str:
    corner, side = (8 * CELL, 6 * CELL), 2 * CELL
    styles = ("casing", "camera bold")
    return "".join(rectangle(corner, side, side, style) for style in styles)


def worst_pixel(row: int, column: int) -> str:
    """A cross-hair at the pixel of the largest error."""
    x, y = (column + 0.5) * PIXEL, (row + 0.5) * PIXEL
    parts = []
    for style in ("casing", "error"):
        corners = [
            (x + 9 * math.cos(turn * math.pi / 2), y + 9 * math.sin(turn * math.pi / 2))
            for turn in range(4)
        ]
        parts.append(polygon(corners, style))
        parts.append(line((x - 15, y), (x - 9, y), style) + line((x + 9, y), (x + 15, y), style))
    return "".join(parts)
