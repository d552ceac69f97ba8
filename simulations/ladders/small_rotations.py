"""Small rotations: how many terms of the exponential map a few degrees need."""

import math

import numpy as np

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.arrays import Floats
from simulations.models.geometry import quaternions
from simulations.models.geometry.cross_products import CYCLES, cross_polynomial
from simulations.models.geometry.rotations import exponential

ANGLE_RAD = math.radians(5.0)
COUNT = 4096


def prepare() -> Floats:
    """Rotation vectors (N, 3): 5° about axes in all directions."""
    axes = np.random.default_rng(5).standard_normal((COUNT, 3))
    return ANGLE_RAD * axes / np.linalg.norm(axes, axis=-1, keepdims=True)


def reference(vectors: Floats) -> Floats:
    """The exponential series of the matrix [v]ₓ, term by term, in the longest floats there are.

    Twenty terms of a 5° turn end below 1e−38. Nothing but sums and products is used, which
    extended precision has on every machine.
    """
    v = vectors.astype(np.longdouble)
    K = np.zeros((len(v), 3, 3), np.longdouble)
    K[:, 2, 1], K[:, 0, 2], K[:, 1, 0] = v[:, 0], v[:, 1], v[:, 2]
    K = K - np.swapaxes(K, 1, 2)
    term = np.zeros_like(K) + np.eye(3, dtype=np.longdouble)
    total = term.copy()
    for order in range(1, 21):
        term = (term[:, :, :, None] * K[:, None, :, :]).sum(axis=2) / order
        total += term
    return total


def first_order(vectors: Floats) -> Floats:
    """I + K: turns by atan θ, and stretches by 1/cos of that; errs by θ²/2 per direction."""
    R = np.empty((len(vectors), 3, 3))
    for i, j, k in CYCLES:
        R[:, i, j], R[:, j, i] = -vectors[:, k], vectors[:, k]
        R[:, k, k] = 1.0
    return R


def second_order(vectors: Floats) -> Floats:
    """I + K + K²/2: the sine is still taken as the angle, which errs by θ³/6."""
    return cross_polynomial(vectors, 1.0, 0.5)


def cayley(vectors: Floats) -> Floats:
    """(I − K/2)⁻¹(I + K/2) = I + (K + K²/2)/(1 + θ²/4): a true rotation, by 2 atan(θ/2).

    Short of θ by θ³/12, half of what `second_order` misses, for one more division.
    """
    x, y, z = vectors.T
    shrink = 1.0 / (1.0 + 0.25 * (x * x + y * y + z * z))
    return cross_polynomial(vectors, shrink, 0.5 * shrink)


def by_quaternion(vectors: Floats) -> Floats:
    return quaternions.to_matrix(quaternions.from_rotation_vector(vectors))


def rms_frobenius(result: Floats, truth: Floats, _vectors: Floats) -> float:
    """Root mean over the rotations of the summed squares of the nine differences."""
    squares = ((result - truth).astype(np.float64) ** 2).sum(axis=(-1, -2))
    return float(np.sqrt(squares.mean()))


def worst_distortion(result: Floats, _truth: Floats, _vectors: Floats) -> float:
    """Frobenius norm of RᵀR − I: how far from keeping lengths and right angles."""
    gram = np.swapaxes(result, -1, -2) @ result - np.eye(3)
    return float(np.linalg.norm(gram, axis=(-1, -2)).max())


LADDER = Ladder(
    id="small-rotations",
    title="Small rotations",
    workload="4096 rotations by 5° about axes in all directions",
    prepare=prepare,
    tiers=(
        Tier("first-order", "I + K", "3 entries", first_order),
        Tier("second-order", "I + K + K²/2", "18 products", second_order),
        Tier("cayley", "Cayley", "23 products, 1 division", cayley),
        Tier("exact", "Rodrigues", "18 products, 2 sines, 1 norm", exponential),
        Tier("quaternion", "By quaternion", "18 products, 2 sines, 2 norms", by_quaternion),
    ),
    reference=reference,
    reference_label="twenty terms of the exponential series in extended precision",
    metrics=(
        Metric("rms", "RMS error of the matrix", "Frobenius norm", rms_frobenius),
        Metric("distortion", "Largest |RᵀR − I|", "Frobenius norm", worst_distortion),
    ),
    default_tier="exact",
)
