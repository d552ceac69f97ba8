"""Image Formation Pipeline: one point from the scene to a pixel value.

The first panel has the path of the point, and below it four tiles of computed values: greys are
those of a file in sRGB, and each dot is `ELECTRONS_PER_DOT` electrons. The second has the ledger of
its numbers, which do not depend on the place of the marker on the path.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from simulations.engine import drawing
from simulations.engine.drafting import swatch
from simulations.engine.frame import Frame, Panel, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.color.srgb import encode_srgb
from simulations.scenes.formation_pipeline.stations import (
    CELLS,
    WHITE_E,
    Journey,
    Station,
    light_around,
    stations,
    travel,
)

type Legs = tuple[tuple[Point, ...], ...]

LAST_STATION = 7.0
WIDTH, HEIGHT = 400.0, 310.0
AXIS_ROW = 100.0
WALL_COLUMN, UNITS_PER_METRE = 46.0, 24.0  # between the wall, which is fixed, and the lens
LENS_TO_PLANE = 72.0
LENS_FOOT = 34.0  # from the axis down to the lens's handle
POINT_RISE = 42.0  # height of the point above the axis; drawn larger than true, like the camera
FIRST_LEG = 0.2  # share of the way to the lens at which the point is known in camera coordinates
CELL, LIGHT, WELL, CODE = ((column, 244.0) for column in (350.0, 250.0, 150.0, 50.0))
"""Centres of the tiles on the lower row."""
SIDE = 72.0  # of a tile
TILES = (
    ("sensor cell", "image"),
    ("light", "light"),
    ("electrons", "error"),
    ("pixel value", "image"),
)
"""Names and roles of the tiles."""
FIRST_TILE = 4  # the station at which the first tile is reached
ELECTRONS_PER_DOT = 100.0
LEDGER_WIDTH, LEDGER_HEIGHT = 400.0, 384.0
LEDGER_TOP, ROW_HEIGHT, BULLET_COLUMN = 4.0, 47.0, 18.0


@dataclass(frozen=True, slots=True)
class Settings:
    station: float = slider("Step", 0.0, 0.0, LAST_STATION, 0.02)
    play: int = action("Play", "Pause", drives="station", effect="play", seconds=14.0)
    step: int = action("Next step", drives="station", effect="step")
    distance: float = slider("Camera distance", 4.0, 2.0, 8.0, 0.1, unit="m")
    albedo: float = slider("Albedo ρ", 0.6, 0.0, 1.0, 0.01)
    again: int = action(*("Take another photo",) * 8)


def journey_of(distance: float, albedo: float, again: int) -> Journey:
    return travel(distance, albedo, exposure=again)


def lens_column(distance_m: float) -> float:
    """Column of the lens for a distance of the camera from the wall."""
    return WALL_COLUMN + UNITS_PER_METRE * distance_m


def route(distance_m: float) -> Legs:
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


def travelled(legs: Legs, station: float) -> list[Point]:
    """The path up to the marker at ``station`` (0 to the number of legs)."""
    path = [legs[0][0]]
    for index, leg in enumerate(legs):
        share = min(max(station - index, 0.0), 1.0)
        if share <= 0:
            break
        remaining = share * sum(math.dist(a, b) for a, b in pairwise(leg))
        for a, b in pairwise(leg):
            length = math.dist(a, b)
            part = min(remaining / length, 1.0) if length > 0 else 1.0
            path.append((a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])))
            remaining -= part * length
            if remaining <= 0:
                break
    return path


def draw_way(journey: Journey, distance_m: float, station: float) -> str:
    """The first panel."""
    legs = route(distance_m)
    path = travelled(legs, station)
    return "".join(
        (
            *scenery(),
            *camera(lens_column(distance_m)),
            drawing.path(legs, "muted thin dashed"),
            *onward(),
            drawing.polyline(path, "ray bold") if len(path) > 1 else "",
            *tiles(journey, int(station)),
            drawing.dot(legs[0][0], "world", 4.5),
            drawing.dot(legs[2][-1], "image", 3.0),
            drawing.dot(path[-1], "ray", 6.5),
        )
    )


def onward() -> Iterator[str]:
    """Heads of arrows in the gaps between the tiles, which are read from right to left."""
    for start, end in pairwise((CELL, LIGHT, WELL, CODE)):
        middle, row = (start[0] + end[0]) / 2, start[1]
        yield drawing.arrow((middle + 6, row), (middle - 6, row), "muted thin", 9)


def scenery() -> Iterator[str]:
    """The painted wall with the point, the lamp, and the world's axes: ahead and down."""
    point = (WALL_COLUMN, AXIS_ROW - POINT_RISE)
    lamp = (point[0] + 34, 20.0)  # on the side that the camera sees
    tip = (point[0] + 0.2 * (lamp[0] - point[0]), point[1] + 0.25 * (lamp[1] - point[1]))
    yield drawing.line((point[0], point[1] - 22), (point[0], AXIS_ROW + 28), "world bold faint")
    yield drawing.arrow(lamp, tip, "light bold")
    yield drawing.circle(lamp, 6, "light solid")
    yield drawing.text((lamp[0] - 11, lamp[1] + 4), "lamp", "light small ground", "end")
    yield drawing.arrow((54, 146), (24, 146), "world", 6)
    yield drawing.arrow((54, 146), (54, 176), "world", 6)
    yield drawing.text((46, 164), "world", "world small", "end")


