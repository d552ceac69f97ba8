"""Image Formation Pipeline: one point from the scene to a pixel value.

The first panel has the room with the path of the point, and below it four tiles of computed values:
greys are those of a file in sRGB, and each dot is `ELECTRONS_PER_DOT` electrons. The second has the
ledger of its numbers, which do not depend on the place of the marker on the path.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from simulations.engine import drawing
from simulations.engine.drafting import swatch, swatch_polygon
from simulations.engine.frame import Frame, Panel, Raster, readout
from simulations.engine.handles import Handle, Point
from simulations.engine.raster import of_planes
from simulations.engine.scene import Scene
from simulations.engine.settings import action, slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb, encode_srgb_codes
from simulations.models.projection.pinhole import intrinsics, look_at, project, world_to_camera
from simulations.scenes._turned_camera import BUTTON, VIEWFINDER
from simulations.scenes.formation_pipeline.stations import (
    CELLS,
    LAMP_COS,
    POINT_M,
    WHITE_E,
    Journey,
    Station,
    light_around,
    stations,
    travel,
)
from simulations.world.light import LAMP_ELEVATION_RAD, lamp_direction
from simulations.world.radiance import Lighting
from simulations.world.room import finer, light_of
from simulations.world.still_life import WALL_DISTANCE

type Legs = tuple[tuple[Point, ...], ...]

LAST_STATION = 7.0
WIDTH, HEIGHT = 400.0, 306.0
ROOM_ROWS = 196.0  # of the room at the top, in view box units
ROOM_FOCAL, ROOM_CENTRE = 300.0, (199.5, 97.5)
ROOM_POSE = look_at((9.0, 1.2, 2.5), (0.0, 3.5, 1.2), (0.0, 0.0, 1.0))
"""The reader's eye, outside the wall with the door, which is left out of the picture."""
FINER = 1.5  # pixels of the room's picture, per view box unit
AHEAD, DOWN = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, -1.0])
ORIGIN = np.array([2.0, WALL_DISTANCE - POINT_M[2], 1.5])
"""Of the chain's world axes in the room: right, down and ahead to the wall with the speck."""
SPECK = ORIGIN + np.array([POINT_M[0], POINT_M[2], -POINT_M[1]])
LENS_TO_PLANE, LENS_RADIUS_M = 1.0, 0.32  # metres; drawn larger than true
BODY = 0.6, 0.5, 0.15  # half width and height of the camera, and its depth behind the plane
TOP = tuple(
    face @ [(1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.5, 0.0)] + [0.0, -0.6, 0.14]
    for box in (VIEWFINDER, BUTTON)
    for face in (box[0], box[5], box[2], box[4], box[1])
)
"""Viewfinder and button in the room, from the centre of the lens, the faces that hide others last;
the lowest is not seen."""
FIRST_LEG = 0.2  # share of the way to the lens at which the point is known in camera coordinates
CELL, LIGHT, WELL, CODE = ((column, 242.0) for column in (50.0, 150.0, 250.0, 350.0))
"""Centres of the tiles below the room."""
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
    play: int = action("Play", "Pause", drives="station", effect="play", seconds=14.0, arrival=True)
    step: int = action("Next step", drives="station", effect="step")
    distance: float = slider("Camera distance", 4.0, 2.0, 8.0, 0.1, unit="m")
    albedo: float = slider("Albedo ρ", 0.6, 0.0, 1.0, 0.01)
    again: int = action(*("Take another photo",) * 8)


def journey_of(distance: float, albedo: float, again: int) -> Journey:
    return travel(distance, albedo, exposure=again)


def picture() -> Raster:
    """The room as the reader sees it, lit so that the lamp is 60° from the normal of the wall."""
    level = math.cos(LAMP_ELEVATION_RAD)
    K = finer(intrinsics(ROOM_FOCAL, ROOM_CENTRE), FINER)
    columns, rows, height = (round(FINER * size) for size in (WIDTH, ROOM_ROWS, HEIGHT))
    lit = light_of(K, ROOM_POSE, columns, rows, Lighting(math.degrees(math.acos(LAMP_COS / level))))
    raster = np.zeros((height, columns, 4), np.uint8)  # the part below the room is empty
    raster[:rows] = of_planes([encode_srgb_codes(plane) for plane in lit])
    return raster


