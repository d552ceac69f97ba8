"""The Poisson distribution, and the distance of samples from it.

The probability of a count k where ``mean`` are expected is e^-mean mean^k / k!. Without powers and
factorials: each probability is the previous one times mean / k.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.require import require


def poisson_cumulative(mean: float) -> tuple[int, Floats]:
    """P(N <= k) for k = first, first + 1, … until it reaches 1.

    Returns
    -------
    first : the lowest count; less than 1e-20 of the probability lies below it.
    cumulative : (n,) float64, rising to 1.

    Raises
    ------
    ValueError
        If the mean is negative, undefined, or above 1e10, for which the array would be too large.
    """
    require("mean", mean, 0 <= mean <= 1e10, "0 to 1e10")
    reach = 10 * np.sqrt(mean) + 30  # ten standard deviations, and more where the mean is small
    first, last = max(0, int(mean - reach)), int(mean + reach)
    if mean == 0:
        return 0, np.ones(1)
    with np.errstate(divide="ignore"):  # a tiny mean: only 0 is counted
        steps = np.log(mean / np.arange(first + 1, last + 1, dtype=float))
    # Relative to the first term the largest is at most e^155, if the first count is 0.
    terms = np.exp(np.concatenate(([0.0], np.cumsum(steps))))
    return first, np.cumsum(terms) / terms.sum()


def gap_from_poisson(counted: ArrayLike, mean: float, full_well: float = np.inf) -> float:
    """Kolmogorov-Smirnov distance: the largest gap between two cumulative distributions.

    Parameters
    ----------
    counted : (n,)
        Whole numbers, drawn with this mean and limited to the full well, itself a whole number.
    mean : float
        Mean of the Poisson distribution that they are compared with.

    Returns
    -------
    A probability. See `largest_chance_gap` for what exact samples leave.
    """
    counts = np.asarray(counted)
    if counts.size == 0 or np.isnan(counts).any():
        raise ValueError("no counts, or undefined ones; legal: one number or more")
    first, cumulative = poisson_cumulative(mean)
    expected = np.where(first + np.arange(cumulative.size) >= full_well, 1.0, cumulative)
    # Counts beyond either end are counted at the end.
    place = np.clip(counts - first, 0, cumulative.size - 1).astype(np.int64)
    share = np.cumsum(np.bincount(place.ravel(), minlength=cumulative.size)) / counts.size
    return float(np.abs(share - expected).max())


def largest_chance_gap(distributions: int, samples: int) -> float:
    """The median of the largest gap of exact samples from as many distributions.

    Kolmogorov's limit: sqrt(samples) times the gap exceeds x with probability 2 exp(-2 x^2), as
    long as that is small. For whole numbers it is a little less.
    """
    if min(distributions, samples) < 1:
        raise ValueError(f"{distributions} distributions of {samples} samples; legal: 1 or more")
    exceeded = 1 - 0.5 ** (1 / distributions)
    return math.sqrt(math.log(2 / exceeded) / (2 * samples))
