"""Handles of the tiled floor: the box, the horizon, and the vanishing points."""

import math
from collections.abc import Callable, Mapping

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.projection.level_ground import ground_to_image
from simulations.scenes.tiled_floor.drawing import (
    from_picture,
    from_plane,
    in_picture,
    in_plane,
    inside,
)
from simulations.scenes.tiled_floor.settings import Settings
from simulations.scenes.tiled_floor.view import MIDDLE, Camera, box_of, camera_of

ASIDE_PX = 80.0
"""Distance along the horizon of its handle from the box's, which start in the middle."""

type At = Callable[[Settings, Outputs], Point | None]
type Pull = Callable[[Settings, Point], Mapping[str, Value]]


def _foot(settings: Settings, _outputs: Outputs) -> Point | None:
    """The middle of the box's base."""
    pixel, seen = camera_of(settings).image(np.array([settings.box_x, settings.box_y, 0.0]))
    return in_picture(pixel) if seen else None


def _foot_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """Move the box to the floor at a place; not available in the sky."""
    view = camera_of(settings)
    x, y, nearness = np.linalg.solve(
        ground_to_image(view.pose, view.K), [*from_picture(place), 1.0]
    )
    return {"box_x": float(x / nearness), "box_y": float(y / nearness)} if nearness > 0.0 else {}


def _top(settings: Settings, _outputs: Outputs) -> Point | None:
    """The middle of the box's top."""
    box = box_of(settings)
    pixel, seen = camera_of(settings).image(np.array([box.x, box.y, box.height]))
    return in_picture(pixel) if seen else None


def _top_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The height whose image, on the vertical line through the middle, is nearest to the place.

    The image of a height h is (B + h V) / w, on a line through the image of the base.
    """
    view, box = camera_of(settings), box_of(settings)
    base = ground_to_image(view.pose, view.K) @ [box.x, box.y, 1.0]
    vertical = view.K @ view.directions[2]
    wanted = np.array(from_picture(place))
    along = vertical[:2] * base[2] - base[:2] * vertical[2]
    upwards = float((vertical[:2] - wanted * vertical[2]) @ along)
    if not upwards:
        return {}
    return {"box_height": -float((base[:2] - wanted * base[2]) @ along) / upwards}


def _level(settings: Settings, _outputs: Outputs) -> Point:
    """A point of the horizon, aside from the one nearest to the principal point."""
    view = camera_of(settings)
    middle, line = view.K[:2, 2], view.horizon
    nearest = middle - (line[:2] @ middle + line[2]) * line[:2]
    aside = ASIDE_PX if settings.principal_x <= 0.0 else -ASIDE_PX
    return in_picture(nearest + aside * np.array([line[1], -line[0]]))


def _level_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The horizon is f tan(pitch) from the principal point, upwards in the camera's world."""
    view = camera_of(settings)
    roll = math.radians(settings.roll)
    x, y = np.array(from_picture(place)) - view.K[:2, 2]
    rise = -float(x * math.sin(roll) + y * math.cos(roll))
    return {"pitch": math.degrees(math.atan2(rise, settings.focal_length))}


def _vanishing(index: int, to_panel: Callable[[np.ndarray], Point]) -> At:
    def at(settings: Settings, _outputs: Outputs) -> Point | None:
        pixels, finite = camera_of(settings).vanishing
        if not finite[index] or not inside(place := to_panel(pixels[index])):
            return None
        return place

    return at


def _azimuth(view: Camera, pixel: Point) -> float:
    """Angle of a pixel's ray to the right of the camera's direction, degrees, ±90."""
    ray = view.pose[:3, :3].T @ np.linalg.solve(view.K, [*pixel, 1.0])
    forward = view.pose[2, :2]  # on the floor
    right = np.array([forward[1], -forward[0]])
    return math.degrees(math.atan2(right @ ray[:2], forward @ ray[:2]))


def _first_pulled(from_panel: Callable[[Point], Point]) -> Pull:
    def pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
        return {"yaw": -_azimuth(camera_of(settings), from_panel(place))}

    return pulled


def _second_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The rows across have two directions, to the right and to the left."""
    azimuth = _azimuth(camera_of(settings), from_plane(place))
    return {"yaw": math.copysign(90.0, azimuth) - azimuth}


def _principal(settings: Settings, _outputs: Outputs) -> Point:
    return in_plane(camera_of(settings).K[:2, 2])


def _principal_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    x, y = from_plane(place)
    return {"principal_x": x - MIDDLE[0], "principal_y": y - MIDDLE[1]}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("level", "picture", "Horizon", ("pitch",), _level, _level_pulled, role="camera"),
    Handle("box", "picture", "Box", ("box_x", "box_y"), _foot, _foot_pulled, role="world"),
    Handle("top", "picture", "Top of the box", ("box_height",), _top, _top_pulled, role="world"),
    Handle(
        "first",
        "picture",
        "Vanishing point v₁",
        ("yaw",),
        _vanishing(0, in_picture),
        _first_pulled(from_picture),
        role="image",
        reversed=("yaw",),
    ),
    Handle(
        "first-wide",
        "plane",
        "Vanishing point v₁",
        ("yaw",),
        _vanishing(0, in_plane),
        _first_pulled(from_plane),
        role="image",
        reversed=("yaw",),
    ),
    Handle(
        "second-wide",
        "plane",
        "Vanishing point v₂",
        ("yaw",),
        _vanishing(1, in_plane),
        _second_pulled,
        role="image",
        reversed=("yaw",),
    ),
    Handle(
        "principal",
        "plane",
        "Principal point",
        ("principal_x", "principal_y"),
        _principal,
        _principal_pulled,
        role="camera",
        reversed=("principal_y",),
    ),
)
