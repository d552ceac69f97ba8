"""Smooth waves in a different direction for each colour, so that the colours are uncorrelated."""

import numpy as np
from numpy.typing import NDArray

PERIOD_PX = 12.0
WAYS_RAD = (0.2, 1.3, 2.2)
"""Direction in which the wave of red, green and blue runs."""
LAGS_RAD = (0.0, 2.1, 4.2)


def soft_colours(width: int, height: int) -> NDArray[np.float32]:
    """(height, width, 3) linear RGB in [0.15, 0.85]."""
    x, y = np.meshgrid(np.arange(width, dtype=float), np.arange(height, dtype=float))
    waves = [
        0.5 + 0.35 * np.cos(2 * np.pi * (x * np.cos(way) + y * np.sin(way)) / PERIOD_PX + lag)
        for way, lag in zip(WAYS_RAD, LAGS_RAD, strict=True)
    ]
    return np.stack(waves, axis=-1).astype(np.float32)
