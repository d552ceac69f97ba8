"""The 64 cosine patterns of a block, each in its cell of the table of coefficients."""

import numpy as np
from numpy.typing import NDArray

from simulations.engine.frame import Raster
from simulations.engine.raster import to_rgba8
from simulations.models.compression.blocks import BLOCK, DCT
from simulations.models.compression.zigzag import RANK

ACROSS, DOWN = 5, 4
"""Pixels of the panel's raster for a sample of a pattern; a line between the cells is one."""
KEPT, ZERO = 1.0, 0.15
"""Contrast of the patterns with and without a coefficient."""
UNUSED = 0.3
"""Opacity of the patterns whose coefficients are not used."""

_WAVES = DCT / np.abs(DCT).max(axis=1, keepdims=True)
PATTERNS = np.einsum("uy,vx->uvyx", _WAVES, _WAVES)
"""(8, 8, 8, 8) patterns from −1 to 1: vertical and horizontal frequency, row, column."""


def pattern_table(codes: NDArray[np.integer], first: int) -> Raster:
    """Each pattern with the sign of its code (8, 8); faint where that is zero or not used."""
    used = first > RANK
    kept = (codes != 0) & used
    contrast = np.where(kept, KEPT * np.sign(codes), ZERO)
    shades = 0.5 + 0.5 * contrast[..., None, None] * PATTERNS
    opacity = np.broadcast_to(np.where(used, 1.0, UNUSED)[..., None, None], shades.shape)
    return to_rgba8(_table(shades), _table(opacity))


def _table(cells: NDArray[np.floating]) -> NDArray[np.floating]:
    """(8, 8, 8, 8) cells as a picture, with an empty line above and to the left of each."""
    large = cells.repeat(DOWN, axis=2).repeat(ACROSS, axis=3)
    framed = np.pad(large, ((0, 0), (0, 0), (1, 0), (1, 0)))
    height, width = framed.shape[2:]
    return framed.swapaxes(1, 2).reshape(BLOCK * height, BLOCK * width)
