"""All photographs as small frames, each with the outline of its board and its error. A press on one
leaves it out."""

import numpy as np

from simulations.engine.drafting import label
from simulations.engine.drawing import line, path, rectangle
from simulations.engine.frame import format_number
from simulations.engine.handles import Point
from simulations.models.arrays import Floats
from simulations.scenes.calibration.boards import Boards

COLUMNS, CELL = 8, (48.0, 48.0)
LEFT, TOP, HEAD = 8.0, 32.0, 16.0
FRAME = (44.0, 33.0)
"""Largest sides of a frame."""


def contact_sheet(
    given: Boards, errors_px: Floats, used: list[bool], without: int, shown: int
) -> str:
    """The photographs with their errors (P,) in px; that which is shown has a bold frame, and the
    one left out is crossed."""
    width, height = given.size
    scale = min(FRAME[0] / width, FRAME[1] / height)
    words = "Press here to take it in again" if without else "Press a photograph to leave it out"
    parts = [label((LEFT + HEAD, HEAD + 4.0), words, "small")]
    for index, (error, is_used) in enumerate(zip(errors_px, used, strict=True)):
        x, y = middle_of(index + 1)
        corner = (x - 0.5 * scale * width, y - 0.5 * scale * height)
        outline = np.array(corner) + scale * (_outline(*given.views.of(index)) + 0.5)
        frame = "image bold" if index == shown else "muted thin"
        parts.append(rectangle(corner, scale * width, scale * height, frame))
        parts.append(path([[*outline, outline[0]]], "world" if is_used else "muted dashed"))
        if index + 1 == without:
            parts.append(line((x - 12.0, y + 9.0), (x + 12.0, y - 9.0), "error"))
        words = format_number(float(error), 3 if error < 1 else 1) if np.isfinite(error) else "–"
        parts.append(label((x, y + 28.0), words, "small" if is_used else "muted small", "middle"))
    return "".join(parts)


def middle_of(number: int) -> Point:
    """The middle of the frame of a photograph, counted from 1; of none for 0."""
    if number == 0:
        return LEFT + 4.0, HEAD
    row, column = divmod(number - 1, COLUMNS)
    return LEFT + (column + 0.5) * CELL[0], TOP + row * CELL[1] + 0.5 * FRAME[1]


def number_at(place: Point) -> int:
    """The photograph at a place; 0 above all of them."""
    row = int((place[1] - TOP) // CELL[1])
    column = min(max(int((place[0] - LEFT) // CELL[0]), 0), COLUMNS - 1)
    return row * COLUMNS + column + 1 if row >= 0 else 0


def _outline(board: Floats, pixels: Floats) -> Floats:
    """(4, 2) the pixels of the outermost corners, in turn."""
    u, v = board.T
    return pixels[[(u + v).argmin(), (u - v).argmax(), (u + v).argmax(), (u - v).argmin()]]
