"""Pictures of edges with a known MTF, made without the book's renderer, and pairs of evenly lit
frames of a known sensor."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.special import erf

from simulations.models.arrays import Floats, centred
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.photon_counting import Sensor
from simulations.models.sensor.photon_transfer_fit import Estimate, SensorEstimate, characterise
from simulations.models.sensor.photon_transfer_frames import counted_pair, read_pair, unequal_cells
from simulations.models.sensor.photon_transfer_pair import measure_pair

type Pairs = list[NDArray[np.uint16]]

SENSOR = Sensor(full_well_e=15_000.0, read_noise_e=10.0, gain_e_per_dn=4.0)
PRNU, DSNU_E = 0.01, 4.0

FILE_GAIN = 20.0
"""Electrons per 255th of white in files, as at a high ISO."""


def pairs_of(
    size: int, seed: int, sensor: Sensor = SENSOR, count: int = 12, prnu: float = PRNU
) -> Pairs:
    """Pairs (2, size, size) of evenly spaced means, from dark to 1.1 times the full well."""
    rng = np.random.default_rng(seed)
    cells = unequal_cells((size, size), prnu, DSNU_E, rng)
    means = np.linspace(0.0, 1.1 * sensor.full_well_e, count)
    return [read_pair(counted_pair(mean, cells, sensor, rng), cells, sensor, rng) for mean in means]


def estimate_of(pairs: Pairs, most: float = 0.7) -> SensorEstimate:
    """The estimate of the sensor; the first pair gives the black level."""
    levels = [measure_pair(pair, SENSOR.highest_dn) for pair in pairs]
    return characterise(levels, levels[0].mean_dn, SENSOR.highest_dn, most)


def scored(estimates: Mapping[str, tuple[Estimate, float]]) -> dict[str, float]:
    """Deviations of the known estimates from their truth, in standard errors."""
    return {
        name: (estimate.value - truth) / estimate.error
        for name, (estimate, truth) in estimates.items()
        if not estimate.reason
    }


def light_of(level_dn: float, seed: int, size: int = 200) -> Floats:
    """Light (size, size, 3) in 255ths of white, with photon noise."""
    rng = np.random.default_rng(seed)
    return rng.poisson(level_dn * FILE_GAIN, (size, size, 3)) / FILE_GAIN


def as_srgb(light_dn: Floats) -> NDArray[np.uint8]:
    """The sRGB codes of a file."""
    return np.rint(255 * encode_srgb(np.clip(light_dn / 255, 0, 1))).astype(np.uint8)


def gaussian_edge(
    height: int, width: int, angle_deg: float, sigma: float = 1.0, *, bow: float = 0.0
) -> Floats:
    """An edge (H, W) from 0 to 1 through the middle, blurred by a Gaussian of ``sigma`` px.

    Pixels are samples at points. ``bow`` bends the edge into a parabola, in px per squared px.
    """
    x, y = centred(width), centred(height)[:, None]
    angle = np.deg2rad(angle_deg)
    distance = np.cos(angle) * x + np.sin(angle) * y - bow * y**2
    return np.asarray(0.5 + 0.5 * erf(distance / (np.sqrt(2.0) * sigma)))


def gaussian_half(sigma: float) -> float:
    """MTF50 of `gaussian_edge`, in cycles per pixel: where exp(−2 π² σ² f²) is one half."""
    return float(np.sqrt(np.log(2.0) / 2.0) / (np.pi * sigma))


def grain(shape: tuple[int, ...], sigma: float, seed: int) -> Floats:
    """White Gaussian noise of standard deviation ``sigma``."""
    return np.random.default_rng(seed).normal(0.0, sigma, shape)
