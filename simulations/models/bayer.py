"""The Bayer filter mosaic: which colour each pixel of a sensor sees.

A pattern names the filters of the top left 2x2 pixels, row by row. Whatever the pattern, the
red pixels lie on every second row and column: demosaicing works on *quads* whose first
pixel is red, made by mirroring the mosaic outwards.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

type Array = NDArray[np.floating]

PATTERNS = ("RGGB", "BGGR", "GRBG", "GBRG")
MARGIN = 8
"""Quads of mirrored mosaic on each side: more than any demosaicing method here looks out."""


def filter_colours(height: int, width: int, pattern: str = "RGGB") -> NDArray[np.uint8]:
    """Index of the filter's colour (H, W): 0 red, 1 green, 2 blue."""
    quad = np.array(["RGB".index(letter) for letter in _checked(pattern)], np.uint8).reshape(2, 2)
    tiled = np.tile(quad, ((height + 1) // 2, (width + 1) // 2))
    colours: NDArray[np.uint8] = tiled[:height, :width]
    return colours


def mosaic(rgb: ArrayLike, pattern: str = "RGGB") -> Array:
    """What the sensor keeps of a picture (H, W, 3): one colour per pixel, (H, W).

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


def through_filters(cfa: ArrayLike, pattern: str = "RGGB") -> Array:
    """The mosaic as one would see it through the filters: (H, W, 3), two of three values 0."""
    values = np.asarray(cfa)
    seen = np.zeros((*values.shape, 3), values.dtype)
    for index, letter in enumerate(_checked(pattern)):
        y, x = divmod(index, 2)
        seen[y::2, x::2, "RGB".index(letter)] = values[y::2, x::2]
    return seen


@dataclass(frozen=True, slots=True)
class Quads:
    """A mosaic cut into its four colours, each a plane of one value per quad of 2x2 pixels.

    Within a quad: ``red`` top left, ``green_red`` beside it in the red row, ``green_blue``
    below it in the blue row, ``blue`` bottom right. The planes reach `MARGIN` quads beyond
    the mosaic on every side.
    """

    red: Array
    green_red: Array
    green_blue: Array
    blue: Array


def to_quads(cfa: Array, pattern: str) -> Quads:
    """Mirror the mosaic (H, W >= 2) outwards until it starts and ends with whole quads.

    Mirroring about the edge pixel keeps the order of the filters, so that a flat colour
    stays flat up to the border.
    """
    top, left = red_position(pattern)
    height, width = cfa.shape
    pad = 2 * MARGIN
    padded = np.pad(
        cfa,
        ((pad + top, pad + (top + height) % 2), (pad + left, pad + (left + width) % 2)),
        mode="reflect",
    )
    planes = [np.ascontiguousarray(padded[y::2, x::2]) for y in (0, 1) for x in (0, 1)]
    return Quads(*planes)


def from_quads(planes: NDArray[np.floating], shape: tuple[int, int], pattern: str) -> Array:
    """Interleave (3, 2, 2, h, w) planes, indexed by colour and place in the quad, to (H, W, 3)."""
    top, left = red_position(pattern)
    colours, _, _, rows, columns = planes.shape
    whole = planes.transpose(3, 1, 4, 2, 0).reshape(2 * rows, 2 * columns, colours)
    pad = 2 * MARGIN
    inner = whole[pad + top : pad + top + shape[0], pad + left : pad + left + shape[1]]
    return np.ascontiguousarray(inner)


def red_position(pattern: str) -> tuple[int, int]:
    """Row and column of the red filter within the pattern."""
    return divmod(_checked(pattern).index("R"), 2)


def _checked(pattern: str) -> str:
    if pattern not in PATTERNS:
        raise ValueError(f"pattern {pattern!r}; legal: {', '.join(PATTERNS)}")
    return pattern
