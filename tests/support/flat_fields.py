"""Pairs of evenly lit frames of a sensor whose truth is known."""

import numpy as np
from numpy.typing import NDArray

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
