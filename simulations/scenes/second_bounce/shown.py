"""The brightness of the chosen point on the floor of the second-bounce figure."""

from dataclasses import dataclass

import numpy as np

from simulations.scenes.second_bounce.stages import PLACES, Planes


@dataclass(frozen=True, slots=True)
class Shown:
    """Brightness of the point: by the lamp alone, and by all light in red and in blue."""

    lamp: float
    red: float
    blue: float


def shown_at(planes: Planes, place: float) -> Shown:
    """Linear interpolation between the computed places."""
    red, blue = planes.all_light
    return Shown(*(float(np.interp(place, PLACES, each[0])) for each in (planes.lamp, red, blue)))
