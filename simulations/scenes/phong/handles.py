"""Handles of the Phong figure: the highlight, the probed point, lamp and camera."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes._ball.marks import angle_of_normal
from simulations.scenes._ball.probe import bearing_deg, probe_on_ball
from simulations.scenes.phong import width
from simulations.scenes.phong.drawing import FOOT, VECTOR, highlight_grip, lamp_place, towards
from simulations.scenes.phong.settings import Settings


def _highlight(settings: Settings, _outputs: Outputs) -> Point | None:
    """Above the point whose normal halves the angle of lamp and camera; None if they are
    opposed."""
    if abs(settings.light_angle) == 180:
        return None
    return highlight_grip(math.radians(settings.light_angle))


def _highlight_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    """The light's angle for a highlight at a place; below 180°, at which none is visible."""
    return {"light_angle": min(max(2 * angle_of_normal(place), -179.0), 179.0)}


def _lamp(settings: Settings, _outputs: Outputs) -> Point:
    return lamp_place(math.radians(settings.light_angle - settings.probe))


def _lamp_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    turn = _angle_at_foot(place, settings.light_angle - settings.probe)
    return {"light_angle": math.remainder(settings.probe + turn, 360)}


def _camera(settings: Settings, _outputs: Outputs) -> Point:
    return towards(math.radians(-settings.probe), VECTOR)


def _camera_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The camera is fixed; the point turns with its normal."""
    return {"probe": -_angle_at_foot(place, -settings.probe)}


def _angle_at_foot(place: Point, present_deg: float) -> float:
    """The angle of a place from the normal; unchanged at the foot itself."""
    across, up = place[0] - FOOT[0], FOOT[1] - place[1]
    return bearing_deg(across, up, present_deg)


def _width(settings: Settings, _outputs: Outputs) -> Point | None:
    return width.at(settings.model, settings.shininess)


def _width_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"shininess": width.shininess_at(place, settings.model)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "highlight",
        "camera",
        "Highlight",
        ("light_angle",),
        _highlight,
        _highlight_pulled,
        role="ray",
    ),
    probe_on_ball("world"),
    Handle("lamp", "lobe", "Lamp", ("light_angle",), _lamp, _lamp_pulled, role="light"),
    Handle(
        "camera",
        "lobe",
        "Camera",
        ("probe",),
        _camera,
        _camera_pulled,
        role="camera",
        reversed=("probe",),
    ),
    Handle(
        "width",
        "width",
        "Width of the highlight",
        ("shininess",),
        _width,
        _width_pulled,
        role="ray",
        reversed=("shininess",),
    ),
)
