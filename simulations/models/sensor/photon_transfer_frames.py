"""Frames of an evenly lit surface, whose cells differ."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.sensor.photon_counting import Sensor, quantise, read_out, shot_noise


@dataclass(frozen=True, slots=True)
class Cells:
    """What differs from cell to cell, and is the same in every frame."""

    response: Floats
    """(H, W) light that a cell counts, as a share of the mean."""
    offset_e: Floats
    """(H, W) electrons that its amplifier adds."""


def unequal_cells(
    shape: tuple[int, int], prnu: float, dsnu_e: float, rng: np.random.Generator
) -> Cells:
    """Cells with normal deviations: ``prnu`` a share of the light, ``dsnu_e`` in electrons."""
    response = np.maximum(1 + prnu * rng.standard_normal(shape), 0)
    return Cells(response, dsnu_e * rng.standard_normal(shape))


def counted_pair(mean_e: float, cells: Cells, sensor: Sensor, rng: np.random.Generator) -> Floats:
    """Electrons (2, H, W) counted in two frames of the same light."""
    return shot_noise(np.stack([mean_e * cells.response] * 2), rng, sensor.full_well_e)


def read_pair(
    electrons: Floats, cells: Cells, sensor: Sensor, rng: np.random.Generator
) -> NDArray[np.uint16]:
    """Codes (2, H, W) of the electrons counted."""
    return quantise(read_out(electrons + cells.offset_e, sensor, rng), sensor.bits)
