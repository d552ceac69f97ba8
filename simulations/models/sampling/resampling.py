"""Interpolation between the pixels of a picture, and resizing.

Pixel (column, row) is centred at x = column, y = row; a picture of width W covers x from −0.5 to W
− 0.5. Coordinates are (x, y) = (right, down), while arrays are indexed [row, column]. Szeliski, 2nd
ed., §3.5.1–3.5.2; R. G. Keys, *Cubic convolution interpolation*, 1981.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, Mask, as_vectors
from simulations.models.require import require, require_one_of
from simulations.models.sampling import bspline


@dataclass(frozen=True, slots=True)
class Kernel:
    """An interpolation kernel: the weight of a pixel at a signed distance, in pixels."""

    weigh: Callable[[Floats], Floats]
    radius: float
    """Distance from which on the weight is zero."""
    prefiltered: bool = False
    """Whether the weights are for `bspline.coefficients` of the picture instead of its pixels."""

    @property
    def taps(self) -> int:
        """Pixels per axis that contribute."""
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
    "spline": Kernel(bspline.weigh, 2.0, prefiltered=True),
    "lanczos3": Kernel(_lanczos3, 3.0),
}
"""From cheap to expensive: 1, 4, 16, 16 and 36 pixels are read for each value."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GatherTable:
    """Where each output value comes from: computed once per map, applied to any picture."""

    shape: tuple[int, ...]
    """Shape of the output, without channels."""
    source_shape: tuple[int, int]
    """(H, W) of the source pictures."""
    kernel: Kernel
    corner: NDArray[np.intp]
    """(N,) flat index of the first of taps × taps pixels, in a picture with `margin` around it."""
    across: Floats
    """(taps, N) weights of the columns; those of each output sum to 1."""
    down: Floats
    """(taps, N) weights of the rows, as precise: float32 or float64."""
    inside: Mask
    """(N,) whether the output lies on the picture at all."""

    @property
    def margin(self) -> int:
        """Pixels around the picture that a kernel at its edge reaches."""
        return self.kernel.taps // 2


def gather_table(
    xy_px: ArrayLike,
    source_shape: tuple[int, int],
    kernel: str = "bilinear",
    dtype: type[np.floating] = np.float64,
) -> GatherTable:
    """Indices and weights to sample pictures of ``source_shape`` = (H, W) at ``xy_px`` (..., 2).

    Weights of float64 are right for any picture; those of float32 only for pictures of float32, for
    which they are faster. Beyond the border the border pixels repeat. Coordinates off the picture,
    huge or NaN (treated as 0) are legal; ``inside`` is False for them.
    """
    positions = as_vectors("xy_px", xy_px, 2)
    return gather_table_at(positions[..., 0], positions[..., 1], source_shape, kernel, dtype)