def camera(lens: float) -> Iterator[str]:
    """Optical axis, lens, the camera's axes, ahead and down, and image plane."""
    plane = lens + LENS_TO_PLANE
    yield drawing.line((14, AXIS_ROW), (plane + 10, AXIS_ROW), "camera thin dashed faint")
    yield drawing.ellipse((lens, AXIS_ROW), (7, 34), "camera fill")
    yield drawing.text((lens, AXIS_ROW - 42), "lens", "camera", "middle")
    yield drawing.arrow((lens, AXIS_ROW), (lens - 30, AXIS_ROW), "camera", 6)
    yield drawing.arrow((lens, AXIS_ROW), (lens, AXIS_ROW + 30), "camera", 6)
    yield drawing.line((plane, AXIS_ROW - 60), (plane, AXIS_ROW + 76), "image bold")
    yield drawing.text((plane, AXIS_ROW - 68), "image plane", "image", "middle")


def tiles(journey: Journey, station: int) -> Iterator[str]:
    """The four tiles; those that the marker has not reached are faint."""
    contents = (sensor_cells, light_tile, electron_dots, pixel_value)
    corners = [(x - SIDE / 2, y - SIDE / 2) for x, y in (CELL, LIGHT, WELL, CODE)]
    entries = zip(TILES, corners, contents, strict=True)
    for index, ((name, role), corner, content) in enumerate(entries, start=FIRST_TILE):
        known = index <= station
        tile = content(journey, corner) + drawing.rectangle(corner, SIDE, SIDE, role)
        yield drawing.rectangle(corner, SIDE, SIDE, "casing solid")
        yield drawing.group([tile], "" if known else "faint")
        words = f"{name} {journey.code}" if known and name == "pixel value" else name
        below = (corner[0] + SIDE / 2, corner[1] + SIDE + 20)
        yield drawing.text(below, words, f"{role} small", "middle")


def grey(corner: Point, side: float, light: float) -> str:
    return swatch(corner, side, side, [float(encode_srgb(light))] * 3)


