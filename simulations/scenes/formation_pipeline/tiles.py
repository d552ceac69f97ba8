"""The lower row of the way: what the sensor, the light, the electrons and the file hold.

Each tile shows computed values: greys are those of a file in sRGB, and each dot is
`ELECTRONS_PER_DOT` electrons. Tiles that the marker has not reached are faint.
"""

from collections.abc import Sequence

import numpy as np

from simulations.engine import drawing
from simulations.engine.drafting import swatch
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.scenes.formation_pipeline.stations import (
    FOCAL_PX,
    LAMP_COS,
    WHITE_E,
    Journey,
)

type Point = tuple[float, float]

SIDE = 72.0
CELLS = 9
"""Cells of the sensor along each side of its tile."""
SPECK_RADIUS_M, WALL_ALBEDO = 0.02, 0.08
"""The disc of paint around the point, and the paint of the wall around it."""
ELECTRONS_PER_DOT = 100.0
FIRST, NAMES = 4, ("sensor cell", "light", "electrons", "pixel value")
ROLES = ("image", "light", "error", "image")
"""The step at which the first tile is reached, and the names and roles of all four."""


def draw_tiles(journey: Journey, corners: Sequence[Point], reached: int) -> str:
    """SVG markup of the four tiles, with the upper left ``corners``, up to the step ``reached``."""
    contents = (_sensor, _light, _electrons, _pixel_value)
    parts = []
    for index, (corner, content) in enumerate(zip(corners, contents, strict=True)):
        known = index + FIRST <= reached
        tile = content(journey, corner) + drawing.rectangle(corner, SIDE, SIDE, ROLES[index])
        parts.append(drawing.rectangle(corner, SIDE, SIDE, "casing solid"))
        parts.append(drawing.group([tile], "" if known else "faint"))
        code = f" {journey.code}" if known and content is _pixel_value else ""
        name, middle = NAMES[index] + code, (corner[0] + SIDE / 2, corner[1] + SIDE + 20)
        parts.append(drawing.text(middle, name, f"{ROLES[index]} small", "middle"))
    return "".join(parts)


def picture(journey: Journey) -> Floats:
    """Light (n, n) in the cells around the point's own, relative to a white wall that faces the
    lamp: the disc of paint on its wall, averaged over each cell."""
    offsets = np.arange(CELLS) - CELLS // 2
    columns, rows = (round(place) + offsets - place for place in journey.pixel)
    away = np.hypot(columns[None, :], rows[:, None])
    radius = FOCAL_PX * SPECK_RADIUS_M / journey.camera_m[2]
    covered = np.clip(radius - away + 0.5, 0.0, 1.0)
    wall = WALL_ALBEDO * LAMP_COS
    return np.asarray(wall + covered * (journey.relative_light - wall))


def _grey(corner: Point, side: float, light: float) -> str:
    return swatch(corner, side, side, [float(encode_srgb(light))] * 3)


def _sensor(journey: Journey, corner: Point) -> str:
    """Cells of the sensor with the light in them, the point's own in the middle."""
    side = SIDE / CELLS
    places = [(corner[0] + side * column, corner[1] + side * row)
              for row in range(CELLS) for column in range(CELLS)]  # fmt: skip
    cells = zip(places, picture(journey).ravel().tolist(), strict=True)
    middle = places[CELLS * CELLS // 2]
    return "".join(_grey(place, side, light) for place, light in cells) + drawing.rectangle(
        middle, side, side, "image bold"
    )


def _light(journey: Journey, corner: Point) -> str:
    """The point's light in the middle of that of a white wall that faces the lamp."""
    inner = (corner[0] + SIDE / 4, corner[1] + SIDE / 4)
    return _grey(corner, SIDE, 1.0) + _grey(inner, SIDE / 2, journey.relative_light)


def _electrons(journey: Journey, corner: Point) -> str:
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


def _pixel_value(journey: Journey, corner: Point) -> str:
    return swatch(corner, SIDE, SIDE, [journey.code / 255.0] * 3)
