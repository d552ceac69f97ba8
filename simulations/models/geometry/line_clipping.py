"""The part of a line within a rectangle.

The line is a triple (a, b, c) with a x + b y + c = 0. It has no slope, so that vertical lines are
no special case.

Source: Hartley and Zisserman, Multiple View Geometry, 2nd ed., §2.2.1 (lines as triples).
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_vectors


def line_in_rectangle(line: ArrayLike, lowest: ArrayLike, highest: ArrayLike) -> Floats:
    """The ends of the part of a line inside a rectangle with level and upright sides.

    A side of the rectangle crosses the line if a x + b y + c has opposite signs at its two corners;
    the place is their mean, each weighted by the other's value.

    Parameters
    ----------
    line : (3,), of any scale.
    lowest, highest : (2,), the smallest and the largest x and y of the rectangle.

    Returns
    -------
    ends : (2, 2), in the order of their x and, where that is equal, of their y. (0, 2) if the line
        misses the rectangle or only touches a corner, and for the line at infinity, three zeros, or
        entries that are not finite.
    """
    entries = as_vectors("line", line, 3)
    left, low = as_vectors("lowest", lowest, 2)
    right, high = as_vectors("highest", highest, 2)
    corners = np.array([(left, low), (right, low), (right, high), (left, high)])
    largest = np.abs(entries).max()
    if not (np.isfinite(largest) and entries[:2].any()):
        return np.empty((0, 2))
    a, b, c = entries / largest
    values = a * corners[:, 0] + b * corners[:, 1] + c
    found: list[Floats] = []
    for i, value in enumerate(values):
        following = values[i - 3]
        if value == 0.0:
            found.append(corners[i])
        elif np.sign(value) == -np.sign(following):
            share = value / (value - following)
            found.append(corners[i] + share * (corners[i - 3] - corners[i]))
    if len(found) != 2 or np.array_equal(found[0], found[1]):
        return np.empty((0, 2))
    return np.array(sorted(found, key=tuple))
