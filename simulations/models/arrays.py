"""Array types of the models, the conversions that every model starts with, and positions and
quantiles."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

type Floats = NDArray[np.floating]
"""Real numbers: float64, or float32 where they are pixels."""
type Mask = NDArray[np.bool_]
"""Arrays of bool."""
type Planes = NDArray[np.float32]
"""Pictures (..., H, W), a plane of pixels for each colour."""


def as_floats(values: ArrayLike) -> Floats:
    """An array of floats: float32 stays float32 (pictures), whole numbers become float64.

    Half precision becomes float32. Raises `ValueError` for complex numbers, whose imaginary part
    would be lost.
    """
    array = np.asarray(values)
    if array.dtype.kind == "c":
        raise ValueError(f"values of type {array.dtype}; legal: real numbers")
    if array.dtype.kind == "f":
        return array.astype(np.float32) if array.dtype == np.float16 else array
    return array.astype(np.float64)


def as_vectors(name: str, values: ArrayLike, length: int) -> NDArray[Any]:
    """An array (..., length) of float64; raises `ValueError` with the name for other shapes."""
    vectors = _as_doubles(name, values)
    if vectors.shape[-1:] != (length,):
        raise ValueError(f"{name} of shape {vectors.shape}; legal: (..., {length})")
    return vectors


def as_array(name: str, values: ArrayLike, *shape: int) -> NDArray[Any]:
    """An array of float64 of exactly that shape, without broadcasting."""
    array = _as_doubles(name, values)
    if array.shape != shape:
        raise ValueError(f"{name} of shape {array.shape}; legal: {shape}")
    return array


def as_matrices(name: str, values: ArrayLike, *shape: int) -> NDArray[Any]:
    """An array (..., rows, columns) of float64; raises `ValueError` for other shapes."""
    matrices = _as_doubles(name, values)
    if matrices.shape[-2:] != shape:
        legal = ", ".join(map(str, shape))
        raise ValueError(f"{name} of shape {matrices.shape}; legal: (..., {legal})")
    return matrices


def _as_doubles(name: str, values: ArrayLike) -> NDArray[Any]:
    array = np.asarray(values)
    if array.dtype.kind == "c":
        raise ValueError(f"{name} of type {array.dtype}; legal: real numbers")
    return np.asarray(array, float)


def as_colours(values: ArrayLike) -> Floats:
    """Colours (..., 3) by `as_floats`; `ValueError` for other shapes, such as RGB with alpha."""
    colours = as_floats(values)
    if colours.shape[-1:] != (3,):
        raise ValueError(f"colours of shape {colours.shape}; legal: (..., 3)")
    return colours


def through_matrix(matrix: ArrayLike, colours: ArrayLike) -> Floats:
    """Colours (..., 3), each times a matrix (3, 3), in the colours' own precision."""
    values = as_colours(colours)
    with np.errstate(over="ignore", invalid="ignore"):
        return values @ np.asarray(matrix, values.dtype).T


def gathered(planes: NDArray[Any], numbers: NDArray[np.integer]) -> NDArray[Any]:
    """``planes[:, numbers]``, plane by plane, which a browser does twice as fast."""
    found = np.empty((len(planes), *numbers.shape), planes.dtype)
    for plane, values in zip(planes, found, strict=True):
        values[...] = plane[numbers]
    return found


def last_axis_first(values: NDArray[Any]) -> NDArray[Any]:
    """A view (n, ...) of values (..., n), sooner than by `np.moveaxis`."""
    return values.transpose(-1, *range(values.ndim - 1))


def first_axis_last(values: NDArray[Any]) -> NDArray[Any]:
    """A view (..., n) of values (n, ...)."""
    return values.transpose(*range(1, values.ndim), 0)


def slopes(values: Floats) -> tuple[Floats, Floats]:
    """The changes (H, W) per row and per column of values (H, W), at least two each way.

    The same as `np.gradient`, whose checks take longer than its arithmetic on small pictures.
    """
    down, across = np.empty_like(values), np.empty_like(values)
    for along, change in ((values, down), (values.T, across.T)):
        np.subtract(along[2:], along[:-2], out=change[1:-1])
        change[1:-1] *= 0.5
        change[0], change[-1] = along[1] - along[0], along[-1] - along[-2]
    return down, across


def centred(count: int) -> Floats:
    """Centres (count,) of a row of pixels, from the middle of the row: whole numbers or halves."""
    return np.arange(count) - 0.5 * (count - 1)


def quantile_of(values: Floats, share: float = 0.5) -> float:
    """The value (...) that this share of all is below; by default the middle one.

    `np.median` and `np.percentile` would load all of `np.ma` in the browser. NaN counts as the
    largest. Raises `IndexError` if there are no values.
    """
    return float(np.sort(values, axis=None)[round(share * (values.size - 1))])
