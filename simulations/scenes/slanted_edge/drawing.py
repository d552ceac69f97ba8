"""The three panels: the picture of the edge, the light across it, and the MTF."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import Point, dot, line, path, rectangle, text
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale
from simulations.models.arrays import Floats
from simulations.models.pixel_grid import centred
from simulations.models.sampling.slanted_edge import EdgeReading
from simulations.scenes.slanted_edge.stages import COLUMNS, FREQUENCIES, ROWS

WIDTH, HEIGHT = 400.0, 300.0
PER_PX = WIDTH / COLUMNS
MIDDLE_ROW = ROWS // 2
REACH = 4.0
"""Pixels either side of the edge that the second panel shows."""
ACROSS = Plot(Axis(-REACH, REACH, 34.0, 388.0), Axis(0.0, 1.05, 214.0, 40.0))
WAVES = Plot(Axis(0.0, 1.0, 34.0, 388.0), Axis(0.0, 1.05, 214.0, 40.0))
NYQUIST = 0.5
LEVELS = Scale(ticks=(0, 0.5, 1), grid=(0.5, 1), tick_style="muted small")
SPECK = 1.4
"""Length of the stroke for a pixel."""


def edge_end(angle_deg: float) -> Point:
    """The point where the edge leaves the picture at its upper border."""
    return WIDTH / 2 + HEIGHT / 2 * math.tan(math.radians(angle_deg)), 0.0


def angle_of(place: Point) -> float:
    """Angle in degrees of the edge that leaves the picture above a place."""
    right, up = float(place[0]) - WIDTH / 2, HEIGHT / 2 - float(place[1])
    return math.degrees(math.atan2(right, max(up, 1.0)))


def over_picture(angle_deg: float) -> str:
    """The edge, the handle at its end, and the row whose pixels are set off."""
    end = edge_end(angle_deg)
    foot = (WIDTH - end[0], HEIGHT)
    corner = (0.0, MIDDLE_ROW * PER_PX)
    return "".join(
        (
            line(foot, end, "casing"),
            line(foot, end, "world dashed"),
            rectangle(corner, WIDTH, PER_PX, "casing"),
            rectangle(corner, WIDTH, PER_PX, "camera"),
            dot((end[0], 6.0), "world", 5),
        )
    )


def light_across(reading: EdgeReading, row: Floats, angle_deg: float) -> str:
    """Each pixel by its distance from the edge; those of one row; the slope of their means."""
    own = centred(COLUMNS) * math.cos(math.radians(angle_deg))
    near = np.abs(own) < REACH
    return "".join(
        (
            ACROSS.frame(Scale("distance from the edge", "px", style="small"), LEVELS),
            ACROSS.curve(reading.between, reading.slope, "light"),
            _specks(reading),
            *(ACROSS.mark(x, y, "camera", 3.5) for x, y in zip(own[near], row[near], strict=True)),
            legend(
                (ACROSS.x.start, 282),
                (
                    Entry("all pixels", "image bold"),
                    Entry("one row", "camera", "dot"),
                    Entry("slope, per px", "light"),
                ),
                "small",
                ACROSS.x.end - ACROSS.x.start,
            ),
        )
    )


def _specks(reading: EdgeReading) -> str:
    near = np.abs(reading.distance) < REACH
    x = ACROSS.x.position(reading.distance[near]).tolist()
    y = ACROSS.y.position(reading.value[near]).tolist()
    half = SPECK / 2
    return path([[(u - half, v), (u + half, v)] for u, v in zip(x, y, strict=True)], "image bold")


def waves_left(measured: Floats, true: Floats) -> str:
    """The MTF by the formulae, and as measured from the picture."""
    return "".join(
        (
            WAVES.region(x=(NYQUIST, 1.0)),
            WAVES.frame(Scale("frequency", "cycles per px", style="small"), LEVELS),
            WAVES.upright(NYQUIST, "camera thin dashed"),
            text((WAVES.x.place(NYQUIST), 28), "Nyquist", "camera small halo", "middle"),
            WAVES.curve(FREQUENCIES, true, "ray bold"),
            *_dots(measured),
            legend(
                (WAVES.x.start, 282),
                (Entry("lens × pixel", "ray bold"), Entry("from the edge", "image", "dot")),
                "small",
            ),
        )
    )


def _dots(measured: Floats) -> Iterator[str]:
    if np.isnan(measured).any():
        yield text((WAVES.x.place(0.5), 130), "too few different distances", "error halo", "middle")
        return
    for f, left in zip(FREQUENCIES[::2].tolist(), measured[::2].tolist(), strict=True):
        yield WAVES.mark(f, left, "image", 2.5)
