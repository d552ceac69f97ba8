"""The drawings of the lens-aberrations scene: the frame of the close-up, and the two profiles."""

from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import Point, dot, line, path, polyline, rectangle, text
from simulations.engine.frame import format_number
from simulations.models.arrays import Floats

WIDTH, HEIGHT = 400.0, 300.0
LEFT, RIGHT = 54.0, 384.0
LIGHT_TOP, LIGHT_BOTTOM = 30.0, 150.0
SHIFT_MIDDLE, SHIFT_HALF = 222.0, 42.0
LARGEST_SHIFT_PX = 3.0
"""At the ends of the shift axis."""


def close_up_frame(left: float, top: float) -> str:
    """Where the close-up lies; ``left`` and ``top`` are shares of the picture."""
    corner, size = (left * WIDTH, top * HEIGHT), ((1 - left) * WIDTH - 1, (1 - top) * HEIGHT - 1)
    return "".join(rectangle(corner, *size, style) for style in ("casing", "camera"))


def profile(
    tangents: Floats, cos4: Floats, open_share: Floats, corner_px: tuple[float, float]
) -> str:
    """Light above, shifts of red and blue below, against the tangent of the field angle."""
    return "".join((*_light(tangents, cos4, open_share), *_shifts(corner_px), *_angles()))


def corner_light_mark(share: float) -> tuple[float, float]:
    """A share of the light, at the corner's end of the plot."""
    return _x(1.0), LIGHT_BOTTOM - (LIGHT_BOTTOM - LIGHT_TOP) * share


def corner_light_marked(row: float) -> float:
    """The share of the light that is plotted in a row."""
    return (LIGHT_BOTTOM - row) / (LIGHT_BOTTOM - LIGHT_TOP)


def corner_shift_mark(shift_px: float) -> tuple[float, float]:
    """A shift, at the corner's end of the plot."""
    return _x(1.0), SHIFT_MIDDLE - SHIFT_HALF / LARGEST_SHIFT_PX * shift_px


def corner_shift_marked(row: float) -> float:
    """The shift that is plotted in a row, in pixels."""
    return (SHIFT_MIDDLE - row) * LARGEST_SHIFT_PX / SHIFT_HALF


def _x(tangent: float) -> float:
    return LEFT + (RIGHT - LEFT) * tangent


def _curve(tangents: Floats, share: Floats) -> list[Point]:
    return [
        (_x(float(t)), LIGHT_BOTTOM - (LIGHT_BOTTOM - LIGHT_TOP) * float(s))
        for t, s in zip(tangents, share, strict=True)
    ]


def _light(tangents: Floats, cos4: Floats, open_share: Floats) -> Iterator[str]:
    grid = []
    for share, label in ((1.0, "1"), (0.5, "½"), (0.25, "¼"), (0.0, "0")):
        y = LIGHT_BOTTOM - (LIGHT_BOTTOM - LIGHT_TOP) * share
        grid.append([(LEFT, y), (RIGHT, y)])
        yield text((LEFT - 9, y + 4.5), label, "muted", "end")
    yield path(grid, "muted thin faint")
    yield text((8, LIGHT_TOP - 12), "light", "")
    yield text((RIGHT - 16, LIGHT_TOP - 12), "rim", "camera", "end")
    yield text((RIGHT - 50, LIGHT_TOP - 12), "cos⁴", "light", "end")
    yield polyline(_curve(tangents, open_share), "camera dashed")
    yield polyline(_curve(tangents, cos4), "light dashed")
    yield polyline(_curve(tangents, cos4 * open_share), "bold")
    yield dot(corner_light_mark(float(open_share[-1])), "camera")


def _shifts(corner_px: tuple[float, float]) -> Iterator[str]:
    y_of = SHIFT_HALF / LARGEST_SHIFT_PX
    grid = []
    for shift in (-2.0, 0.0, 2.0):
        y = SHIFT_MIDDLE - y_of * shift
        grid.append([(LEFT, y), (RIGHT, y)])
        yield text((LEFT - 9, y + 4.5), format_number(shift, 0), "muted", "end")
    yield path(grid, "muted thin faint")
    yield text((8, SHIFT_MIDDLE - SHIFT_HALF - 4), "shift, px", "error")
    for name, shift, style in (
        ("red", corner_px[0], "error bold"),
        ("blue", corner_px[1], "image bold"),
    ):
        yield line((_x(0.0), SHIFT_MIDDLE), corner_shift_mark(shift), style)
        if abs(corner_px[1] - corner_px[0]) > 0.8:
            y = SHIFT_MIDDLE - y_of * 0.86 * shift
            below = shift < 0 and y + 20 < SHIFT_MIDDLE + SHIFT_HALF
            place = (_x(0.86), y + (16 if below else -7))
            yield text(place, name, f"{style.partition(' ')[0]} halo", "middle")
    yield dot(corner_shift_mark(corner_px[1]), "image")


def _angles() -> Iterator[str]:
    for degrees in (0, 15, 30, 45):
        x = _x(float(np.tan(np.radians(degrees))))
        yield line((x, SHIFT_MIDDLE + SHIFT_HALF), (x, SHIFT_MIDDLE + SHIFT_HALF - 5), "muted")
        yield text((x, SHIFT_MIDDLE + SHIFT_HALF + 16), f"{degrees}°", "muted", "middle")
    row = SHIFT_MIDDLE + SHIFT_HALF
    yield line((LEFT, row), (RIGHT, row), "muted")
    yield text(((LEFT + RIGHT) / 2, row + 31), "angle from the axis", "", "middle")
