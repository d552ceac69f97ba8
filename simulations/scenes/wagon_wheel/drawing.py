"""Drawings of the wagon wheel: the wheel itself, marks on the film, spokes against time."""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drawing import (
    Point,
    arrow,
    circle,
    dot,
    line,
    path,
    polyline,
    text,
)
from simulations.engine.plotting.axis import Axis
from simulations.engine.plotting.clipping import clipped
from simulations.engine.plotting.legend import Entry, legend
from simulations.engine.plotting.plot import Plot
from simulations.engine.plotting.scale import Scale

WIDTH, HEIGHT = 400.0, 300.0
CENTRE, RADIUS = (200.0, 150.0), 115.0

HEAD = 9.0
DIAL, DIAL_END, FASTEST = 18.0, math.radians(80.0), 6.0
"""Distance of the dial of speeds from the rim, its end as an angle from the top, and the largest
speed."""

BEFORE, AFTER = 6.0, 2.0
"""Frames of the past and the future that the plot shows."""
ROWS = 3.0
"""Spoke spacings on its other axis."""
PLOT = Plot(Axis(-BEFORE, AFTER, 48.0, 386.0), Axis(0.0, ROWS, 246.0, 44.0))
"""Frames from now, and spoke spacings."""


def wheel(spokes: int, angle_rad: float, speed: float) -> str:
    """The wheel at this moment; one spoke is marked, which the film does not record."""
    ends = [angle_rad + 2 * math.pi * index / spokes for index in range(spokes)]
    bars = [[_polar(end, 14), _polar(end, RADIUS - 4)] for end in ends]
    parts = [
        circle(CENTRE, RADIUS, "world bold"),
        circle(CENTRE, RADIUS - 9, "world thin"),
        path(bars[1:], "world bold"),
        path(bars[:1], "ray bold"),
        dot(marked_spoke(angle_rad), "ray", 6),
        circle(CENTRE, 14, "world fill"),
    ]
    mark = on_dial(speed)
    right = mark[0] >= CENTRE[0]
    name = (mark[0] + (14 if right else -14), mark[1] - 4)
    parts += [*_dial(), _arrow(speed, "world bold"), dot(mark, "world", 5)]
    return "".join((*parts, text(name, "speed", "world small ground", "start" if right else "end")))


def marked_spoke(angle_rad: float) -> tuple[float, float]:
    """The end of the marked spoke at the rim."""
    return _polar(angle_rad, RADIUS - 4)


def over_film(apparent: float, certain: bool) -> str:
    """The apparent motion of the frames; in both senses where nothing tells them apart."""
    return "".join(
        _arrow(seen, style)
        for seen in ((apparent,) if certain else (apparent, -apparent))
        if abs(seen) > 1e-9
        for style in ("casing", "error bold")
    )


def on_dial(speed: float) -> tuple[float, float]:
    """Place of a speed, in turns per second, on the dial, whose scale is wider for slow ones."""
    turned = math.copysign(math.sqrt(min(abs(speed) / FASTEST, 1.0)), speed)
    return _polar(-math.pi / 2 + turned * DIAL_END, RADIUS + DIAL)


def speed_at(place: Point) -> float:
    """The speed on the dial in the direction of a place."""
    across, up = float(place[0]) - CENTRE[0], CENTRE[1] - float(place[1])
    turned = math.atan2(across, up) / DIAL_END
    return FASTEST * math.copysign(turned * turned, turned)


def angle_at(place: Point) -> float:
    """Angle of a place about the wheel's centre, clockwise from the right, in radians."""
    return math.atan2(float(place[1]) - CENTRE[1], float(place[0]) - CENTRE[0])


def _dial() -> Iterator[str]:
    """The dial above the wheel; speeds to the right turn it clockwise."""
    arc = [_polar(-math.pi / 2 + DIAL_END * step / 24, RADIUS + DIAL) for step in range(-24, 25)]
    yield polyline(arc, "muted thin faint")
    whole = [on_dial(float(speed)) for speed in range(-int(FASTEST), int(FASTEST) + 1)]
    outwards = 1.0 + 5.0 / (RADIUS + DIAL)
    ticks = [
        [(x, y), (CENTRE[0] + (x - CENTRE[0]) * outwards, CENTRE[1] + (y - CENTRE[1]) * outwards)]
        for x, y in whole
    ]
    yield path(ticks, "muted thin")


