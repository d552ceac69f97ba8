"""JPEG's cosine transform: one large product, two small ones, a Fourier transform, integers."""

import numpy as np
from numpy.typing import NDArray

from simulations.engine.ladder import Ladder, Metric, Tier
from simulations.models.compression import BLOCK, DCT, LUMINANCE_TABLE, block_dct

type Floats = NDArray[np.floating]

SIDE = 256
FIXED_BITS = 13
"""Fraction bits of the cosines in `fixed_point`, as in the slow integer transform of libjpeg."""

_DCT_32 = DCT.astype(np.float32)
_DCT_64X64 = np.kron(DCT, DCT)
_DCT_64X64_32 = _DCT_64X64.astype(np.float32)
_DCT_FIXED = np.rint(DCT * 2**FIXED_BITS).astype(np.int32)


def prepare() -> Floats:
    """Blocks (1024, 8, 8) of whole codes −128…127: waves that grow finer, an edge, grain."""
    y, x = np.mgrid[:SIDE, :SIDE] / SIDE
    waves = 60.0 * np.cos(60.0 * np.pi * (x * x + y * y))
    edge = np.where(x > y, 40.0, -40.0)
    grain = 8.0 * np.random.default_rng(3).standard_normal((SIDE, SIDE))
    codes = np.clip(np.rint(waves + edge + grain), -128, 127)
    count = SIDE // BLOCK
    grid: Floats = codes.reshape(count, BLOCK, count, BLOCK).swapaxes(1, 2)
    return grid.reshape(-1, BLOCK, BLOCK)


def reference(blocks: Floats) -> Floats:
    """The double sum of the standard, in extended precision, with cosines from nested roots."""
    cosine = cosines()
    n = np.arange(BLOCK)
    basis = np.stack([cosine[(2 * n + 1) * k % (4 * BLOCK)] for k in range(BLOCK)])
    basis = basis / 2
    basis[0] = basis[0] * cosine[4]
    wide = blocks.astype(np.longdouble)
    rows = (basis[:, :, None] * wide[:, None, :, :]).sum(axis=2)
    both: Floats = (rows[:, :, None, :] * basis).sum(axis=3)
    return both


def cosines() -> Floats:
    """cos(πj/16) for j = 0…31, by halving angles: cos(a/2) = √((1 + cos a)/2)."""
    quadrant = np.zeros(9, np.longdouble)
    quadrant[0] = 1
    for step in (8, 4, 2):
        for j in range(step // 2, 8, step):
            quadrant[j] = _root((1 + _extend(quadrant, 2 * j)) / 2)
    return np.array([_extend(quadrant, j) for j in range(32)])


def _extend(quadrant: Floats, j: int) -> np.floating:
    j = min(j, 32 - j)
    value: np.floating = quadrant[j] if j <= 8 else -quadrant[16 - j]
    return value


def _root(square: np.floating) -> np.floating:
    """Square root with a Newton step, in case the C library's is no better than float64."""
    root = np.longdouble(np.sqrt(np.float64(square)))
    improved: np.floating = (root + square / root) / 2
    return improved


def direct(blocks: Floats) -> Floats:
    """All 64 coefficients from all 64 samples in one product."""
    flat = blocks.reshape(-1, BLOCK * BLOCK) @ _DCT_64X64.T
    return flat.reshape(blocks.shape)


def direct_float32(blocks: Floats) -> Floats:
    flat = blocks.astype(np.float32).reshape(-1, BLOCK * BLOCK) @ _DCT_64X64_32.T
    return flat.reshape(blocks.shape)


def separable_float32(blocks: Floats) -> Floats:
    rows: Floats = _DCT_32 @ blocks.astype(np.float32) @ _DCT_32.T
    return rows


def by_fourier(blocks: Floats) -> Floats:
    """Rows, then columns, each as the Fourier transform of its eight samples reordered.

    Even samples forwards, then odd ones backwards; a turn by a sixteenth of the frequency
    leaves the cosines (Makhoul 1980).
    """
    order = np.array([0, 2, 4, 6, 7, 5, 3, 1])
    turn = 0.5 * np.exp(-0.5j * np.pi * np.arange(BLOCK) / BLOCK)
    turn[0] = np.sqrt(1 / BLOCK)
    done = blocks
    for _ in range(2):
        done = np.swapaxes((np.fft.fft(done[..., order]) * turn).real, -1, -2)
    return done


def fixed_point(blocks: Floats) -> Floats:
    """32-bit integers: cosines of 13 fraction bits, 3 of which are kept between the passes."""
    keep = 3
    rows = np.matmul(_DCT_FIXED, blocks.astype(np.int32))
    rows = (rows + (1 << (FIXED_BITS - keep - 1))) >> (FIXED_BITS - keep)
    both = np.matmul(rows, _DCT_FIXED.T)
    both = (both + (1 << (FIXED_BITS - 1))) >> FIXED_BITS
    codes: Floats = both / 2.0**keep
    return codes


def worst_codes(result: Floats, truth: Floats, _blocks: Floats) -> float:
    return float(np.abs(result - truth).max())


def changed_per_million(result: Floats, truth: Floats, _blocks: Floats) -> float:
    """Of a million coefficients, those that quality 50 rounds to another whole number.

    Whole codes give many sums that lie exactly between two numbers. There both are right.
    """
    quotient = truth / LUMINANCE_TABLE
    tie = np.abs(quotient - np.floor(quotient) - 0.5) < 1e-9
    changed = np.rint(result / LUMINANCE_TABLE) != np.rint(quotient)
    return float(1e6 * (changed & ~tie).mean())


LADDER = Ladder(
    id="block-dct",
    title="Transforming blocks",
    workload="256 × 256 pixels in 1024 blocks of 8 × 8 whole codes",
    prepare=prepare,
    tiers=(
        Tier("fixed-point", "Rows, columns, integers", "1024 products a block", fixed_point),
        Tier("separable-32", "Rows, columns, float32", "1024 products a block", separable_float32),
        Tier("separable", "Rows, then columns", "1024 products a block", block_dct),
        Tier("direct-32", "64 × 64 matrix, float32", "4096 products a block", direct_float32),
        Tier("direct", "64 × 64 matrix", "4096 products a block", direct),
        Tier("fourier", "By Fourier transforms", "16 transforms of 8 a block", by_fourier),
    ),
    reference=reference,
    reference_label="the standard's double sum in extended precision",
    metrics=(
        Metric("worst", "Largest error", "codes", worst_codes),
        Metric("changed", "Coefficients that round otherwise", "per million", changed_per_million),
    ),
    default_tier="separable",
)
