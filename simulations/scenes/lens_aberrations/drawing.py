"""The drawings of the lens-aberrations scene: the frame of the close-up, and the two profiles."""

import math
from collections.abc import Iterator

from simulations.engine.drawing import dot, line, rectangle, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats

WIDTH, HEIGHT = 400.0, 300.0
TANGENTS = Axis(0.0, 1.0, 54.0, 384.0)
"""Tangent of the field angle, from the middle to the corner."""
LIGHT = Plot(TANGENTS, Axis(0.0, 1.0, 150.0, 30.0))
SHIFT = Plot(TANGENTS, Axis(-3.0, 3.0, 260.0, 176.0))
"""In pixels."""
SHARES = Scale(ticks=((1.0, "1"), (0.5, "½"), (0.25, "¼"), (0.0, "0")), grid=(1.0, 0.5, 0.25, 0.0))
PIXELS = Scale(ticks=(-2, 0, 2), grid=(-2, 0, 2))
ANGLES = Scale(ticks=[(math.tan(math.radians(angle)), f"{angle}°") for angle in (0, 15, 30, 45)])


def close_up_frame(left: float, top: float) -> str:
    """The frame of the close-up; ``left`` and ``top`` are shares of the picture."""
    corner, size = (left * WIDTH, top * HEIGHT), ((1 - left) * WIDTH - 1, (1 - top) * HEIGHT - 1)
    return "".join(rectangle(corner, *size, style) for style in ("casing", "camera"))


def profile(
    tangents: Floats, cos4: Floats, open_share: Floats, corner_px: tuple[float, float]
) -> str:
    """Light above, shifts of red and blue below, against the tangent of the field angle."""
    return "".join((*_light(tangents, cos4, open_share), *_shifts(corner_px)))


def corner_light_mark(share: float) -> tuple[float, float]:
    """A share of the light, at the corner's end of the plot."""
    return LIGHT.at(1.0, share)


def corner_light_marked(row: float) -> float:
    """The share of the light that is plotted in a row."""
    return LIGHT.y.value(row)


def corner_shift_mark(shift_px: float) -> tuple[float, float]:
    """A shift, at the corner's end of the plot."""
    return SHIFT.at(1.0, shift_px)


def corner_shift_marked(row: float) -> float:
    """The shift that is plotted in a row, in pixels."""
    return SHIFT.y.value(row)


def _light(tangents: Floats, cos4: Floats, open_share: Floats) -> Iterator[str]:
    x, top = LIGHT.at(1.0, 1.0)
    yield LIGHT.grid(Scale(), SHARES)
    yield LIGHT.y_axis(SHARES)
    yield text((8, top - 12), "light", "")
    yield text((x - 16, top - 12), "rim", "camera", "end")
    yield text((x - 50, top - 12), "cos⁴", "light", "end")
    yield LIGHT.curve(tangents, open_share, "camera dashed")
    yield LIGHT.curve(tangents, cos4, "light dashed")
    yield LIGHT.curve(tangents, cos4 * open_share, "bold")
    yield dot(corner_light_mark(float(open_share[-1])), "camera")


def _shifts(corner_px: tuple[float, float]) -> Iterator[str]:
    left, foot = TANGENTS.start, SHIFT.y.start
    yield SHIFT.grid(Scale(), PIXELS)
    yield SHIFT.y_axis(PIXELS)
    yield line((left, foot), (TANGENTS.end, foot), "muted")
    yield SHIFT.x_axis(ANGLES)
    yield text((8, SHIFT.y.end), "shift, px", "error")
    for name, shift, style in (
        ("red", corner_px[0], "error bold"),
        ("blue", corner_px[1], "image bold"),
    ):
        yield line(SHIFT.at(0.0, 0.0), corner_shift_mark(shift), style)
        if abs(corner_px[1] - corner_px[0]) > 0.8:
            x, y = SHIFT.at(0.86, 0.86 * shift)
            below = shift < 0 and y + 20 < SHIFT.y.start
            role = style.partition(" ")[0]
            yield text((x, y + (16 if below else -7)), name, f"{role} halo", "middle")
    yield dot(corner_shift_mark(corner_px[1]), "image")
    yield text(((left + TANGENTS.end) / 2, foot + 36), "angle from the axis", "", "middle")
