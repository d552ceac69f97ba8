"""Shading interpolated from the corners of a grid.

Either the light of the corners is interpolated (Gouraud 1971), or their normals, and each pixel is
lit by the result (Phong 1975). Either is exact at the corners and errs between them with the square
of the cell's width.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_floats
from simulations.models.light.reflectance import normalise


def blend_cells(corners: ArrayLike, height: int, width: int) -> Floats:
    """Values at the corners of a grid, blended linearly in rows and columns across each cell.

    Parameters
    ----------
    corners : (R, C, ...)
        Two rows and two columns or more. The outermost are at the centres of the outermost pixels,
        the others evenly between them.
    height, width : int
        Pixels, two or more each way.

    Returns
    -------
    (height, width, ...) in the corners' own precision.
    """
    values = as_floats(corners)
    if values.ndim < 2 or min(values.shape[:2]) < 2:
        raise ValueError(f"corners of shape {values.shape}; legal: two or more each way")
    if min(height, width) < 2:
        raise ValueError(f"{height} x {width} pixels; legal: two or more each way")
    rows = _blend_rows(values, height)
    return np.swapaxes(_blend_rows(np.swapaxes(rows, 0, 1), width), 0, 1)


def blend_normals(corners: ArrayLike, height: int, width: int) -> Floats:
    """Unit normals (height, width, 3) blended across the cells of a grid of them."""
    return normalise(blend_cells(corners, height, width))


def _blend_rows(values: Floats, count: int) -> Floats:
    """``count`` rows, evenly from the first of ``values`` to the last."""
    cells = len(values) - 1
    place = np.arange(count, dtype=values.dtype) * (cells / (count - 1))
    cell = np.minimum(place.astype(np.int32), cells - 1)
    share = (place - cell).astype(values.dtype).reshape(-1, *(1,) * (values.ndim - 1))
    with np.errstate(over="ignore", invalid="ignore"):
        return values[cell] + share * (values[cell + 1] - values[cell])
