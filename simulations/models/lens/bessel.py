"""The Bessel function J₀, for the diffraction of round openings.

Abramowitz and Stegun, *Handbook of Mathematical Functions*, 1964, 9.4.1 and 9.4.3.
"""

import numpy as np
from numpy.polynomial.polynomial import polyval
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.require import require

NEAR = (1.0, -2.2499997, 1.2656208, -0.3163866, 0.0444479, -0.0039444, 0.0002100)
"""Coefficients of the powers of (x/3)², for x up to 3."""
SIZE = (0.79788456, -0.00000077, -0.00552740, -0.00009512, 0.00137237, -0.00072805, 0.00014476)
LAG = (-0.78539816, -0.04166397, -0.00003954, 0.00262573, -0.00054125, -0.00029333, 0.00013558)
"""Coefficients of the powers of 3/x, for x above 3: the amplitude of a cosine that falls with √x,
and the difference of its phase from x."""


def bessel_j0(x: ArrayLike) -> Floats:
    """J₀ at real arguments (...), to 1e-7.

    Raises `ValueError` beyond ±1e6, where the phase begins to lose that accuracy to rounding.
    """
    size = np.abs(np.asarray(x, float))
    require("x", size, np.all(size <= 1e6), "at most 1e6 in size")
    close, answer = size <= 3.0, np.empty_like(size)
    answer[close] = polyval((size[close] / 3.0) ** 2, NEAR)
    far = size[~close]
    turns = far + polyval(3.0 / far, LAG)
    answer[~close] = polyval(3.0 / far, SIZE) / np.sqrt(far) * np.cos(turns)
    return answer
