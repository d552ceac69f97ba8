"""Values of a picture between its pixels, and at another size.

Pixel (column, row) is centred at x = column, y = row; a picture of width W covers x from −0.5 to
W − 0.5. Coordinates are (x, y) = (right, down), while arrays are indexed [row, column].
Szeliski, 2nd ed., §3.5.1–3.5.2; R. G. Keys, *Cubic convolution interpolation*, 1981.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.floats import as_vectors

type Floats = NDArray[np.floating]


@dataclass(frozen=True, slots=True)
class Kernel:
    """An interpolation kernel: the weight of a pixel at a signed distance, in pixels."""

    weigh: Callable[[Floats], Floats]
    radius: float
    """The weight is zero from this distance on."""

    @property
    def taps(self) -> int:
        """Pixels per axis that take part."""
        return round(2.0 * self.radius)


def _box(x: Floats) -> Floats:
    return np.where((x >= -0.5) & (x < 0.5), 1.0, 0.0)


def _triangle(x: Floats) -> Floats:
    return np.maximum(1.0 - np.abs(x), 0.0)


def _keys(x: Floats) -> Floats:
    """Cubic convolution with a = −1/2: exact for quadratics."""
    t = np.abs(x)
    inner = (1.5 * t - 2.5) * t * t + 1.0
    outer = ((-0.5 * t + 2.5) * t - 4.0) * t + 2.0
    return np.where(t < 1.0, inner, np.where(t < 2.0, outer, 0.0))


def _lanczos3(x: Floats) -> Floats:
    return np.where(np.abs(x) < 3.0, np.sinc(x) * np.sinc(x / 3.0), 0.0)


KERNELS = {
    "nearest": Kernel(_box, 0.5),
    "bilinear": Kernel(_triangle, 1.0),
    "bicubic": Kernel(_keys, 2.0),
    "lanczos3": Kernel(_lanczos3, 3.0),
}
"""Cheap to dear: 1, 4, 16 and 36 pixels are read for each value."""


@dataclass(frozen=True, slots=True)
class GatherTable:
    """Where each output value comes from: computed once per map, applied to any picture."""

    shape: tuple[int, ...]
    """Shape of the output, without channels."""
    source_shape: tuple[int, int]
    """(H, W) of the pictures that it fits."""
    index: NDArray[np.intp]
    """(taps², N) flat pixel indices."""
    weight: Floats
    """(taps², N) float32 weights; the column of each output sums to 1."""
    inside: NDArray[np.bool_]
    """(N,) whether the output lies on the picture at all."""


def gather_table(
    xy_px: ArrayLike, source_shape: tuple[int, int], kernel: str = "bilinear"
) -> GatherTable:
    """Indices and weights to sample pictures of ``source_shape`` = (H, W) at ``xy_px`` (..., 2).

    Beyond the border the border pixels repeat. Coordinates off the picture, huge or NaN (which
    counts as 0) are legal; ``inside`` tells which.
    """
    chosen = _kernel(kernel)
    height, width = source_shape
    if height < 1 or width < 1:
        raise ValueError(f"source_shape {source_shape}: must be at least 1 x 1")
    positions = as_vectors("xy_px", xy_px, 2)
    x, y = positions[..., 0].ravel(), positions[..., 1].ravel()
    inside = (x >= -0.5) & (x < width - 0.5) & (y >= -0.5) & (y < height - 0.5)
    columns, x_weights = _axis_taps(x, width, chosen)
    rows, y_weights = _axis_taps(y, height, chosen)
    index = (rows[:, None] * width + columns[None]).reshape(chosen.taps**2, x.size)
    weight = (y_weights[:, None] * x_weights[None]).reshape(chosen.taps**2, x.size)
    return GatherTable(positions.shape[:-1], source_shape, index, weight, inside)


def gather(table: GatherTable, image: ArrayLike, fill: float | None = 0.0) -> Floats:
    """Apply a table to a picture (H, W) or (H, W, C).

    Channels are gathered one at a time from contiguous planes. ``fill`` is the value off the
    picture; None repeats the border. float32 pictures stay float32, everything else is float64.
    """
    picture = np.asarray(image)
    if picture.shape[:2] != table.source_shape or picture.ndim not in (2, 3):
        raise ValueError(
            f"image of shape {picture.shape}: the table is for {table.source_shape} or "
            f"{table.source_shape} + (channels,)"
        )
    dtype = np.float32 if picture.dtype == np.float32 else np.float64
    planes = picture.astype(dtype, copy=False).reshape(*table.source_shape, -1)
    result = np.empty((table.index.shape[1], planes.shape[2]), dtype)
    for channel in range(planes.shape[2]):
        plane = np.ascontiguousarray(planes[..., channel]).reshape(-1)
        total = plane[table.index[0]]
        if len(table.index) > 1:  # a single tap has weight 1
            total *= table.weight[0]
            for index, weight in zip(table.index[1:], table.weight[1:], strict=True):
                total += weight * plane[index]
        result[:, channel] = total
    if fill is not None:
        result[~table.inside] = fill
    return result.reshape((*table.shape, *picture.shape[2:]))


def sample(
    image: ArrayLike, xy_px: ArrayLike, kernel: str = "bilinear", fill: float | None = 0.0
) -> Floats:
    """Values of a picture (H, W[, C]) at positions ``xy_px`` (..., 2): `gather_table`, `gather`."""
    picture = np.asarray(image)
    table = gather_table(xy_px, (picture.shape[0], picture.shape[1]), kernel)
    return gather(table, picture, fill)


def resize(image: ArrayLike, height: int, width: int, kernel: str = "bilinear") -> Floats:
    """A picture (H, W[, C]) at another size, low-pass filtered where it shrinks.

    Both sizes cover the same area. Shrinking widens the kernel by the same factor, so that
    every input pixel counts and nothing aliases; at the border the kernel is cut off and its
    weights brought back to a sum of 1.
    """
    chosen = _kernel(kernel)
    if height < 1 or width < 1:
        raise ValueError(f"height {height}, width {width}: must be at least 1")
    picture: Floats = np.asarray(image)
    if picture.ndim not in (2, 3) or 0 in picture.shape:
        raise ValueError(f"image of shape {picture.shape}: must be (H, W) or (H, W, C), not empty")
    dtype = np.float32 if picture.dtype == np.float32 else np.float64
    by_row = _resize_matrix(picture.shape[0], height, chosen).astype(dtype)
    by_column = _resize_matrix(picture.shape[1], width, chosen).astype(dtype)
    planes = picture.astype(dtype, copy=False).reshape(*picture.shape[:2], -1)
    # One plane per channel, rows first.
    resized: Floats = np.matmul(np.matmul(by_row, np.moveaxis(planes, 2, 0)), by_column.T)
    return np.ascontiguousarray(np.moveaxis(resized, 0, 2)).reshape(
        height, width, *picture.shape[2:]
    )


def _axis_taps(position: Floats, size: int, kernel: Kernel) -> tuple[NDArray[np.intp], Floats]:
    """(taps, N) clamped indices along one axis, and their float32 weights."""
    bounded = np.clip(np.nan_to_num(position, nan=0.0), -0.5, size - 0.5)
    if kernel.taps == 1:
        nearest = np.floor(bounded + 0.5).astype(np.intp)[None]
        return np.minimum(nearest, size - 1), np.ones(nearest.shape, np.float32)
    base = np.floor(bounded)
    offsets = np.arange(1 - kernel.taps // 2, 1 + kernel.taps // 2)[:, None]
    weights = kernel.weigh((base - bounded) + offsets)
    weights /= weights.sum(axis=0)  # Lanczos alone does not quite sum to 1
    index = np.clip(base.astype(np.intp) + offsets, 0, size - 1)
    return index, weights.astype(np.float32)


def _resize_matrix(size: int, new_size: int, kernel: Kernel) -> Floats:
    """(new_size, size) weights of the old pixels in each new one."""
    ratio = size / new_size
    widening = max(ratio, 1.0)
    centre = (np.arange(new_size)[:, None] + 0.5) * ratio - 0.5
    weights = kernel.weigh((np.arange(size) - centre) / widening)
    result: Floats = weights / weights.sum(axis=1, keepdims=True)
    return result


def _kernel(name: str) -> Kernel:
    if name not in KERNELS:
        raise ValueError(f"kernel {name!r}: legal: {', '.join(KERNELS)}")
    return KERNELS[name]
