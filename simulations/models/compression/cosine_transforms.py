"""Other computations of the cosine transform of 8x8 blocks, and a reference for all.

All map blocks (..., 8, 8) of codes about 0 to coefficients of the same shape. `blocks.block_dct`
does so by two small products.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.compression.blocks import BLOCK, DCT, Transform, block_dct

FIXED_BITS = 13
"""Fraction bits of the cosines in `fixed_point`, as in the slow integer transform of libjpeg."""
PASS_BITS = 3
"""Fraction bits between its two passes."""
SAMPLE_BITS = 2
"""Fraction bits of its samples: a mean of four whole codes is still exact."""

_DCT_32 = DCT.astype(np.float32)
_DCT_64X64 = np.kron(DCT, DCT)
_DCT_64X64_32 = _DCT_64X64.astype(np.float32)
_DCT_FIXED = np.rint(DCT * 2**FIXED_BITS).astype(np.int32)


def direct(blocks: Floats) -> Floats:
    """All 64 coefficients from all 64 samples in one product."""
    flat = blocks.reshape(-1, BLOCK * BLOCK) @ _DCT_64X64.T
    return flat.reshape(blocks.shape)


def direct_float32(blocks: Floats) -> Floats:
    flat = blocks.astype(np.float32).reshape(-1, BLOCK * BLOCK) @ _DCT_64X64_32.T
    return flat.reshape(blocks.shape)


def separable_float32(blocks: Floats) -> Floats:
    return _DCT_32 @ blocks.astype(np.float32) @ _DCT_32.T


def dct_by_fourier(blocks: Floats) -> Floats:
    """Rows, then columns, each as the Fourier transform of its eight samples reordered.

    Even samples forwards, then odd ones backwards; a turn by a sixteenth of the frequency
    leaves the cosines (Makhoul 1980). Frequencies above the fourth mirror those below it.
    """
    order = np.array([0, 2, 4, 6, 7, 5, 3, 1])
    turn = 0.5 * np.exp(-0.5j * np.pi * np.arange(BLOCK) / BLOCK)
    turn[0] = np.sqrt(1 / BLOCK)
    done = blocks
    for _ in range(2):
        half = np.fft.rfft(done[..., order])
        whole = np.concatenate([half, half[..., 3:0:-1].conj()], axis=-1)
        done = np.swapaxes((whole * turn).real, -1, -2)
    return done


def fixed_point(blocks: Floats) -> Floats:
    """32-bit integers: samples in quarters of a code, cosines of 13 bits, eighths in between."""
    samples = np.rint(blocks * 2**SAMPLE_BITS).astype(np.int32)
    rows = _shift(np.matmul(_DCT_FIXED, samples), FIXED_BITS + SAMPLE_BITS - PASS_BITS)
    both = _shift(np.matmul(rows, _DCT_FIXED.T), FIXED_BITS)
    return both / 2.0**PASS_BITS


def _shift(numbers: NDArray[np.int32], bits: int) -> NDArray[np.int32]:
    """Divided by 2^bits to the nearest whole number."""
    return (numbers + (1 << (bits - 1))) >> bits


TRANSFORMS: Mapping[str, Transform] = MappingProxyType(
    {
        "fixed-point": fixed_point,
        "separable-32": separable_float32,
        "separable": block_dct,
        "direct-32": direct_float32,
        "direct": direct,
        "fourier": dct_by_fourier,
    }
)
"""The transforms by their names in the ladder `block-dct`."""


def exact_block_dct(blocks: Floats) -> Floats:
    """The double sum of the standard, in extended precision, with cosines from nested roots.

    It shares nothing with the transforms above. It is a reference only, being very slow.
    """
    cosine = exact_cosines()
    n = np.arange(BLOCK)
    basis = np.stack([cosine[(2 * n + 1) * k % (4 * BLOCK)] for k in range(BLOCK)])
    basis = basis / 2
    basis[0] = basis[0] * cosine[4]
    wide = blocks.astype(np.longdouble)
    rows = (basis[:, :, None] * wide[..., None, :, :]).sum(axis=-2)
    return (rows[..., :, None, :] * basis).sum(axis=-1)


def exact_cosines() -> Floats:
    """cos(πj/16) for j = 0…31, by halving angles: cos(a/2) = √((1 + cos a)/2)."""
    quadrant = np.zeros(9, np.longdouble)
    quadrant[0] = 1
    for step in (8, 4, 2):
        for j in range(step // 2, 8, step):
            quadrant[j] = _root((1 + _extend(quadrant, 2 * j)) / 2)
    return np.array([_extend(quadrant, j) for j in range(32)])


def _extend(quadrant: Floats, j: int) -> np.floating:
    j = min(j, 32 - j)
    return quadrant[j] if j <= 8 else -quadrant[16 - j]


def _root(square: np.floating) -> np.floating:
    """Square root with a Newton step, as a C library's extended one may have only float64's
    precision."""
    root = np.longdouble(np.sqrt(np.float64(square)))
    return (root + square / root) / 2
