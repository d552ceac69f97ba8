"""Cross products, and polynomials of [v]ₓ, the matrix with [v]ₓ p = v × p: rotations and their
approximations.

Source: Szeliski, Computer Vision, 2nd ed., §2.1.3.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, as_vectors

CYCLES = ((0, 1, 2), (1, 2, 0), (2, 0, 1))


def cross_polynomial(
    vector: ArrayLike, linear: ArrayLike, square: ArrayLike
) -> NDArray[np.float64]:
    """I + linear [v]ₓ + square [v]ₓ², (..., 3, 3), of vectors (..., 3) and coefficients (...).

    Entry by entry, with [v]ₓ² = v vᵀ − |v|² I, which takes fewer products than a product of
    matrices.
    """
    v = np.ascontiguousarray(np.moveaxis(as_vectors("vector", vector, 3), -1, 0))
    shape = np.broadcast_shapes(v.shape[1:], np.shape(linear), np.shape(square))
    R = np.empty((*shape, 3, 3))
    with np.errstate(over="ignore", invalid="ignore"):
        for i, j, k in CYCLES:
            both, aside = square * v[i] * v[j], linear * v[k]
            R[..., i, j] = both - aside
            R[..., j, i] = both + aside
            R[..., k, k] = 1.0 - square * (v[i] * v[i] + v[j] * v[j])
    return R


def cross(first: Floats, second: Floats) -> Floats:
    """v × w (..., 3) of vectors (..., 3), in a third of the time that numpy takes for a few."""
    (a, b, c), (x, y, z) = ((v[..., 0], v[..., 1], v[..., 2]) for v in (first, second))
    return np.stack([b * z - c * y, c * x - a * z, a * y - b * x], axis=-1)
