"""The radii of the photograph's pixels, and the methods to invert the lens for them.

The photograph is 320 × 240 px with a focal length of 200 px, so that its half-diagonal is 200 px
and its corners are at the normalised radius r = 1, 45° from the axis.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.distortion.lens_model import (
    Distortion,
    fold_radius,
    largest_distorted_radius,
)
from simulations.models.distortion.undistortion import INVERSES
from simulations.models.pixel_grid import centred

WIDTH_PX, HEIGHT_PX = 320, 240
FOCAL_PX = 200.0
HALF_DIAGONAL = 0.5 * np.hypot(WIDTH_PX, HEIGHT_PX) / FOCAL_PX
"""Normalised radius of the picture's corners: 1."""
TIERS = tuple(name for name in INVERSES if name != "fixed-point-20")
"""Methods to find the source of a pixel's light: rungs of the ladder `inverse-strong`, without the
longest of those that may diverge."""


@dataclass(frozen=True, slots=True)
class Radii:
    """The distinct radii among the pixel centres: a radial map is solved once for each."""

    distinct: Floats
    """Sorted normalised radii."""
    of_pixel: NDArray[np.intp]
    """(HEIGHT_PX · WIDTH_PX,) index into ``distinct``."""


def centred_pixels() -> Floats:
    """(HEIGHT_PX, WIDTH_PX, 2) pixel centres relative to the principal point, in px."""
    return np.stack(np.meshgrid(centred(WIDTH_PX), centred(HEIGHT_PX)), axis=-1)


def pixel_radii() -> Radii:
    # Twice a coordinate is an odd whole number, so that equal radii are exactly equal.
    doubled = np.rint(2.0 * centred_pixels()).astype(np.int64)
    squares, of_pixel = np.unique((doubled**2).sum(axis=-1).ravel(), return_inverse=True)
    return Radii(np.sqrt(squares) / (2.0 * FOCAL_PX), of_pixel.astype(np.intp))


def ideal_radii(seen: Floats, lens: Distortion, tier: str) -> Floats:
    """The radius without the lens of each radius in the photograph, as the tier computes it.

    Only the last three detect the fold; the others continue past it, or overflow.
    """
    points = np.stack((seen, np.zeros_like(seen)), axis=-1)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        return INVERSES[tier](points, lens)[..., 0]


def true_radii(seen: Floats, lens: Distortion) -> Floats:
    """The same by bisection to the last bit, independent of all tiers; NaN past the fold.

    The image radius is written out: r (1 + k₁ r² + k₂ r⁴).
    """
    fold = min(fold_radius(lens), 1e3)
    low, high = np.zeros_like(seen), np.full_like(seen, fold)
    for _ in range(64):
        middle = 0.5 * (low + high)
        s = middle * middle
        beyond = middle * (1.0 + s * (lens.k1 + s * lens.k2)) > seen
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return np.where(seen < largest_distorted_radius(lens), high, np.nan)


def inversion_error_px(lens: Distortion, tier: str) -> float:
    """RMS error over the photograph of the scene point that each pixel is drawn from.

    In pixels of the pinhole picture, without pixels that show nothing.
    """
    radii = pixel_radii()
    wrong = ideal_radii(radii.distinct, lens, tier) - true_radii(radii.distinct, lens)
    pixels = np.bincount(radii.of_pixel)
    seen = ~np.isnan(wrong)
    if np.isinf(wrong[seen]).any():
        return float("inf")
    square = np.average(np.square(wrong[seen]), weights=pixels[seen])
    return float(np.sqrt(square)) * FOCAL_PX