def _arrow(speed: float, style: str) -> str:
    """An arrow along the dial from the top to a speed; without head if it is shorter than that."""
    end = on_dial(speed)
    top = -math.pi / 2
    angle = math.atan2(end[1] - CENTRE[1], end[0] - CENTRE[0])
    arc = [_polar(top + (angle - top) * step / 24, RADIUS + DIAL) for step in range(25)]
    before_head = [point for point in arc if math.dist(point, end) > HEAD]
    if not before_head:
        return polyline(arc, style)
    return polyline(before_head, style) + arrow(before_head[-1], end, style, HEAD)


def track(per_frame: float, seen_per_frame: float, certain: bool, time: float) -> str:
    """Positions of the spokes over time: lines for the truth, dots for the frames.

    ``per_frame`` and ``seen_per_frame`` are in spoke spacings per frame; the spokes are equal, so
    that the picture repeats at every whole spacing.
    """
    slopes = [seen_per_frame] if certain else [seen_per_frame, -seen_per_frame]
    first, last = math.ceil(time - BEFORE - 1e-9), math.floor(time + 1e-9)
    frames = [frame for frame in range(first, last + 1) if frame >= 0]
    parts = [*_axes(time)]
    parts.append(_lines(per_frame, 0.0, time, time - BEFORE, time + AFTER, "world thin"))
    for slope in slopes:
        # Through the dots: on frame n the two waves differ by a whole number of spacings.
        at = frames[-1] if frames else 0
        shift = (per_frame - slope) * at
        parts.append(_lines(slope, shift, time, time - BEFORE, float(last), "error dashed"))
    parts += _dots(per_frame, frames, time)
    return "".join((*parts, legend((PLOT.x.start, 17.0), LEGEND)))


def _lines(slope: float, shift: float, now: float, start: float, end: float, style: str) -> str:
    """All lines u = slope t + shift + whole number, cut to the plot."""
    start = max(start, 0.0)
    if end <= start:
        return ""
    ends = (slope * start + shift, slope * end + shift)
    low, high = math.ceil(-max(ends)), math.floor(ROWS - min(ends))
    pieces = []
    for whole in range(low, high + 1):
        first, last = (start, ends[0] + whole), (end, ends[1] + whole)
        piece = clipped(first, last, (start, end), (0.0, ROWS))
        if piece:
            pieces.append([PLOT.at(t - now, u) for t, u in piece])
    return path(pieces, style) if pieces else ""


def _dots(per_frame: float, frames: list[int], now: float) -> Iterator[str]:
    """The spokes in each frame taken so far."""
    for frame in frames:
        u = per_frame * frame
        # Rounded, so that a dot exactly on the edge is on the same side on every machine.
        first = math.ceil(round(-u, 9))
        places = np.arange(first, math.floor(round(ROWS - u, 9)) + 1) + u
        yield from (dot(PLOT.at(frame - now, float(place)), "image", 4.0) for place in places)


def _axes(now: float) -> Iterator[str]:
    frames = range(max(math.ceil(now - BEFORE), 0), math.floor(now + AFTER) + 1)
    # A label in a corner would be cut in half as it appears or disappears.
    clear = [frame for frame in frames if -BEFORE + 0.1 < frame - now < AFTER - 0.1]
    ticks = [(frame - now, "" if frame % 2 else str(frame)) for frame in clear]
    yield PLOT.frame(Scale("time", "frames", ticks), Scale(ticks=(0, 1)))
    x, foot = PLOT.at(0, 0)
    yield line((x, foot + 4), (x, PLOT.y.end), "muted dashed")
    yield text((x, PLOT.y.end - 7), "now", "muted small ground", "middle")
    yield text((PLOT.x.start - 34, foot + 41), "↑ turn, in spoke spacings")


LEGEND = (
    Entry("spokes", "world"),
    Entry("frames", "image", "dot"),
    Entry("what it seems", "error dashed"),
)


UNITS_PER_FRAME = (PLOT.x.end - PLOT.x.start) / (BEFORE + AFTER)


def _polar(angle_rad: float, radius: float) -> tuple[float, float]:
    """A place at an angle, clockwise from the right."""
    return (CENTRE[0] + radius * math.cos(angle_rad), CENTRE[1] + radius * math.sin(angle_rad))
