"""A smaller, grey copy of a photograph, in which a board is looked for first."""

import numpy as np

from simulations.models.arrays import Planes
from simulations.models.chequerboard.corner_windows import LUMA, Picture

STRIP = 64
"""Rows of the result that are made at once, which bounds the memory for large photographs."""


def reduced(picture: Picture, factor: int) -> Planes:
    """The means (h, w) of the luma of ``factor`` × ``factor`` pixels of codes (H, W) or (H, W, 3).

    Rows and columns left over are left out. Pixel (x, y) of the result is centred at
    factor · (x + ½) − ½ of the picture.
    """
    height, width = (length // factor for length in picture.shape[:2])
    colours = 1 if picture.ndim == 2 else 3
    weight = np.ones(1) if colours == 1 else np.array(LUMA)
    weights = np.tile(weight, factor).astype(np.float32) / np.float32(factor**2)
    grey = np.empty((height, width), np.float32)
    wide = np.uint16 if picture.dtype == np.uint8 and factor < 256 else np.float64
    for top in range(0, height, STRIP):
        rows = min(STRIP, height - top)
        strip = picture[top * factor : (top + rows) * factor, : width * factor]
        strip = strip.reshape(rows, factor, width * factor * colours)
        total = strip.sum(axis=1, dtype=wide) if factor > 1 else strip[:, 0]
        grey[top : top + rows] = (
            total.reshape(rows, width, factor * colours).astype(np.float32) @ weights
        )
    return grey
