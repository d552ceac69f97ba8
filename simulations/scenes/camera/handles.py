"""Handles of the camera simulator: the distance in focus, the edge of the field of view and the
lamp in the plan; any thing in the photograph."""

import math
from collections.abc import Mapping

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.distortion.lens_model import (
    Distortion,
    distort,
    fold_radius,
    undistort_clamped,
)
from simulations.pictures.still_life.depth import depth_met
from simulations.scenes._still_life_camera.rays import (
    SENSOR_HEIGHT_MM,
    SENSOR_WIDTH_MM,
    principal_mm,
)
from simulations.scenes.camera.dolly import after_step, focal_before_step
from simulations.scenes.camera.lens import half_view_tangent
from simulations.scenes.camera.plan import (
    PLAN_HEIGHT,
    PLAN_WIDTH,
    STILL_LIFE_MIDDLE,
    edge_mark,
    edge_marked,
    focus_mark,
    focus_marked,
    lamp_mark,
    seen_from,
)
from simulations.scenes.camera.settings import Settings


def _focus(settings: Settings, _outputs: Outputs) -> Point:
    return focus_mark(settings.focus, settings.back)


def _focus_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"focus": focus_marked(place, settings.back)}


def _edge(settings: Settings, _outputs: Outputs) -> Point:
    now = after_step(settings)
    return edge_mark(half_view_tangent(now.focal_length, now.focus, now.k1), now.back)


def _edge_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The focal length that images a ray through the place on the edge of the sensor."""
    lens = Distortion(k1=settings.k1)
    tangent = min(max(edge_marked(place, settings.back), 1e-3), fold_radius(lens))
    principal = SENSOR_WIDTH_MM / 2 / float(distort(np.array((tangent, 0.0)), lens)[0])
    return {"focal_length": focal_before_step(principal, settings.focus, settings.back)}


def _lamp(settings: Settings, _outputs: Outputs) -> Point:
    return lamp_mark(settings.light_angle, back=settings.back)


def _lamp_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The angle of the place from the middle of the still life; unchanged in the middle itself."""
    across, away = seen_from(place, settings.back)
    nearer = STILL_LIFE_MIDDLE - away
    if not (across or nearer):
        return {}
    return {"light_angle": math.degrees(math.atan2(across, nearer))}


def _middle(_settings: Settings, _outputs: Outputs) -> Point:
    return (PLAN_WIDTH / 2, PLAN_HEIGHT / 2)


def _aimed(settings: Settings, place: Point) -> Mapping[str, Value]:
    """Focus on what the lens images at a place of the photograph, if any ray arrives there."""
    now = after_step(settings)
    principal = principal_mm(now.focal_length, now.focus)
    across = (place[0] / PLAN_WIDTH - 0.5) * SENSOR_WIDTH_MM / principal
    down = (place[1] / PLAN_HEIGHT - 0.5) * SENSOR_HEIGHT_MM / principal
    ideal, reached = undistort_clamped([(across, down)], Distortion(k1=settings.k1))
    if not reached.all():
        return {}
    return {"focus": depth_met((*ideal[0], 1.0), settings.back) - settings.back}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("aim", "photograph", "Object to focus on", ("focus",), _middle, _aimed, "aim"),
    Handle("focus", "plan", "Distance in focus", ("focus",), _focus, _focus_pulled, role="ray"),
    Handle(
        "edge",
        "plan",
        "Edge of the field of view",
        ("focal_length",),
        _edge,
        _edge_pulled,
        role="camera",
    ),
    Handle("lamp", "plan", "Lamp", ("light_angle",), _lamp, _lamp_pulled, role="light"),
)
