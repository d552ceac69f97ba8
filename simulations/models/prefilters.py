"""What a picture is averaged with before it is sampled, and what that leaves of a wave.

A pre-filter is a symmetric kernel along one axis, held as a quadrature rule: places in pixels
and weights that add up to 1. In two dimensions it is applied along both axes. Waves are complex
exponentials, whose phase may be quadratic, so that stripes and the zone plate are filtered by
the same sum. Szeliski, 2nd ed., sections 2.3.1 and 3.5.2.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

type Floats = NDArray[np.float64]
type Complexes = NDArray[np.complex128]

GAUSSIAN_SIGMA_PX = 0.5
"""Blur of the Gaussian pre-filter: about that of a sharp lens."""
LOBES = 4
"""Zero crossings on each side before the windowed sinc ends."""
INTERVALS = 128
"""Of Simpson's rule; for waves of up to 1.5 cycles per pixel its error is below 1e-4."""


@dataclass(frozen=True, slots=True)
class Prefilter:
    """A symmetric kernel as a quadrature rule."""

    offsets_px: Floats
    """(n,) places relative to the sample."""
    weights: Floats
    """(n,) that add up to 1: grey stays as it is."""


def prefilter(kind: str) -> Prefilter:
    """``none`` (a point), ``box`` (the pixel's area), ``gaussian`` or ``sinc`` (windowed)."""
    match kind:
        case "none":
            return Prefilter(np.zeros(1), np.ones(1))
        case "box":
            return _by_simpson(0.5, np.ones(INTERVALS + 1))
        case "gaussian":
            reach = 5 * GAUSSIAN_SIGMA_PX
            offsets = np.linspace(-reach, reach, INTERVALS + 1)
            return _by_simpson(reach, np.exp(-0.5 * (offsets / GAUSSIAN_SIGMA_PX) ** 2))
        case "sinc":
            offsets = np.linspace(-LOBES, LOBES, INTERVALS + 1)
            return _by_simpson(LOBES, np.sinc(offsets) * np.sinc(offsets / LOBES))
    raise ValueError(f"prefilter: {kind!r}; legal: none, box, gaussian, sinc")


def _by_simpson(reach: float, kernel: Floats) -> Prefilter:
    """The rule for a kernel given at equal steps from ``-reach`` to ``reach``."""
    weights = np.full(kernel.size, 2.0)
    weights[1::2] = 4.0
    weights[[0, -1]] = 1.0
    weights *= kernel
    return Prefilter(np.linspace(-reach, reach, kernel.size), weights / weights.sum())


def transfer(kernel: Prefilter, frequency: ArrayLike) -> Floats:
    """Factor (...) on the amplitude of waves of ``frequency`` (...) cycles per pixel.

    Negative where the filter turns crests into troughs, as the box does between 1 and 2.
    """
    turns = np.asarray(frequency, float)[..., None] * kernel.offsets_px
    factor: Floats = np.cos(2 * np.pi * turns) @ kernel.weights
    return factor


def filtered_wave(
    kernel: Prefilter, x: ArrayLike, frequency: float, chirp: float = 0.0
) -> Complexes:
    """The wave exp(iπ(2 f x + c x²)) after the filter, at places ``x`` (...) in pixels.

    Its local frequency is ``frequency + chirp * x`` cycles per pixel.
    """
    seen = np.asarray(x, float)[..., None] - kernel.offsets_px
    wave: Complexes = np.exp(1j * np.pi * seen * (2 * frequency + chirp * seen)) @ kernel.weights
    return wave
