"""Exact box-filtered patterns: the share of a pixel's footprint that a stripe or a tile covers.

The integral over the footprint takes one subtraction and no supersampling; details finer than a
pixel become their mean instead of moiré.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, slopes

NARROWEST = 1e-6  # least width of a pixel, to avoid division by zero


def band(u: Floats, low: ArrayLike, high: ArrayLike, footprint: ArrayLike) -> Floats:
    """Share of [u − w/2, u + w/2] that lies in [low, high]; w = ``footprint``, same units."""
    half = 0.5 * np.asarray(footprint)
    covered: Floats = np.clip(u + half, low, high) - np.clip(u - half, low, high)
    return covered / (2.0 * half)


def band_about(distance: Floats, half_width: float, area: bool = True) -> Floats:
    """Share of each pixel (H, W) within ``half_width`` of the line where ``distance`` is 0."""
    return band(distance, -half_width, half_width, pixel_width(distance, area))


def stripes(u: Floats, period: float, width: float, footprint: ArrayLike) -> Floats:
    """Mean over the footprint of stripes of ``width`` centred on every multiple of ``period``."""
    half = 0.5 * np.asarray(footprint)

    def covered_up_to(position: Floats) -> Floats:
        cycles = position / period + 0.5
        whole = np.floor(cycles)
        inside = np.clip((cycles - whole - 0.5) * period, -0.5 * width, 0.5 * width)
        return whole * width + inside

    return (covered_up_to(u + half) - covered_up_to(u - half)) / (2.0 * half)


def checker(
    u: Floats, v: Floats, tile: float, footprint_u: ArrayLike, footprint_v: ArrayLike
) -> Floats:
    """Mean over the footprint of a chequerboard that is 1 on one colour and 0 on the other."""
    along_u = 2.0 * stripes(u, 2.0 * tile, tile, footprint_u) - 1.0
    along_v = 2.0 * stripes(v, 2.0 * tile, tile, footprint_v) - 1.0
    return 0.5 + 0.5 * along_u * along_v


def siemens_star(x: Floats, y: Floats, spokes: int, pixel: ArrayLike) -> Floats:
    """Share of the light spokes in pixels so wide: resolution falls towards the centre, where they
    blend to grey."""
    per_rad = spokes / np.pi  # a spoke is 1 wide, as is its gap
    footprint = np.asarray(pixel) * per_rad / np.maximum(np.hypot(x, y), NARROWEST)
    return stripes(np.arctan2(y, x) * per_rad - 0.5, 2.0, 1.0, footprint)


def pixel_width(coordinate: Floats, area: bool = True) -> Floats:
    """Change of ``coordinate`` (H, W) across a pixel, summed over both axes; without ``area``, of a
    sample at the middle of the pixel, next to nothing."""
    if not area:
        return np.asarray(NARROWEST)
    down, across = slopes(coordinate)
    return np.maximum(np.abs(down) + np.abs(across), NARROWEST)


def blend(base: Floats, colour: ArrayLike, amount: Floats) -> Floats:
    """Blend ``base`` (..., 3) with ``colour`` (3,) or (..., 3) by ``amount`` (...)."""
    return base + (np.asarray(colour, base.dtype) - base) * amount[..., None]
