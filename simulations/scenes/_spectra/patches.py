"""A chart of patches: a column for each surface, a row for each way to see it."""

from dataclasses import dataclass

import numpy as np

from simulations.engine.drawing import Point, dot, line, rectangle, text
from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.scenes._spectra.choices import NAMES

WIDTH, HEIGHT = 400, 320
UNIT = 4
"""View box units per pixel."""
LEFT, TOP = 88, 12
CELL, GAP = 24, 12
"""Width of a patch, and the gap below it."""
KNOB = 302.0
"""Height of the handle, which hangs below the frame of the chosen surface."""


@dataclass(frozen=True, slots=True)
class Chart:
    """The layout of a chart."""

    rows: tuple[tuple[str, str], ...]
    """Names of the rows and their colour roles, from the top."""
    row: int
    """Height of a patch in view box units, a multiple of 8."""
    gap: int = GAP
    """Space between the rows, a multiple of 4."""

    def paint(self, steps: tuple[Floats, ...], *, twin: bool) -> Raster:
        """Bytes (H, W, 4) from linear sRGB (2, 12, 3) for each row; twins in the lower halves."""
        shown = np.stack([each if twin else each[[0, 0]] for each in steps])
        cells = to_rgba8(encode_srgb(shown.reshape(-1, len(NAMES), 3)))
        picture = np.zeros((HEIGHT // UNIT, WIDTH // UNIT, 4), np.uint8)
        halves = cells.repeat(self.row // UNIT // 2, axis=0).repeat(CELL // UNIT, axis=1)
        high, left = self.row // UNIT, LEFT // UNIT
        for row in range(len(self.rows)):
            top = self.top(row) // UNIT
            patches = halves[row * high : (row + 1) * high]
            picture[top : top + high, left : left + patches.shape[1]] = patches
        return picture

    def overlay(self, surface: str) -> str:
        """The names and borders of the rows, and a frame around the chosen surface."""
        corner = (LEFT + NAMES.index(surface) * CELL, TOP - 4)
        size = (CELL, self.top(len(self.rows)) - self.gap - TOP + 8)
        knob = middle(surface)
        names = [
            text((LEFT - 8, self.top(row) + self.row / 2 + 4.5), name, role, "end")
            for row, (name, role) in enumerate(self.rows)
        ]
        frame = rectangle(corner, *size, "ray bold")
        stem = line((knob[0], corner[1] + size[1]), knob, "ray bold")
        across, down = CELL * len(NAMES), self.top(len(self.rows)) - self.gap - TOP
        tops = range(TOP, TOP + down, self.row + self.gap) if self.gap else (TOP,)
        high = self.row if self.gap else down
        borders = [rectangle((LEFT, top), across, high, "muted thin faint") for top in tops]
        return "".join((*names, *borders, frame, stem, dot(knob, "ray", 5)))

    def top(self, row: int) -> int:
        """Upper edge of a row."""
        return TOP + row * (self.row + self.gap)


def surface_at(place: Point) -> str:
    """The surface whose column is nearest to a place of the panel."""
    column = int((float(place[0]) - LEFT) // CELL)
    return NAMES[min(max(column, 0), len(NAMES) - 1)]


def middle(surface: str) -> tuple[float, float]:
    """The handle of the column."""
    return LEFT + (NAMES.index(surface) + 0.5) * CELL, KNOB
