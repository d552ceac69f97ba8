"""A rolling shutter: each row is exposed a little later, so that moving things lean."""

import math

from simulations.engine.drafting import label
from simulations.engine.drawing import arrow, line, polygon, polyline, rectangle
from simulations.engine.illustration import Illustration, Panel
from simulations.engine.plotting import Axis

WIDTH, HEIGHT = 320.0, 212.0
ROWS, READ_MS = 1080, 20.0
EXPOSURE_MS = 8.0
SPEED_PX_PER_S = 9600.0
"""Ten times the speed of the bus in the chapter's example, whose slant is too small to draw."""
SHOWN = 12  # rows that are drawn
TIME = Axis(0.0, READ_MS + EXPOSURE_MS, 26, 300)
DOWN = Axis(0.0, 1.0, 30, 170)


def delay_ms(row: float) -> float:
    """Delay of a row after the first."""
    return READ_MS * row / ROWS


def shift_px(row: float) -> float:
    """Distance that the bus has moved by then."""
    return SPEED_PX_PER_S * delay_ms(row) / 1000.0


def lean_deg() -> float:
    return math.degrees(math.atan2(shift_px(ROWS), ROWS))


def _rows() -> str:
    marks = []
    height = (DOWN.end - DOWN.start) / SHOWN
    for number in range(SHOWN):
        delay = delay_ms(ROWS * number / SHOWN)
        start, end = TIME.place(delay), TIME.place(delay + EXPOSURE_MS)
        top = DOWN.start + number * height
        marks.append(rectangle((start, top + 2), end - start, height - 4, "light fill thin"))
    foot = DOWN.end + 14
    marks += [
        arrow((TIME.start, foot), (TIME.end, foot), "muted"),
        label((TIME.end, foot + 18), "time", "muted", "end"),
        label((TIME.place(EXPOSURE_MS) + 10, DOWN.start + 9), "first row is open", "light"),
        label((TIME.place(READ_MS) - 34, DOWN.end - 3), "last row is open", "light", "end"),
    ]
    return "".join(marks)


def _bus() -> str:
    unit = (DOWN.end - DOWN.start) / ROWS
    left, right, top, foot = 70.0, 232.0, 330.0, 830.0

    def at(x: float, row: float) -> tuple[float, float]:
        return x + unit * shift_px(row), DOWN.start + unit * row

    def outline(x: float, end: float, first: float, last: float, style: str) -> str:
        return polygon([at(x, first), at(end, first), at(end, last), at(x, last)], style)

    windows = (left + 14 + 36 * place for place in range(4))
    straight = [(left, top), (right, top), (right, foot), (left, foot), (left, top)]
    shift = unit * shift_px(top)
    marks = [
        rectangle((10, DOWN.start), 300, DOWN.end - DOWN.start, "image thin"),
        polyline([(x + shift, DOWN.start + unit * row) for x, row in straight], "muted dashed"),
        outline(left, right, top, foot, "world fill"),
        *(outline(x, x + 26, top + 60, top + 230, "world") for x in windows),
        arrow((right + shift + 22, 60), (right + shift + 62, 60), "ray"),
        line((10, DOWN.end - 12), (310, DOWN.end - 12), "muted thin"),
        label((160, DOWN.end + 26), f"leans by {lean_deg():.0f}°", "error", "middle"),
    ]
    return "".join(marks)


def draw() -> Illustration:
    words = (
        f"Left, the times at which rows are exposed: each begins later than the one above, the "
        f"last {READ_MS:g} ms after the first. Right, a bus that moves to the right meanwhile: its "
        f"lower rows are drawn farther right, and its uprights lean by {lean_deg():.0f}°."
    )
    panels = (
        Panel("rows", "When rows are exposed", WIDTH, HEIGHT, overlay=_rows()),
        Panel("bus", "What a picture shows", WIDTH, HEIGHT, overlay=_bus()),
    )
    return Illustration(panels, words)
