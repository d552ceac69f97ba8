"""Handles of the two views: the lamp, its two images, and the right camera."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.two_views import pictures, plan
from simulations.scenes.two_views.settings import Settings
from simulations.scenes.two_views.view import in_picture, view_of

NEAREST_M = 0.5
"""Least depth, for places nearer to the plane of the left camera or behind it."""


def _lamp(settings: Settings, _outputs: Outputs) -> Point:
    view = view_of(settings)
    x, y = plan.above(view.depth, float(view.point[0]))
    return float(x), float(y)


def _lamp_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """Its height in the world changes with it; its height in the left picture does not."""
    Z, X = (float(value) for value in plan.metres_at(place))
    depth = max(Z, NEAREST_M)
    return {"depth": depth, "left_x": settings.focal_length * X / depth}


def _right_camera(settings: Settings, _outputs: Outputs) -> Point:
    x, y = plan.above(0.0, settings.baseline)
    return float(x), float(y)


def _right_camera_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"baseline": float(plan.metres_at(place)[1])}


def _axis(settings: Settings, _outputs: Outputs) -> Point:
    x, y = plan.axis_end(view_of(settings))
    return float(x), float(y)


def _axis_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    Z, X = (float(value) for value in plan.metres_at(place))
    return {"toe_in": math.degrees(math.atan2(settings.baseline - X, Z))}


def _left(settings: Settings, _outputs: Outputs) -> Point:
    x, y = pictures.place(view_of(settings).left)
    return float(x), float(y)


def _left_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    x, y = pictures.pixel_at(place)
    return {"left_x": float(x), "left_up": -float(y)}


def _right(settings: Settings, _outputs: Outputs) -> Point | None:
    """None if the right camera does not see it."""
    pixel = view_of(settings).right
    if not in_picture(pixel):
        return None
    x, y = pictures.place(pixel)
    return float(x), float(y)


def _right_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The depth at a place along the epipolar line."""
    view = view_of(settings)
    return {"depth": view.pair.depth(view.left, pictures.pixel_at(place))}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "lamp",
        "plan",
        "Lamp",
        ("depth", "left_x"),
        _lamp,
        _lamp_pulled,
        role="world",
        reversed=("left_x",),
    ),
    Handle(
        "camera",
        "plan",
        "Right camera",
        ("baseline",),
        _right_camera,
        _right_camera_pulled,
        role="camera",
        reversed=("baseline",),
    ),
    Handle(
        "axis", "plan", "Axis of the right camera", ("toe_in",), _axis, _axis_pulled, role="camera"
    ),
    Handle(
        "left",
        "left",
        "Left image of the lamp",
        ("left_x", "left_up"),
        _left,
        _left_pulled,
        role="image",
    ),
    Handle(
        "right", "right", "Right image of the lamp", ("depth",), _right, _right_pulled, role="image"
    ),
)
