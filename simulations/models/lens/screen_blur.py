"""Defocus as a filter on a finished picture and its depth: fast, without hidden objects.

Pictures are planar: (C, H, W) float32. Objects behind a near one were never recorded, so these
filters cannot show them through its soft edge. Potmesil and Chakravarty, SIGGRAPH 1981.
"""

import numpy as np

from simulations.models.arrays import Floats, Planes
from simulations.models.lens.disc_blur import LARGEST_RADIUS
from simulations.models.require import as_whole
from simulations.models.sampling.aliasing import filter_and_sample, gaussian_kernel


def binned_gaussian(planes: Planes, radius_px: Floats, bins: int = 6) -> Planes:
    """Each pixel from the nearest of a few Gaussian blurs of the whole picture.

    A disc of radius r has the variance r²/4 along each axis, so σ = r/2.
    """
    bins = as_whole("bins", bins, 2)
    largest = _largest(radius_px)
    chosen = np.rint(radius_px / max(largest, 1e-9) * (bins - 1)).astype(np.intp)
    result = np.empty_like(planes)
    for index in range(bins):
        here = chosen == index
        if not here.any():
            continue
        kernel = gaussian_kernel(0.5 * largest * index / (bins - 1)).astype(np.float32)
        for plane, out in zip(planes, result, strict=True):
            out[here] = filter_and_sample(plane, 1, kernel)[here]
    return result


def gather_discs(planes: Planes, radius_px: Floats, depth: Floats) -> Planes:
    """Each pixel is the weighted mean of the neighbours whose disc reaches it.

    A neighbour spreads over the area of its disc. The disc of a neighbour behind the pixel is at
    most as wide as the pixel's own, so that a blurred background does not leak onto sharp objects
    in front.
    """
    radius = np.maximum(radius_px, 0.5).astype(np.float32)
    largest = max(_largest(radius_px), 0.5) + 0.5
    reach = int(np.ceil(largest)) - 1
    height, width = radius.shape
    border = ((reach, reach), (reach, reach))
    wide, radii, depths = (
        np.pad(planes, ((0, 0), *border), mode="edge"),
        np.pad(radius, border, mode="edge"),
        np.pad(depth, border, mode="edge"),
    )
    total, weights = np.zeros_like(planes), np.zeros_like(radius)
    for down in range(-reach, reach + 1):
        for right in range(-reach, reach + 1):
            if np.hypot(down, right) >= largest:
                continue
            rows = slice(reach + down, reach + down + height)
            columns = slice(reach + right, reach + right + width)
            theirs = radii[rows, columns]
            spread = np.where(depths[rows, columns] > depth, np.minimum(theirs, radius), theirs)
            weight = np.clip(spread + np.float32(0.5 - np.hypot(down, right)), 0, 1) / spread**2
            weights += weight
            total += weight * wide[:, rows, columns]
    return total / weights


def _largest(radius_px: Floats) -> float:
    """The largest of the radii (H, W); raises `ValueError` if one is NaN, negative or too large."""
    if not np.all((radius_px >= 0) & (radius_px <= LARGEST_RADIUS)):
        raise ValueError(
            f"radius_px from {radius_px.min()} to {radius_px.max()}; legal: 0 to {LARGEST_RADIUS:g}"
        )
    return float(radius_px.max(initial=0.0))
