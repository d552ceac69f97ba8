"""The square that is mapped, with the letter and the lines in it."""

import numpy as np

from simulations.models.arrays import Floats

HALF = 40.0
"""Half the side of the square, which is centred on the origin."""


def box(left: float, bottom: float, right: float, top: float) -> Floats:
    """Corners (4, 2) of a rectangle, counter-clockwise from the lower left."""
    return np.array([(left, bottom), (right, bottom), (right, top), (left, top)], dtype=float)


SQUARE = box(-HALF, -HALF, HALF, HALF)
LETTER = (box(-24, -28, -12, 28), box(-12, 17, 24, 28), box(-12, -6, 14, 5))
"""The bars of an F, a letter that differs from its rotated mirror image."""


def grid_segments() -> Floats:
    """The square's sides, inner grid lines and diagonals, (12, 2, 2)."""
    stations = np.linspace(-HALF, HALF, 5)
    vertical = [[(s, -HALF), (s, HALF)] for s in stations]
    horizontal = [[(-HALF, s), (HALF, s)] for s in stations]
    diagonals = [SQUARE[[0, 2]], SQUARE[[1, 3]]]
    return np.array([*vertical, *horizontal, *diagonals])


GRID = grid_segments()[:10]
