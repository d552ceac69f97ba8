"""A Bayer mosaic as four planes, one per place in the quad of 2x2 pixels.

Whatever the pattern, the red pixels lie on every second row and column. Mirrored outwards until it
starts with a red pixel, every mosaic has the same pattern: all four patterns need only one formula
per missing colour, and a plane has a quarter of the pixels.
"""

from dataclasses import dataclass

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.sensor.bayer import red_position

MARGIN = 8
"""Quads of mirrored mosaic on each side: more than any demosaicing method reaches."""


@dataclass(frozen=True, slots=True)
class Quads:
    """A mosaic cut into its four colours, each a plane of one value per quad of 2x2 pixels.

    Within a quad: ``red`` top left, ``green_red`` next to it in the red row, ``green_blue`` below
    it in the blue row, ``blue`` bottom right. The planes reach `MARGIN` quads beyond the mosaic on
    every side.
    """

    red: Floats
    green_red: Floats
    green_blue: Floats
    blue: Floats


def to_quads(cfa: Floats, pattern: str) -> Quads:
    """Mirror the mosaic (H, W >= 2) outwards until it starts and ends with whole quads.

    Mirroring about the edge pixel preserves the order of the filters, so that a flat colour stays
    flat up to the border.
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


def from_quads(planes: Floats, shape: tuple[int, int], pattern: str) -> Floats:
    """Interleave (3, 2, 2, h, w) planes, indexed by colour and place in the quad, to (H, W, 3)."""
    top, left = red_position(pattern)
    colours, _, _, rows, columns = planes.shape
    whole = planes.transpose(3, 1, 4, 2, 0).reshape(2 * rows, 2 * columns, colours)
    pad = 2 * MARGIN
    inner = whole[pad + top : pad + top + shape[0], pad + left : pad + left + shape[1]]
    return np.ascontiguousarray(inner)


def left_of(plane: Floats) -> Floats:
    """At each quad, the value of the quad to its left. Values that wrap around end in the
    margin."""
    return np.roll(plane, 1, axis=1)


def right_of(plane: Floats) -> Floats:
    """At each quad, the value of the quad to its right."""
    return np.roll(plane, -1, axis=1)


def above(plane: Floats) -> Floats:
    """At each quad, the value of the quad above."""
    return np.roll(plane, 1, axis=0)


def below(plane: Floats) -> Floats:
    """At each quad, the value of the quad below."""
    return np.roll(plane, -1, axis=0)