def sensor_cells(journey: Journey, corner: Point) -> str:
    """Cells of the sensor with the light in them, the point's own in the middle."""
    side, parts = SIDE / CELLS, []
    for (row, column), light in np.ndenumerate(light_around(journey)):
        parts.append(grey((corner[0] + side * column, corner[1] + side * row), side, float(light)))
    middle = (corner[0] + side * (CELLS // 2), corner[1] + side * (CELLS // 2))
    return "".join((*parts, drawing.rectangle(middle, side, side, "image bold")))


def light_tile(journey: Journey, corner: Point) -> str:
    """The point's light in the middle of that of a white wall that faces the lamp."""
    inner = (corner[0] + SIDE / 4, corner[1] + SIDE / 4)
    return grey(corner, SIDE, 1.0) + grey(inner, SIDE / 2, journey.relative_light)


def electron_dots(journey: Journey, corner: Point) -> str:
    """Dots on random places of a grid that a full well would fill."""
    across = round((WHITE_E / ELECTRONS_PER_DOT) ** 0.5)
    count = min(round(journey.counted_e / ELECTRONS_PER_DOT), across * across)
    chosen = np.random.default_rng(int(journey.counted_e)).permutation(across * across)[:count]
    pitch = SIDE / across
    dots = [
        (corner[0] + pitch * (index % across + 0.5), corner[1] + pitch * (index // across + 0.5))
        for index in chosen.tolist()
    ]
    return drawing.path([(dot, dot) for dot in dots], "error bold") if dots else ""


def pixel_value(journey: Journey, corner: Point) -> str:
    return swatch(corner, SIDE, SIDE, [journey.code / 255.0] * 3)


def draw_ledger(entries: Sequence[Station], station: float) -> str:
    """The second panel: the numbers so far, with the current line framed.

    Later stations have only their names, so that the reader can predict their numbers.
    """
    reached = int(station)
    rows = [LEDGER_TOP + (row + 0.5) * ROW_HEIGHT for row in (0.0, station, len(entries) - 1.0)]
    start, here, end = ((BULLET_COLUMN, row) for row in rows)
    parts = [drawing.line(here, end, "muted thin dashed")]
    for index, entry in enumerate(entries):
        top = LEDGER_TOP + index * ROW_HEIGHT
        style = entry.role if index <= reached else "muted"
        if index == reached:
            parts.append(drawing.rectangle((2, top), LEDGER_WIDTH - 4, ROW_HEIGHT, f"{style} fill"))
            parts.append(drawing.line(start, here, "ray bold"))
        bullet = f"{style} solid" if index <= reached else style
        parts.append(drawing.circle((BULLET_COLUMN, top + ROW_HEIGHT / 2), 5.0, bullet))
        row = top + (17 if index <= reached else 28)
        parts.append(drawing.text((40, row), entry.title, f"{style} strong"))
        if index <= reached:
            weight = "strong" if index == reached else ""
            parts.append(drawing.text((40, top + 38.5), entry.numbers, weight))
    return "".join(parts)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    journey: Journey = outputs["journey"]
    entries, station = stations(journey), settings.station
    way = draw_way(journey, settings.distance, station)
    ledger, title = draw_ledger(entries, station), "What is known after each step"
    electrons, code, entry = journey.counted_e, journey.code, entries[int(station)]
    return Frame(
        (
            Panel(
                "way", "The way of the light (not to scale)", WIDTH, HEIGHT, overlay=way, lead=True
            ),
            Panel("ledger", title, LEDGER_WIDTH, LEDGER_HEIGHT, overlay=ledger),
        ),
        (
            readout("electrons", "Electrons counted", electrons, "e⁻", digits=0, role="error"),
            readout("pixel_value", "Pixel value", code, "of 255", digits=0, role="image"),
        ),
        f"{entry.sentence}: {entry.numbers}.",
    )


def marker(settings: Settings, _outputs: Outputs) -> Point:
    return travelled(route(settings.distance), settings.station)[-1]


def lens_foot(settings: Settings, _outputs: Outputs) -> Point:
    return lens_column(settings.distance), AXIS_ROW + LENS_FOOT


def ledger_line(settings: Settings, _outputs: Outputs) -> Point:
    return BULLET_COLUMN, LEDGER_TOP + (int(settings.station) + 0.5) * ROW_HEIGHT


def ledger_pulled(_settings: Settings, place: Point) -> dict[str, float]:
    """The beginning of a line, where a search would find any place in it."""
    row = math.floor((place[1] - LEDGER_TOP) / ROW_HEIGHT)
    return {"station": float(min(max(row, 0), LAST_STATION))}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("marker", "way", "Light", ("station",), marker, reach="press", role="ray"),
    Handle("camera", "way", "Camera", ("distance",), lens_foot, role="camera"),
    Handle("line", "ledger", "Mark in the list", ("station",), ledger_line, ledger_pulled, "press"),
)
SCENE = Scene(
    "formation-pipeline",
    "Image Formation Pipeline",
    Settings,
    draw,
    (Stage("journey", journey_of),),
    HANDLES,
)
