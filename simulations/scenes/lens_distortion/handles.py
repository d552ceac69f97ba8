"""Handles of the lens-distortion figure: a crossing of the grid, a point of the
photograph, and the image radius of the crossing in the plot."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.distortion.lens_model import Distortion
from simulations.models.distortion.radial_profile import evaluate
from simulations.scenes.lens_distortion.drawing import (
    CENTRE,
    IN_PICTURE,
    SAMPLE,
    UNITS_PER_RADIUS,
    image_of,
)
from simulations.scenes.lens_distortion.profile import at_radii, radius_at
from simulations.scenes.lens_distortion.settings import Settings

RADIUS = math.hypot(*SAMPLE)
"""Radius of the sample point without the lens."""


def _crossing(settings: Settings, _outputs: Outputs) -> Point:
    return image_of(SAMPLE, _lens(settings))


def _crossing_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"k1": _putting(SAMPLE, place, settings.k2)}


def _in_picture(settings: Settings, _outputs: Outputs) -> Point | None:
    """The handle in the photograph, if it is not corrected."""
    return None if settings.correct else image_of(IN_PICTURE, _lens(settings))


def _in_picture_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"k1": _putting(IN_PICTURE, place, settings.k2)}


def _curve(settings: Settings, _outputs: Outputs) -> Point:
    return at_radii(RADIUS, float(evaluate(_lens(settings).radial, RADIUS)))


def _curve_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"k1": _first_coefficient(radius_at(place)[1], RADIUS, settings.k2)}


def _lens(settings: Settings) -> Distortion:
    return Distortion(k1=settings.k1, k2=settings.k2)


def _putting(ideal: tuple[float, float], place: Point, k2: float) -> float:
    """The k₁ that images a point at a place or, as the image is on the ray through the ideal point,
    at its nearest point of that ray.
    """
    radius = math.hypot(*ideal)
    across, down = ((place[i] - CENTRE[i]) / UNITS_PER_RADIUS for i in (0, 1))
    along = (across * ideal[0] + down * ideal[1]) / radius
    return _first_coefficient(along, radius, k2)


def _first_coefficient(image: float, ideal: float, k2: float) -> float:
    """The k₁ that images radius ``ideal`` at ``image``: r (1 + k₁ r² + k₂ r⁴) solved for it."""
    return (image / ideal - 1.0) / ideal**2 - k2 * ideal**2


HANDLES: tuple[Handle[Settings], ...] = (
    Handle(
        "crossing",
        "grid",
        "Image of a crossing",
        ("k1",),
        _crossing,
        _crossing_pulled,
        role="image",
    ),
    Handle(
        "point",
        "picture",
        "Point of the picture",
        ("k1",),
        _in_picture,
        _in_picture_pulled,
        role="image",
    ),
    Handle("curve", "profile", "Radius in the image", ("k1",), _curve, _curve_pulled, role="image"),
)
