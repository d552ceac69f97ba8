"""Pre-filters for sampling, and their effect on waves.

A pre-filter is a symmetric kernel along one axis, as a quadrature rule: places in pixels and
weights with sum 1. In two dimensions it is applied along both axes. Waves are complex exponentials,
whose phase may be quadratic, so that stripes and the zone plate are filtered by the same sum.
Szeliski, 2nd ed., sections 2.3.1 and 3.5.2.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats
from simulations.models.require import require

type Complexes = NDArray[np.complex128]

KINDS = ("none", "box", "gaussian", "sinc")
"""The kinds of `prefilter`."""
GAUSSIAN_SIGMA_PX = 0.5
"""Standard deviation of the Gaussian pre-filter: about the blur of a sharp lens."""
LOBES = 4
"""Zero crossings on each side before the windowed sinc ends."""
INTERVALS = 128
"""Intervals of Simpson's rule; its error is below 1e-4 for waves of up to 1.5 cycles per pixel."""


@dataclass(frozen=True, slots=True)
class Prefilter:
    """A symmetric kernel as a quadrature rule."""

    offsets_px: Floats
    """(n,) places relative to the sample."""
    weights: Floats
    """(n,) with sum 1, so that grey is unchanged."""


def prefilter(kind: str) -> Prefilter:
    """The pre-filter of a kind: a point, the pixel's area, or one of two bell curves."""
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
    raise ValueError(f"prefilter {kind!r}; legal: {', '.join(KINDS)}")


def _by_simpson(reach: float, kernel: Floats) -> Prefilter:
    """The rule for a kernel given at equal steps from ``-reach`` to ``reach``."""
    weights = np.full(kernel.size, 2.0)
    weights[1::2] = 4.0
    weights[[0, -1]] = 1.0
    weights *= kernel
    return Prefilter(np.linspace(-reach, reach, kernel.size), weights / weights.sum())


def transfer(kernel: Prefilter, frequency: ArrayLike) -> Floats:
    """Factor (...) on the amplitude of waves of ``frequency`` (...) cycles per pixel.

    Negative where the filter turns crests into troughs, as the box does between 1 and 2. See
    `INTERVALS` for the accuracy of the kernels that are quadratures. Raises `ValueError` for
    frequencies above 1e9, whose phase is lost to rounding.
    """
    cycles = np.asarray(frequency, float)
    require("frequency", cycles, np.all(np.abs(cycles) <= 1e9), "at most 1e9 in size")
    offsets, weights = _half(kernel)
    return np.cos(2 * np.pi * cycles[..., None] * offsets) @ weights


def _half(kernel: Prefilter) -> tuple[Floats, Floats]:
    """Places of 0 or more with the weights of both sides: opposite places sum to a cosine."""
    count = kernel.offsets_px.size
    offsets = kernel.offsets_px[count // 2 :]
    weights = 2 * kernel.weights[count // 2 :]
    if count % 2:
        weights[0] /= 2  # the middle counts once
    return offsets, weights


def filtered_wave(
    kernel: Prefilter, x: ArrayLike, frequency: float, chirp: float = 0.0
) -> Complexes:
    """The wave exp(iπ(2 f x + c x²)) after the filter, at places ``x`` (...) in pixels.

    Its local frequency is ``frequency + chirp * x`` cycles per pixel. The filter multiplies it by a
    factor: without chirp by `transfer`, the same at all places, otherwise by the same sum with
    weights times exp(iπ c o²) at the offset o.
    """
    for name, value in (("frequency", frequency), ("chirp", chirp)):
        require(name, value, abs(value) <= 1e9, "at most 1e9 in size")
    place = np.asarray(x, float)
    require("x", place, np.all(np.abs(place) <= 1e9), "at most 1e9 in size")
    wave: Complexes = np.exp(1j * np.pi * place * (2 * frequency + chirp * place))
    if chirp == 0:
        return wave * transfer(kernel, frequency)
    offsets, weights = _half(kernel)
    cosines = np.cos(2 * np.pi * (frequency + chirp * place)[..., None] * offsets)
    # A matrix product would start the threads of a linear algebra library for a few thousand sums.
    turned = weights * np.exp(1j * np.pi * chirp * offsets * offsets)
    wave *= np.einsum("...n,n->...", cosines, turned)
    return wave
