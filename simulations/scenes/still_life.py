"""A still life through a fast lens: the picture of the title page.

The lens is one of medium format that does not breathe: the picture keeps its size as the focus
moves, so that only the discs of confusion change.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from simulations.engine.accuracy import Accuracy, columns
from simulations.engine.controls import Value
from simulations.engine.frame import Frame, Panel, Raster, format_number
from simulations.engine.handles import Handle, Point
from simulations.engine.raster import of_planes
from simulations.engine.scene import Scene
from simulations.engine.settings import slider
from simulations.engine.stages import Outputs, Stage
from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb_codes
from simulations.models.projection import pinhole
from simulations.world.depth import ray_depth
from simulations.world.layers import LitScene
from simulations.world.still_life import OBJECTS, object_depth
from simulations.world.still_life_camera import (
    HANDLE_TANGENT,
    Rays,
    blur_layers,
    find_surfaces,
    floor_tangent,
    light_surfaces,
    line_on_floor,
    overlay,
)

COLUMNS = 800  # pixels across at rest; half as many down
WIDTH, HEIGHT = 800.0, 400.0  # view box of the picture
FOCAL_MM, FILM_WIDTH_MM = 80.0, 76.0
UNITS_PER_TANGENT = WIDTH * FOCAL_MM / FILM_WIDTH_MM  # view box units; of the angle from the axis


@dataclass(frozen=True, slots=True)
class Settings:
    focus: float = slider("Focus", 3.2, 1.8, 8.0, 0.1, unit="m", arrival=7.0)
    aperture: float = slider("Aperture", 2.0, 1.4, 22.0, 0.1, prefix="f/")
    light_angle: float = slider("Light angle", 40.0, -80.0, 80.0, 1.0, unit="°")


def parameters(_settings: Settings, _level: str) -> Mapping[str, Value]:
    return {"back": 0.0, "enlarged": 1.0}


def pixel_rays(columns: int) -> Rays:
    rows = columns // 2
    centre = ((columns - 1) / 2.0, (rows - 1) / 2.0)
    K = pinhole.intrinsics(columns * FOCAL_MM / FILM_WIDTH_MM, centre)
    return Rays(pinhole.pixel_rays(K, columns, rows), np.ones((rows, columns), bool))


def disc_width(aperture: float, focus: float, depth: Floats | float) -> Floats:
    """Width of the disc of confusion of points ``depth`` metres away, in widths of the picture."""
    opening_m = FOCAL_MM / aperture / 1000.0
    return opening_m * FOCAL_MM / FILM_WIDTH_MM * np.abs(1.0 / np.asarray(depth) - 1.0 / focus)


def defocus(lit: LitScene, aperture: float, focus: float, columns: int) -> LitScene:
    return blur_layers(lit, lambda depth: columns * disc_width(aperture, focus, depth) / 2.0)


def picture(lit: LitScene, enlarged: float) -> Raster:
    return of_planes(encode_srgb_codes(overlay(lit, enlarged)))


def tangents(place: Point) -> Point:
    """Tangents to the right and down of a place of the view box."""
    return (place[0] - WIDTH / 2) / UNITS_PER_TANGENT, (place[1] - HEIGHT / 2) / UNITS_PER_TANGENT


def floor_row(depth: float) -> float:
    """Row of the view box in which the floor is ``depth`` metres away."""
    return HEIGHT / 2 + UNITS_PER_TANGENT * floor_tangent(depth)


def draw(settings: Settings, outputs: Outputs) -> Frame:
    """The picture, and where the plane of focus cuts the floor."""
    focus = settings.focus
    line = line_on_floor(outputs["light"], floor_row(focus), WIDTH, HEIGHT)
    nearest = min(OBJECTS, key=lambda item: abs(1 / object_depth(item) - 1 / focus))
    sharp = f"the {nearest.name} is the sharpest thing" if focus < 7.3 else "the wall is sharp"
    side = "right" if settings.light_angle > 0 else "left"
    lit = f"lit from {abs(settings.light_angle):.0f}° to the {side}"
    return Frame(
        (Panel("picture", "", WIDTH, HEIGHT, outputs["picture"], line),),
        (),
        "Balls and boxes on a chequered floor, a test chart on the wall behind them; focused at "
        f"{format_number(focus, 1)} m with f/{settings.aperture:.1f}, {sharp}; {lit}.",
    )


def focus_at(settings: Settings, _outputs: Outputs) -> Point:
    return WIDTH / 2 + HANDLE_TANGENT * UNITS_PER_TANGENT, floor_row(settings.focus)


def middle(_settings: Settings, _outputs: Outputs) -> Point:
    return WIDTH / 2, HEIGHT / 2


def focus_on(_settings: Settings, place: Point) -> Mapping[str, Value]:
    """Focus on the object at a place of the picture."""
    return {"focus": ray_depth((*tangents(place), 1.0))}


SCENE = Scene(
    "still-life",
    "Still Life",
    Settings,
    draw,
    (
        Stage("rays", pixel_rays),
        Stage("surfaces", find_surfaces, ("rays",)),
        Stage("light", light_surfaces, ("surfaces",)),
        Stage("defocus", defocus, ("light",)),
        Stage("picture", picture, ("defocus",)),
    ),
    (
        Handle("aim", "picture", "Object to focus on", ("focus",), middle, focus_on, reach="aim"),
        Handle("focus", "picture", "Focus", ("focus",), focus_at, role="ray"),
    ),
    accuracy=Accuracy(levels=columns(200, 400, COLUMNS)),
    parameters=parameters,
)
