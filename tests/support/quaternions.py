"""Quaternions as SciPy has them, and how far two are apart."""

import numpy as np
from scipy.spatial.transform import Rotation

from simulations.models.arrays import Floats


def wxyz(rotation: Rotation) -> Floats:
    """(..., 4), the real part first, as in our models."""
    return np.roll(rotation.as_quat(), 1, axis=-1)


def same_up_to_sign(a: Floats, b: Floats) -> Floats:
    """(...) largest difference of the entries; q and −q are one rotation."""
    return np.minimum(np.abs(a - b).max(axis=-1), np.abs(a + b).max(axis=-1))
