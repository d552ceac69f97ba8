"""The three panels: the picture of the edge, the light across it, and the MTF."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import dot, line, path, rectangle, text
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
LIGHT = Scale(ticks=(0, 1), grid=(0.5, 1), tick_style="muted small")
CONTRAST = Scale(ticks=(0, 0.5, 1), grid=(0.5, 1), tick_style="muted small")
HANDLE_ROW = 40.0
"""Height of the edge's handle."""
SPECK = 1.4
"""Length of the stroke for a pixel."""


def edge_at(angle_deg: float, row: float) -> tuple[float, float]:
    """The point of the edge at a height of the panel."""
    return WIDTH / 2 + (HEIGHT / 2 - row) * math.tan(math.radians(angle_deg)), row


def angle_of(across: float) -> float:
    """Angle in degrees of the edge whose handle is so far from the panel's left."""
    return math.degrees(math.atan2(across - WIDTH / 2, HEIGHT / 2 - HANDLE_ROW))


def over_picture(angle_deg: float) -> str:
    """The edge, its handle, and the row whose pixels are set off."""
    end, foot = edge_at(angle_deg, 0.0), edge_at(angle_deg, HEIGHT)
    corner = (0.0, MIDDLE_ROW * PER_PX)
    return "".join(
        (
            line(foot, end, "casing"),
            line(foot, end, "world dashed"),
            rectangle(corner, WIDTH, PER_PX, "casing"),
            rectangle(corner, WIDTH, PER_PX, "camera"),
            dot(edge_at(angle_deg, HANDLE_ROW), "world", 5),
        )
    )


def light_across(reading: EdgeReading, row: Floats, angle_deg: float) -> str:
    """Each pixel by its distance from the edge; those of one row; the slope of their means."""
    own = centred(COLUMNS) * math.cos(math.radians(angle_deg))
    near = np.abs(own) < REACH
    return "".join(
        (
            ACROSS.frame(Scale("distance from the edge", "px", (-4, 0, 4), style="small"), LIGHT),
            ACROSS.curve(reading.between, reading.slope, "light"),
            _specks(reading),
            *(ACROSS.mark(x, y, "camera", 3.5) for x, y in zip(own[near], row[near], strict=True)),
            legend(
                (ACROSS.x.start, 282),
                (
                    Entry("all pixels", "image", "dot"),
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
            WAVES.frame(Scale("frequency", "cycles per px", (0.5, 1), style="small"), CONTRAST),
            WAVES.upright(NYQUIST, "camera thin dashed"),
            text((WAVES.x.place(NYQUIST), 28), "Nyquist", "camera small ground", "middle"),
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
        yield text(WAVES.at(0.98, 0.75), "too few different distances", "error ground", "end")
        return
    for f, left in zip(FREQUENCIES[::4].tolist(), measured[::4].tolist(), strict=True):
        yield WAVES.mark(f, left, "image", 2.5)
