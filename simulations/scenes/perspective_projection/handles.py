"""Handles of the projection figure: the point, its image, and the image plane."""

from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.scenes.perspective_projection import picture, top_view
from simulations.scenes.perspective_projection.settings import Settings
from simulations.scenes.perspective_projection.view import (
    HALF_WIDTH_PX,
    METRES_PER_PX,
    REFERENCE_DEPTH_M,
    Camera,
    View,
    view_of_point,
)


def view_of(settings: Settings) -> View:
    """The view at these settings."""
    camera = Camera(settings.focal_length, settings.perspective / 100.0)
    return view_of_point(settings.point_x, settings.point_y, settings.depth, camera)


def _point(settings: Settings, _outputs: Outputs) -> Point:
    x, y = top_view.above(settings.depth, settings.point_x)
    return float(x), float(y)


def _point_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    Z, X = top_view.metres_at(place)
    return {"depth": float(Z), "point_x": float(X)}


def _plane(settings: Settings, _outputs: Outputs) -> Point | None:
    """The lower end of the image plane, if it is in the panel."""
    depth = view_of(settings).camera.plane_m
    if depth < top_view.LEFT_M:
        return None
    x, y = top_view.above(depth, HALF_WIDTH_PX * METRES_PER_PX)
    return float(x), float(y)


def _plane_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The focal length of full perspective; the centre stays where it is."""
    Z, _ = top_view.metres_at(place)
    from_reference = (REFERENCE_DEPTH_M - float(Z)) * settings.perspective / 100.0
    return {"focal_length": (REFERENCE_DEPTH_M - from_reference) / METRES_PER_PX}


def _image(settings: Settings, _outputs: Outputs) -> Point | None:
    view = view_of(settings)
    if not view.visible:
        return None
    x, y = picture.place(view.x, view.y)
    return float(x), float(y)


def _image_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The point of the same depth that has its image there."""
    x, y = picture.pixel_at(place)
    view = view_of(settings)
    scale = view.camera.size_at(view.Z)
    return {"point_x": float(x) / scale, "point_y": float(y) / scale}


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "point",
        "top",
        "Point",
        ("depth", "point_x"),
        _point,
        _point_pulled,
        role="world",
        reversed=("point_x",),
    ),
    Handle("plane", "top", "Image plane", ("focal_length",), _plane, _plane_pulled, role="image"),
    Handle(
        "image",
        "image",
        "Image of the point",
        ("point_x", "point_y"),
        _image,
        _image_pulled,
        role="image",
        reversed=("point_y",),
    ),
)
