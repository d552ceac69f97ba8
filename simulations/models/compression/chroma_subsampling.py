"""Colour stored more coarsely than brightness, as in JPEG and in video: 4:2:2 and 4:2:0.

The eye resolves differences of colour worse than differences of light. Of the three numbers of the
name the first is a row of four luma samples; the second counts the colour samples along it, and the
third how many of them are new in the next row. Szeliski, 2nd ed., section 2.3.3. The inverse is in
`simulations.models.compression.chroma_upsampling`.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_floats
from simulations.models.require import as_whole, require, require_one_of

SUBSAMPLING = {"4:4:4": (1, 1), "4:2:2": (1, 2), "4:2:0": (2, 2)}
"""Rows and columns of luma samples per colour difference."""


def subsampling_factor(name: str) -> tuple[int, int]:
    """Rows and columns of pixels that share one colour; raises `ValueError` for other names."""
    require_one_of("subsampling", name, SUBSAMPLING)
    return SUBSAMPLING[name]


def coarsen(plane: ArrayLike, factor: tuple[int, int]) -> Floats:
    """Means over cells of ``factor`` (rows, columns) samples of a plane (H, W).

    Cells that extend over the border repeat it, so that the result has ``ceil(H / rows)`` rows and
    likewise columns. Raises `ValueError` for an empty plane and for factors that are not whole
    numbers of 1 or more.
    """
    values = as_floats(plane)
    require("plane", values.shape, values.ndim == 2 and values.size > 0, "(H, W), not empty")
    rows, columns = (as_whole("factor", each, 1) for each in factor)
    height, width = values.shape
    whole = np.pad(values, ((0, -height % rows), (0, -width % columns)), mode="edge")
    cells = whole.reshape(whole.shape[0] // rows, rows, whole.shape[1] // columns, columns)
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(cells.mean(axis=(1, 3)))
