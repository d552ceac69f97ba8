"""The photon-transfer curve: what the noise of flat fields says of a sensor.

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
from simulations.models.sensor.photon_counting import Sensor, quantise, read_out, shot_noise
from simulations.models.whole_numbers import as_whole

SATURATED_SHARE = 0.7
"""Of the mean whose variance is largest: EMVA 1288 fits the line up to there."""

LEAST_VARIANCE_DN2 = 0.5
"""Above it rounding adds 1/12 to a variance, to a thousandth of the whole. Below, the sum depends
on where between two codes the mean lies, and soon all pixels have the same code."""

FEWEST_E = 10.0
"""Electrons from which on that holds without read noise too. Fewer fall on few codes, and rounding
them adds several times as much, or takes away: gains would come out 2 % off."""

LARGEST_ERROR = 0.1
"""Standard error of a gain, as a share of it, from which on it is refused."""


@dataclass(frozen=True, slots=True)
class Gain:
    """A sensor's conversion gain, measured."""

    e_per_dn: float
    """Electrons per code."""
    error_e_per_dn: float
    """One standard error, by chance alone."""


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


def straight_part(mean_dn: ArrayLike, variance_dn: ArrayLike) -> Mask:
    """Which levels (N,) of a transfer curve a line may be fitted to.

    A well or a converter that is nearly full cuts the variance, and means alone do not tell: left
    out are levels above 70 % of the one of largest variance. So are those whose variance is below
    0.5 DN², for which a code is too coarse a step, and those of fewer than 10 electrons by a first
    fit to all the others. Raises `ValueError` for other shapes than (N,) and for numbers that are
    not finite.
    """
    mean, variance = as_floats(mean_dn), as_floats(variance_dn)
    if mean.ndim != 1 or mean.shape != variance.shape:
        raise ValueError(f"mean {mean.shape} and variance {variance.shape}; legal: both (N,)")
    if not (np.isfinite(mean).all() and np.isfinite(variance).all()):
        raise ValueError("a mean or a variance is not finite; legal: finite")
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

    A line is fitted with weight 1 / variance² of each point, since a variance of ``samples``
    values is known to a fraction of itself, sqrt(2 / (samples − 1)). From twenty even levels
    of 20 000 samples the gain comes out to about half a per cent, as long as most of them have
    a variance above 0.5 DN²: with a well of 20 000 electrons, up to some 50 electrons per code.

    Raises
    ------
    ValueError
        For fewer than two levels on the straight part, and where they tell the gain to worse
        than 10 % (one standard error): they are too near each other, or too noisy, or their
        variance does not rise with the mean.
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
            f"levels that tell the gain to {100 * share:.0f} % only; "
            f"legal: {100 * LARGEST_ERROR:.0f} % or better"
        )
    return Gain(1 / slope, share / slope)


def _line(mean: Floats, variance: Floats, samples: int) -> tuple[float, float]:
    """Slope of the weighted fit, and its standard error as a share of it."""
    samples = as_whole("samples", samples, 2)
    spread, largest = float(np.ptp(mean)), float(variance.max())  # so that no square overflows
    x, y = mean / spread, variance / largest
    weight = y**-2
    x = x - np.average(x, weights=weight)
    moment, product = float(np.sum(weight * x * x)), float(np.sum(weight * x * y))
    error = math.sqrt(2 / (samples - 1) / moment)
    return largest / spread * (product / moment), error * moment / product if product else math.inf
