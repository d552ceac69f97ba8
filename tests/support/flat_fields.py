"""Pairs of evenly lit frames of a sensor whose truth is known, and files of such light."""

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.photon_counting import Sensor
from simulations.models.sensor.photon_transfer_fit import SensorEstimate, characterise
from simulations.models.sensor.photon_transfer_frames import (
    counted_pair,
    read_pair,
    unequal_cells,
)
from simulations.models.sensor.photon_transfer_pair import measure_pair

type Pairs = list[NDArray[np.uint16]]

SENSOR = Sensor(full_well_e=15_000.0, read_noise_e=10.0, gain_e_per_dn=4.0)
PRNU, DSNU_E = 0.01, 4.0

FILE_GAIN = 20.0
"""Electrons per 255th of white of the files: as at a high ISO."""


def pairs_of(
    size: int, seed: int, sensor: Sensor = SENSOR, count: int = 12, prnu: float = PRNU
) -> Pairs:
    """Pairs (2, size, size) from the dark to a tenth above the full well, evenly spaced."""
    rng = np.random.default_rng(seed)
    cells = unequal_cells((size, size), prnu, DSNU_E, rng)
    means = np.linspace(0.0, 1.1 * sensor.full_well_e, count)
    return [read_pair(counted_pair(mean, cells, sensor, rng), cells, sensor, rng) for mean in means]


def estimate_of(pairs: Pairs, sensor: Sensor = SENSOR, most: float = 0.7) -> SensorEstimate:
    """The sensor, with the first pair as its black."""
    levels = [measure_pair(pair, sensor.highest_dn) for pair in pairs]
    return characterise(levels, levels[0].mean_dn, sensor.highest_dn, most)


def light_of(level_dn: float, seed: int, size: int = 200) -> Floats:
    """Light (size, size, 3), in 255ths of white, that cells count as whole electrons."""
    rng = np.random.default_rng(seed)
    return rng.poisson(level_dn * FILE_GAIN, (size, size, 3)) / FILE_GAIN


def as_srgb(light_dn: Floats) -> NDArray[np.uint8]:
    """The codes of a file."""
    return np.rint(255 * encode_srgb(np.clip(light_dn / 255, 0, 1))).astype(np.uint8)
