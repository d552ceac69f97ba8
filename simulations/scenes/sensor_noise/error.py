"""Distance of the patches' electrons from Poisson's distribution."""

from collections.abc import Iterator
from itertools import repeat

import numpy as np

from simulations.engine.frame import Readout, format_number
from simulations.models.arrays import Floats
from simulations.models.sensor.photon_counting import ShotModel
from simulations.models.sensor.poisson import gap_from_poisson, largest_chance_gap
from simulations.scenes.sensor_noise.stages import FULL_WELL_E, count_patches

EXPOSURES = 16
"""Exposures of the patches for the error of a tier."""


def estimates(
    counted: Floats | None, mean_e: Floats, new_noise: int, model: ShotModel
) -> Iterator[Readout]:
    """The largest gap between the cumulatives of ``counted`` (24, 1600) and of ``mean_e`` (24,).

    As 1600 pixels of a patch are few, each step adds another exposure of the same patches. The
    first is ``counted``, if given.
    """
    rng = np.random.default_rng((new_noise, 3))
    for exposures in range(1, EXPOSURES + 1):
        if counted is None:
            counted = count_patches(mean_e, rng, model)
        elif exposures > 1:
            counted = np.concatenate((counted, count_patches(mean_e, rng, model)), axis=1)
        gap = max(map(gap_from_poisson, counted, mean_e, repeat(FULL_WELL_E)))
        chance = largest_chance_gap(*counted.shape)
        label = (
            f"Largest gap to Poisson’s cumulative, {exposures} of {EXPOSURES} exposures "
            f"(chance: {format_number(chance, 3)})"
        )
        yield Readout("error", label, format_number(gap, 3), "probability", "error")
