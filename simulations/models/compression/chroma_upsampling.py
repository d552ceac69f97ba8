"""Coarse colour differences interpolated to every pixel: the decoder's half of 4:2:2 and 4:2:0.

A coarse sample is the mean of its cell, located at the cell's centre, a quarter of its own spacing
from the centres of the pixels on either side. So along each halved axis every method is one row of
weights for the pixel before the centre, and the same row mirrored for the pixel after it. ITU-T
T.871 (JFIF); the triangle is the "fancy upsampling" of the Independent JPEG Group's library.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_floats
from simulations.models.compression.chroma_subsampling import coarsen
from simulations.models.require import require, require_one_of

KERNELS: Mapping[str, tuple[float, float, float, float]] = MappingProxyType(
    {
        "repeated": (0, 0, 1, 0),
        "triangle": (0, 1 / 4, 3 / 4, 0),
        "parabola": (0, 1 / 8, 1, -1 / 8),
        "cubic": (-3 / 128, 29 / 128, 111 / 128, -9 / 128),
    }
)
"""Weights of the samples two and one before, the pixel's own, and one after.

The parabola is the one that has the three nearest means, averaged over the pixel's half of its
cell: the two halves keep the mean of the cell. The cubic is Catmull and Rom's, at a quarter.
"""
LARGEST = 1e12
"""Largest code: far beyond any picture's, and small enough for every sum and square to stay
finite."""

METHODS = (*KERNELS, "guided")
"""Methods by increasing work."""

GRAIN_CODES = 12.0
"""For ``guided``: differences of luma, in codes, that are too small to predict colour."""


def refine(
    plane: ArrayLike, factor: tuple[int, int], luma: ArrayLike, method: str = "triangle"
) -> Floats:
    """A colour difference (h, w) at every pixel of the luma (H, W).

    Parameters
    ----------
    plane
        Means over cells, from `chroma_subsampling.coarsen`: ``ceil(H / rows)`` rows and so on.
    factor
        Rows and columns of a cell, 1 or 2 each.
    luma
        Sets the size; its values, in codes, matter to ``guided`` only.
    method
        One of `METHODS`.

    Raises
    ------
    ValueError
        For another method or factor, for a plane that does not fit the luma, and for values that
        are not finite or too large.
    """
    values, light = as_floats(plane), as_floats(luma)
    require_one_of("method", method, METHODS)
    require("factor", factor, set(factor) <= {1, 2}, "1 or 2 rows, 1 or 2 columns")
    fitting = tuple(-(-side // cells) for side, cells in zip(light.shape, factor, strict=False))
    if light.ndim != 2 or 0 in light.shape or values.shape != fitting:
        raise ValueError(
            f"plane of shape {values.shape} for luma of shape {light.shape}, factor {factor}; "
            "legal: one sample for each cell of a luma (H, W), not empty"
        )
    for name, codes in (("plane", values), ("luma", light)):
        if not np.all(np.abs(codes) <= LARGEST):
            raise ValueError(f"{name} reaches {np.abs(codes).max()}; legal: finite, to {LARGEST:g}")
    if method == "guided":
        return _guided(values, factor, light)
    return _interpolate(values, factor, light.shape, method)


def _interpolate(
    plane: Floats, factor: tuple[int, int], shape: tuple[int, ...], name: str
) -> Floats:
    full = plane
    for axis in (0, 1):
        if factor[axis] == 2:
            full = np.moveaxis(_doubled(np.moveaxis(full, axis, 0), KERNELS[name]), 0, axis)
    return full[: shape[0], : shape[1]]


def _doubled(plane: Floats, kernel: tuple[float, ...]) -> Floats:
    """Twice as many rows; the border is repeated."""
    count = len(plane)
    padded = np.pad(plane, ((2, 2), (0, 0)), mode="edge")
    full = np.zeros((2 * count, plane.shape[1]), plane.dtype)
    for offset, weight in zip((-2, -1, 0, 1), kernel, strict=True):
        if weight:
            full[0::2] += weight * padded[2 + offset : 2 + offset + count]
            full[1::2] += weight * padded[2 - offset : 2 - offset + count]
    return full


def _guided(plane: Floats, factor: tuple[int, int], luma: Floats) -> Floats:
    """Colour follows luma within a cell as it does among the 3 x 3 cells around it.

    He, Sun and Tang: Guided image filtering, ECCV 2010: a local regression on the guide.
    """
    coarse_luma = coarsen(luma, factor)
    light, colour = _local_mean(coarse_luma), _local_mean(plane)
    together = _local_mean(coarse_luma * plane) - light * colour
    spread = _local_mean(coarse_luma * coarse_luma) - light * light
    slope = together / (spread + GRAIN_CODES**2)
    up = {
        name: _interpolate(each, factor, luma.shape, "parabola")
        for name, each in (("plane", plane), ("luma", coarse_luma), ("slope", slope))
    }
    return up["plane"] + up["slope"] * (luma - up["luma"])


def _local_mean(plane: Floats) -> Floats:
    """Mean over 3 x 3 samples; the border is repeated."""
    padded = np.pad(plane, 1, mode="edge")
    rows = padded[:-2] + padded[1:-1] + padded[2:]
    return (rows[:, :-2] + rows[:, 1:-1] + rows[:, 2:]) / 9
