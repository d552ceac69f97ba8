"""Colour without brightness: chromaticities (x, y), the whites of lights, distances of colours.

Szeliski, 2nd ed., §2.3.2; CIE 15:2004.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_colours
from simulations.models.color.cie import D65_XY
from simulations.models.require import require

ILLUMINANT_A_XY = (0.44758, 0.40745)
"""A tungsten lamp of 2856 K."""


def white_xyz(xy: ArrayLike) -> Floats:
    """XYZ (3,) of a light of chromaticity (x, y), with Y = 1.

    Raises `ValueError` unless both and 1 − x − y are at least 0, and y above 1e-6.
    """
    pair = np.asarray(xy, np.float64)
    x, y = pair if pair.shape == (2,) else (np.nan, np.nan)
    require("chromaticity", pair, x >= 0 and y > 1e-6 and x + y <= 1, "x ≥ 0, y > 1e-6, x + y ≤ 1")
    return np.array([x / y, 1.0, (1 - x - y) / y])


def xyz_to_xyy(xyz: ArrayLike) -> Floats:
    """CIE XYZ to chromaticity and luminance (x, y, Y), all (..., 3).

    Black has no chromaticity. Like all colours whose sum is not positive and finite, it gets that
    of D65, so that grey scales end in grey.
    """
    colours = as_colours(xyz)
    largest = np.abs(colours).max(axis=-1, keepdims=True)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        scaled = colours / largest  # sums can neither overflow nor vanish
        total = scaled.sum(axis=-1, keepdims=True)
        pair = scaled[..., :2] / total
    pair = np.where(total > 0, pair, np.asarray(D65_XY, colours.dtype))
    return np.concatenate([pair, colours[..., 1:2]], axis=-1)


def lab_distance(lab: ArrayLike, other: ArrayLike) -> Floats:
    """ΔE*ab of 1976 (...) between L*a*b* colours (..., 3): about 2 is just noticeable."""
    with np.errstate(over="ignore", invalid="ignore"):
        difference = as_colours(lab) - as_colours(other)
        return np.sqrt(np.square(difference).sum(axis=-1))
