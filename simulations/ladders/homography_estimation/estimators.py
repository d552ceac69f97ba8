"""Estimators of a homography from matched points (N, 2), which minimise different errors.

They omit the checks of `models.geometry.homography_estimation`, so that only the method is timed.
Each returns H (3, 3), of any scale and sign.

Source: Hartley and Zisserman, Multiple View Geometry, 2nd ed., §4.1, §4.2 and §4.4.
"""

import math

import numpy as np

from simulations.models.arrays import Floats

STEPS = 2
"""Steps of Gauss–Newton: from a normalised start the second changes less than the noise."""


def plain(source: Floats, target: Floats) -> Floats:
    """Direct linear transform in pixels, with columns of 1 next to columns of 10⁷."""
    return _null_vector(_system(source, target))


def normalised(source: Floats, target: Floats) -> Floats:
    before, T, _ = _normalise(source)
    after, _, U_inverse = _normalise(target)
    return U_inverse @ _null_vector(_system(before, after)) @ T


def squared(source: Floats, target: Floats) -> Floats:
    """Normalised, by the 9 × 9 matrix AᵀA, whose size does not depend on the number of points.

    Squaring halves the digits of an ill-conditioned problem; normalised, this one is
    well-conditioned.
    """
    before, T, _ = _normalise(source)
    after, _, U_inverse = _normalise(target)
    return U_inverse @ _smallest_eigenvector(_system(before, after)) @ T


def four_points(source: Floats, target: Floats) -> Floats:
    """Exact for the four matches farthest out along the diagonals; the others are ignored."""
    sums, differences = source.sum(axis=1), source[:, 0] - source[:, 1]
    four = [sums.argmin(), differences.argmax(), sums.argmax(), differences.argmin()]
    before, T, _ = _normalise(source[four])
    after, _, U_inverse = _normalise(target[four])
    system = _system(before, after)
    h = np.append(np.linalg.solve(system[:, :8], -system[:, 8]), 1.0)
    return U_inverse @ h.reshape(3, 3) @ T


def one_sided(source: Floats, target: Floats) -> Floats:
    """From `squared`, least squares of the distances in the second picture.

    The most likely homography if the points of the first picture were exact.
    """
    return _refined(source, target, source_noise=0.0)


def two_sided(source: Floats, target: Floats) -> Floats:
    """The same, each match weighted by the noise of *both* its points (Sampson's distance).

    The map enlarges the noise of the first picture by its derivatives J, so that a residual has the
    covariance I + J Jᵀ in units of the noise.
    """
    return _refined(source, target, source_noise=1.0)


def _refined(source: Floats, target: Floats, *, source_noise: float) -> Floats:
    before, T, _ = _normalise(source)
    after, U, U_inverse = _normalise(target)
    h = _smallest_eigenvector(_system(before, after)).reshape(9)
    h = h / h[8]
    for _ in range(STEPS):
        residual, slope, J = _linearised(h, before, after)
        if source_noise:
            # In normalised units, the noise of the two pictures differs by their scales.
            _whiten(residual, slope, J * (source_noise * T[0, 0] / U[0, 0]))
        flat = slope.reshape(-1, 8)
        h[:8] -= np.linalg.solve(flat.T @ flat, flat.T @ residual.reshape(-1))
    return U_inverse @ h.reshape(3, 3) @ T


def _linearised(h: Floats, before: Floats, after: Floats) -> tuple[Floats, Floats, Floats]:
    """Mapped minus measured points, and the derivatives by eight entries of h and by the source
    point.

    (2, N), (2, N, 8) and (2, 2, N).
    """
    x, y = before.T
    inverse_w = 1.0 / (h[6] * x + h[7] * y + h[8])
    seen = np.stack((h[0] * x + h[1] * y + h[2], h[3] * x + h[4] * y + h[5])) * inverse_w
    slope = np.zeros((2, len(before), 8))
    for axis in range(2):
        slope[axis, :, 3 * axis] = x * inverse_w
        slope[axis, :, 3 * axis + 1] = y * inverse_w
        slope[axis, :, 3 * axis + 2] = inverse_w
        slope[axis, :, 6] = -seen[axis] * x * inverse_w
        slope[axis, :, 7] = -seen[axis] * y * inverse_w
    linear = h[:6].reshape(2, 3)[:, :2, None]
    J = (linear - seen[:, None] * h[6:8, None]) * inverse_w
    return seen - after.T, slope, J


def _whiten(residual: Floats, slope: Floats, J: Floats) -> None:
    """Whiten residuals in place, by Cholesky factors of I + J Jᵀ."""
    xx, yy = 1.0 + (J * J).sum(axis=1)
    xy = (J[0] * J[1]).sum(axis=0)
    first = 1.0 / np.sqrt(xx)
    lean = xy * first
    second = 1.0 / np.sqrt(yy - lean * lean)
    residual[0] *= first
    residual[1] = (residual[1] - lean * residual[0]) * second
    slope[0] *= first[:, None]
    slope[1] = (slope[1] - lean[:, None] * slope[0]) * second[:, None]


def _normalise(points: Floats) -> tuple[Floats, Floats, Floats]:
    """Points about 0 at a mean distance of √2, the matrix that maps to them, and its inverse."""
    centre = points.mean(axis=0)
    moved = points - centre
    scale = math.sqrt(2.0) / float(np.sqrt((moved * moved).sum(axis=1)).mean())
    x, y = centre.tolist()
    T = np.array([[scale, 0.0, -scale * x], [0.0, scale, -scale * y], [0.0, 0.0, 1.0]])
    return moved * scale, T, np.array([[1 / scale, 0.0, x], [0.0, 1 / scale, y], [0.0, 0.0, 1.0]])


def _system(before: Floats, after: Floats) -> Floats:
    """(2N, 9): x' (h₃·x) = h₁·x and y' (h₃·x) = h₂·x."""
    n = len(before)
    rows = np.zeros((2, n, 9))
    for axis in range(2):
        rows[axis, :, 3 * axis : 3 * axis + 2] = before
        rows[axis, :, 3 * axis + 2] = 1.0
        rows[axis, :, 6:8] = -after[:, axis, None] * before
        rows[axis, :, 8] = -after[:, axis]
    return rows.reshape(2 * n, 9)


def _null_vector(system: Floats) -> Floats:
    null_vector: Floats = np.linalg.svd(system, full_matrices=False)[2][8]
    return null_vector.reshape(3, 3)


def _smallest_eigenvector(system: Floats) -> Floats:
    smallest: Floats = np.linalg.eigh(system.T @ system)[1][:, 0]
    return smallest.reshape(3, 3)
