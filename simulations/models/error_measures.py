"""Measures of an error as a single number."""

import math

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.require import as_whole, require_positive


def root_mean_square(errors: ArrayLike) -> float:
    """The root of the mean of the squares of errors (...), in their unit."""
    return math.sqrt(float(np.mean(np.square(errors))))


def psnr_db(picture: ArrayLike, reference: ArrayLike, peak: float = 1.0, crop: int = 0) -> float:
    """Peak signal to noise ratio in decibel, leaving out ``crop`` pixels at each border.

    Of pictures (H, W, ...), or of values (N,). Equal ones give infinity, and those infinitely apart
    minus infinity. Raises `ValueError` if nothing is left after the crop, or the shapes differ.
    """
    a, b = np.asarray(picture, np.float64), np.asarray(reference, np.float64)
    if a.shape != b.shape or a.ndim < 1:
        raise ValueError(f"pictures of shapes {a.shape} and {b.shape}; legal: equal, (H, W, ...)")
    crop = as_whole("crop", crop, 0)
    if 2 * crop >= min(a.shape[:2]):
        raise ValueError(f"crop {crop} px of a picture {a.shape}; legal: less than half of it")
    inner = tuple(slice(crop, size - crop) for size in a.shape[:2])
    require_positive("peak", peak)
    with np.errstate(over="ignore", invalid="ignore"):
        return decibels(float(np.mean(np.square((a[inner] - b[inner]) / peak))))


def decibels(mean_square: float) -> float:
    """The ratio in decibel of a mean square error, as a share of the peak's square."""
    if mean_square == 0.0:
        return math.inf
    return -math.inf if mean_square == math.inf else -10 * math.log10(mean_square)
