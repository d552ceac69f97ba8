"""Magnification of a picture on the same grid."""

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import centred
from simulations.models.require import require_positive
from simulations.models.sampling.resampling import KERNELS


def magnify(plane: NDArray[np.float32], scale: float) -> NDArray[np.float32]:
    """A plane (H, W) scaled about its centre by bicubic interpolation, one axis after the other.

    The shape stays the same; parts outside are lost. Raises `ValueError` unless the scale is above
    0 and finite.
    """
    require_positive("scale", scale)
    if scale == 1.0:
        return plane
    turned = np.ascontiguousarray(_magnify_rows(plane, scale).T)  # rows are quick to gather
    return np.ascontiguousarray(_magnify_rows(turned, scale).T)


def _magnify_rows(plane: NDArray[np.float32], scale: float) -> NDArray[np.float32]:
    size, kernel = plane.shape[0], KERNELS["bicubic"]
    with np.errstate(over="ignore"):
        position = np.clip(0.5 * (size - 1) + centred(size) / scale, -1.0, size)  # then all is edge
    base = np.floor(position)
    result = np.zeros_like(plane)
    for tap in range(-1, 3):
        weight = kernel.weigh(base + tap - position).astype(np.float32)
        result += weight[:, None] * plane[np.clip(base.astype(int) + tap, 0, size - 1)]
    return result
