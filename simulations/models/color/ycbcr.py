"""Luma and colour differences, as JPEG stores a picture.

Colours are arrays (..., 3). Szeliski, 2nd ed., section 2.3.2.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, through_matrix

YCBCR_FROM_RGB = np.array(
    [
        [0.299, 0.587, 0.114],
        [-0.299 / 1.772, -0.587 / 1.772, 0.5],
        [0.5, -0.587 / 1.402, -0.114 / 1.402],
    ]
)
"""Full-range luma and colour differences of JPEG (ITU-R BT.601, JFIF 1.02)."""

_RGB_FROM_YCBCR = np.linalg.inv(YCBCR_FROM_RGB)


def rgb_to_ycbcr(srgb: ArrayLike) -> Floats:
    """sRGB-encoded values to luma in [0, 1] and colour differences in [-0.5, 0.5]."""
    return through_matrix(YCBCR_FROM_RGB, srgb)


def ycbcr_to_rgb(ycbcr: ArrayLike) -> Floats:
    """The inverse of `rgb_to_ycbcr`."""
    return through_matrix(_RGB_FROM_YCBCR, ycbcr)
