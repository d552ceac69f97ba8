"""A playing card, the seven of hearts, as polygons that a transformation of the plane can move.

Its index in the corner tells a card from its mirror image, and its pips tell near from far.
"""

import math
from collections.abc import Iterator

import numpy as np

from simulations.engine.drafting import swatch_polygon
from simulations.models.arrays import Floats

WIDE, HIGH = 50.0, 70.0
"""Size of the card, whose centre is the origin; y points up."""
PAPER, RED = (0.985, 0.975, 0.94), (0.77, 0.09, 0.13)
"""sRGB."""


def _heart(x: float, y: float, wide: float) -> Floats:
    """A heart about (x, y), upside down on the lower half of the card as on a real one."""
    t = np.arange(48) * (math.tau / 48)
    up = 13 * np.cos(t) - 5 * np.cos(2 * t) - 2 * np.cos(3 * t) - np.cos(4 * t) + 2
    sign = 1.0 if y > -1.0 else -1.0
    return np.stack([x + wide * np.sin(t) ** 3 / 2, y + sign * wide * up / 33], axis=-1)


def _rounded(wide: float, high: float, radius: float) -> Floats:
    turns = np.linspace(0, math.pi / 2, 7)
    right, top = wide / 2 - radius, high / 2 - radius
    corners = [
        (math.copysign(right, math.cos(a)), math.copysign(top, math.sin(a)), a)
        for a in (math.pi / 4 + quarter * math.pi / 2 for quarter in range(4))
    ]
    return np.array(
        [
            (x + radius * math.cos(a - math.pi / 4 + t), y + radius * math.sin(a - math.pi / 4 + t))
            for x, y, a in corners
            for t in turns
        ]
    )


def _index() -> Iterator[Floats]:
    """The 7 and its heart in the upper left corner."""
    x = (-22, -15, -15, -18.3, -20.2, -17, -22)
    y = (31.5, 31.5, 30.3, 23.5, 23.5, 29.8, 29.8)
    yield np.stack((x, y), axis=-1)
    yield _heart(-18.5, 19.5, 5.5)


SEVEN = [(-9.5, 21), (9.5, 21), (0, 11), (-9.5, 0), (9.5, 0), (-9.5, -21), (9.5, -21)]
OUTLINE = _rounded(WIDE, HIGH, 4.0)
MARKS = (*(_heart(x, y, 11.0) for x, y in SEVEN), *_index(), *(-mark for mark in _index()))
"""Polygons (n, 2): the pips, and the index at both ends."""


def card_markup(outline: Floats, marks: list[Floats]) -> str:
    """The card in its own colours, after a transformation and clipping; empty polygons are left
    out."""
    shapes = ((outline, PAPER), *((mark, RED) for mark in marks))
    return "".join(swatch_polygon(shape, colour) for shape, colour in shapes if len(shape) > 2)
