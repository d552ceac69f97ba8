"""Sampling and aliasing of detail that is too fine for the grid of samples.

Frequencies are in cycles per sample spacing (or per whatever the rate is given in); Nyquist is half
the rate. Szeliski, 2nd ed., sections 2.3.1 and 3.5.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_floats
from simulations.models.require import as_whole, require, require_positive

LARGEST_SIGMA = 1e6
"""Largest sigma of a kernel: eight million taps, wider than any picture."""


def alias_frequency(frequency: ArrayLike, rate: float = 1.0) -> Floats:
    """The signed frequency (...) in [-rate/2, rate/2) that has the same samples.

    Negative means that the wave seems to run backwards. Exactly at Nyquist both signs have the same
    samples; the negative one is returned. The remainder of a division is exact in floating point,
    so that the result is right however large the frequency. Raises `ValueError` for a rate that is
    not positive and for values that are not finite.
    """
    require_positive("rate", rate)
    f = np.asarray(frequency, float)  # in float32 the rate itself would be rounded
    require("frequency", f, np.isfinite(f).all(), "finite")
    rest = np.fmod(f, rate)
    # Half of the smallest number would round to zero: compare with the other part instead.
    alias: Floats = np.where(rest >= rate - rest, rest - rate, rest)
    return np.where(alias < -rate - alias, alias + rate, alias)


def apparent_wheel_speed(
    turns_per_s: ArrayLike, spokes: int, frames_per_s: float
) -> tuple[Floats, Mask]:
    """Turns per second that a filmed wheel seems to make, and whether its direction is certain.

    A wheel looks the same after one spoke spacing, so that ``spokes * turns`` aliases at the frame
    rate. For a turn of exactly half a spacing per frame the direction is uncertain.
    """
    spokes = as_whole("spokes", spokes, 1)
    turns = np.asarray(turns_per_s, float)
    require("turns_per_s", turns, np.all(np.abs(turns) <= 1e9), "at most 1e9 in size")
    passing_per_s = turns * spokes
    spokes_per_s = alias_frequency(passing_per_s, frames_per_s)
    certain = ~np.isclose(np.abs(spokes_per_s), frames_per_s / 2, rtol=1e-9, atol=0)
    return spokes_per_s / spokes, certain


def zone_plate(x: ArrayLike, y: ArrayLike, scale: float) -> Floats:
    """Rings that get finer outwards, in [0, 1]: ``(1 + cos(pi r^2 / scale)) / 2``.

    At distance ``r`` from the centre their frequency is ``r / scale`` cycles per unit, so that
    samples one unit apart start to alias at ``r = scale / 2``. Where the phase overflows, the rings
    are infinitely fine and have their mean, 1/2.
    """
    require_positive("scale", scale)
    with np.errstate(over="ignore"):
        phase = np.pi * (np.square(as_floats(x)) + np.square(as_floats(y))) / scale
    if np.isfinite(phase).all():
        return np.asarray(0.5 + 0.5 * np.cos(phase))
    known = np.isfinite(phase)
    return np.where(known, 0.5 + 0.5 * np.cos(np.where(known, phase, 0)), 0.5)


def gaussian_kernel(sigma: float) -> Floats:
    """Normalised samples of a Gaussian out to 4 sigma; sigma 0 is the single tap 1.

    Convention: ``sigma`` is the standard deviation of the taps themselves, as weights on whole
    numbers; truncation makes it at most 0.1 % too small. From 1 on the taps are samples of the
    Gaussian of that sigma. Samples of a narrower one would be too narrow: at 0.3 their standard
    deviation would be 0.09. They are therefore samples of a wider Gaussian.

    Raises `ValueError` for a sigma that is negative or above `LARGEST_SIGMA`.
    """
    require("sigma", sigma, 0 <= sigma <= LARGEST_SIGMA, f"0 to {LARGEST_SIGMA:g}")
    if sigma == 0:
        return np.ones(1)
    offsets = np.arange(-np.ceil(4 * sigma), np.ceil(4 * sigma) + 1)
    if sigma < 1:
        taps = _ratio_of_neighbours(sigma) ** np.square(offsets)
    else:
        taps = np.exp(-0.5 * (offsets / sigma) ** 2)
    return taps / taps.sum()


def _ratio_of_neighbours(sigma: float) -> float:
    """The q for which taps q^(n²), samples of a Gaussian, have the variance sigma² below 1.

    Newton's method for ``2 Σ (n² − σ²) q^(n²) = σ²``, which is convex in q: from a start that is
    too large it descends to the root without passing it.
    """
    squares = np.arange(1.0, 7.0) ** 2
    weights = 2 * (squares - sigma**2)
    ratio = 0.61  # exp(-1/2), the answer for sigma 1, is a little less
    for _ in range(12):
        excess = float(weights @ ratio**squares) - sigma**2
        ratio -= excess / float(weights @ (squares * ratio ** (squares - 1)))
    return max(ratio, 0.0)


def filter_and_sample(fine: ArrayLike, factor: int, kernel: ArrayLike) -> Floats:
    """Low-pass (H, W) by a separable kernel of odd length, then keep the centre of each block.

    The border is mirrored. With an even factor the centre lies half a sample off the grid:
    the kernel's samples must allow for it.
    """
    image, taps = _divisible(fine, factor), as_floats(kernel)
    if taps.ndim != 1 or taps.size % 2 == 0:
        raise ValueError(f"kernel of shape {taps.shape}; legal: one axis of odd length")
    with np.errstate(over="ignore", invalid="ignore"):
        for axis in (0, 1):
            image = _filter_axis(image, taps, factor, axis)
    return image


def _filter_axis(image: Floats, taps: Floats, factor: int, axis: int) -> Floats:
    """Filter along one axis, only at the samples that remain."""
    reach = taps.size // 2
    pad = [(reach, reach) if at == axis else (0, 0) for at in range(image.ndim)]
    padded = np.moveaxis(np.pad(image, pad, mode="symmetric"), axis, 0)
    first, count = (factor - 1) // 2, image.shape[axis] // factor
    total = np.zeros((count, *padded.shape[1:]), image.dtype)
    for index, tap in enumerate(taps[::-1]):
        start = first + index
        total += tap * padded[start : start + (count - 1) * factor + 1 : factor]
    return np.moveaxis(total, 0, axis)


def box_mtf(frequency: ArrayLike, width: float = 1.0) -> Floats:
    """Contrast of a sine after averaging over a pixel: ``|sinc(f width)|``, 2/pi at Nyquist."""
    # Clipped where the contrast is 0 to all digits, as the sine of infinity is undefined.
    cycles = np.clip(_cycles(frequency, width), -1e300, 1e300)
    return np.abs(np.sinc(cycles))


def _cycles(frequency: ArrayLike, width: float) -> Floats:
    """Cycles (...) over a width."""
    f = np.asarray(frequency, float)
    if not (np.isfinite(f).all() and np.isfinite(width)):
        raise ValueError(f"frequency {f.tolist()} and width {width}; legal: finite")
    with np.errstate(over="ignore"):
        return f * width


def contrast(signal: ArrayLike) -> float:
    """Michelson's contrast, (max - min) / (max + min) of light; 0 for darkness."""
    values = as_floats(signal)
    low, high = float(values.min()), float(values.max())
    if not 0 <= low <= high < np.inf:
        raise ValueError(f"signal from {low} to {high}; legal: light of 0 or more, finite")
    share = low / high if high > 0 else 1.0  # sums of the largest numbers would overflow
    return (1 - share) / (1 + share)


def _divisible(image: ArrayLike, factor: int) -> Floats:
    values = as_floats(image)
    if factor < 1 or values.ndim < 2 or values.shape[0] % factor or values.shape[1] % factor:
        raise ValueError(f"factor {factor} of an image {values.shape}; legal: a divisor of both")
    return values
