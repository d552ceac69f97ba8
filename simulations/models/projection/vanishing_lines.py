"""The vanishing point of lines drawn over a picture, by maximum likelihood.

A line is drawn by its two ends, each with independent normal noise of one σ in x and in y. The
likeliest vanishing point has the least sum of squared distances of the ends from lines through it.

Pixels as in `simulations.models.projection.pinhole`. Points are homogeneous, (x, y, 1) or (x, y, 0)
for a point at infinity, of any scale.

Source: Hartley and Zisserman, Multiple View Geometry, 2nd ed., §8.6; Liebowitz and Zisserman,
Metric rectification for perspective images of planes, CVPR 1998.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, Mask, as_array, as_matrices
from simulations.models.least_squares import levenberg_marquardt
from simulations.models.require import require


def line_residuals(segments: ArrayLike, point: ArrayLike) -> tuple[Floats, Floats]:
    """How far lines miss a point, (N,), and the derivatives (N, 3) by its homogeneous coordinates.

    The square of a residual is the least sum of squared distances of the two ends from a line
    through the point. It is the smaller eigenvalue of S = A Aᵀ + B Bᵀ, with A and B the ends seen
    from the point. Its sign is that of the side on which the point lies. Scaling the point changes
    nothing, and a point at infinity is one like any other.

    Parameters
    ----------
    segments : (N, 2, 2) the ends of the lines.
    point : (3,) homogeneous, or (N, 3) one for each line; not an end of both.
    """
    ends = as_matrices("segments", segments, 2, 2)
    points = np.broadcast_to(np.asarray(point, float), (len(ends), 3))
    first, second = ends[:, 0], ends[:, 1]
    A, B = (points[:, 2:] * end - points[:, :2] for end in (first, second))
    S_xx, S_yy = A[:, 0] ** 2 + B[:, 0] ** 2, A[:, 1] ** 2 + B[:, 1] ** 2
    S_xy = A[:, 0] * A[:, 1] + B[:, 0] * B[:, 1]
    larger = (S_xx + S_yy + np.hypot(S_xx - S_yy, 2.0 * S_xy)) / 2.0
    larger = np.maximum(larger, 1e-300)
    angle = np.arctan2(2.0 * S_xy, S_xx - S_yy) / 2.0
    along = np.stack([np.cos(angle), np.sin(angle)], axis=1)  # of the line, through the point
    lines = _joining(first, second)
    residuals = (lines * points).sum(axis=1) / np.sqrt(larger)
    on_A, on_B = (along * A).sum(axis=1), (along * B).sum(axis=1)
    by_xy = -2.0 * (on_A + on_B)[:, None] * along
    by_w = 2.0 * (on_A * (along * first).sum(axis=1) + on_B * (along * second).sum(axis=1))
    growth = np.column_stack([by_xy, by_w]) / larger[:, None]  # of the larger eigenvalue, relative
    return residuals, lines / np.sqrt(larger)[:, None] - residuals[:, None] * growth / 2.0


def fit_vanishing_point(segments: ArrayLike, sigma_px: float = 1.0) -> tuple[Floats, Floats]:
    """The likeliest vanishing point of two or more lines, and its covariance.

    Parameters
    ----------
    segments : (N, 2, 2) the ends of the lines.
    sigma_px : standard deviation of an end in x and in y.

    Returns
    -------
    point : (3,) homogeneous, for the pixel and its covariance see `pixel_of`.
    covariance : (3, 3) of those three numbers, to first order; of rank 2, as their scale is fixed.

    Raises
    ------
    ValueError
        For fewer than two lines, a line without length, lines that all coincide, ends that are not
        finite, and a sigma below 1e-9 or above 1e9.
    """
    ends = as_matrices("segments", segments, 2, 2)
    require("segments", len(ends), len(ends) >= 2, "two or more")
    check_sigma(sigma_px)
    check_segments(ends)
    middle, scale = ends.mean(axis=(0, 1)), float(np.abs(ends - ends.mean(axis=(0, 1))).max())
    near = (ends - middle) / scale
    lines = _joining(near[:, 0], near[:, 1])
    _, sizes, axes = np.linalg.svd(lines)
    require("segments", len(ends), sizes[1] > 1e-9 * sizes[0], "lines that do not all coincide")

    def residuals(point: Floats) -> tuple[Floats, Floats]:
        r, by_point = line_residuals(near, point)
        return r, by_point @ _across(point)

    def moved(point: Floats, step: Floats) -> Floats:
        further = point + _across(point) @ step
        return np.asarray(further / np.linalg.norm(further))

    point = levenberg_marquardt(residuals, moved, axes[2])
    across, (_, J) = _across(point), residuals(point)
    spread = across @ np.linalg.inv(J.T @ J) @ across.T * (sigma_px / scale) ** 2
    back = np.array([[scale, 0.0, middle[0]], [0.0, scale, middle[1]], [0.0, 0.0, 1.0]])
    return back @ point, back @ spread @ back.T


def check_sigma(sigma_px: float) -> None:
    """Raises `ValueError` for standard deviations that no drawn line has."""
    require("sigma_px", sigma_px, 1e-9 <= sigma_px <= 1e9, "1e-9 to 1e9")


def check_segments(segments: Floats) -> None:
    """Raises `ValueError` unless all ends are finite and all lines have a length."""
    require("segments", segments, bool(np.isfinite(segments).all()), "finite")
    lengths = np.hypot(*(segments[:, 1] - segments[:, 0]).T)
    require("lengths", lengths, bool((lengths > 0.0).all()), "lines with two ends")


def pixel_of(point: ArrayLike, covariance: ArrayLike) -> tuple[Floats, Floats, Mask]:
    """A homogeneous point as a pixel (2,), and its covariance (2, 2) from that of its numbers.

    The third value is False for a point at infinity, whose pixel is NaN.
    """
    x, y, w = as_array("point", point, 3)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        pixel = np.array([x, y]) / w
        J = np.column_stack([np.eye(2), -pixel]) / w
        spread = J @ as_array("covariance", covariance, 3, 3) @ J.T
    finite = np.isfinite(pixel).all() and np.isfinite(spread).all()
    return (pixel, spread, finite) if finite else (pixel * np.nan, spread * np.nan, finite)


def _across(point: Floats) -> Floats:
    """Two directions (3, 2) of unit length at right angles to a point, and to each other."""
    return np.asarray(np.linalg.svd(point[None, :])[2][1:].T)


def _joining(first: Floats, second: Floats) -> Floats:
    """Lines (N, 3) through two points (N, 2) each: (x, y, 1) × (u, v, 1), written out for speed."""
    (x, y), (u, v) = first.T, second.T
    return np.stack([y - v, u - x, x * v - y * u], axis=1)
