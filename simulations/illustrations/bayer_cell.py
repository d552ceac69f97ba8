"""The Bayer mosaic, the cells of each colour, and the interpolation of a missing green."""

import numpy as np
from numpy.typing import NDArray

from simulations.engine.drafting import label, swatch
from simulations.engine.drawing import arrow, rectangle
from simulations.engine.illustration import Illustration, Panel
from simulations.models.sensor.bayer import filter_colours

WIDTH, HEIGHT = 300.0, 250.0
CELLS, PITCH, EDGE = 6, 40.0, 30.0
LETTERS = "RGB"
FILTERS = ((0.86, 0.36, 0.30), (0.42, 0.70, 0.36), (0.34, 0.48, 0.84))
"""Colours of the filters in the drawing."""
RED_CELL = (2, 2)  # row and column of the cell whose green is interpolated
NEIGHBOURS = ((-1, 0), (1, 0), (0, -1), (0, 1))


def colours() -> NDArray[np.uint8]:
    """Colour of each cell: 0 red, 1 green, 2 blue."""
    return filter_colours(CELLS, CELLS, "RGGB")


def _corner(row: int, column: int) -> tuple[float, float]:
    return EDGE + PITCH * column, 4 + PITCH * row


def _cell(row: int, column: int, colour: int) -> str:
    x, y = _corner(row, column)
    return swatch((x + 1, y + 1), PITCH - 2, PITCH - 2, FILTERS[colour])


def _mosaic() -> Panel:
    marks = [
        _cell(row, column, int(colour)) + _letter(row, column, LETTERS[int(colour)])
        for (row, column), colour in np.ndenumerate(colours())
    ]
    marks.append(rectangle(_corner(0, 0), 2 * PITCH, 2 * PITCH, "bold"))
    return Panel("mosaic", "One filter over each cell", WIDTH, HEIGHT, overlay="".join(marks))


def _letter(row: int, column: int, letter: str) -> str:
    x, y = _corner(row, column)
    return label((x + PITCH / 2, y + PITCH / 2 + 5), letter, "on-swatch strong", "middle")


def _greens() -> Panel:
    row, column = RED_CELL
    places = [*np.ndindex(CELLS, CELLS)]
    marks = [rectangle(_corner(*place), PITCH, PITCH, "muted thin faint") for place in places]
    marks += [_cell(r, c, 1) for r, c in np.argwhere(colours() == 1).tolist()]
    x, y = (value + PITCH / 2 for value in _corner(row, column))
    for down, across in NEIGHBOURS:
        start = (x + across * 0.8 * PITCH, y + down * 0.8 * PITCH)
        marks.append(arrow(start, (x + across * 12, y + down * 12), "on-swatch bold", 8))
        marks.append(_letter(row + down, column + across, "¼"))
    marks.append(rectangle(_corner(row, column), PITCH, PITCH, "error bold"))
    marks.append(label((x, y + 5), "?", "error strong", "middle"))
    title = "Green, and the red cell that lacks it"
    return Panel("green", title, WIDTH, HEIGHT, overlay="".join(marks))


def draw() -> Illustration:
    found = colours()
    count = [int((found == k).sum()) for k in range(3)]
    words = (
        f"{CELLS} by {CELLS} cells under the filters R G over G B: {count[0]} red, {count[1]} "
        f"green and {count[2]} blue. Beside it the green cells alone. At a red cell green was not "
        "measured; its four neighbours above, below, left and right were, and each gives a "
        "quarter."
    )
    return Illustration((_mosaic(), _greens()), words)
