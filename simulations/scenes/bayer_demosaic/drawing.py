"""The drawings of the Bayer scene: the frame of the enlargement and the letters of its filters."""

import math
from collections.abc import Iterator

from simulations.engine.drawing import line, polygon, rectangle, text
from simulations.pictures.mosaic_subjects import CLOSE_COLUMNS, CLOSE_ROWS

WIDTH, HEIGHT = 400, 320
"""A pixel of the close-up is a square of 20 units, large enough for a letter."""


def close_up_frame(top: int, left: int, pixel: float) -> str:
    """Where in the picture the close-up lies, ``pixel`` units to the pixel."""
    corner, size = (left * pixel, top * pixel), (CLOSE_COLUMNS * pixel, CLOSE_ROWS * pixel)
    return rectangle(corner, *size, "casing") + rectangle(corner, *size, "camera")


def filter_letters(pattern: str) -> str:
    """The letter of each filter, at the centre of its enlarged pixel; one quad is framed."""
    return "".join(_letters(pattern)) + _quad()


def _letters(pattern: str) -> Iterator[str]:
    unit = WIDTH / CLOSE_COLUMNS
    for row in range(CLOSE_ROWS):
        for column in range(CLOSE_COLUMNS):
            letter = pattern[2 * (row % 2) + column % 2]
            place = ((column + 0.5) * unit, (row + 0.5) * unit + 4)
            yield text(place, letter, "small halo", "middle")


def _quad() -> str:
    unit = WIDTH / CLOSE_COLUMNS
    corner = (8 * unit, 6 * unit)
    return rectangle(corner, 2 * unit, 2 * unit, "casing") + rectangle(
        corner, 2 * unit, 2 * unit, "camera bold"
    )


def worst_pixel(row: int, column: int, pixel: float) -> str:
    """A cross-hair at the pixel of the largest error."""
    x, y = (column + 0.5) * pixel, (row + 0.5) * pixel
    parts = []
    for style in ("casing", "error"):
        corners = [
            (x + 9 * math.cos(turn * math.pi / 2), y + 9 * math.sin(turn * math.pi / 2))
            for turn in range(4)
        ]
        parts.append(polygon(corners, style))
        parts.append(line((x - 15, y), (x - 9, y), style) + line((x + 9, y), (x + 15, y), style))
    return "".join(parts)
