"""The photon-transfer curve: a sensor's gain from the noise of flat fields.

With the black level taken off, a field that frees λ electrons in each pixel has the mean λ / g and
the variance λ / g² + floor, in codes, g being the conversion gain in electrons per code: a straight
line of slope 1 / g. European Machine Vision Association, *Standard 1288: characterization of image
sensors and cameras*, release 4.0. J. Janesick, *Photon Transfer*, 2007.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_floats
from simulations.models.require import as_whole, require
from simulations.models.sensor.photon_counting import Sensor, quantise, read_out, shot_noise

SATURATED_SHARE = 0.7
"""Share of the mean of the largest variance, up to which EMVA 1288 fits the line."""

LEAST_VARIANCE_DN2 = 0.5
"""Least variance: above it rounding adds 1/12, to a thousandth of the whole. Below, the sum depends
on the position of the mean between two codes, and soon all pixels have the same code."""

FEWEST_E = 10.0
"""Least count of electrons for which this holds without read noise too. With fewer, rounding
changes the variance several times as much, and gains would be 2 % off."""

LARGEST_ERROR = 0.1
"""Largest standard error of a gain, as a share of it."""


@dataclass(frozen=True, slots=True)
class Gain:
    """A sensor's conversion gain, measured."""

    e_per_dn: float
    """Electrons per code."""
    error_e_per_dn: float
    """One standard error, from random noise alone."""


def photon_transfer(
    mean_e: ArrayLike, sensor: Sensor, rng: np.random.Generator, samples: int = 20_000
) -> tuple[Floats, Floats]:
    """Mean and variance in codes of flat fields at each level (N,): the photon-transfer curve.

    The variance is half of that of the difference of two exposures, as in a laboratory,
    where it cancels the pattern that a real sensor has. In the part ruled by shot noise
    ``variance = mean / gain``: see `estimate_gain`.
    """
    levels = as_floats(mean_e).reshape(-1)
    samples = as_whole("samples", samples, 2)
    fields = []
    for _ in range(2):
        counted = shot_noise(np.repeat(levels[:, None], samples, 1), rng, sensor.full_well_e)
        fields.append(quantise(read_out(counted, sensor, rng), sensor.bits).astype(np.float64))
    mean: Floats = (fields[0] + fields[1]).mean(axis=1) / 2 - sensor.black_level_dn
    variance: Floats = (fields[0] - fields[1]).var(axis=1, ddof=1) / 2
    return mean, variance


LARGEST_DN = 1e100
"""Largest mean or variance of a transfer curve, so that sums of squares are finite."""


def straight_part(mean_dn: ArrayLike, variance_dn: ArrayLike) -> Mask:
    """Which levels (N,) of a transfer curve can be used to fit a line.

    Not the levels above 70 % of the one of largest variance, as a nearly full well or converter
    reduces the variance; not those with a variance below 0.5 DN², which is too small for the step
    of a code; and not those of fewer than 10 electrons by a first fit to all the others. Raises
    `ValueError` for other shapes than (N,) and for numbers that are not finite.
    """
    mean, variance = as_floats(mean_dn), as_floats(variance_dn)
    if mean.ndim != 1 or mean.shape != variance.shape:
        raise ValueError(f"mean {mean.shape} and variance {variance.shape}; legal: both (N,)")
    for name, levels in (("mean", mean), ("variance", variance)):
        legal = bool((np.abs(levels) <= LARGEST_DN).all())
        require(name, levels, legal, f"finite, at most {LARGEST_DN:g} in size")
    if mean.size == 0:
        return np.zeros(0, bool)
    unsaturated = mean <= SATURATED_SHARE * mean[np.argmax(variance)]
    straight: Mask = unsaturated & (variance >= LEAST_VARIANCE_DN2)
    if straight.any() and np.ptp(mean[straight]) > 0:
        slope, _ = _line(mean[straight].astype(float), variance[straight].astype(float), 2)
        straight &= mean >= FEWEST_E * slope
    return straight


def estimate_gain(mean_dn: ArrayLike, variance_dn: ArrayLike, samples: int = 20_000) -> Gain:
    """The gain from a transfer curve (N,): one over the slope of its straight part.

    A line is fitted with weight 1 / variance² of each point, since the relative error of a variance
    of ``samples`` values is sqrt(2 / (samples − 1)). From twenty even levels of 20 000 samples the
    error of the gain is about half a per cent, as long as most of them have a variance above 0.5
    DN²: with a well of 20 000 electrons, up to some 50 electrons per code.

    Raises
    ------
    ValueError
        For fewer than two levels on the straight part, and if the standard error exceeds 10 %: the
        levels are too near each other, or too noisy, or their variance does not rise with the mean.
    """
    straight = straight_part(mean_dn, variance_dn)
    mean, variance = (as_floats(part)[straight].astype(float) for part in (mean_dn, variance_dn))
    if mean.size < 2 or np.ptp(mean) == 0:
        raise ValueError(
            f"{mean.size} of {straight.size} levels on the straight part; legal: two that differ, "
            f"of {LEAST_VARIANCE_DN2} DN² and {FEWEST_E:g} electrons or more, "
            "up to 70 % of the mean of largest variance"
        )
    slope, share = _line(mean, variance, samples)
    if not slope > 0:
        raise ValueError(f"variance does not rise with the mean, slope {slope:.3g}; legal: above 0")
    if share > LARGEST_ERROR:
        raise ValueError(
            f"levels that determine the gain to {100 * share:.0f} % only; "
            f"legal: {100 * LARGEST_ERROR:.0f} % or better"
        )
    return Gain(1 / slope, share / slope)


def _line(mean: Floats, variance: Floats, samples: int) -> tuple[float, float]:
    """Slope of the weighted fit, and its standard error as a share of it."""
    samples = as_whole("samples", samples, 2)
    spread, largest = float(np.ptp(mean)), float(variance.max())  # to avoid overflow of squares
    x, y = mean / spread, variance / largest
    weight = y**-2
    x = x - np.average(x, weights=weight)
    moment, product = float(np.sum(weight * x * x)), float(np.sum(weight * x * y))
    error = math.sqrt(2 / (samples - 1) / moment)
    return largest / spread * (product / moment), error * moment / product if product else math.inf