def gather_table_at(
    x_px: Floats,
    y_px: Floats,
    source_shape: tuple[int, int],
    kernel: str = "bilinear",
    dtype: type[np.floating] = np.float64,
) -> GatherTable:
    """`gather_table` for separate arrays of x and y, (...) each."""
    chosen = _kernel(kernel)
    height, width = source_shape
    require("source_shape", source_shape, min(height, width) >= 1, "1 x 1 or more")
    x, y = x_px.ravel(), y_px.ravel()
    inside = (x >= -0.5) & (x < width - 0.5) & (y >= -0.5) & (y < height - 0.5)
    column, across = _axis_taps(x, width, chosen, dtype)
    row, down = _axis_taps(y, height, chosen, dtype)
    corner = row * (width + 2 * (chosen.taps // 2)) + column
    return GatherTable(
        shape=x_px.shape,
        source_shape=source_shape,
        kernel=chosen,
        corner=corner,
        across=across,
        down=down,
        inside=inside,
    )


@dataclass(frozen=True, slots=True)
class Source:
    """A picture prepared for many tables of one kernel."""

    shape: tuple[int, ...]
    """Shape of the picture: (H, W) or (H, W, C)."""
    kernel: Kernel
    planes: tuple[Floats, ...]
    """The channels, filtered for the kernel, with the border repeated as far as it reaches."""


def gather_source(image: ArrayLike, kernel: str = "bilinear") -> Source:
    """Prepare a picture (H, W) or (H, W, C) for `gather` with several tables.

    float32 pictures stay float32, everything else becomes float64.
    """
    return _source(np.asarray(image), _kernel(kernel))


def _source(picture: NDArray[Any], kernel: Kernel) -> Source:
    require("image", picture.shape, picture.ndim in (2, 3), "(H, W) or (H, W, channels)")
    dtype = np.float32 if picture.dtype == np.float32 else np.float64
    channels = picture.astype(dtype, copy=False).reshape(*picture.shape[:2], -1)
    planes = [  # each contiguous
        np.pad(channels[..., channel], kernel.taps // 2, mode="edge")
        for channel in range(channels.shape[2])
    ]
    if kernel.prefiltered:
        planes = [bspline.coefficients(plane) for plane in planes]
    return Source(picture.shape, kernel, tuple(planes))


def gather(table: GatherTable, image: ArrayLike | Source, fill: float | None = 0.0) -> Floats:
    """Apply a table to a picture (H, W) or (H, W, C), or to the result of `gather_source`.

    ``fill`` is the value off the picture; None repeats the border. float32 pictures stay float32,
    everything else is computed in float64.
    """
    picture = image if isinstance(image, Source) else np.asarray(image)
    if picture.shape[:2] != table.source_shape or len(picture.shape) not in (2, 3):
        raise ValueError(
            f"image of shape {picture.shape}; legal for the table: {table.source_shape} or "
            f"{table.source_shape} + (channels,)"
        )
    source = picture if isinstance(picture, Source) else _source(picture, table.kernel)
    if source.kernel is not table.kernel:
        raise ValueError("source for another kernel; legal: for that of the table")
    dtype = source.planes[0].dtype if source.planes else np.dtype(np.float32)
    if table.across.dtype.itemsize < dtype.itemsize:
        raise ValueError(f"image of {dtype}; legal: float32, since the table's weights are")
    across: Floats = table.across.astype(dtype, copy=False)
    down: Floats = table.down.astype(dtype, copy=False)
    result = np.empty((table.corner.size, len(source.planes)), dtype)
    for channel, plane in enumerate(source.planes):
        result[:, channel] = _weighed(plane, table.corner, across, down)
    if fill is not None:
        result[~table.inside] = fill
    return result.reshape((*table.shape, *source.shape[2:]))


def _weighed(framed: Floats, corner: NDArray[np.intp], across: Floats, down: Floats) -> Floats:
    """Values (N,): the rows of taps are summed first, for taps instead of taps² more products."""
    width, flat = framed.shape[1], np.ascontiguousarray(framed).reshape(-1)
    if len(across) == 1:  # a single tap has weight 1
        return flat[corner]
    total = np.empty(corner.shape, flat.dtype)
    row, tap = np.empty_like(total), np.empty_like(total)
    for down_by, row_weight in enumerate(down):
        into = row if down_by else total
        for column, weight in enumerate(across):
            # Shifting the picture instead of the indices needs one index per output.
            read = tap if column else into
            np.multiply(flat[down_by * width + column :][corner], weight, out=read)
            if column:
                into += tap
        into *= row_weight
        if down_by:
            total += row
    return total


def sample(
    image: ArrayLike, xy_px: ArrayLike, kernel: str = "bilinear", fill: float | None = 0.0
) -> Floats:
    """Values of a picture (H, W[, C]) at positions ``xy_px`` (..., 2): `gather_table`, `gather`."""
    picture = np.asarray(image)
    kind = np.float32 if picture.dtype == np.float32 else np.float64
    table = gather_table(xy_px, (picture.shape[0], picture.shape[1]), kernel, kind)
    return gather(table, picture, fill)


def resize(image: ArrayLike, height: int, width: int, kernel: str = "bilinear") -> Floats:
    """A picture (H, W[, C]) at another size, low-pass filtered where it shrinks.

    Both sizes cover the same area. Shrinking widens the kernel by the same factor, so that every
    input pixel counts and nothing aliases; at the border the kernel is cut off and its weights are
    scaled to a sum of 1.
    """
    chosen = _kernel(kernel)
    if chosen.prefiltered:
        legal = ", ".join(name for name, other in KERNELS.items() if not other.prefiltered)
        raise ValueError(f"kernel {kernel!r} smooths what it has not filtered; legal: {legal}")
    if height < 1 or width < 1:
        raise ValueError(f"height {height}, width {width}; legal: 1 or more")
    picture: Floats = np.asarray(image)
    if picture.ndim not in (2, 3) or 0 in picture.shape:
        raise ValueError(f"image of shape {picture.shape}; legal: (H, W) or (H, W, C), not empty")
    dtype = np.float32 if picture.dtype == np.float32 else np.float64
    by_row = _resize_matrix(picture.shape[0], height, chosen).astype(dtype)
    by_column = _resize_matrix(picture.shape[1], width, chosen).astype(dtype)
    planes = picture.astype(dtype, copy=False).reshape(*picture.shape[:2], -1)
    # One plane per channel, rows first.
    resized: Floats = np.matmul(np.matmul(by_row, np.moveaxis(planes, 2, 0)), by_column.T)
    return np.ascontiguousarray(np.moveaxis(resized, 0, 2)).reshape(
        height, width, *picture.shape[2:]
    )


def _axis_taps(
    position: Floats, size: int, kernel: Kernel, dtype: type[np.floating]
) -> tuple[NDArray[np.intp], Floats]:
    """First of the taps (N,) along one axis, counted with the margin, and weights (taps, N)."""
    bounded = np.clip(position, -0.5, size - 0.5)
    missing = np.isnan(bounded)
    if missing.any():
        bounded[missing] = 0.0
    if kernel.taps == 1:
        nearest = np.floor(bounded + 0.5).astype(np.intp)
        return np.minimum(nearest, size - 1), np.ones((1, nearest.size), dtype)
    base = np.floor(bounded)
    weights = np.empty((kernel.taps, bounded.size))
    for row, offset in zip(weights, range(1 - kernel.taps // 2, 1 + kernel.taps // 2), strict=True):
        row[:] = kernel.weigh((base - bounded) + offset)
    if kernel.taps > 2:  # two are what is left of 1 and that; Lanczos does not quite sum to 1
        weights /= weights.sum(axis=0)
    return base.astype(np.intp) + 1, weights.astype(dtype, copy=False)


def _resize_matrix(size: int, new_size: int, kernel: Kernel) -> Floats:
    """(new_size, size) weights of the old pixels in each new one."""
    ratio = size / new_size
    widening = max(ratio, 1.0)
    centre = (np.arange(new_size)[:, None] + 0.5) * ratio - 0.5
    weights = kernel.weigh((np.arange(size) - centre) / widening)
    return weights / weights.sum(axis=1, keepdims=True)


def _kernel(name: str) -> Kernel:
    require_one_of("kernel", name, KERNELS)
    return KERNELS[name]