def places_in_view_box(*places: Floats) -> list[Point]:
    """Places (3,) of the room in the view box."""
    camera = world_to_camera(np.array(places), ROOM_POSE)
    pixels, _ = project(camera, intrinsics(ROOM_FOCAL, ROOM_CENTRE))
    return [tuple(pixel) for pixel in (pixels + 0.5).tolist()]


def lens_of(distance_m: float) -> Floats:
    """The centre of the lens (3,) of a camera at this distance from the wall."""
    return np.array([ORIGIN[0], WALL_DISTANCE - distance_m, ORIGIN[2]])


def legs_of(distance_m: float) -> Legs:
    """The legs between stations 0 to 7, each a polyline."""
    lens = lens_of(distance_m)
    image = lens + (lens - SPECK) * LENS_TO_PLANE / distance_m
    start, first, middle, hit = places_in_view_box(
        SPECK, SPECK + FIRST_LEG * (lens - SPECK), lens, image
    )
    return (
        (start, first),
        (first, middle),
        (middle, hit),
        (hit, CELL),
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
            if part < 1.0:
                break
    return path


def draw_path(journey: Journey, distance_m: float, station: float) -> str:
    """The first panel."""
    legs = legs_of(distance_m)
    path = travelled(legs, station)
    return "".join(
        (
            paint(journey),
            *scenery(),
            *camera(lens_of(distance_m)),
            enlargement(legs[2][-1]),
            drawing.path(legs, "muted thin dashed"),
            *arrows_between_tiles(),
            drawing.polyline(path, "ray bold") if len(path) > 1 else "",
            *tiles(journey, int(station)),
            drawing.dot(legs[2][-1], "image", 3.0),
            drawing.dot(path[-1], "ray", 6.5),
        )
    )


def arrows_between_tiles() -> Iterator[str]:
    """Heads of arrows in the gaps between the tiles."""
    for start, end in pairwise((CELL, LIGHT, WELL, CODE)):
        middle, row = (start[0] + end[0]) / 2, start[1]
        yield drawing.arrow((middle - 6, row), (middle + 6, row), "muted thin", 9)


def enlargement(cell: Point) -> str:
    """Lines from the cell that is hit to the tile that shows it larger."""
    half = SIDE / 2
    corners = (cell, (CELL[0] - half, CELL[1] - half), (CELL[0] + half, CELL[1] + half))
    return drawing.polygon(corners, "casing") + drawing.polygon(corners, "image thin fill")


def paint(journey: Journey) -> str:
    """The speck on the wall in its own grey, drawn five times as wide as it is."""
    turns = np.linspace(0.0, 2 * math.pi, 20, endpoint=False)
    rim = [SPECK + 0.1 * np.array([math.cos(a), 0.0, math.sin(a)]) for a in turns]
    light = float(encode_srgb(journey.relative_light))
    return swatch_polygon(places_in_view_box(*rim), [light] * 3) + drawing.polygon(
        places_in_view_box(*rim), "world thin"
    )


def scenery() -> Iterator[str]:
    """The lamp, and the direction of its light."""
    level = math.cos(LAMP_ELEVATION_RAD)
    towards = np.array(lamp_direction(math.degrees(math.acos(LAMP_COS / level))))
    lamp, tip = places_in_view_box(SPECK + 1.5 * towards, SPECK + 0.25 * towards)
    yield drawing.arrow(lamp, tip, "light bold")
    yield drawing.circle(lamp, 6, "light solid")
    yield drawing.text((lamp[0] - 11, lamp[1] + 4), "lamp", "light small ground", "end")


def camera(lens: Floats) -> Iterator[str]:
    """The camera, cut open on the reader's side: lens and image plane."""
    wide, high, behind = BODY
    turns = np.linspace(0.0, 2 * math.pi, 32, endpoint=False)
    rim = [lens + LENS_RADIUS_M * np.array([math.cos(a), 0.0, math.sin(a)]) for a in turns]
    back, far = -LENS_TO_PLANE - behind, -wide
    sides = (
        [(far, back, -high), (far, 0, -high), (far, 0, high), (far, back, high)],
        [(far, back, -high), (wide, back, -high), (wide, back, high), (far, back, high)],
        [(far, back, -high), (wide, back, -high), (wide, 0, -high), (far, 0, -high)],
    )
    for side in sides:
        corners = places_in_view_box(*(lens + np.array(corner) for corner in side))
        yield drawing.polygon(corners, "casing solid") + drawing.polygon(corners, "camera fill")
    corners = [(-0.42, -0.32), (0.42, -0.32), (0.42, 0.32), (-0.42, 0.32)]
    sheet = [lens + np.array([u, -LENS_TO_PLANE, v]) for u, v in corners]
    yield drawing.polygon(places_in_view_box(*sheet), "casing solid")
    yield drawing.polygon(places_in_view_box(*sheet), "image bold fill")
    front = [lens + np.array([u, 0.0, v]) for u in (-wide, wide) for v in (-high, high)]
    yield drawing.polygon(places_in_view_box(*(front[i] for i in (0, 1, 3, 2))), "camera fill")
    yield drawing.polygon(places_in_view_box(*rim), "casing solid")
    yield drawing.polygon(places_in_view_box(*rim), "camera bold fill")
    for face in TOP:
        corners = places_in_view_box(*(lens + face))
        yield drawing.polygon(corners, "casing solid") + drawing.polygon(corners, "camera fill")
    above = lens - 1.6 * high * DOWN
    front_top, plane_top = places_in_view_box(above, above - LENS_TO_PLANE * AHEAD)
    left = max(plane_top[0] + 14.0, 82.0), plane_top[1] - 4.0
    right = max(front_top[0] - 8.0, 94.0), front_top[1] - 4.0
    yield drawing.text(left, "image plane", "image small ground", "end")
    yield drawing.text(right, "lens", "camera small ground")


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
    """The light of the point in a field with the light of a white wall that faces the lamp."""
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
    path_markup = draw_path(journey, settings.distance, station)
    ledger, title = draw_ledger(entries, station), "What is known after each step"
    electrons, code, entry = journey.counted_e, journey.code, entries[int(station)]
    return Frame(
        (
            Panel(
                "way",
                "The way of the light",
                WIDTH,
                HEIGHT,
                outputs["picture"],
                overlay=path_markup,
                lead=True,
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
    return travelled(legs_of(settings.distance), settings.station)[-1]


def lens_foot(settings: Settings, _outputs: Outputs) -> Point:
    return places_in_view_box(lens_of(settings.distance) + LENS_RADIUS_M * DOWN)[0]


def ledger_line(settings: Settings, _outputs: Outputs) -> Point:
    return BULLET_COLUMN, LEDGER_TOP + (int(settings.station) + 0.5) * ROW_HEIGHT


def ledger_pulled(_settings: Settings, place: Point) -> dict[str, float]:
    """The beginning of a line, where a search would find any place in it."""
    row = math.floor((place[1] - LEDGER_TOP) / ROW_HEIGHT)
    return {"station": float(min(max(row, 0), LAST_STATION))}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("marker", "way", "Point", ("station",), marker, reach="press", role="ray"),
    Handle("camera", "way", "Camera", ("distance",), lens_foot, role="camera"),
    Handle(
        "line",
        "ledger",
        "Mark in the list",
        drives=("station",),
        at=ledger_line,
        pull=ledger_pulled,
        reach="press",
    ),
)
SCENE = Scene(
    "formation-pipeline",
    "Image Formation Pipeline",
    Settings,
    draw,
    (Stage("journey", journey_of), Stage("picture", picture)),
    HANDLES,
)
