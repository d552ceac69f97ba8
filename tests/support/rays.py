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


def rays_around(forward: Floats, spread: float, count: int, seed: int = 0) -> Floats:
    """(count, 3) unit vectors; ``spread`` is how far each entry may be off."""
    rng = np.random.default_rng(seed)
    return unit(np.asarray(forward) + spread * rng.uniform(-1, 1, (count, 3)))
