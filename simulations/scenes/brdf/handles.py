"""Handles of the BRDF figure: lamp, camera, the point on the ball, the angle."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.brdf import energy, lobe, materials
from simulations.scenes.brdf.settings import Settings


def _lamp(settings: Settings, _outputs: Outputs) -> Point:
    return lobe.towards(settings.light_angle, lobe.LAMP)


def _lamp_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"light_angle": lobe.angle_at(place)}


def _camera(settings: Settings, _outputs: Outputs) -> Point:
    return lobe.towards(settings.view_angle, lobe.CAMERA)


def _camera_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"view_angle": lobe.angle_at(place)}


def _probe(settings: Settings, _outputs: Outputs) -> Point:
    """The camera is fixed in front of the ball; the normal is turned away from it."""
    return materials.on_equator(-settings.view_angle)


def _probe_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"view_angle": -materials.angle_of_normal(place)}


def _material(settings: Settings, _outputs: Outputs) -> Point:
    return materials.at(settings.roughness, settings.specular)


def _material_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return materials.material_at(place)


def _incidence(settings: Settings, outputs: Outputs) -> Point:
    return energy.at(abs(settings.light_angle), outputs["exchange"].sent)


def _incidence_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"light_angle": math.copysign(energy.angle_at(place), settings.light_angle)}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "material",
        "camera",
        "Material",
        ("roughness", "specular"),
        _material,
        _material_pulled,
        role="ray",
    ),
    Handle("lamp", "lobe", "Lamp", ("light_angle",), _lamp, _lamp_pulled, role="light"),
    Handle("eye", "lobe", "Camera", ("view_angle",), _camera, _camera_pulled, role="camera"),
    Handle(
        "probe",
        "camera",
        "Probed point",
        ("view_angle",),
        _probe,
        _probe_pulled,
        role="world",
        reversed=("view_angle",),
    ),
    Handle(
        "incidence",
        "energy",
        "Angle of the light",
        ("light_angle",),
        _incidence,
        _incidence_pulled,
        role="light",
    ),
)
