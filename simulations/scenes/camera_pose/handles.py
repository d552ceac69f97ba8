"""Handles of the pose figure: the camera, and the tip of its forward axis."""

import math
from collections.abc import Mapping

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.camera_pose.plans import from_camera, metres_at
from simulations.scenes.camera_pose.room import AXIS_M, Standpoint
from simulations.scenes.camera_pose.settings import Settings


def _at(outputs: Outputs, forward: float) -> Point:
    standpoint: Standpoint = outputs["standpoint"]
    x, y = from_camera(standpoint)(np.array([0.0, 0.0, forward]))
    return float(x), float(y)


def _camera(_settings: Settings, outputs: Outputs) -> Point:
    return _at(outputs, 0.0)


def _camera_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    X, Z = metres_at(place)
    return {"camera_x": X, "camera_z": Z}


def _tip(_settings: Settings, outputs: Outputs) -> Point:
    return _at(outputs, AXIS_M)


def _tip_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    X, Z = metres_at(place)
    return {"pan": math.degrees(math.atan2(X - settings.camera_x, Z - settings.camera_z))}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "camera",
        "world",
        "Camera",
        ("camera_x", "camera_z"),
        _camera,
        _camera_pulled,
        role="camera",
    ),
    Handle("tip", "world", "Forward axis", ("pan",), _tip, _tip_pulled, role="camera"),
)
