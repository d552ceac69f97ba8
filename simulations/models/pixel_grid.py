"""Positions of pixels."""

import numpy as np

from simulations.models.arrays import Floats


def centred(count: int) -> Floats:
    """Centres (count,) of a row of pixels, from the middle of the row: whole numbers or halves."""
    return np.arange(count) - 0.5 * (count - 1)
