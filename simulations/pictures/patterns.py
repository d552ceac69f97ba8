"""Antialiased surface patterns: each is the mean over the pixel, not the value at its centre."""

import numpy as np

from simulations.models.arrays import Floats

NARROWEST = 1e-6
"""Pixel width below which a pattern is taken at a point: keeps the quotient of `stripes` finite."""


def pixel_width(coordinate: Floats) -> Floats:
    """How far ``coordinate`` (H, W) runs across one pixel, both ways together."""
    down, across = np.gradient(coordinate)
    return np.abs(down) + np.abs(across)


def stripes(phase: Floats, width: Floats) -> Floats:
    """Mean over ``width`` of a square wave: +1 on [0, 1), −1 on [1, 2), and so on.

    The integral of a square wave is a triangle wave; its difference over the width is exact.
    """
    span = np.maximum(width, NARROWEST)
    return 2.0 * (_triangle(phase - span / 2) - _triangle(phase + span / 2)) / span


def _triangle(phase: Floats) -> Floats:
    return np.abs(phase / 2 - np.floor(phase / 2) - 0.5)


def chequer(u: Floats, v: Floats) -> Floats:
    """Share of the light squares of a unit chequerboard in each pixel, in [0, 1]."""
    return 0.5 + 0.5 * stripes(u, pixel_width(u)) * stripes(v, pixel_width(v))


def band(distance: Floats, half_width: float) -> Floats:
    """Share of each pixel within ``half_width`` of the line where ``distance`` is 0."""
    width = np.maximum(pixel_width(distance), NARROWEST)
    upper = np.minimum(distance + width / 2, half_width)
    lower = np.maximum(distance - width / 2, -half_width)
    return np.maximum(upper - lower, 0.0) / width


def siemens_star(x: Floats, y: Floats, spokes: int) -> Floats:
    """Share of the light spokes: resolution falls towards the centre, where they blend to grey."""
    radius = np.hypot(x, y)
    angle = np.arctan2(y, x)
    pixel = 0.5 * (pixel_width(x) + pixel_width(y))
    turns = spokes / np.pi  # a spoke and its gap span a phase of 2
    return 0.5 + 0.5 * stripes(angle * turns, pixel * turns / np.maximum(radius, NARROWEST))
