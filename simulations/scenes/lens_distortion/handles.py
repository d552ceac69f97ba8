"""What of the lens-distortion figure can be grabbed: the sample point, in the grid and the plot."""

import math
from collections.abc import Mapping

import numpy as np

from simulations.engine.controls import Value
from simulations.engine.handles import Handle, Point
from simulations.engine.stages import Outputs
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.distortion.radial_profile import evaluate
from simulations.scenes.lens_distortion.drawing import CENTRE, SAMPLE, UNITS_PER_RADIUS, to_view
from simulations.scenes.lens_distortion.profile import at_radii, radius_at
from simulations.scenes.lens_distortion.settings import Settings

RADIUS = math.hypot(*SAMPLE)
"""Of the sample point without the lens."""


def _crossing(settings: Settings, _outputs: Outputs) -> Point:
    x, y = to_view(distort(np.asarray(SAMPLE), Distortion(k1=settings.k1, k2=settings.k2)))
    return float(x), float(y)


def _crossing_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    """The image lies on the ray through the ideal point: what counts is how far out."""
    across, down = ((place[i] - CENTRE[i]) / UNITS_PER_RADIUS for i in (0, 1))
    along = (across * SAMPLE[0] + down * SAMPLE[1]) / RADIUS
    return {"k1": _first_coefficient(along, RADIUS, settings.k2)}


def _curve(settings: Settings, _outputs: Outputs) -> Point:
    lens = Distortion(k1=settings.k1, k2=settings.k2)
    return at_radii(RADIUS, float(evaluate(lens.radial, RADIUS)))


def _curve_pulled(settings: Settings, place: Point) -> Mapping[str, Value]:
    return {"k1": _first_coefficient(radius_at(place)[1], RADIUS, settings.k2)}


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
    Handle("curve", "profile", "Radius in the image", ("k1",), _curve, _curve_pulled, role="image"),
)
