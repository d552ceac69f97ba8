"""The digits of both computations that are right at the mark, as bars of one cell per digit."""

import math

from simulations.engine.drawing import line, path, rectangle, text
from simulations.engine.frame import format_number
from simulations.scenes.stability import plot
from simulations.scenes.stability.errors import Errors
from simulations.scenes.stability.settings import Settings

WIDTH, HEIGHT = 400.0, 290.0
LEFT, RIGHT, BAR = 16.0, 384.0, 46.0
ROWS = (66.0, 178.0)
"""Tops of the two bars."""
CELLS = {"float64": 16, "float32": 8}
"""Digits that each format can hold, rounded up."""


def right_digits(error: float) -> str:
    """Right digits to a tenth; a text if there are no inputs."""
    return "no inputs" if math.isnan(error) else format_number(-math.log10(error), 1)


def draw(settings: Settings, errors: Errors) -> str:
    """SVG markup of the panel; a dashed line marks what the rounded inputs allow, κ u."""
    at, cells = plot.place_of(settings), CELLS[settings.digits]
    names = plot.CURVE_NAMES[settings.formula]
    parts = []
    for top, name, role, curve in zip(
        ROWS, names, ("error", "image"), (errors.written, errors.rearranged), strict=True
    ):
        error = float(plot.shown(curve, settings.digits)[at])
        parts += [
            text((LEFT, top - 12.0), name, f"{role} strong"),
            text((RIGHT, top - 12.0), right_digits(error), f"{role} strong", "end"),
            _bar(top, 0.0 if math.isnan(error) else -math.log10(error), cells, role),
        ]
    bound = float(errors.bound[at])
    if not math.isnan(bound):
        x = _column(-math.log10(bound), cells)
        foot = ROWS[1] + BAR + 10.0
        parts.append(line((x, ROWS[0] - 6.0), (x, foot), "muted dashed"))
        left = x > WIDTH / 2
        parts.append(
            text(
                (x, foot + 16.0),
                "what rounded inputs allow",
                "muted small",
                "end" if left else "start",
            )
        )
    return "".join(parts)


def _column(digits: float, cells: int) -> float:
    return LEFT + (RIGHT - LEFT) * min(max(digits / cells, 0.0), 1.0)


def _bar(top: float, digits: float, cells: int, role: str) -> str:
    """Cells, the right digits filled."""
    edges = [LEFT + (RIGHT - LEFT) * index / cells for index in range(1, cells)]
    filled = _column(digits, cells) - LEFT
    return "".join(
        (
            rectangle((LEFT, top), RIGHT - LEFT, BAR, "muted thin"),
            rectangle((LEFT, top), filled, BAR, f"{role} solid faint") if filled > 0 else "",
            path([[(x, top), (x, top + BAR)] for x in edges], "muted thin faint"),
        )
    )
