"""The three panels: the picture of the edge, the light across it, and the MTF."""

import math
from collections.abc import Iterator, Sequence
from textwrap import wrap

import numpy as np

from simulations.engine.drawing import dot, line, path, rectangle, text
from simulations.engine.frame import format_number
from simulations.engine.handles import Point
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.models.pixel_grid import centred
from simulations.models.sampling.slanted_edge import FREQUENCIES, EdgeReading
from simulations.models.sampling.slanted_edge_line import EdgeLine
from simulations.models.sampling.slanted_edge_pixels import EdgePixels
from simulations.scenes.slanted_edge.rectangle import HEIGHT, WIDTH, Box, centre_of, corner_of
from simulations.scenes.slanted_edge.settings import Settings
from simulations.scenes.slanted_edge.stages import Place, Sharpness

REACHES = (4.0, 8.0, 16.0, 32.0, 64.0)
"""Pixels either side of the edge that the second panel may show ..."""
RISES = 2.0
"""... at least so many times the width over which the light rises from a tenth to nine tenths."""
NYQUIST = 0.5
CONTRAST = (0, 0.5, 1)
HANDLE_ROW = 20.0
"""Height of the edge's handle."""
SPECK, MOST_SPECKS = 1.4, 800
"""Length of the stroke for a pixel, and how many are drawn."""
EDGE = "world dashed"
WORDS, LINE, ROOM = 42, 20.0, 80.0
"""Letters in a line of a refusal, height of a line, and of all lines."""


def edge_at(angle_deg: float, row: float) -> tuple[float, float]:
    """The point of the simulated edge at a height of the panel."""
    return WIDTH / 2 + (HEIGHT / 2 - row) * math.tan(math.radians(angle_deg)), row


def angle_of(across: float) -> float:
    """Angle in degrees of the edge whose handle is so far from the panel's left."""
    return math.degrees(math.atan2(across - WIDTH / 2, HEIGHT / 2 - HANDLE_ROW))


def over_picture(
    settings: Settings, box: Box, pixels: EdgePixels | str, simulated: bool, refusal: str
) -> str:
    """The edge, the rectangle, the row whose pixels are set off, the handles, and a refusal."""
    (left, top), (right, bottom) = centre_of(settings), corner_of(settings)
    left, top = 2 * left - right, 2 * top - bottom
    frame = ((left, top), right - left, bottom - top)
    found = pixels.line if isinstance(pixels, EdgePixels) else None
    parts: list[str] = []
    if simulated:
        parts += _both((edge_at(settings.angle, HEIGHT), edge_at(settings.angle, 0.0)), EDGE)
    elif found:
        parts += _both(_ends(found, box), EDGE)
    parts += [
        rectangle(*frame, "casing"),
        rectangle(*frame, "error" if refusal else "image"),
        *(_both(_row(found, box), "camera") if found else ()),
        dot(centre_of(settings), "image", 4),
        dot(corner_of(settings), "image", 5),
    ]
    if simulated:
        parts.append(dot(edge_at(settings.angle, HANDLE_ROW), "world", 5))
    parts += _sentence(refusal, below=bottom < HEIGHT - ROOM)
    return "".join(parts)


def kept_places(places: Sequence[Place]) -> str:
    """The rectangles that were kept, each with its MTF50 in cycles per pixel."""
    parts = []
    for place in places:
        box, half = place.box, place.sharpness.half.frequency
        wide, high = box.right - box.left, box.bottom - box.top
        corner, middle = box.at(0, 0), box.at(0.5 * wide, 0.5 * high)
        size = (wide / box.per_unit, high / box.per_unit)
        words = "no MTF" if place.sharpness.refusal else format_number(half, 3)
        parts += [
            rectangle(corner, *size, "casing"),
            rectangle(corner, *size, "image thin"),
            text((middle[0], middle[1] + 5.0), words, "image small ground", "middle"),
        ]
    return "".join(parts)


def _sentence(refusal: str, *, below: bool) -> Iterator[str]:
    """A refusal in lines, at the foot of the picture, or at its top if the rectangle is there."""
    lines = wrap(refusal, WORDS)
    first = HEIGHT - 14.0 - LINE * (len(lines) - 1) if below else HANDLE_ROW + 30.0
    for number, words in enumerate(lines):
        yield text((WIDTH / 2, first + LINE * number), words, "error ground", "middle")


def _both(ends: Sequence[Point], style: str) -> Iterator[str]:
    yield line(ends[0], ends[1], "casing")
    yield line(ends[0], ends[1], style)


def _ends(edge: EdgeLine, box: Box) -> Sequence[Point]:
    """The ends of the edge that was found, in the panel."""
    y = centred(edge.picture.shape[0])[edge.rows[[0, -1]]]
    return [_in_panel(edge, box, x, y) for x, y in zip(edge.column(y), y, strict=True)]


def _row(edge: EdgeLine, box: Box) -> Sequence[Point]:
    """The ends of the row, or column, in the middle."""
    end = 0.5 * edge.picture.shape[1]
    y = float(centred(edge.picture.shape[0])[middle_row(edge)])
    return [_in_panel(edge, box, x, y) for x in (-end, end)]


