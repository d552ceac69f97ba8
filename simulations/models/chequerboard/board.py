"""A chequerboard: its corners, and its drawing at true scale, to print or to show on a screen.

Board frame, in millimetres: the first inner corner at (0, 0, 0), x along the rows of squares, y
down, z into the board, away from the camera. The square before the first inner corner is dark.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.require import as_whole, require_positive

RULER_MM, RULER_STEP_MM = 100, 10
"""Largest length and divisions of the ruler, by which a reader checks the size of the print."""
FOOT_MM = 14.0
"""Height of the ruler and its caption, below the margin."""


@dataclass(frozen=True, slots=True)
class Board:
    """The squares of a chequerboard; `ValueError` for fewer than 3 either way."""

    across: int = 10
    """Squares along a row."""
    down: int = 7
    """Rows of squares."""
    side_mm: float = 25.0

    def __post_init__(self) -> None:
        as_whole("across", self.across, 3)
        as_whole("down", self.down, 3)
        require_positive("side_mm", self.side_mm)

    @property
    def corners(self) -> tuple[int, int]:
        """Inner corners across and down, where four squares meet."""
        return self.across - 1, self.down - 1

    @property
    def indices(self) -> Floats:
        """(N, 2) whole numbers, column and row of each inner corner, row by row."""
        columns, rows = self.corners
        grid = np.meshgrid(np.arange(float(columns)), np.arange(float(rows)))
        return np.stack(grid, axis=-1).reshape(-1, 2)

    @property
    def points_mm(self) -> Floats:
        """(N, 3) the inner corners in the board frame, in the order of `indices`."""
        flat = self.indices * self.side_mm
        return np.column_stack([flat, np.zeros(len(flat))])

    @property
    def ruler_mm(self) -> int:
        """Length of the ruler below the board: as many whole divisions as the board is wide."""
        wide = int(self.across * self.side_mm / RULER_STEP_MM) * RULER_STEP_MM
        return min(max(wide, RULER_STEP_MM), RULER_MM)


def board_svg(board: Board, caption: str = "") -> str:
    """The board as SVG at true scale, on a white sheet with a margin of one square and a ruler.

    The caption follows the ruler's length, in letters that need no escaping.
    """
    side, across, down = board.side_mm, board.across, board.down
    width, height = (across + 2) * side, (down + 2) * side + FOOT_MM
    squares = "".join(
        f"M{_mm((column + 1) * side)} {_mm((row + 1) * side)}h{_mm(side)}v{_mm(side)}h{_mm(-side)}z"
        for row in range(down)
        for column in range(row % 2, across, 2)
    )
    left, top = side, (down + 2) * side
    ticks = "".join(
        f"M{_mm(left + at)} {_mm(top)}v{_mm(4.0 if at % 50 == 0 else 2.5)}"
        for at in range(0, board.ruler_mm + 1, RULER_STEP_MM)
    )
    words = f"{board.ruler_mm} mm" + (f" · {caption}" if caption else "")
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_mm(width)}mm" height="{_mm(height)}mm"'
        f' viewBox="0 0 {_mm(width)} {_mm(height)}">'
        f'<rect width="100%" height="100%" fill="#fff"/>'
        f'<path d="{squares}" fill="#000" shape-rendering="crispEdges"/>'
        f'<path d="M{_mm(left)} {_mm(top)}h{board.ruler_mm}{ticks}" stroke="#000"'
        f' stroke-width="0.2" fill="none"/>'
        f'<text x="{_mm(left)}" y="{_mm(top + 9)}" font-family="sans-serif" font-size="4">{words}'
        "</text></svg>"
    )


def _mm(length: float) -> str:
    return f"{length:.4f}".rstrip("0").rstrip(".")
