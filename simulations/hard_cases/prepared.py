"""What the questions of several hard cases are about: photographs of edges, frames of a sensor."""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.sampling.first_fall import first_fall
from simulations.models.sampling.slanted_edge import read_edge
from simulations.models.sampling.slanted_edge_picture import edge_picture, edge_transfer
from simulations.models.sensor import bayer, demosaicing
from simulations.models.sensor.photon_counting import Sensor
from simulations.models.sensor.photon_transfer_fit import SensorEstimate, characterise
from simulations.models.sensor.photon_transfer_frames import counted_pair, read_pair, unequal_cells
from simulations.models.sensor.photon_transfer_pair import measure_pair

ORANGE = np.array([1.0, 0.5, 0.1])
SENSOR = Sensor(full_well_e=15_000.0, read_noise_e=10.0, gain_e_per_dn=4.0)
SIDE = 64


def spread(method: str, pattern: str, height: int, width: int) -> float:
    """Largest departure from a flat orange after mosaic and reconstruction."""
    flat = np.broadcast_to(ORANGE, (height, width, 3))
    restored = demosaicing.demosaic(bayer.mosaic(flat, pattern), pattern, method)
    return float(np.abs(restored - ORANGE).max())


def pairs() -> list[np.ndarray]:
    """Twelve pairs of frames, from black to beyond the full well."""
    rng = np.random.default_rng(3)
    cells = unequal_cells((SIDE, SIDE), 0.01, 0.0, rng)
    means = np.linspace(0.0, 1.1 * SENSOR.full_well_e, 12)
    return [read_pair(counted_pair(mean, cells, SENSOR, rng), cells, SENSOR, rng) for mean in means]


def sensor(frames: list[np.ndarray]) -> SensorEstimate:
    """The sensor as its pairs of frames show it."""
    levels = [measure_pair(pair, 4095) for pair in frames]
    return characterise(levels, levels[0].mean_dn, 4095, 0.7)


def smoothed(frames: list[np.ndarray]) -> list[np.ndarray]:
    """Each pixel the mean of two neighbours."""
    return [((pair[..., 1:] + pair[..., :-1]) // 2).astype(np.uint16) for pair in frames]


def gain_of_one_frame(frames: list[np.ndarray]) -> float:
    """Mean over variance of single frames, as if the cells were equal."""
    black = frames[0].mean()
    return float(np.mean([(pair[0].mean() - black) / pair[0].var() for pair in frames[4:8]]))


def edge(angle_deg: float) -> Floats:
    """A photograph of a slanted edge through a Gaussian spot, 80 × 80 pixels."""
    return edge_picture(80, 80, math.radians(angle_deg), _spot)


def mtf50(picture: ArrayLike) -> float:
    """The frequency of half contrast, read from a photograph of an edge."""
    return read_edge(picture).half_contrast().frequency


def true_mtf50(angle_deg: float) -> float:
    """The same frequency by the formulae of spot and pixel."""
    fine = np.linspace(0.0, 0.5, 5001)
    return first_fall(fine, _spot(fine) * edge_transfer(fine, math.radians(angle_deg)), 0.5)


def _spot(frequency: Floats) -> Floats:
    """The transfer of a Gaussian with a standard deviation of a pixel."""
    factor: Floats = np.exp(-2.0 * np.square(np.pi * frequency))
    return factor
