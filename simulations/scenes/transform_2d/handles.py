"""Handles of the explorer: P, its image, a corner of the image, and the families."""

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
from simulations.scenes.transform_2d import hierarchy
from simulations.scenes.transform_2d.settings import Settings

HALF_WAY = 14.0
"""From half way between two marks of families up to the edge of a frame."""


def unpulled(settings: Settings) -> Floats:
    """The matrix (3, 3) of family and amount alone."""
    return family.transformation(settings.transform, settings.amount)


def matrix(settings: Settings) -> Floats:
    """The matrix (3, 3) that the figure shows."""
    pull = (settings.pull_x, settings.pull_y)
    return family.pulled(settings.transform, unpulled(settings), pull)


def _point(settings: Settings, _outputs: Outputs) -> Point:
    return _pair(to_view((settings.point_x, settings.point_y)))


def _point_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    x, y = _pair(from_view(place))
    return {"point_x": x, "point_y": y}


def _image(settings: Settings, _outputs: Outputs) -> Point | None:
    image, valid = apply_homography(matrix(settings), (settings.point_x, settings.point_y))
    return _pair(to_view(image)) if valid else None


def _image_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    matrices = family.way(settings.transform, (settings.pull_x, settings.pull_y))
    point = np.array([settings.point_x, settings.point_y])
    return {"amount": float(nearest_amount(matrices, point, place))}


def _corner(settings: Settings, _outputs: Outputs) -> Point:
    return _pair(to_view(family.pulled_corner(matrix(settings))))


def _corner_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    x, y = _pair(from_view(place) - family.pulled_corner(unpulled(settings)))
    return {"pull_x": x, "pull_y": y}


def _family(settings: Settings, _outputs: Outputs) -> Point:
    return hierarchy.grip(settings.transform)


def _family_pulled(_settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"transform": hierarchy.innermost_at((place[0], place[1] - HALF_WAY))}


def _pair(place: Floats) -> Point:
    return float(place[0]), float(place[1])


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "corner",
        "plane",
        "Corner of the image",
        ("pull_x", "pull_y"),
        _corner,
        _corner_pulled,
        role="image",
    ),
    Handle(
        "point", "plane", "Point P", ("point_x", "point_y"), _point, _point_pulled, role="world"
    ),
    Handle("image", "plane", "Image of P", ("amount",), _image, _image_pulled, role="image"),
    Handle(
        "family",
        "hierarchy",
        "Family mark",
        ("transform",),
        _family,
        _family_pulled,
        reach="press",
        role="image",
    ),
)
