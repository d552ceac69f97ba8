"""The grid of controls below a figure's panels, by the width of the page."""

from collections.abc import Sequence
from itertools import groupby

from simulations.engine.controls import Control

COLUMNS = 12
"""Of the grid of controls: divisible by all numbers of controls in a row."""
IN_A_ROW = {"narrow": 2, "small": 2, "middle": 3, "wide": 4}
"""Controls in a row at most, by the room that there is."""
FOLDED = ("narrow", "small")
"""Where only the main controls are in sight; elsewhere all share their rows."""
ROWS_IN_SIGHT = 2
"""Rows of controls that a phone shows together with the first panel, and room to spare."""


def even_columns(count: int, most: int) -> int:
    """Columns, at most ``most``, with few rows and no single item in the last one."""
    expected = [n for n in range(2, most + 1) if n <= count and count % n != 1]
    if not expected:
        return min(max(count, 1), most)
    fewest_rows = min(-(-count // n) for n in expected)
    return min(n for n in expected if -(-count // n) == fewest_rows)


def gather_buttons(controls: Sequence[Control]) -> list[tuple[Control, ...]]:
    """Each control by itself, but buttons that follow each other together."""
    cells: list[tuple[Control, ...]] = []
    for is_action, run in groupby(controls, key=lambda control: control.kind == "action"):
        together = tuple(run)
        cells += [together] if is_action else [(control,) for control in together]
    return cells


def cells_in_sight(places: Sequence[int], most: int) -> int:
    """How many cells, from the first, are main ones; the others are folded where it is narrow.

    A scene states its settings in the order of their weight, so the main ones are those that come
    first. A fold that would hide a single row saves no room: then all are main.
    """
    if len(_rows(places, most)) <= ROWS_IN_SIGHT + 1:
        return len(places)
    counts = range(len(places), 0, -1)
    return next(n for n in counts if len(_rows(places[:n], most)) <= ROWS_IN_SIGHT)


def spans(places: Sequence[int], most: int) -> list[int]:
    """Columns of each cell, with rows as few and as even as can be, the fuller ones below.

    ``places`` are the widths of the cells in controls; none takes more than ``most``.
    """
    rows = _rows([min(place, most) for place in places], most)
    widths = [(row, max(sum(row), min(most, 2) if len(rows) == 1 else 0)) for row in rows]
    return [COLUMNS * place // width for row, width in widths for place in row]


def _rows(places: Sequence[int], most: int) -> list[list[int]]:
    """The fewest rows, and of those the most even; found from the last row upwards."""
    best: list[list[list[int]]] = [[]]  # of the first n cells
    for end in range(1, len(places) + 1):
        starts = [start for start in range(end) if sum(places[start:end]) <= most]
        candidates = [[*best[start], list(places[start:end])] for start in starts]
        best.append(
            min(candidates, key=lambda rows: (len(rows), sum(sum(row) ** 2 for row in rows)))
        )
    return best[-1]
