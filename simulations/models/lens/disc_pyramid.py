"""Blur by discs on a coarser grid: faster than `disc_blur` for wide discs, with softer edges.

Pictures are planar: (C, H, W) float32. Burt, "Fast filter transforms for image processing",
Computer Graphics and Image Processing 16, 1981.
"""

import math

import numpy as np

from simulations.models.arrays import Planes
from simulations.models.lens.disc_blur import check_radius, disc_blur

LARGEST_REDUCED_RADIUS = 8.0
"""Largest radius in pixels of the grid that it is drawn on. On a coarser grid at least half of it
remains, which is enough for the outline."""


def pyramid_blur(planes: Planes, radius_px: float) -> Planes:
    """``planes`` (C, H, W) convolved with about a disc; the border pixels repeat beyond the edge.

    Up to `LARGEST_REDUCED_RADIUS` the same as `disc_blur`. Wider discs are drawn on a grid reduced
    by a power of two, at a cost that hardly depends on the radius. Reducing and enlarging also
    blurs, so the disc on the coarse grid is smaller: the total variance is right, but the fourth
    moment is up to an eighth too large, for a softer outline.
    """
    check_radius(radius_px)
    halvings = max(0, math.ceil(math.log2(max(radius_px, 1.0) / LARGEST_REDUCED_RADIUS)))
    height, width = planes.shape[1:]
    small = planes
    for _ in range(halvings):
        small = halve(small)
    small = disc_blur(small, _reduced_radius(radius_px, 2**halvings))
    for _ in range(halvings):
        small = double(small)
    return small if halvings == 0 else np.ascontiguousarray(small[:, :height, :width])


def _reduced_radius(radius_px: float, factor: int) -> float:
    """Radius in coarse pixels for which the total variance is ``R²/4 + 1/12``, as in `disc_blur`.

    Along each axis reducing and enlarging add (factor² − 1) / 2, and the disc r²/4 + 1/12 in coarse
    pixels.
    """
    return math.sqrt((radius_px**2 + 1 / 3 - 2 * (factor**2 - 1)) / factor**2 - 1 / 3)


def halve(planes: Planes) -> Planes:
    """Half the grid by weights (1, 3, 3, 1) / 8 each way, the transpose of `double`.

    Unlike means of 2 × 2 pixels, they do not shift points of light.
    """
    return _halve_last(_halve_last(planes).swapaxes(1, 2)).swapaxes(1, 2)


def _halve_last(planes: Planes) -> Planes:
    padded = np.pad(planes, ((0, 0), (0, 0), (1, 1 + planes.shape[2] % 2)), mode="edge")
    outer = padded[..., 0:-3:2] + padded[..., 3::2]
    inner = padded[..., 1:-2:2] + padded[..., 2:-1:2]
    return np.float32(0.125) * outer + np.float32(0.375) * inner


def double(planes: Planes) -> Planes:
    """Linear interpolation onto twice the grid, the inverse placement of `halve`."""
    return _double_last(_double_last(planes).swapaxes(1, 2)).swapaxes(1, 2)


def _double_last(planes: Planes) -> Planes:
    near = np.float32(0.75) * planes
    far = np.float32(0.25) * planes
    doubled = np.empty((*planes.shape[:2], 2 * planes.shape[2]), np.float32)
    doubled[..., 0::2] = near
    doubled[..., 1::2] = near
    doubled[..., 2::2] += far[..., :-1]
    doubled[..., 1:-1:2] += far[..., 1:]
    doubled[..., 0] += far[..., 0]
    doubled[..., -1] += far[..., -1]
    return doubled
