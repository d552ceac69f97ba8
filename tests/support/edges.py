"""Pictures of edges whose MTF is known, made without the book's own renderer."""

import numpy as np
from scipy.special import erf

from simulations.models.arrays import Floats, centred


def gaussian_edge(
    height: int, width: int, angle_deg: float, sigma: float = 1.0, *, bow: float = 0.0
) -> Floats:
    """(H, W) edge through the middle from 0 to 1, blurred by a Gaussian, at points.

    ``bow`` bends it into a parabola, in px per squared px.
    """
    x, y = centred(width), centred(height)[:, None]
    angle = np.deg2rad(angle_deg)
    distance = np.cos(angle) * x + np.sin(angle) * y - bow * y**2
    return np.asarray(0.5 + 0.5 * erf(distance / (np.sqrt(2.0) * sigma)))


def gaussian_half(sigma: float) -> float:
    """MTF50 of that blur, in cycles per pixel: where exp(−2 π² σ² f²) is one half."""
    return float(np.sqrt(np.log(2.0) / 2.0) / (np.pi * sigma))


def grain(shape: tuple[int, ...], sigma: float, seed: int) -> Floats:
    """White noise."""
    return np.random.default_rng(seed).normal(0.0, sigma, shape)
