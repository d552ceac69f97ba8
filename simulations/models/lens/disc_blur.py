"""Convolution with a uniform disc, the blur of an ideal lens out of focus.

The kernel is the share of each pixel that the disc covers. Small kernels are summed tap by tap;
large ones are multiplied in the frequency domain, where a disc of a hundred pixels costs as much as
one of ten. Both results are equal up to rounding.

Pictures are planar: (C, H, W) float32. Szeliski, 2nd ed., sections 2.2.3 and 3.4.
"""

import math

import numpy as np

from simulations.models.arrays import Floats, Planes
from simulations.models.require import require

LARGEST_SUMMED_RADIUS = 6.0
"""Pixels. Up to this radius tap by tap is faster, measured on the camera's picture."""

LARGEST_RADIUS = 1024.0
"""Pixels. The limit bounds memory, as the picture is extended beyond its edge by the radius."""

NARROW_RADIUS = 0.6153864
"""Pixels. The kernel of this radius has the disc's own variance, R²/4 along each axis. Kernels of
narrower discs have less, and up to ½ none."""


def disc_kernel(radius_px: float) -> Planes:
    """(2n+1, 2n+1) weights of a uniform disc with sum 1: the area of each pixel that it covers.

    As each weight is a mean over a pixel, the variance along either axis is that of the disc and
    that of a pixel, ``R²/4 + 1/12``, to 0.02 px² from R = 1.5 on and to 0.11 px² below. A disc
    below `NARROW_RADIUS` is a mixture of that disc and of none, whose variance is R²/4. The weights
    change with the radius without a jump.
    """
    check_radius(radius_px)
    if radius_px == 0:
        return np.ones((1, 1), np.float32)
    weights = _shares(max(radius_px, NARROW_RADIUS))
    if radius_px < NARROW_RADIUS:
        weights *= (radius_px / NARROW_RADIUS) ** 2
        weights[1, 1] += 1.0 - weights.sum()
    return np.asarray(weights, np.float32)


def _shares(radius: float) -> Floats:
    """Area of each pixel that a disc wider than a pixel covers, as a share of the disc."""
    reach = math.ceil(radius - 0.5)
    borders = np.minimum(np.arange(reach + 1) + 0.5, radius)
    to_corner = np.zeros((reach + 2, reach + 2))
    to_corner[1:, 1:] = _area_to_corner(borders, borders[:, None], radius)
    # The borders of the middle pixel are on both sides of the centre: twice the area to one of
    # them.
    to_corner[0], to_corner[:, 0] = -to_corner[1], -to_corner[:, 1]
    to_corner[0, 0] = to_corner[1, 1]
    quarter = np.maximum(np.diff(np.diff(to_corner, axis=0), axis=1), 0.0)
    half = np.concatenate((quarter[:, :0:-1], quarter), axis=1)
    weights = np.concatenate((half[:0:-1], half))
    return np.asarray(weights / weights.sum())


def _area_to_corner(x: Floats, y: Floats, radius: float) -> Floats:
    """Area of the disc between its centre and the corner (x, y), both from 0 to the radius."""
    level = np.minimum(x, np.sqrt(np.maximum(radius**2 - y**2, 0.0)))  # height y up to here
    return y * level + _area_under_arc(x, radius) - _area_under_arc(level, radius)


def _area_under_arc(x: Floats, radius: float) -> Floats:
    """Integral of √(R² − x²) from 0 to x."""
    sine = np.minimum(x / radius, 1.0)
    return 0.5 * radius**2 * (sine * np.sqrt(1.0 - sine**2) + np.arcsin(sine))


def check_radius(radius_px: float) -> None:
    """Raises `ValueError` unless the radius is from 0 to `LARGEST_RADIUS`."""
    require("radius_px", radius_px, 0 <= radius_px <= LARGEST_RADIUS, f"0 to {LARGEST_RADIUS:g}")


def disc_blur(planes: Planes, radius_px: float) -> Planes:
    """``planes`` (C, H, W) convolved with a disc; the border pixels repeat beyond the edge.

    Returns the same object for the radius 0.
    """
    check_radius(radius_px)
    if radius_px == 0:
        return planes
    convolve = summed if radius_px <= LARGEST_SUMMED_RADIUS else transformed
    return convolve(planes, disc_kernel(radius_px))


def extended(planes: Planes, reach: int) -> Planes:
    """``planes`` (C, H, W) with so many more pixels at each border, which repeat it; `np.pad` takes
    several times as long."""
    count, height, width = planes.shape
    inner, end = slice(reach, reach + height), reach + width
    wide = np.empty((count, height + 2 * reach, width + 2 * reach), planes.dtype)
    wide[:, inner, reach:end] = planes
    wide[:, inner, :reach], wide[:, inner, end:] = planes[..., :1], planes[..., -1:]
    wide[:, :reach] = wide[:, reach : reach + 1]
    wide[:, reach + height :] = wide[:, reach + height - 1 : reach + height]
    return wide


def summed(planes: Planes, kernel: Planes) -> Planes:
    """``planes`` convolved with a symmetric kernel tap by tap, one plane at a time for the
    processor's cache.
    """
    reach = kernel.shape[0] // 2
    padded = extended(planes, reach)
    return np.stack([_summed_plane(plane, kernel[reach:, reach:]) for plane in padded])


def _summed_plane(padded: Planes, quarter: Planes) -> Planes:
    """Convolve a padded plane by the kernel's lower right quarter: four pixels share each
    product."""
    reach = len(quarter) - 1
    height, width = (length - 2 * reach for length in padded.shape)
    total = np.zeros((height, width), padded.dtype)
    for down, row in enumerate(quarter.tolist()):
        rows = padded[reach + down : reach + down + height]
        if down:
            rows = rows + padded[reach - down : reach - down + height]
        for right, weight in enumerate(row):
            if weight == 0.0:  # and so is the rest of the row
                break
            columns = rows[:, reach + right : reach + right + width]
            if right:
                columns = columns + rows[:, reach - right : reach - right + width]
            total += weight * columns
    return total


def transformed(planes: Planes, kernel: Planes) -> Planes:
    """``planes`` convolved by a product of spectra, on a grid wide enough to avoid wrap-around."""
    reach = kernel.shape[0] // 2
    height, width = planes.shape[1:]
    grid = (fast_length(height + 2 * reach), fast_length(width + 2 * reach))
    padded = extended(planes, reach)
    spectrum = np.fft.rfft2(padded, s=grid)
    spectrum *= np.fft.rfft2(kernel, s=grid)
    blurred = np.fft.irfft2(spectrum, s=grid)[
        :, 2 * reach : 2 * reach + height, 2 * reach : 2 * reach + width
    ]
    # Clamp rounding errors: a mean is within the range of its values, and light is not negative.
    low, high = (extreme(planes, axis=(1, 2), keepdims=True) for extreme in (np.min, np.max))
    return np.clip(blurred, low, high)


def fast_length(least: int) -> int:
    """The smallest whole number of at least ``least`` without a prime factor above 5."""
    length = least
    while _without_small_factors(length) != 1:
        length += 1
    return length


def _without_small_factors(number: int) -> int:
    """A number divided by all its factors 2, 3 and 5."""
    for factor in (2, 3, 5):
        while number % factor == 0:
            number //= factor
    return number
