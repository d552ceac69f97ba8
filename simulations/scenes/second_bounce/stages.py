"""The stages of the second-bounce figure: the lamp's light, then the light between the planes.

There are two kinds of light: red, for which wall and floor have the same albedo, and blue, for
which a red wall has a tenth of it.
"""

import math
from dataclasses import dataclass

import numpy as np

from simulations.engine.stages import Stage
from simulations.models.arrays import Floats
from simulations.models.light.interreflection import (
    bounced,
    lamp_light,
    mean_lamp_light,
    seen_of,
)

RED_WALL = 0.1
"""Share of the floor's albedo that a red wall has in green and blue."""
PLACES: Floats = np.linspace(0.0, 1.0, 201)
"""Distances from the edge at which both planes are shown."""


@dataclass(frozen=True, slots=True)
class Planes:
    """Brightness of both planes; 1 is a perfect white that faces the lamp."""

    lamp: Floats
    """(2, 201) by the lamp alone, in red light; the floor first."""
    all_light: Floats
    """(2, 2, 201) in red light and in blue: floor and wall."""


def _direct(light_angle: float, opening: float) -> Floats:
    """(2, CELLS) irradiance of the strips of floor and wall."""
    light, angle = math.radians(light_angle), math.radians(opening)
    return np.stack([mean_lamp_light(light, angle), mean_lamp_light(angle - light, angle)])


def _bounces(bounces: str) -> int | None:
    return None if bounces == "all" else int(bounces)


def _albedos(albedo: float, wall: str) -> Floats:
    """(2, 2) of floor and wall, in red light and in blue."""
    blue = albedo * RED_WALL if wall == "red" else albedo
    return np.array([[albedo, albedo], [albedo, blue]])


def _planes(
    direct: Floats, light_angle: float, opening: float, bounces: str, albedo: float, wall: str
) -> Planes:
    """The brightness at all places. The last bounce is computed for each place, so that shadows
    stay sharp."""
    light, angle = math.radians(light_angle), math.radians(opening)
    sharp = np.stack([lamp_light(PLACES, light, angle), lamp_light(PLACES, angle - light, angle)])
    view = seen_of(PLACES, angle)
    count = _bounces(bounces)
    shown = []
    for albedos in _albedos(albedo, wall):
        arriving = sharp
        if count != 0:
            before = bounced(direct, albedos, angle, None if count is None else count - 1)
            arriving = sharp + before[::-1] @ view.T
        shown.append(albedos[:, None] * arriving)
    return Planes(albedo * sharp, np.stack(shown))


STAGES = (
    Stage("direct", _direct),
    Stage("planes", _planes, ("direct",)),
)
