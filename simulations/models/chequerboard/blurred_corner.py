"""Where two edges cross: the light about a corner of a chequerboard, blurred by a Gaussian.

An ideal corner is +1 where a point lies on the same side of both edges, and −1 elsewhere: the
product of two signs. Blurred by a Gaussian, it is the mean of that product over two normal
variables, the distances from the two edges, whose correlation is the cosine of the angle between
the edges' normals. Z. Drezner and G. O. Wesolowsky, *On the computation of the bivariate normal
integral*, 1990, equation 3.
"""

from functools import lru_cache
from math import erf, sqrt

import numpy as np
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats

FAR, PER_UNIT = 6.0, 1024
"""Distance beyond which an edge has no effect, in standard deviations; entries of the table per
unit."""
STEEPEST = 0.995
"""Largest correlation: edges 6° apart."""


def blurred_edge(h: ArrayLike) -> Floats:
    """A blurred step (...) from −1 to 1 at distances ``h`` (...) in standard deviations."""
    distance = np.asarray(h, float)
    place = (np.clip(distance, -FAR, FAR) + FAR) * PER_UNIT
    index = np.minimum(place.astype(np.int64), _steps().size - 2)
    before = _steps()[index]
    blurred: Floats = before + (place - index) * (_steps()[index + 1] - before)
    return blurred


@lru_cache
def _steps() -> Floats:
    """erf(h/√2) for h from −`FAR` to `FAR`: linear between entries to 6e-8."""
    count = round(2 * FAR * PER_UNIT) + 1
    return np.array([erf((n / PER_UNIT - FAR) / sqrt(2.0)) for n in range(count)])


def blurred_corner(h: ArrayLike, k: ArrayLike, correlation: ArrayLike) -> Floats:
    """The corner (...) in [−1, 1], at distances from its two edges.

    Parameters
    ----------
    h, k : (...) signed distances from the edges in standard deviations of the blur.
    correlation : (...) cosine of the angle between the normals of the edges, within ± `STEEPEST`.
    """
    first, second = np.asarray(h, float), np.asarray(k, float)
    product = blurred_edge(first) * blurred_edge(second)
    lean = np.arcsin(np.clip(correlation, -STEEPEST, STEEPEST))
    squares, cross = first * first + second * second, 2.0 * first * second
    for node, weight in _gauss_legendre():
        sine = np.sin(0.5 * (node + 1.0) * lean)
        exponent = (cross * sine - squares) / (2.0 * (1.0 - sine * sine))
        product = product + (weight * lean / np.pi) * np.exp(exponent)
    return product


@lru_cache
def _gauss_legendre() -> tuple[tuple[float, float], ...]:
    nodes, weights = np.polynomial.legendre.leggauss(8)
    return tuple(zip(nodes.tolist(), weights.tolist(), strict=True))
