"""What of the Lambertian figure can be grabbed: the lamp, and the probed point in two views."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.reflection.lambertian_drawing import (
    LAMP_DISTANCE,
    PLAN_CENTRE,
    PLAN_RADIUS,
    in_plan,
)
from simulations.scenes.reflection.lambertian_settings import Settings
from simulations.scenes.reflection.marks import CENTRE, RADIUS, on_equator


def _lamp(settings: Settings, _outputs: Outputs) -> Point:
    return in_plan(math.radians(settings.light_angle), LAMP_DISTANCE)


def _lamp_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"light_angle": _angle_in_plan(place, settings.light_angle)}


def _brightest(settings: Settings, _outputs: Outputs) -> Point | None:
    """Where the normal points to the lamp, if the camera sees it."""
    if abs(settings.light_angle) > 90:
        return None
    return on_equator(math.radians(settings.light_angle))


def _brightest_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"light_angle": _angle_of_normal(place)}


def _probe(settings: Settings, _outputs: Outputs) -> Point:
    return on_equator(math.radians(settings.probe))


def _probe_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"probe": _angle_of_normal(place)}


def _probe_in_plan(settings: Settings, _outputs: Outputs) -> Point:
    return in_plan(math.radians(settings.probe), PLAN_RADIUS)


def _probe_in_plan_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"probe": _angle_in_plan(place, settings.probe)}


def _angle_in_plan(place: Point, present_deg: float) -> float:
    """The direction of a place from the middle of the plan; at the middle, as it is."""
    across, down = place[0] - PLAN_CENTRE[0], place[1] - PLAN_CENTRE[1]
    return math.degrees(math.atan2(across, down)) if across or down else present_deg


def _angle_of_normal(place: Point) -> float:
    """The angle of the normal on the equator above or below a place of the picture."""
    across = (place[0] - CENTRE[0]) / RADIUS
    return math.degrees(math.asin(min(max(across, -1.0), 1.0)))


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "brightest",
        "camera",
        "Brightest point",
        ("light_angle",),
        _brightest,
        _brightest_pulled,
        role="light",
    ),
    Handle("probe", "camera", "Probed point", ("probe",), _probe, _probe_pulled, role="ray"),
    Handle("lamp", "above", "Lamp", ("light_angle",), _lamp, _lamp_pulled, role="light"),
    Handle(
        "probe-above",
        "above",
        "Probed point",
        ("probe",),
        _probe_in_plan,
        _probe_in_plan_pulled,
        role="ray",
    ),
)
