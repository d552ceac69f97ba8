"""The Bayer filter mosaic: the colour of each pixel of a sensor.

A pattern names the filters of the top left 2x2 pixels, row by row. Szeliski, 2nd ed., section 2.3.2
(colour filter arrays).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats
from simulations.models.require import as_whole, require_one_of

PATTERNS = ("RGGB", "BGGR", "GRBG", "GBRG")


def filter_colours(height: int, width: int, pattern: str = "RGGB") -> NDArray[np.uint8]:
    """Index of the filter's colour (H, W): 0 red, 1 green, 2 blue.

    Raises `ValueError` for an unknown pattern and unless both sizes are whole and above 0.
    """
    height, width = as_whole("height", height, 1), as_whole("width", width, 1)
    quad = np.array(["RGB".index(letter) for letter in _checked(pattern)], np.uint8).reshape(2, 2)
    tiled = np.tile(quad, ((height + 1) // 2, (width + 1) // 2))
    return tiled[:height, :width]


def mosaic(rgb: ArrayLike, pattern: str = "RGGB") -> Floats:
    """The mosaic of a picture (H, W, 3): one colour per pixel, (H, W).

    Raises `ValueError` for another shape or an unknown pattern. Any size from 1x1 is legal.
    """
    picture = np.asarray(rgb)
    if picture.ndim != 3 or picture.shape[2] != 3 or 0 in picture.shape:
        raise ValueError(f"picture of shape {picture.shape}; legal: (H, W, 3), not empty")
    cfa = np.empty(picture.shape[:2], picture.dtype)
    for index, letter in enumerate(_checked(pattern)):
        y, x = divmod(index, 2)
        cfa[y::2, x::2] = picture[y::2, x::2, "RGB".index(letter)]
    return cfa


def through_filters(cfa: ArrayLike, pattern: str = "RGGB") -> Floats:
    """The mosaic in the colours of its filters: (H, W, 3), two of three values 0."""
    values = np.asarray(cfa)
    seen = np.zeros((*values.shape, 3), values.dtype)
    for index, letter in enumerate(_checked(pattern)):
        y, x = divmod(index, 2)
        seen[y::2, x::2, "RGB".index(letter)] = values[y::2, x::2]
    return seen


def red_position(pattern: str) -> tuple[int, int]:
    """Row and column of the red filter within the pattern."""
    return divmod(_checked(pattern).index("R"), 2)


def _checked(pattern: str) -> str:
    require_one_of("pattern", pattern, PATTERNS)
    return pattern
