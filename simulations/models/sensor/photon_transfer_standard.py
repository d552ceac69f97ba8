"""Full well, dynamic range and linearity as EMVA Standard 1288, release 4.0, defines them.

The full well is where noise is largest. The standard asks for fifty levels. With fewer the full
well lies somewhere between the noisiest pair and the next brighter one.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.sensor.photon_transfer_fit import (
    UNSATURATED,
    Estimate,
    SensorEstimate,
    electrons,
)
from simulations.models.sensor.photon_transfer_pair import Level

FEWEST = 4
"""Levels of different exposure, of which linearity can be told."""
LOWEST, HIGHEST = 0.05, 0.95
"""Shares of saturation between which it is measured."""
NO_TIMES = "The files do not say how long they were exposed."


@dataclass(frozen=True, slots=True)
class Standard:
    """Numbers of the standard."""

    full_well: Estimate
    """Electrons at which noise is largest."""
    dynamic_range: Estimate
    """Full well by the signal that is equal to its noise."""
    linearity_error: Estimate
    """Mean size of the deviations from a line through the exposures, as a share of it."""


def standard_estimates(
    levels: Sequence[Level], black_dn: float, exposures: Sequence[float], sensor: SensorEstimate
) -> Standard:
    """The numbers of a sensor that `characterise` found in the levels.

    ``exposures`` are in any unit, NaN where they are not known; the light must be the same.
    """
    if sensor.noise is None or sensor.gain.reason:
        return Standard(*[Estimate.unknown(sensor.gain.reason)] * 3)
    order = np.argsort([level.mean_dn for level in levels])
    mean = np.array([level.mean_dn for level in levels])[order] - black_dn
    noisiest = int(np.argmax([levels[place].noise_dn2 for place in order]))
    low, *high = (electrons(sensor.noise, dn) for dn in mean[noisiest : noisiest + 2].tolist())
    full = Estimate(low.value, math.nan, UNSATURATED, "above")
    for next_one in high:
        apart = (next_one.value - low.value) / 3  # holds two thirds of even chances
        middle = 0.5 * (low.value + next_one.value)
        full = Estimate(middle, math.hypot(low.error, apart))
    times = np.array(exposures, float)[order]
    saturated = mean[noisiest] if high else math.inf
    return Standard(full, _dynamic_range(full, sensor), _linearity(mean, times, saturated))


def _dynamic_range(full: Estimate, sensor: SensorEstimate) -> Estimate:
    """The signal that is equal to its noise is √(read noise² + rounding²) + ½ electrons."""
    read = sensor.read_noise
    if read.reason:
        return Estimate.unknown(read.reason)
    dark = math.hypot(read.value, sensor.gain.value / math.sqrt(12))
    value = full.value / (dark + 0.5)
    if full.reason:
        return Estimate(value, math.nan, full.reason, full.bound)
    by_read = read.error * read.value / dark / (dark + 0.5)
    return Estimate(value, value * math.hypot(full.error / full.value, by_read))


def _linearity(mean: Floats, exposures: Floats, full_dn: float) -> Estimate:
    """Deviations of the levels in between from the line whose relative deviations are least."""
    lowest = LOWEST * min(full_dn, float(mean.max()))
    used = (mean >= lowest) & (mean <= HIGHEST * full_dn) & (exposures > 0)
    x, y = exposures[used], mean[used]
    if len(set(x.tolist())) < FEWEST:
        few = f"Linearity needs {FEWEST} exposures between 5 and 95 % of saturation."
        return Estimate.unknown(few if used.any() else NO_TIMES)
    line = np.polyval(np.polyfit(x, y, 1, w=1 / y), x)
    off = np.abs(y - line) / line
    return Estimate(float(off.mean()), float(off.std(ddof=1)) / math.sqrt(len(off)))
