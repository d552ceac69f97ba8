"""Points on a lens, for rays that sample it: evenly by a spiral, or by chance.

Szeliski, 2nd ed., section 2.2.3; H. Vogel, *A better way to construct the sunflower head*, 1979.
"""

import numpy as np

from simulations.models.arrays import Floats
from simulations.models.whole_numbers import as_whole

GOLDEN_ANGLE_RAD = np.pi * (3.0 - np.sqrt(5.0))


def fibonacci_disc(count: int) -> Floats:
    """(count, 2) points of a sunflower on the unit disc: each stands for the same area.

    Raises `ValueError` for a count below 1. A single point lies off the centre, at radius √½.
    """
    count = as_whole("count", count, 1)
    index = np.arange(count)
    radius, angle = np.sqrt((index + 0.5) / count), index * GOLDEN_ANGLE_RAD
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)


def random_disc(count: int, shape: tuple[int, ...], rng: np.random.Generator) -> Floats:
    """(count, 2, *shape) points, uniform on the unit disc and independent of one another."""
    count = as_whole("count", count, 1)
    radius = np.sqrt(rng.random((count, *shape), dtype=np.float32))
    angle = np.float32(2 * np.pi) * rng.random((count, *shape), dtype=np.float32)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
