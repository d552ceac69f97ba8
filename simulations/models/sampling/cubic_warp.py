"""Warps of pictures by cubic interpolation, fast enough for dragging.

The same values as `resampling.sample` with the kernel ``bicubic``, for planar pictures (C, H, W) of
float32. The places are computed once for all pictures. The kernel is stored as a row and a column
of four weights, which takes less work than sixteen weights.

Pixel (column, row) is centred at x = column, y = row. Szeliski, 2nd ed., section 3.5.1; R. G. Keys,
*Cubic convolution interpolation for digital image processing*, 1981.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, Planes
from simulations.models.require import require

TAPS = 4
"""Pixels per axis that contribute to a value."""


@dataclass(frozen=True, slots=True)
class CubicWarp:
    """Where each output pixel comes from."""

    source_shape: tuple[int, int]
    """(H, W) of the source pictures."""
    corner: NDArray[np.intp]
    """(h, w) flat index of the upper left of the 4 x 4 contributing pixels."""
    across: Planes
    """(4, h, w) weights of their columns; they sum to 1."""
    down: Planes
    """(4, h, w) weights of their rows."""


def cubic_warp(x_px: ArrayLike, y_px: ArrayLike, source_shape: tuple[int, int]) -> CubicWarp:
    """The warp that reads pictures of ``source_shape`` = (H, W) at ``x_px``, ``y_px`` (h, w).

    All 4 x 4 neighbours must lie on the picture: x from 1 to W − 2, and y likewise. Raises
    `ValueError` elsewhere, for NaN too, and for pictures that are too small.
    """
    require("source_shape", source_shape, min(source_shape) >= TAPS, f"{TAPS} x {TAPS} or more")
    height, width = source_shape
    column, across = _taps("x_px", np.asarray(x_px, float), width)
    row, down = _taps("y_px", np.asarray(y_px, float), height)
    return CubicWarp(source_shape, row * width + column, across, down)


def _taps(name: str, position: Floats, size: int) -> tuple[NDArray[np.intp], Planes]:
    """First of four neighbours along an axis, and their weights: Keys' cubics with a = −1/2."""
    low, high = position.min(initial=1.0), position.max(initial=1.0)
    if not (low >= 1.0 and high <= size - 2):
        raise ValueError(f"{name} from {low} to {high}; legal: 1 to {size - 2}, of {size} pixels")
    before = position.astype(np.intp)
    t = (position - before).astype(np.float32)
    weights = np.empty((TAPS, *t.shape), np.float32)
    weights[0] = t * (t * (1 - t / 2) - np.float32(0.5))
    weights[3] = t * t * (t - 1) / 2
    weights[2] = t + weights[0] - 2 * weights[3]  # a ramp stays a ramp ...
    weights[1] = 1 - weights[0] - weights[2] - weights[3]  # ... and a level a level
    return before - 1, weights


def warp(table: CubicWarp, planes: Planes) -> Planes:
    """``planes`` (C, H, W) interpolated at the places of the table: (C, h, w)."""
    height, width = table.source_shape
    if planes.ndim != 3 or planes.shape[1:] != table.source_shape:
        raise ValueError(f"planes {planes.shape}; legal: (channels, {height}, {width})")
    result = np.empty((len(planes), *table.corner.shape), np.float32)
    row, tap = np.empty_like(result[0]), np.empty_like(result[0])
    for plane, total in zip(np.ascontiguousarray(planes, np.float32), result, strict=True):
        flat = plane.reshape(-1)
        for down in range(TAPS):
            into = row if down else total
            for across in range(TAPS):
                # Shifting the picture instead of the indices needs one index per output.
                read = tap if across else into
                values = flat[down * width + across :][table.corner]
                np.multiply(values, table.across[across], out=read)
                if across:
                    into += tap
            into *= table.down[down]
            if down:
                total += row
    return result
