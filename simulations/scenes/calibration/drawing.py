"""The photograph with its corners and their errors."""

import math

import numpy as np

from simulations.engine.drawing import circle, line, path, rectangle, text
from simulations.engine.frame import format_number
from simulations.engine.letters import width_of
from simulations.models.arrays import Floats

WIDTH = 400.0
"""View box units of the width of a photograph."""
ARROW, STROKE = 13.0, 7.0
"""Lengths that the RMS error is enlarged to, about: of one photograph, and of many."""
HEAD = 4.0
NAMES = ("photograph", "without distortion")
MARGIN = 10.0
LINE_AT = 0.9
"""Place of the handle on the dividing line, as a share of the height from the top."""


def view_box(size: tuple[int, int]) -> tuple[float, float]:
    """Width and height of the panel of a photograph of this size."""
    return WIDTH, size[1] * WIDTH / size[0]


def to_view(pixels: Floats, size: tuple[int, int]) -> Floats:
    """Places (..., 2) in the panel of places in the photograph."""
    return (pixels + 0.5) * (WIDTH / size[0])


def enlargement(rms_px: float, size: tuple[int, int], length: float = ARROW) -> float:
    """1, 2 or 5 times a power of ten, by which errors of this size become visible arrows."""
    wanted = length / max(rms_px * WIDTH / size[0], 1e-9)
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power <= wanted)


def corners(found: Floats, off: Floats, size: tuple[int, int], times: float) -> str:
    """The found corners (N, 2), each with its error, ``times`` enlarged, as an arrow."""
    start = to_view(found, size)
    end = start + off * (times * WIDTH / size[0])
    marks = [circle(place, 2.2, "image thin") for place in start]
    return "".join(("".join(marks), _arrows(start, end)))


def strokes(found: Floats, off: Floats, size: tuple[int, int], times: float) -> str:
    """The errors of many photographs' corners (N, 2), each a stroke that starts at its corner."""
    start = to_view(found, size)
    end = start + off * (times * WIDTH / size[0])
    lines = np.stack((start, end), axis=1)
    return path(lines, "casing") + path(lines, "error")


def _arrows(start: Floats, end: Floats) -> str:
    """Arrows (N, 2) in two elements."""
    shaft = end - start
    length = np.maximum(np.hypot(*shaft.T), 1e-9)[:, None]
    along = shaft / length * np.minimum(HEAD, 0.6 * length)
    across = along[:, ::-1] * (0.45, -0.45)
    heads = np.stack((end - along + across, end, end - along - across), axis=1)
    strokes = [*np.stack((start, end), axis=1), *heads]
    return path(strokes, "casing") + path(strokes, "error")


def legend(times: float, used: bool) -> str:
    """What the arrows show."""
    words = f"errors × {format_number(times, 0 if times >= 1 else 1)}"
    if not used:
        words += ", photograph not used"
    return text((MARGIN, 20.0), words, "error small ground")


def dividing_line(share: float, size: tuple[int, int]) -> str:
    """The line between the photograph and the undistorted one, and their names where there is
    room."""
    width, height = view_box(size)
    x, foot = share * width, height - MARGIN
    if share == 1.0:
        return text((width - 30.0, LINE_AT * height + 4.0), NAMES[1], "small ground", "end")
    parts = [line((x, 0), (x, height), style) for style in ("casing", "image bold")]
    if x > width_of(NAMES[0], "small") + 2 * MARGIN:
        parts.append(text((MARGIN, foot), NAMES[0], "small ground"))
    if width - x > width_of(NAMES[1], "small") + 2 * MARGIN:
        parts.append(text((width - MARGIN, foot), NAMES[1], "small ground", "end"))
    return "".join(parts)


def empty(size: tuple[int, int]) -> str:
    """The border of a photograph that is not at hand."""
    width, height = view_box(size)
    return rectangle((0.5, 0.5), width - 1.0, height - 1.0, "muted thin")
