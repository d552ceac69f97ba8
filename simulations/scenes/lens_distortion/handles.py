"""Handles of the lens-distortion figure: two points of the photograph, a crossing of the grid."""

import math
from collections.abc import Mapping

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.distortion.lens_model import Distortion, fold_radius
from simulations.scenes.lens_distortion.drawing import (
    CENTRE,
    INNER,
    OUTER,
    SAMPLE,
    UNITS_PER_RADIUS,
    held,
    image_of,
)
from simulations.scenes.lens_distortion.settings import Settings

RADIUS = math.hypot(*SAMPLE)
"""Radius of the sample point without the lens."""


def _crossing(settings: Settings, _outputs: Outputs) -> Point | None:
    """The image of the crossing, if it is inside the fold."""
    lens = _lens(settings)
    return image_of(SAMPLE, lens) if fold_radius(lens) > RADIUS else None


def _crossing_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"k1": _first_coefficient(_pulled_to(SAMPLE, place), RADIUS, settings.k2)}


def _inner(settings: Settings, _outputs: Outputs) -> Point | None:
    return _in_photograph(INNER, settings)


def _inner_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"k1": _first_coefficient(_pulled_to(INNER, place), math.hypot(*INNER), settings.k2)}


def _outer(settings: Settings, _outputs: Outputs) -> Point | None:
    return _in_photograph(OUTER, settings)


def _outer_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The k₂ that images the radius at the place: r (1 + k₁ r² + k₂ r⁴) solved for it."""
    square = OUTER[0] ** 2 + OUTER[1] ** 2
    factor = _pulled_to(OUTER, place) / math.sqrt(square)
    return {"k2": (factor - 1.0 - settings.k1 * square) / square**2}


def _in_photograph(ideal: tuple[float, float], settings: Settings) -> Point | None:
    """A handle in the photograph, within its border where the point is farther out; none past the
    fold and in a corrected photograph."""
    lens = _lens(settings)
    if settings.correct or math.hypot(*ideal) >= fold_radius(lens):
        return None
    return held(ideal, lens)


def _lens(settings: Settings) -> Distortion:
    return Distortion(k1=settings.k1, k2=settings.k2)


def _pulled_to(ideal: tuple[float, float], place: Point) -> float:
    """The image radius at a place or, as the image is on the ray through the ideal point, at its
    nearest point of that ray."""
    across, down = ((place[i] - CENTRE[i]) / UNITS_PER_RADIUS for i in (0, 1))
    return (across * ideal[0] + down * ideal[1]) / math.hypot(*ideal)


def _first_coefficient(image: float, ideal: float, k2: float) -> float:
    """The k₁ that images radius ``ideal`` at ``image``: r (1 + k₁ r² + k₂ r⁴) solved for it."""
    return (image / ideal - 1.0) / ideal**2 - k2 * ideal**2


HANDLES: tuple[Handle[Settings], ...] = (
    Handle("point", "picture", "Inner point", ("k1",), _inner, _inner_pulled, role="image"),
    Handle("outer", "picture", "Outer point", ("k2",), _outer, _outer_pulled, role="image"),
    Handle(
        "crossing",
        "grid",
        "Image of a crossing",
        ("k1",),
        _crossing,
        _crossing_pulled,
        role="image",
    ),
)
