"""Two cameras that see the same point: epipolar lines and depth.

Camera frames and pixels as in `simulations.models.projection.pinhole`. The motion X' = R X + t
takes points from the first camera's frame to the second's; the second camera's centre is −Rᵀt in
the first one's. Lengths in one unit, such as metres.

Source: Szeliski, Computer Vision, 2nd ed., §11.3.1 and §12.1; Longuet-Higgins, A computer algorithm
for reconstructing a scene from two projections, Nature 1981; Hartley and Zisserman, Multiple View
Geometry, 2nd ed., ch. 9.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_array, as_vectors
from simulations.models.geometry.quaternions import check_rotation
from simulations.models.require import require, require_positive


def essential_matrix(R: ArrayLike, t: ArrayLike) -> Floats:
    """E = [t]ₓ R, (3, 3): rays d and d' of one point fulfil d'ᵀ E d = 0.

    Both rays and the baseline are in one plane. Raises `ValueError` if t is zero or not finite:
    without a baseline any two rays fulfil the equation.
    """
    rotation, offset = check_rotation(as_array("R", R, 3, 3)), as_array("t", t, 3)
    require("t", offset, np.isfinite(offset).all() and offset.any(), "finite, not zero")
    return np.cross(offset, rotation.T).T


def fundamental_matrix(
    K_first: ArrayLike, K_second: ArrayLike, R: ArrayLike, t: ArrayLike
) -> Floats:
    """F = K₂⁻ᵀ E K₁⁻¹, (3, 3): homogeneous pixels of one point fulfil x'ᵀ F x = 0."""
    E = essential_matrix(R, t)
    half = np.linalg.solve(as_array("K_first", K_first, 3, 3).T, E.T).T
    return np.linalg.solve(as_array("K_second", K_second, 3, 3).T, half)


def epipolar_lines(F: ArrayLike, pixels: ArrayLike) -> tuple[Floats, Mask]:
    """Epipolar lines in the second picture, which contain the matches of pixels of the first: F x.

    Parameters
    ----------
    F : (3, 3) from `fundamental_matrix`, of any scale.
    pixels : (..., 2)

    Returns
    -------
    lines : (..., 3) with a² + b² = 1, so that a x + b y + c is a distance in pixels; NaN where
        invalid.
    valid : (...,) bool, False for the epipole, the image of the other camera, which has no line,
        and if a number is not finite.
    """
    matrix, points = as_array("F", F, 3, 3), as_vectors("pixels", pixels, 2)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        terms = matrix * np.append(points, np.ones((*points.shape[:-1], 1)), axis=-1)[..., None, :]
        lines = terms.sum(axis=-1)
        size = np.abs(terms).sum(axis=-1)
        normal = np.hypot(lines[..., 0], lines[..., 1])
        valid = normal > 1e-12 * np.hypot(size[..., 0], size[..., 1])
        scaled = lines / normal[..., None]
    valid &= np.isfinite(scaled).all(axis=-1)
    return np.where(valid[..., None], scaled, np.nan), valid


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def depth_of_match(
    first: ArrayLike,
    second: ArrayLike,
    K_first: ArrayLike,
    K_second: ArrayLike,
    R: ArrayLike,
    t: ArrayLike,
) -> tuple[Floats, Mask]:
    """Depth from the first camera at which the image of a pixel's ray is nearest to the match.

    The ray's image a + Z b, a = K₂ t and b = K₂ R K₁⁻¹ x, is the epipolar line; the match is taken
    to the nearest point of that. The first pixel counts as exact.

    Parameters
    ----------
    first, second : (..., 2) pixels

    Returns
    -------
    depth : (...), ∞ for the vanishing point of the ray, NaN where invalid.
    valid : (...,) bool, False if the match is beyond infinity, where no point in front of the first
        camera is seen; for the epipole, whose ray is seen as a point; and if a number is not
        finite.
    """
    x, q = as_vectors("first", first, 2), as_vectors("second", second, 2)
    essential_matrix(R, t)
    K2 = as_array("K_second", K_second, 3, 3)
    ray = (
        np.append(x, np.ones((*x.shape[:-1], 1)), axis=-1)
        @ np.linalg.inv(as_array("K_first", K_first, 3, 3)).T
    )
    a, b = K2 @ np.asarray(t, float), ray @ (K2 @ np.asarray(R, float)).T
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        terms = b[..., :2] * a[2], a[:2] * b[..., 2:]
        along = terms[0] - terms[1]
        seen = np.abs(along).max(axis=-1) > 1e-12 * np.abs(terms).max(axis=(0, -1))
        near = ((a[:2] - q * a[2]) * along).sum(axis=-1)
        far = ((b[..., :2] - q * b[..., 2:]) * along).sum(axis=-1)
        depth = np.where(far == 0.0, np.inf, -near / far)
    valid = seen & (depth > 0.0) & np.isfinite(near) & np.isfinite(far)
    return np.where(valid, depth, np.nan), valid


def depth_from_disparity(
    disparity: ArrayLike, focal_px: float, baseline: float
) -> tuple[Floats, Mask]:
    """Z = f b / d of two equal, parallel cameras side by side.

    Parameters
    ----------
    disparity : (...) pixels, x in the left picture minus x in the right one.
    focal_px, baseline : positive.

    Returns
    -------
    depth : (...) in the unit of the baseline, ∞ where d = 0, NaN where invalid.
    valid : (...,) bool, False if d is negative or NaN: no point has such a match.
    """
    require_positive("focal_px", focal_px)
    require_positive("baseline", baseline)
    d = np.asarray(disparity, float)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        depth = np.where(d == 0.0, np.inf, focal_px / d * baseline)
    valid = d >= 0.0
    return np.where(valid, depth, np.nan), valid


def depth_error(
    depth: ArrayLike, focal_px: float, baseline: float, disparity_error: ArrayLike
) -> Floats:
    """ΔZ = Z² Δd / (f b): the error of a depth (...), to first order.

    Without an error of the disparity it is 0, even at infinity.
    """
    require_positive("focal_px", focal_px)
    require_positive("baseline", baseline)
    Z, error = np.broadcast_arrays(np.asarray(depth, float), np.asarray(disparity_error, float))
    exact = ((error == 0.0) | (Z == 0.0)) & ~(np.isnan(Z) | np.isnan(error))
    with np.errstate(over="ignore", invalid="ignore"):
        return np.where(exact, 0.0, Z * (Z * (error / focal_px / baseline)))
