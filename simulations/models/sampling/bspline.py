"""Interpolation by cubic B-splines.

A B-spline is a bump four samples wide. The sum of bumps as high as the samples is a blurred
picture. `coefficients` computes the heights for which the sum meets each sample: the pre-filter
inverts the weights 1/6, 4/6 and 1/6 that the bumps have at the samples.

M. Unser, A. Aldroubi, M. Eden, *B-spline signal processing*, IEEE Transactions on Signal Processing
41 (1993). Szeliski, 2nd ed., section 3.5.1.
"""

import numpy as np

from simulations.models.arrays import Floats

POLE = np.sqrt(3.0) - 2.0
"""The inverse filter's weights are √3 POLE^|n|: each is about a quarter of the one before."""


def weigh(x: Floats) -> Floats:
    """The bump (...) at signed distances ``x`` (...) from its sample, in samples."""
    t = np.abs(x)
    inner = (0.5 * t - 1.0) * t * t + 2.0 / 3.0
    beyond = np.maximum(2.0 - t, 0.0)
    outer = beyond * beyond * beyond / 6.0  # NumPy's third power takes a logarithm
    return np.where(t < 1.0, inner, outer)


def coefficients(samples: Floats) -> Floats:
    """Heights (H, W) of the bumps whose sum passes through ``samples`` (H, W).

    Beyond the border the samples at the border repeat. float32 stays float32.
    """
    return _unsmoothed(_unsmoothed(samples).T).T


def _unsmoothed(samples: Floats) -> Floats:
    """Filter along the first axis: both one-sided sums, which share the sample itself."""
    heights = _one_sided(samples)
    heights += _one_sided(samples[::-1])[::-1]
    heights -= samples
    heights *= samples.dtype.type(np.sqrt(3.0))
    return heights


def _one_sided(samples: Floats) -> Floats:
    """The sum over k = 0, 1, 2 … of POLE^k times the sample k places before.

    1 / (1 − z) is (1 + z) (1 + z²) (1 + z⁴) …, so that each step doubles the number of terms.
    """
    total = samples.copy()
    reach, factor = 1, POLE
    while abs(factor) > np.finfo(samples.dtype).eps:
        weight = samples.dtype.type(factor)
        # All rows before the first are equal to it, and so are their sums.
        first, earlier = weight * total[0], weight * total[:-reach]
        total[:reach] += first
        total[reach:] += earlier
        reach, factor = 2 * reach, factor * factor
    return total
