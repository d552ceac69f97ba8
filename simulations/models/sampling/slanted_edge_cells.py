"""An edge in the cells of a raw file: each colour is measured by the cells that see it.

A developed picture estimates two colours of each pixel from its neighbours, and how far that
changes an edge depends on the balance of the colours. F. van den Bergh's *MTF Mapper* measures the
cells of one colour, too.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.require import require
from simulations.models.sampling.slanted_edge_file import (
    MOST_CLIPPED,
    TOO_LIGHT,
    require_no_plateau,
)
from simulations.models.sampling.slanted_edge_line import (
    SMALLEST,
    TOO_SMALL,
    EdgeLine,
    UnfitEdgeError,
    find_line,
)


def light_of_cells(
    codes: NDArray[np.uint16], colours: str, black: Sequence[float], white: int
) -> Floats:
    """Light (H, W, 3) of red, green and blue with 1 for white, NaN where a cell sees another.

    ``codes`` (H, W) begin with a whole quad, whose ``colours`` are like ``RGGB`` and have codes
    ``black`` (4,) without light. Raises `UnfitEdgeError` as `light_of_codes` does.
    """
    require("colours", colours, len(colours) == 4 and set(colours) == set("RGB"), "as in RGGB")
    if min(codes.shape) < 2 * SMALLEST:
        raise UnfitEdgeError(TOO_SMALL)
    planes = np.full((*codes.shape, 3), np.nan)
    for k, (letter, zero) in enumerate(zip(colours, black, strict=True)):
        rows, columns = slice(k // 2, None, 2), slice(k % 2, None, 2)
        cells = codes[rows, columns]
        if np.mean(cells >= white) > MOST_CLIPPED:
            raise UnfitEdgeError(TOO_LIGHT.format(white))
        light = (np.arange(int(cells.max()) + 1) - zero) / (white - zero)
        require_no_plateau(np.bincount(cells.ravel()), light)
        planes[rows, columns, "RGB".index(letter)] = light[cells]
    return planes


def line_of_cells(planes: Floats) -> EdgeLine:
    """The edge in these planes, found in green, with the mean of four between the cells."""
    green = planes[..., 1]
    around = np.pad(green, 1, mode="reflect")
    beside = around[:-2, 1:-1] + around[2:, 1:-1] + around[1:-1, :-2] + around[1:-1, 2:]
    return find_line(np.where(np.isnan(green), 0.25 * beside, green))
