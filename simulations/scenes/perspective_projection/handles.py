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
    PERSPECTIVE,
    View,
    view_of_point,
)


def view_of(settings: Settings) -> View:
    """The view at these settings."""
    return view_of_point(
        X=settings.point_x,
        Y=settings.point_y,
        Z=settings.depth,
        focal_px=settings.focal_length,
        camera=settings.camera,
    )


def _point(settings: Settings, _outputs: Outputs) -> Point:
    x, y = top_view.above(settings.depth, settings.point_x)
    return float(x), float(y)


def _point_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    Z, X = top_view.metres_at(place)
    return {"depth": float(Z), "point_x": float(X)}


def _plane(settings: Settings, _outputs: Outputs) -> Point:
    """The near end of the image plane."""
    half = HALF_WIDTH_PX * METRES_PER_PX
    x, y = top_view.above(settings.focal_length * METRES_PER_PX, half)
    return float(x), float(y)


def _plane_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    Z, _ = top_view.metres_at(place)
    return {"focal_length": float(Z) / METRES_PER_PX}


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
    scale = view.focal_px / view.Z if view.camera == PERSPECTIVE else view.scale
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
