"""A chequerboard: its corners, and its drawing at true scale, to print or to show on a screen.

Board frame, in millimetres: the first inner corner at (0, 0, 0), x along the rows of squares, y
down, z into the board, away from the camera. The square before the first inner corner is dark.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.require import as_whole, require_positive

RULER_MM, RULER_STEP_MM, RULER_STROKE_MM = 100, 10, 0.2
"""Largest length and divisions of the ruler, by which a reader checks the size of the print."""
FOOT_MM = 14.0
"""Height of the ruler and its caption, below the margin."""
WORDS_MM, WORDS_DOWN_MM = 4.0, 9.0
"""Size of the caption's letters, and how far it stands below the ruler."""
POINTS = 72.0 / 25.4  # PDF's units in a millimetre


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

    @property
    def dark_mm(self) -> list[tuple[float, float]]:
        """Upper left corner of each dark square, from the board's."""
        return [
            (column * self.side_mm, row * self.side_mm)
            for row in range(self.down)
            for column in range(row % 2, self.across, 2)
        ]

    @property
    def ruler_lines_mm(self) -> list[tuple[float, float, float, float]]:
        """The ruler and its divisions, from its left end: where each begins, and its way."""
        marks = range(0, self.ruler_mm + 1, RULER_STEP_MM)
        ticks = [(float(at), 0.0, 0.0, 2.5 if at % 50 else 4.0) for at in marks]
        return [(0.0, 0.0, float(self.ruler_mm), 0.0), *ticks]


def board_svg(board: Board, caption: str = "") -> str:
    """The board as SVG at true scale, on a white sheet with a margin of one square and a ruler.

    The caption follows the ruler's length, in letters that need no escaping.
    """
    side, below = board.side_mm, (board.down + 2) * board.side_mm
    width, height = (board.across + 2) * side, below + FOOT_MM
    squares = "".join(
        f"M{_mm(side + x)} {_mm(side + y)}h{_mm(side)}v{_mm(side)}h{_mm(-side)}z"
        for x, y in board.dark_mm
    )
    lines = "".join(
        f"M{_mm(side + x)} {_mm(below + y)}{f'h{_mm(across)}' if across else f'v{_mm(down)}'}"
        for x, y, across, down in board.ruler_lines_mm
    )
    words = f"{board.ruler_mm} mm" + (f" · {caption}" if caption else "")
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_mm(width)}mm" height="{_mm(height)}mm"'
        f' viewBox="0 0 {_mm(width)} {_mm(height)}">'
        f'<rect width="100%" height="100%" fill="#fff"/>'
        f'<path d="{squares}" fill="#000" shape-rendering="crispEdges"/>'
        f'<path d="{lines}" stroke="#000" stroke-width="{RULER_STROKE_MM}" fill="none"/>'
        f'<text x="{_mm(side)}" y="{_mm(below + WORDS_DOWN_MM)}" font-family="sans-serif"'
        f' font-size="{_mm(WORDS_MM)}">{words}</text></svg>'
    )


def board_pdf(
    board: Board, paper_mm: tuple[float, float], corner_mm: tuple[float, float], caption: str = ""
) -> str:
    """The board as PDF 1.4 on paper of this width and height, which programs print unscaled.

    ``corner_mm`` is the board's upper left corner on the paper. The caption is of ASCII letters
    without brackets, as is the file.
    """
    side, (left, top) = board.side_mm, corner_mm
    width, height = (f"{POINTS * length:.4f}" for length in paper_mm)
    below = top + (board.down + 1) * side
    squares = (
        f"{_mm(left + x)} {_mm(top + y)} {_mm(side)} {_mm(side)} re" for x, y in board.dark_mm
    )
    lines = (
        f"{_mm(left + x)} {_mm(below + y)} m {_mm(left + x + across)} {_mm(below + y + down)} l"
        for x, y, across, down in board.ruler_lines_mm
    )
    words = f"{board.ruler_mm} mm" + (f", {caption}" if caption else "")
    at = f"{POINTS * left:.4f} {POINTS * (paper_mm[1] - below - WORDS_DOWN_MM):.4f} Td"
    drawn = "\n".join((
        f"q {POINTS:.9f} 0 0 {-POINTS:.9f} 0 {height} cm",  # millimetres, downwards
        *squares, "f", f"{RULER_STROKE_MM} w", *lines, "S Q",
        f"BT /F {POINTS * WORDS_MM:.4f} Tf {at} ({words}) Tj ET",
    ))  # fmt: skip
    objects = (
        "<</Type/Catalog/Pages 2 0 R/ViewerPreferences<</PrintScaling/None>>>>",
        "<</Type/Pages/Kids[3 0 R]/Count 1>>",
        f"<</Type/Page/Parent 2 0 R/MediaBox[0 0 {width} {height}]/Contents 4 0 R"
        "/Resources<</Font<</F<</Type/Font/Subtype/Type1/BaseFont/Helvetica>>>>>>>>",
        f"<</Length {len(drawn)}>>stream\n{drawn}\nendstream",
    )
    text, places = "%PDF-1.4\n", []
    for number, content in enumerate(objects, 1):
        places.append(f"{len(text):010d} 00000 n \n")
        text += f"{number} 0 obj\n{content}\nendobj\n"
    count = len(objects) + 1
    table = f"xref\n0 {count}\n0000000000 65535 f \n{''.join(places)}"
    end = f"trailer<</Size {count}/Root 1 0 R>>\nstartxref\n{len(text)}\n%%EOF\n"
    return text + table + end


def _mm(length: float) -> str:
    return f"{length:.4f}".rstrip("0").rstrip(".")
