"""Counts of a Poisson distribution, one from each standard normal deviate.

The count for a deviate z is the quantile of the distribution at the probability of a normal below
z. It grows with z and with the mean, so that a picture with the same deviates has the same grain as
the light changes; only where the mean passes `FEW` does one count in 800 fall by one. A sampler by
rejection would change the grain at every change.
"""

import math

import numpy as np

from simulations.models.arrays import Floats

FEW = 10.0
"""Mean from which on the expansion is used, where its distribution is off by less than 3e-4."""

ROUNDING = 16
"""Bound on the error of sums of probabilities, in units in the last place of 1."""

TAIL = (
    -1.26551223, 1.00002368, 0.37409196, 0.09678418, -0.18628806,
    0.27886807, -1.13520398, 1.48851587, -0.82215223, 0.17087277,
)  # fmt: skip
"""Polynomial in t = 1 / (1 + x / 2) with erfc(x) = t exp(p(t) - x^2) to 1.2e-7 of itself."""


def poisson_from_normal(mean: Floats, z: Floats) -> Floats:
    """Whole numbers (...), 0 or more, for means ``mean`` (...) of 0 or more and deviates ``z``.

    The result is float32 for two arrays of float32. Below `FEW` the probabilities are summed;
    above, the quantile is expanded in powers of 1 / sqrt(mean).
    """
    shape, kind = np.broadcast_shapes(np.shape(mean), np.shape(z)), np.result_type(mean, z)
    mean, z = (np.atleast_1d(part).astype(kind, copy=False) for part in (mean, z))
    mean, z = np.broadcast_arrays(mean, z)
    counted = _expanded(mean, z)
    few = mean < FEW
    if few.any():
        counted[few] = _summed(mean[few], z[few])
    return counted.reshape(shape)


def _expanded(mean: Floats, z: Floats) -> Floats:
    """M. B. Giles, *Algorithm 955: approximation of the inverse Poisson cumulative distribution
    function*, ACM Transactions on Mathematical Software 42 (2016): the first three terms.

    The first is the normal, the second adds the Poisson's skew to the right, and the third narrows
    both tails a little.
    """
    root = np.sqrt(np.maximum(mean, FEW))
    lean = z / root
    lean *= -1 / 72
    lean += 1 / 6
    lean *= z * z + 2
    root *= z
    lean += root
    lean += mean
    return np.maximum(np.floor(lean, out=lean), 0, out=lean)


def _summed(mean: Floats, z: Floats) -> Floats:
    """The exact quantile (n,) of means below `FEW`: how many tails are larger than the normal's.

    The probabilities *above* a count and above a deviate are compared. Those below are so close to
    1 in the dark that an electron in 10¹² pixels would be lost to rounding.
    """
    counted = np.zeros_like(mean)
    chance = np.exp(-mean)  # of a count of 0
    above, tail = -np.expm1(-mean), normal_tail(z)
    more = np.flatnonzero(tail < above)
    # For tails as small as rounding the sums are inaccurate: the count is 1.
    tail = np.maximum(tail, ROUNDING * np.finfo(tail.dtype).eps)
    place, count = more, 0
    while more.size:
        mean, chance, above, tail = mean[more], chance[more], above[more], tail[more]
        count += 1
        counted[place] = count
        chance *= mean / count
        above -= chance
        more = np.flatnonzero(tail < above)
        place = place[more]
    return counted


def normal_tail(z: Floats) -> Floats:
    """Probability (...) of a standard normal above ``z``: erfc(z / √2) / 2, to 1.2e-7 of itself.

    W. H. Press et al., *Numerical Recipes*, 2nd ed., section 6.2, a Chebyshev fit.
    """
    x = np.abs(z) / math.sqrt(2.0)
    t = 1 / (1 + 0.5 * x)
    fit = TAIL[-1] * t
    for coefficient in TAIL[-2:0:-1]:
        fit += coefficient
        fit *= t
    fit += TAIL[0]
    fit -= x * x
    t *= 0.5 * np.exp(fit, out=fit)
    return np.where(z < 0, 1 - t, t)
