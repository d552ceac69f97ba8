"""Drawings of the formation pipeline: the path of the point, and the ledger of its numbers."""

import math
from collections.abc import Iterator
from itertools import pairwise

from simulations.engine import drawing
from simulations.scenes.formation_pipeline.stations import Journey, Station
from simulations.scenes.formation_pipeline.tiles import SIDE, draw_tiles

WIDTH, HEIGHT = 400.0, 310.0

type Point = tuple[float, float]

AXIS_ROW = 100.0
WALL_COLUMN = 46.0
UNITS_PER_METRE = 24.0
"""Drawn distances between the wall, which is fixed, and the lens."""
LENS_TO_PLANE = 72.0
POINT_RISE = 42.0
"""Height of the point above the axis; drawn larger than true, like the camera."""
FIRST_LEG = 0.2
"""Share of the way to the lens at which the point is known in camera coordinates."""
CELL, LIGHT, WELL, CODE = ((column, 244.0) for column in (350.0, 250.0, 150.0, 50.0))
"""Centres of the tiles on the lower row."""
LEDGER_WIDTH, LEDGER_HEIGHT = 400.0, 384.0
LEDGER_TOP, ROW_HEIGHT = 4.0, 47.0
BULLET_COLUMN = 18.0


def lens_column(distance_m: float) -> float:
    """Column of the lens for a distance of the camera from the wall."""
    return WALL_COLUMN + UNITS_PER_METRE * distance_m


def route(distance_m: float) -> tuple[tuple[Point, ...], ...]:
    """The legs between stations 0 to 7, each a polyline."""
    lens = (lens_column(distance_m), AXIS_ROW)
    start = (WALL_COLUMN, AXIS_ROW - POINT_RISE)
    slope = POINT_RISE / (lens[0] - start[0])
    hit = (lens[0] + LENS_TO_PLANE, AXIS_ROW + slope * LENS_TO_PLANE)
    first = (start[0] + FIRST_LEG * (lens[0] - start[0]), start[1] + FIRST_LEG * POINT_RISE)
    return (
        (start, first),
        (first, lens),
        (lens, hit),
        (hit, (CELL[0], hit[1]), CELL),
        (CELL, LIGHT),
        (LIGHT, WELL),
        (WELL, CODE),
    )


def place(legs: tuple[tuple[Point, ...], ...], station: float) -> tuple[Point, list[Point]]:
    """The marker at ``station`` (0 to the number of legs) and its path so far."""
    travelled = [legs[0][0]]
    for index, leg in enumerate(legs):
        share = min(max(station - index, 0.0), 1.0)
        if share <= 0:
            break
        remaining = share * sum(math.dist(a, b) for a, b in pairwise(leg))
        for a, b in pairwise(leg):
            length = math.dist(a, b)
            part = min(remaining / length, 1.0) if length > 0 else 1.0
            travelled.append((a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])))
            remaining -= part * length
            if remaining <= 0:
                break
    return travelled[-1], travelled


def draw_way(journey: Journey, distance_m: float, station: float) -> str:
    """SVG markup of the first panel."""
    legs = route(distance_m)
    marker, travelled = place(legs, station)
    corners = [(x - SIDE / 2, y - SIDE / 2) for x, y in (CELL, LIGHT, WELL, CODE)]
    ahead = drawing.path(legs, "muted thin dashed")
    come = drawing.polyline(travelled, "ray bold") if len(travelled) > 1 else ""
    return "".join(
        (
            _scene(),
            _camera(lens_column(distance_m)),
            ahead,
            *_onward(),
            come,
            draw_tiles(journey, corners, int(station)),
            drawing.dot(legs[0][0], "world", 4.5),
            drawing.dot(legs[2][-1], "image", 3.0),
            drawing.dot(marker, "ray", 6.5),
        )
    )


def _onward() -> Iterator[str]:
    """Heads of arrows in the gaps between the tiles, which are read from right to left."""
    for start, end in pairwise((CELL, LIGHT, WELL, CODE)):
        middle, row = (start[0] + end[0]) / 2, start[1]
        yield drawing.arrow((middle + 6, row), (middle - 6, row), "muted thin", 9)


def _scene() -> str:
    """The painted wall with the point, the lamp, and the world's axes: ahead and down."""
    point = (WALL_COLUMN, AXIS_ROW - POINT_RISE)
    lamp = (point[0] + 34, 20.0)  # on the side that the camera sees
    tip = (point[0] + 0.2 * (lamp[0] - point[0]), point[1] + 0.25 * (lamp[1] - point[1]))
    return "".join(
        (
            drawing.line((point[0], point[1] - 22), (point[0], AXIS_ROW + 28), "world bold faint"),
            drawing.arrow(lamp, tip, "light bold"),
            drawing.circle(lamp, 6, "light solid"),
            drawing.text((lamp[0] - 11, lamp[1] + 4), "lamp", "light small ground", "end"),
            drawing.arrow((54, 146), (24, 146), "world", 6),
            drawing.arrow((54, 146), (54, 176), "world", 6),
            drawing.text((46, 164), "world", "world small", "end"),
        )
    )


def _camera(lens: float) -> str:
    """Optical axis, lens, the camera's axes, ahead and down, and image plane."""
    plane = lens + LENS_TO_PLANE
    return "".join(
        (
            drawing.line((14, AXIS_ROW), (plane + 10, AXIS_ROW), "camera thin dashed faint"),
            drawing.ellipse((lens, AXIS_ROW), (7, 34), "camera fill"),
            drawing.text((lens, AXIS_ROW - 42), "lens", "camera", "middle"),
            drawing.arrow((lens, AXIS_ROW), (lens - 30, AXIS_ROW), "camera", 6),
            drawing.arrow((lens, AXIS_ROW), (lens, AXIS_ROW + 30), "camera", 6),
            drawing.line((plane, AXIS_ROW - 60), (plane, AXIS_ROW + 76), "image bold"),
            drawing.text((plane, AXIS_ROW - 68), "image plane", "image", "middle"),
        )
    )


def draw_ledger(entries: tuple[Station, ...], station: float) -> str:
    """SVG markup of the second panel: the numbers so far, with the current line framed.

    Later stations have only their names, so that the reader can predict their numbers.
    """
    reached = int(station)
    rows = [LEDGER_TOP + (row + 0.5) * ROW_HEIGHT for row in (0.0, station, len(entries) - 1.0)]
    start, here, end = ((BULLET_COLUMN, row) for row in rows)
    parts = [drawing.line(here, end, "muted thin dashed")]
    track = drawing.line(start, here, "ray bold")
    for index, entry in enumerate(entries):
        top = LEDGER_TOP + index * ROW_HEIGHT
        style = entry.role if index <= reached else "muted"
        if index == reached:
            parts.append(drawing.rectangle((2, top), LEDGER_WIDTH - 4, ROW_HEIGHT, f"{style} fill"))
            parts.append(track)
        bullet = f"{style} solid" if index <= reached else style
        parts.append(drawing.circle((BULLET_COLUMN, top + ROW_HEIGHT / 2), 5.0, bullet))
        if index > reached:
            parts.append(drawing.text((40, top + 28), entry.title, f"{style} strong"))
        else:
            parts.append(drawing.text((40, top + 17), entry.title, f"{style} strong"))
            weight = "strong" if index == reached else ""
            parts.append(drawing.text((40, top + 38.5), entry.numbers, weight))
    return "".join(parts)
