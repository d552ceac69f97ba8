"""The exact picture of a slanted edge by a camera whose MTF is known.

Lengths are in pixels, frequencies in cycles per pixel.
"""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, centred
from simulations.models.require import require

STRIPE, FINENESS = 512, 64
"""The true edge is one of many stripes this wide, so that its spectrum is a sum; and how many of
its values are computed per pixel."""


def edge_picture(
    height: int, width: int, angle_rad: float, lens: Callable[[Floats], Floats]
) -> Floats:
    """(H, W) picture of an edge through the middle, slanted to the right.

    ``lens`` is the lens's factor at frequencies (F,); frequencies beyond `FINENESS` / 2 are
    ignored. Dark is 0 and light 1. A pixel's mean over its square is a factor too
    (`edge_transfer`), so each value follows from its distance alone. Raises `ValueError` for more
    than 45° either way.
    """
    require("angle_rad", angle_rad, abs(angle_rad) <= np.pi / 4, "at most π/4 in size")
    x, y = centred(width), centred(height)[:, None]
    distance = np.cos(angle_rad) * x + np.sin(angle_rad) * y
    frequency, edge = _edge_waves()
    left = np.zeros(2 * frequency.size, complex)  # stripes have waves of odd order alone
    left[1::2] = edge * lens(frequency) * edge_transfer(frequency, angle_rad)
    rise = np.fft.irfft(left, 2 * STRIPE * FINENESS)[: STRIPE * FINENESS // 2]
    beyond = np.interp(np.abs(distance), np.arange(rise.size) / FINENESS, rise)
    return 0.5 + np.copysign(beyond, distance)


def edge_transfer(frequency: ArrayLike, angle_rad: float) -> Floats:
    """Transfer factor (...) of a square pixel for waves across an edge at this angle."""
    cycles = np.asarray(frequency, float)
    factor: Floats = np.sinc(cycles * np.cos(angle_rad)) * np.sinc(cycles * np.sin(angle_rad))
    return factor


@lru_cache
def _edge_waves() -> tuple[Floats, NDArray[np.complex128]]:
    """Frequencies (F,) and coefficients (F,) of stripes of −½ and ½, by their Fourier series."""
    count = 2 * STRIPE * FINENESS
    order = np.arange(1, count // 2, 2)
    return order / (2 * STRIPE), np.asarray(-1j * count / (np.pi * order), complex)