def middle_row(edge: EdgeLine) -> int:
    """Index of the row that is set off."""
    return int(edge.rows[len(edge.rows) // 2])


def _in_panel(edge: EdgeLine, box: Box, x: float, y: float) -> Point:
    """A place from the middle of the picture as it was turned, in the panel."""
    across = -x if edge.mirrored else x
    column, row = (y, across) if edge.turned else (across, y)
    width, height = box.right - box.left, box.bottom - box.top
    return box.at(0.5 * width + column, 0.5 * height + row)


def light_across(pixels: EdgePixels | str, reading: EdgeReading | None) -> str:
    """Each pixel by its distance from the edge; those of one row; the slope of their curve."""
    reach = REACHES[0] if reading is None else _reach(reading)
    place = np.linspace(-1.0, 1.0, 161) * reach
    slope = np.zeros(1) if reading is None else reading.curve.slope(place)
    plot = Plot(
        Axis(-reach, reach, 34.0, 388.0), Axis(-0.2, max(1.2, float(slope.max())), 222.0, 40.0)
    )
    light = Scale(ticks=(0, 1), grid=(0, 1), tick_style="muted small")
    across = Scale("distance from the edge", "px", (-reach, 0, reach), style="small")
    parts = [plot.frame(across, light)]
    if reading is not None:
        parts.append(plot.curve(place, slope, "light"))
        parts.append(plot.curve(place, reading.curve.spread(place), "image thin"))
    if isinstance(pixels, EdgePixels):
        parts.append(_specks(plot, pixels.distance, pixels.value))
        parts += _dots_of_row(plot, pixels)
    entries = (
        Entry("all pixels", "image", "dot"),
        Entry("one row", "camera", "dot"),
        Entry("slope, per px", "light"),
    )
    parts.append(legend((plot.x.start, 288), entries, "small", plot.x.end - plot.x.start))
    return "".join(parts)


def _reach(reading: EdgeReading) -> float:
    wanted = min(RISES * reading.rise, 0.5 * reading.pixels.reach)
    return next(reach for reach in REACHES if reach >= wanted)


def _specks(plot: Plot, distance: Floats, value: Floats) -> str:
    near = np.flatnonzero(np.abs(distance) < plot.x.high)
    near = near[:: max(1, math.ceil(near.size / MOST_SPECKS))]
    x = plot.x.position(distance[near]).tolist()
    y = plot.y.position(np.clip(value[near], plot.y.low, plot.y.high)).tolist()
    half = SPECK / 2
    return path([[(u - half, v), (u + half, v)] for u, v in zip(x, y, strict=True)], "image bold")


def _dots_of_row(plot: Plot, pixels: EdgePixels) -> Iterator[str]:
    near = (pixels.row == len(pixels.line.rows) // 2) & (np.abs(pixels.distance) < plot.x.high)
    for x, y in zip(pixels.distance[near].tolist(), pixels.value[near].tolist(), strict=True):
        yield plot.mark(x, y, "camera", 3.5)


def waves_left(sharpness: Sharpness, true: Floats) -> str:
    """The MTF as measured from the picture, and by the formulae if they are known."""
    known = not np.isnan(true).any()
    most = 1.05 if sharpness.refusal else max(1.05, float(sharpness.contrast.max()) + 0.05)
    plot = Plot(Axis(0.0, 1.0, 34.0, 388.0), Axis(0.0, most, 222.0, 40.0))
    contrast = Scale(ticks=CONTRAST, grid=(0.5, 1), tick_style="muted small")
    parts = [
        plot.region(x=(NYQUIST, 1.0)),
        plot.frame(Scale("frequency", "cycles per px", (0.5, 1), style="small"), contrast),
        plot.upright(NYQUIST, "camera thin dashed"),
        text((plot.x.place(NYQUIST), 28), "Nyquist", "camera small ground", "middle"),
        plot.curve(FREQUENCIES, true, "ray bold") if known else "",
        *(() if sharpness.refusal else _measured(plot, sharpness)),
        legend(
            (plot.x.start, 288),
            (
                Entry("lens × pixel", "ray bold", shown=known),
                Entry("from the edge ± 2 errors", "image", "dot"),
            ),
            "small",
        ),
    ]
    return "".join(parts)


def _measured(plot: Plot, sharpness: Sharpness) -> Iterator[str]:
    """The contrast with twice its standard error, and MTF50."""
    every = slice(0, None, 4)
    contrast, error = sharpness.contrast[every], 2.0 * sharpness.error[every]
    bars = zip(FREQUENCIES[every].tolist(), contrast.tolist(), error.tolist(), strict=True)
    strokes = [[plot.clamped(f, c - e), plot.clamped(f, c + e)] for f, c, e in bars]
    yield path(strokes, "image")
    for f, left in zip(FREQUENCIES[every].tolist(), contrast.tolist(), strict=True):
        yield plot.mark(f, left, "image", 2.5)
    if np.isfinite(sharpness.half.frequency):
        yield plot.drop(sharpness.half.frequency, 0.5, "image thin dashed", "xy")
