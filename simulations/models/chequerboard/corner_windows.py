"""Small windows of a photograph about its corners, in which these are found to parts of a pixel."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats

LUMA = (0.299, 0.587, 0.114)
"""Weights of red, green and blue, as in JPEG, whose luma has the finest detail."""

type Picture = NDArray[np.floating] | NDArray[np.uint8]
"""(H, W) grey or (H, W, 3) RGB."""


@dataclass(frozen=True, slots=True)
class Windows:
    """Pixels about N places."""

    values: Floats
    """(N, M) grey."""
    x: Floats
    """(N, M) columns."""
    y: Floats
    """(N, M) rows."""


def windows(picture: Picture, places: Floats, radius: int) -> Windows:
    """The discs of this radius about the pixels nearest to places (N, 2).

    Windows at the border repeat its pixels.
    """
    height, width = picture.shape[:2]
    down, right = np.mgrid[-radius : radius + 1, -radius : radius + 1]
    inside = np.hypot(right, down) < radius + 1.0
    middle = np.rint(places).astype(np.int64)
    column = np.clip(middle[:, :1] + right[inside], 0, width - 1)
    row = np.clip(middle[:, 1:] + down[inside], 0, height - 1)
    values = picture[row, column]
    grey = values @ np.array(LUMA) if picture.ndim == 3 else values.astype(float)
    return Windows(grey, column.astype(float), row.astype(float))


def cone(dx: Floats, dy: Floats, radius: float) -> Floats:
    """Weights (N, M): 1 at a place, 0 from ``radius`` pixels on. Placht and others, 2014, §3.3."""
    weights: Floats = np.maximum(1.0 - np.hypot(dx, dy) / (radius + 0.5), 0.0)
    return weights
