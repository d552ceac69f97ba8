"""Handles of the figure of a corner at infinity: the image of P, P, and the amount in the plot."""

from collections.abc import Mapping

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.arrays import Floats
from simulations.models.geometry.transforms import apply_homography
from simulations.scenes._mapped_square import family
from simulations.scenes._mapped_square.marks import nearest_amount
from simulations.scenes._mapped_square.plane import from_view, to_view
from simulations.scenes.lost_corner import divisor
from simulations.scenes.lost_corner.settings import Settings


def point_of(settings: Settings) -> Floats:
    """P (2,)."""
    return np.array([settings.point_x, settings.point_y])


def matrix(settings: Settings) -> Floats:
    """The homography (3, 3)."""
    return family.transformation("projective", settings.amount)


def _image(settings: Settings, _outputs: Outputs) -> Point | None:
    image, valid = apply_homography(matrix(settings), point_of(settings))
    return _pair(to_view(image)) if valid else None


def _image_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    way = family.way("projective")
    return {"amount": float(nearest_amount(way, point_of(settings), place))}


def _point(settings: Settings, _outputs: Outputs) -> Point:
    return _pair(to_view(point_of(settings)))


def _point_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    x, y = _pair(from_view(place))
    return {"point_x": x, "point_y": y}


def _amount(settings: Settings, _outputs: Outputs) -> Point:
    w = divisor.w_at(matrix(settings), point_of(settings))
    return divisor.PLOT.clamped(settings.amount, w)


def _amount_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"amount": divisor.PLOT.x.value(place[0])}


def _pair(place: Floats) -> Point:
    return float(place[0]), float(place[1])


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("image", "plane", "Image of P", ("amount",), _image, _image_pulled, role="image"),
    Handle(
        "point", "plane", "Point P", ("point_x", "point_y"), _point, _point_pulled, role="world"
    ),
    Handle(
        "amount",
        "divisor",
        "Mark on the curve",
        ("amount",),
        _amount,
        _amount_pulled,
        "press",
        "image",
    ),
)
