"""Rays to look at solids with."""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats

ORIGIN = np.zeros(3)
AHEAD = np.array([0.0, 1.0, 0.0])


def unit(vectors: ArrayLike) -> Floats:
    """(..., 3) of length 1."""
    vectors = np.asarray(vectors, float)
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
