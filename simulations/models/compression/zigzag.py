"""The order in which JPEG stores the coefficients of a block: coarse before fine.

ITU-T T.81, figure A.6. A progressive file sends a picture in this order, some coefficients of all
blocks at a time.
"""

import numpy as np
from numpy.typing import NDArray

from simulations.models.compression.blocks import BLOCK, Codes
from simulations.models.whole_numbers import as_whole


def _zigzag() -> NDArray[np.intp]:
    """Flat indices of a block along its antidiagonals: low frequencies first, by turns."""
    row, column = np.divmod(np.arange(BLOCK * BLOCK), BLOCK)
    diagonal = row + column
    along = np.where(diagonal % 2, row, column)
    return np.lexsort((along, diagonal))


ZIGZAG = _zigzag()
RANK: NDArray[np.intp] = np.argsort(ZIGZAG).reshape(BLOCK, BLOCK)
"""(8, 8) place of each coefficient in that order, from 0."""


def first_in_order(codes: Codes, count: int) -> Codes:
    """Codes (..., 8, 8) with all but the first ``count`` of each block set to 0.

    Raises `ValueError` unless ``count`` is a whole number from 1 to 64.
    """
    return np.where(as_whole("count", count, 1, BLOCK * BLOCK) > RANK, codes, 0)
