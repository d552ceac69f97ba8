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
from simulations.engine.frame import format_number

WIDTH, HEIGHT = 400.0, 300.0
CENTRE, RADIUS = (200.0, 150.0), 115.0

HEAD = 9.0

LEFT, RIGHT, TOP, BOTTOM = 48.0, 386.0, 44.0, 246.0
BEFORE, AFTER = 6.0, 2.0
"""Frames of the past and the future that the plot shows."""
ROWS = 3.0
"""Spoke spacings on its other axis."""


def wheel(spokes: int, angle_rad: float, speed: float) -> str:
    """The wheel at this moment; one spoke is marked, which the film does not record."""
    ends = [angle_rad + 2 * math.pi * index / spokes for index in range(spokes)]
    bars = [[_polar(end, 14), _polar(end, RADIUS - 4)] for end in ends]
    parts = [
        circle(CENTRE, RADIUS, "world bold"),
        circle(CENTRE, RADIUS - 9, "world thin"),
        path(bars[1:], "world bold"),
        path(bars[:1], "ray bold"),
        dot(_polar(angle_rad, RADIUS - 4), "ray", 6),
        circle(CENTRE, 14, "world fill"),
    ]
    if speed:
        parts.append(_turning(speed, _reach(speed), "world bold"))
    label = f"{format_number(speed)} turns/s"
    parts.append(text((12, 22), label, "world strong halo"))
    return "".join(
        (*parts, text((WIDTH - 12, HEIGHT - 10), "one spoke marked", "ray small", "end"))
    )


def over_film(frame: int, apparent: float, certain: bool) -> str:
    """The frame's number, and the motion that the eye makes of the frames."""
    parts = [text((12, 22), f"frame {frame}", "image strong halo")]
    if not certain:
        parts += [_turning(1.0, 30.0, "error bold"), _turning(-1.0, 30.0, "error bold")]
    elif abs(apparent) > 1e-9:
        parts.append(_turning(apparent, _reach(apparent), "error bold"))
    return "".join(parts)


def _reach(speed: float) -> float:
    """Degrees of the arc that stands for a speed in turns per second."""
    return 24.0 + 54.0 * min(abs(speed) / 3.0, 1.0)


def _turning(speed: float, degrees: float, style: str) -> str:
    """An arc with an arrow head above the wheel, in the sense of the turn."""
    sense = math.copysign(1.0, speed)
    arc = [
        _polar(-math.pi / 2 + sense * math.radians(degrees * step / 24), RADIUS + 15)
        for step in range(25)
    ]
    before_head = [point for point in arc if math.dist(point, arc[-1]) > HEAD]
    return polyline(before_head, style) + arrow(before_head[-1], arc[-1], style, HEAD)


def track(per_frame: float, seen_per_frame: float, certain: bool, time: float) -> str:
    """Where the spokes are against time: lines for the truth, dots for the frames.

    ``per_frame`` and ``seen_per_frame`` are in spoke spacings per frame; the spokes look alike,
    so that the picture repeats at every whole spacing.
    """
    slopes = [seen_per_frame] if certain else [seen_per_frame, -seen_per_frame]
    first, last = math.ceil(time - BEFORE - 1e-9), math.floor(time + 1e-9)
    frames = [frame for frame in range(first, last + 1) if frame >= 0]
    parts = [*_axes(time)]
    parts.append(_lines(per_frame, 0.0, time, time - BEFORE, time + AFTER, "world thin"))
    for slope in slopes:
        # Through the dots: on frame n both waves are at a whole number of spacings more or less.
        at = frames[-1] if frames else 0
        shift = (per_frame - slope) * at
        parts.append(_lines(slope, shift, time, time - BEFORE, float(last), "error dashed"))
    parts += _dots(per_frame, frames, time)
    return "".join((*parts, *_legend()))


def _lines(slope: float, shift: float, now: float, start: float, end: float, style: str) -> str:
    """All lines u = slope t + shift + whole number, cut to the plot."""
    start = max(start, 0.0)
    if end <= start:
        return ""
    ends = (slope * start + shift, slope * end + shift)
    low, high = math.ceil(-max(ends)), math.floor(ROWS - min(ends))
    pieces = []
    for whole in range(low, high + 1):
        piece = _clipped(start, ends[0] + whole, end, ends[1] + whole)
        if piece:
            pieces.append([_at(t - now, u) for t, u in piece])
    return path(pieces, style) if pieces else ""


def _clipped(t0: float, u0: float, t1: float, u1: float) -> list[tuple[float, float]]:
    """The part of a segment with 0 <= u <= ROWS, or nothing."""
    rise = u1 - u0
    if abs(rise) < 1e-12:
        return [(t0, u0), (t1, u1)] if 0 <= u0 <= ROWS else []
    shares = sorted(((0.0 - u0) / rise, (ROWS - u0) / rise))
    low, high = max(0.0, shares[0]), min(1.0, shares[1])
    if low >= high:
        return []
    return [(t0 + share * (t1 - t0), u0 + share * rise) for share in (low, high)]


def _dots(per_frame: float, frames: list[int], now: float) -> Iterator[str]:
    """The spokes in each frame taken so far."""
    for frame in frames:
        u = per_frame * frame
        # Rounded, so that a dot on the very edge is on the same side on every machine.
        first = math.ceil(round(-u, 9))
        places = np.arange(first, math.floor(round(ROWS - u, 9)) + 1) + u
        yield from (dot(_at(frame - now, float(place)), "image", 4.0) for place in places)


def _axes(now: float) -> Iterator[str]:
    yield path([[_at(-BEFORE, ROWS), _at(-BEFORE, 0), _at(AFTER, 0)]], "muted")
    ticks = range(math.ceil(now - BEFORE), math.floor(now + AFTER) + 1)
    for frame in ticks:
        if frame < 0:
            continue
        x, y = _at(frame - now, 0)
        yield line((x, y), (x, y + 5), "muted thin")
        if LEFT + 4 < x < RIGHT - 4:
            yield text((x, y + 19), str(frame), "muted", "middle")
    for row in range(int(ROWS) + 1):
        x, y = _at(-BEFORE, row)
        yield text((x - 8, y + 4.5), str(row), "muted", "end")
    yield line(_at(0, -0.02), _at(0, ROWS), "muted dashed")
    yield text((_at(0, 0)[0], TOP - 7), "now", "muted small halo", "middle")
    yield text((RIGHT, BOTTOM + 42), "time, frames", "", "end")
    yield text((LEFT - 34, BOTTOM + 42), "↑ turn, in spoke spacings")


def _legend() -> Iterator[str]:
    y = 17.0
    yield line((LEFT, y - 4.5), (LEFT + 20, y - 4.5), "world")
    yield text((LEFT + 26, y), "spokes", "world")
    yield dot((LEFT + 94, y - 4.5), "image", 4.0)
    yield text((LEFT + 104, y), "frames", "image")
    yield line((LEFT + 172, y - 4.5), (LEFT + 196, y - 4.5), "error dashed")
    yield text((LEFT + 202, y), "what it seems", "error")


def _at(frames_from_now: float, spacings: float) -> Point:
    return (
        LEFT + (RIGHT - LEFT) * (frames_from_now + BEFORE) / (BEFORE + AFTER),
        BOTTOM - (BOTTOM - TOP) * spacings / ROWS,
    )


def _polar(angle_rad: float, radius: float) -> Point:
    """Clockwise from the right."""
    return (CENTRE[0] + radius * math.cos(angle_rad), CENTRE[1] + radius * math.sin(angle_rad))
