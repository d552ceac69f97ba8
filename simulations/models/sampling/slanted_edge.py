"""The MTF of a camera, measured with one picture of a slanted edge.

Rows of pixels meet a slanted edge at places that differ by parts of a pixel. Sorted by their
distance from the edge, the pixels of all rows sample the edge far more finely than one row does:
the edge spread function, ESF. Its slope is the line spread function, LSF, and the size of that
one's Fourier transform is the MTF. P. D. Burns, *Slanted-edge MTF for digital camera and scanner
analysis*, 2000; ISO 12233. Lengths are in pixels, frequencies in cycles per pixel.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats
from simulations.models.pixel_grid import centred
from simulations.models.require import require

BINS = 4
"""Bins per pixel, across the edge."""
STRIPE, FINENESS = 512, 64
"""The true edge is one of many stripes this wide, so that its spectrum is a sum; and how many of
its values are computed per pixel."""


@dataclass(frozen=True, slots=True)
class EdgeReading:
    """The measurements of one picture of an edge."""

    distance: Floats
    """(N,) distance of each pixel from the edge, along its normal; positive on the lighter side."""
    value: Floats
    """(N,) value of each pixel, with 0 and 1 for the darkest and the lightest."""
    place: Floats
    """(B,) middles of the bins."""
    spread: Floats
    """(B,) ESF: the mean of each bin; NaN for a bin without pixels."""
    between: Floats
    """(B − 1,) places of the LSF, half-way from bin to bin."""
    slope: Floats
    """(B − 1,) LSF, per pixel."""

    @property
    def complete(self) -> bool:
        """Whether each bin has pixels. If not, the rows repeat each other."""
        return bool(np.isfinite(self.spread).all())

    def transfer(self, frequency: ArrayLike) -> Floats:
        """MTF (F,) at frequencies (F,) below `BINS`; NaN where the reading is not `complete`.

        Corrected for the loss of fine waves by the means over bins and the differences of bins.
        """
        cycles = np.asarray(frequency, float)
        require("frequency", cycles, np.all(np.abs(cycles) < BINS), f"below {BINS} in size")
        if not self.complete:
            return np.full(cycles.shape, np.nan)
        waves = np.exp(-2j * np.pi * cycles[..., None] * self.between)
        size: Floats = np.abs(waves @ self.slope / np.sum(self.slope))
        return size / np.square(np.sinc(cycles / BINS))


def read_edge(picture: ArrayLike, reach: float = 20.0) -> EdgeReading:
    """Measure an upright edge (H, W), less than 45° from its columns, dark on its left.

    Values must be proportional to the light. Pixels within ``reach`` of the edge take part. Raises
    `ValueError` if a row is not lighter at its last pixel than at its first.
    """
    values = np.asarray(picture, float)
    if values.ndim != 2 or min(values.shape) < 2:
        raise ValueError(f"picture of shape {values.shape}; legal: (H, W), 2 x 2 or more")
    require("picture", values, bool(np.isfinite(values).all()), "finite")
    dark, light = values.min(), values.max()
    row = centred(values.shape[0])
    crossing = _crossings(values, 0.5 * (dark + light))
    along, middle = np.polyfit(row, crossing, 1)
    column = centred(values.shape[1])
    distance = (column - middle - along * row[:, None]) / np.hypot(1.0, along)
    near = np.abs(distance) < reach
    bins = np.arange(-round(BINS * reach), round(BINS * reach))
    index = np.floor(BINS * distance[near]).astype(int) - bins[0]
    level = (values[near] - dark) / (light - dark)
    count = np.bincount(index, minlength=bins.size)
    total = np.bincount(index, level, minlength=bins.size)
    spread = np.where(count > 0, total / np.maximum(count, 1), np.nan)
    place = (bins + 0.5) / BINS
    return EdgeReading(
        distance[near], level, place, spread, 0.5 * (place[1:] + place[:-1]), BINS * np.diff(spread)
    )


def _crossings(values: Floats, level: float) -> Floats:
    """(H,) where each row first reaches the level, in columns from the middle of the picture."""
    if np.any(values[:, 0] >= level) or np.any(values[:, -1] < level):
        raise ValueError("rows that do not cross from dark to light; legal: dark on the left")
    after = np.argmax(values >= level, axis=1)
    rows = np.arange(len(values))
    left, right = values[rows, after - 1], values[rows, after]
    return after - (right - level) / (right - left) - 0.5 * (values.shape[1] - 1)


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
    left = edge * lens(frequency) * edge_transfer(frequency, angle_rad)
    rise = np.fft.irfft(left)[: STRIPE * FINENESS // 2]
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
    order = np.arange(count // 2 + 1)
    coefficients = np.zeros(order.size, complex)
    coefficients[1::2] = -1j * count / (np.pi * order[1::2])
    return order / (2 * STRIPE), coefficients
