"""Handles of the Lambertian figure: the lamp, the probed point, and the paint."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes._ball.marks import angle_of_normal, on_equator
from simulations.scenes._ball.probe import bearing_deg, probe_on_ball
from simulations.scenes.lambertian_shading.brightness_plot import on_plot, read_off
from simulations.scenes.lambertian_shading.drawing import (
    LAMP_DISTANCE,
    PLAN_CENTRE,
    PLAN_RADIUS,
    in_plan,
)
from simulations.scenes.lambertian_shading.settings import Settings


def _lamp(settings: Settings, _outputs: Outputs) -> Point:
    return in_plan(math.radians(settings.light_angle), LAMP_DISTANCE)


def _lamp_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"light_angle": _angle_in_plan(place, settings.light_angle)}


def _brightest(settings: Settings, _outputs: Outputs) -> Point | None:
    """The point whose normal points to the lamp, if the camera sees it."""
    if abs(settings.light_angle) > 90:
        return None
    return on_equator(math.radians(settings.light_angle))


def _brightest_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"light_angle": angle_of_normal(place)}


def _probe_in_plan(settings: Settings, _outputs: Outputs) -> Point:
    return in_plan(math.radians(settings.probe), PLAN_RADIUS)


def _probe_in_plan_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"probe": _angle_in_plan(place, settings.probe)}


def _angle_in_plan(place: Point, present_deg: float) -> float:
    """The direction of a place from the middle of the plan; unchanged at the middle."""
    across, down = place[0] - PLAN_CENTRE[0], place[1] - PLAN_CENTRE[1]
    return bearing_deg(across, down, present_deg)


def _on_curve(settings: Settings, _outputs: Outputs) -> Point:
    theta = abs(math.remainder(settings.light_angle - settings.probe, 360))
    return on_plot(theta, settings.albedo * max(0.0, math.cos(math.radians(theta))))


def _on_curve_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The probe at an angle from the lamp; of two that the camera sees, the nearer one."""
    theta = min(max(read_off(place)[0], 0.0), 180.0)
    light, limit = settings.light_angle, 90.0

    def misfit(angle: float) -> tuple[float, float]:
        """Error of the angle, and distance from the probe."""
        missed = abs(abs(math.remainder(light - angle, 360)) - theta)
        return round(missed, 6), abs(angle - settings.probe)

    both = (math.remainder(light + side * theta, 360) for side in (-1, 1))
    seen = [min(max(angle, -limit), limit) for angle in both]
    return {"probe": min((*seen, -limit, limit), key=misfit)}


def _paint(settings: Settings, _outputs: Outputs) -> Point:
    """The beginning of the curve: the brightness at normal incidence."""
    return on_plot(0.0, settings.albedo)


def _paint_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"albedo": read_off(place)[1]}


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
    probe_on_ball("ray"),
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
    Handle(
        "probe-curve",
        "curve",
        "Probed point",
        ("probe",),
        _on_curve,
        _on_curve_pulled,
        role="ray",
        reversed=("probe",),
    ),
    Handle("paint", "curve", "Albedo", ("albedo",), _paint, _paint_pulled, role="image"),
)
