"""Divide out the colour of the light, and guess it from the picture.

Colours are arrays (..., 3), linear. Szeliski, 2nd ed., section 2.3.2.
"""

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats, as_colours
from simulations.models.require import require


def white_balance(linear: ArrayLike, illuminant_rgb: ArrayLike) -> Floats:
    """Divide out the colour of the light, keeping green as it is (von Kries, in camera RGB).

    Raises `ValueError` if the light lacks a channel altogether: nothing can restore it.
    """
    light = np.asarray(illuminant_rgb, np.float64)
    if light.shape != (3,) or not np.all((light > 0) & np.isfinite(light)):
        raise ValueError(f"illuminant {light.tolist()}; legal: three finite numbers above 0")
    rgb = as_colours(linear)
    with np.errstate(over="ignore", invalid="ignore"):
        gains = (light[1] / light).astype(rgb.dtype)
        return rgb * np.minimum(gains, np.finfo(rgb.dtype).max)  # black stays black


def grey_world(linear: ArrayLike) -> Floats:
    """Estimate of the light's colour, (3,): the mean of the picture, were the world grey."""
    colours = as_colours(linear)
    require("picture", colours.shape, colours.size > 0, "one pixel or more")
    with np.errstate(over="ignore", invalid="ignore"):
        return colours.reshape(-1, 3).mean(axis=0)
