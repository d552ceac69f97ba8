"""The stages of the figure of a real lens: rays by the tier's model, and Snell's for comparison."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.lens.singlet import (
    Rays,
    Singlet,
    paraxial_image_mm,
    rim_mm,
    thin_image_mm,
    through_exact,
    through_paraxial,
    through_thin,
)

LARGEST_MM = 22.0
"""Half the lens's height, unless its surfaces meet before."""
FAN = 5
"""Rays drawn above the axis, and as many below."""
HEIGHTS_MM = np.linspace(0.25, 20.0, 80)
"""Heights of the curve of aberration."""
TIERS = {
    "thin": "Thin lens: one bend",
    "paraxial": "Thick lens, small angles",
    "exact": "Snell’s law at both spheres",
}


@dataclass(frozen=True, slots=True)
class Glass:
    """The lens, and its image in simpler models."""

    lens: Singlet
    rim_mm: float
    distance_mm: float
    """Distance of the object; inf for parallel light."""
    thin_mm: float
    paraxial_mm: float
    """Place of the image on the axis behind the lens's middle; negative or infinite if there is
    none."""

    @property
    def real(self) -> bool:
        """Whether the thick lens has an image behind it."""
        return self.lens.thickness_mm / 2.0 < self.paraxial_mm < math.inf


def object_mm(vergence: float) -> float:
    """The object's distance from its reciprocal in 1/m: infinite for 0."""
    return 1000.0 / vergence if vergence else math.inf


def trace(tier: str, glass: Glass, heights_mm: Floats) -> Rays:
    """Rays (n,) by the model of one tier."""
    simple: dict[str, Callable[[Singlet, float, Floats], Rays]] = {
        "thin": through_thin,
        "paraxial": through_paraxial,
    }
    if tier in simple:
        return simple[tier](glass.lens, glass.distance_mm, heights_mm)
    return through_exact(glass.lens, glass.distance_mm, heights_mm, LARGEST_MM)


def _glass(front: float, back: float, index: float, thickness: float, vergence: float) -> Glass:
    # Curvatures of the settings are positive outwards, per metre.
    lens = Singlet(front / 1000.0, -back / 1000.0, thickness, index)
    far = object_mm(vergence)
    return Glass(
        lens,
        rim_mm(lens, LARGEST_MM),
        far,
        thin_image_mm(lens, far),
        paraxial_image_mm(lens, far),
    )


def fan_heights(opening: float) -> Floats:
    """Heights (n,) evenly spaced over the opening, without the axis."""
    upper = opening * np.arange(1, FAN + 1) / FAN
    return np.concatenate((-upper[::-1], upper))


def _fan(glass: Glass, opening: float, tier: str) -> Rays:
    return trace(tier, glass, fan_heights(opening))


def _marked(glass: Glass, height: float, tier: str) -> Rays:
    return trace(tier, glass, np.array([height]))


def _true(glass: Glass, height: float) -> Rays:
    """The marked ray by Snell's law."""
    return trace("exact", glass, np.array([height]))


def _curve(glass: Glass) -> Floats:
    """(n,) where rays at `HEIGHTS_MM` cross the axis; NaN where they do not."""
    return trace("exact", glass, HEIGHTS_MM).crossing_mm


STAGES = (
    Stage("glass", _glass),
    Stage("fan", _fan, ("glass",)),
    Stage("marked", _marked, ("glass",)),
    Stage("true", _true, ("glass",)),
    Stage("curve", _curve, ("glass",)),
)
