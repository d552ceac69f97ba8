"""Handles of the depth-of-field figure: the plane of focus, the point in focus, the rim of the
opening, and any thing in the picture."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.pictures.still_life.depth import depth_met
from simulations.scenes._still_life_camera.focus_plane import HANDLE_TANGENT
from simulations.scenes._still_life_camera.rays import (
    SENSOR_HEIGHT_MM,
    SENSOR_WIDTH_MM,
    principal_mm,
)
from simulations.scenes.depth_of_field.drawing import (
    AXIS_Y,
    HEIGHT,
    LENS_X,
    WIDTH,
    aperture_of,
    column,
    distance_of,
    half_opening,
)
from simulations.scenes.depth_of_field.focus_line import floor_row, focus_of_row, units_per_tangent
from simulations.scenes.depth_of_field.settings import Settings, has_image


def _focus(settings: Settings, _outputs: Outputs) -> Point:
    return (column(settings.focus), AXIS_Y)


def _focus_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"focus": distance_of(place[0])}


def _rim(settings: Settings, _outputs: Outputs) -> Point | None:
    """The upper end of the opening, if the lens forms an image."""
    if not has_image(settings):
        return None
    return (LENS_X, AXIS_Y - half_opening(settings.focal_length / settings.aperture))


def _rim_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"aperture": settings.focal_length / aperture_of(AXIS_Y - place[1])}


def _floor(settings: Settings, _outputs: Outputs) -> Point | None:
    if not has_image(settings):
        return None
    row = floor_row(settings.focal_length, settings.focus)
    across = HANDLE_TANGENT * units_per_tangent(settings.focal_length, settings.focus)
    return None if row is None else (min(WIDTH / 2 + across, WIDTH), row)


def _floor_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"focus": focus_of_row(settings.focal_length, place[1])}


def _middle(_settings: Settings, _outputs: Outputs) -> Point:
    return (WIDTH / 2, HEIGHT / 2)


def _aimed(settings: Settings, place: Point) -> Mapping[str, Value]:
    """Focus on the thing at a place of the picture; not available without an image."""
    if not has_image(settings):
        return {}
    across = (place[0] / WIDTH - 0.5) * SENSOR_WIDTH_MM
    down = (place[1] / HEIGHT - 0.5) * SENSOR_HEIGHT_MM
    principal = principal_mm(settings.focal_length, settings.focus)
    return {"focus": depth_met((across / principal, down / principal, 1.0))}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("aim", "picture", "Object to focus on", ("focus",), _middle, _aimed, "aim"),
    Handle("floor", "picture", "Plane of focus", ("focus",), _floor, _floor_pulled, role="ray"),
    Handle(
        "focus",
        "lens",
        "Point in focus",
        ("focus",),
        _focus,
        _focus_pulled,
        role="ray",
        reversed=("focus",),
    ),
    Handle(
        "rim",
        "lens",
        "Rim of the opening",
        ("aperture",),
        _rim,
        _rim_pulled,
        role="camera",
        reversed=("aperture",),
    ),
)
