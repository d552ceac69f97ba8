"""Handles of the still life: the plane of focus, and anything in the picture."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.pictures.still_life.depth import depth_met
from simulations.scenes._still_life_camera.focus_plane import HANDLE_TANGENT, floor_depth
from simulations.scenes.still_life.settings import Settings
from simulations.scenes.still_life.view import (
    HEIGHT,
    UNITS_PER_TANGENT,
    WIDTH,
    floor_row,
    tangents,
)


def _focus(settings: Settings, _outputs: Outputs) -> Point:
    return WIDTH / 2 + HANDLE_TANGENT * UNITS_PER_TANGENT, floor_row(settings.focus)


def _focus_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"focus": floor_depth(tangents(place)[1])}


def _middle(_settings: Settings, _outputs: Outputs) -> Point:
    return WIDTH / 2, HEIGHT / 2


def _aimed(_settings: Settings, place: Point) -> Mapping[str, Value]:
    """Focus on the thing at a place of the picture."""
    return {"focus": depth_met((*tangents(place), 1.0))}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("aim", "picture", "Object to focus on", ("focus",), _middle, _aimed, "aim"),
    Handle("focus", "picture", "Focus", ("focus",), _focus, _focus_pulled, role="ray"),
)
