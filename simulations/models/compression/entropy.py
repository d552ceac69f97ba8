"""A lower bound on the bits of JPEG's entropy coder for the codes of a picture.

A symbol is the number of zeros before a coefficient together with its length in bits; the bits of
the coefficient follow as they are. Luma has tables of symbols of its own, the two differences share
theirs. Each symbol counts with its entropy, the bits of an ideal coder; Huffman's whole bits and
the headers of a file are extra. ITU-T T.81, annex F.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.compression.blocks import BLOCK, ZIGZAG, Codes
from simulations.models.compression.jpeg import Coded
from simulations.models.require import require

LARGEST = 2**15 - 1
"""Largest coefficient, of 15 bits: a symbol has four of its eight bits for the length."""


@dataclass(frozen=True, slots=True)
class Size:
    """The size of a compressed picture."""

    bits: float
    """Bits of an ideal entropy coder for JPEG's symbols, without headers."""
    nonzero: int
    """Count of coefficients other than 0, in all three planes."""


def size(coded: Coded) -> Size:
    """The size of a picture."""
    nonzero = sum(int(np.count_nonzero(codes)) for codes in coded.planes)
    return Size(symbol_bits([coded.luma]) + symbol_bits(coded.differences), nonzero)


def symbol_bits(planes: Sequence[Codes]) -> float:
    """Bits of planes that share a table for their means and one for all other coefficients.

    Raises `ValueError` for codes without a symbol in JPEG: fractions, and codes beyond ``LARGEST``.
    """
    for codes in planes:
        require("codes of type", codes.dtype, codes.dtype.kind in "iu", "whole numbers")
        if not np.all((codes >= -LARGEST) & (codes <= LARGEST)):
            raise ValueError(
                f"codes from {codes.min()} to {codes.max()}; legal: -{LARGEST} to {LARGEST}"
            )
    means, others = np.zeros(64), np.zeros(256)
    plain = 0.0
    for codes in planes:
        ordered = codes.reshape(-1, BLOCK * BLOCK)[:, ZIGZAG]
        lengths = _bit_length(np.diff(ordered[:, 0], prepend=0))
        means += np.bincount(lengths, minlength=64)
        symbols, extra = run_symbols(ordered[:, 1:])
        others += symbols
        plain += float(lengths.sum()) + extra
    return plain + _entropy_bits(means) + _entropy_bits(others)


def run_symbols(codes: Codes) -> tuple[Floats, float]:
    """Counts of the symbols of all coefficients but the means, and how many bits follow them.

    Parameters
    ----------
    codes : (N, 63)
        Blocks in zigzag order, without their means.

    Returns
    -------
    counts : (256,) of the symbols 16 run + length; 0x00 is the end of a block whose last codes
        are 0, and 0xF0 stands for sixteen zeros.
    bits : those of the coefficients themselves.
    """
    block, position = np.nonzero(codes)
    first = np.diff(block, prepend=-1) > 0
    before = np.where(first, -1, np.roll(position, 1))
    runs = position - before - 1
    lengths = _bit_length(codes[block, position])
    counts = np.bincount(16 * (runs % 16) + lengths, minlength=256).astype(float)
    counts[0xF0] += (runs // 16).sum()  # sixteen zeros, with more to come
    counts[0] += np.count_nonzero(codes[:, -1] == 0)  # nothing but zeros to the end
    return counts, float(lengths.sum())


def _bit_length(codes: Codes) -> NDArray[np.intp]:
    return np.asarray(np.frexp(codes.astype(float))[1], np.intp)


def _entropy_bits(counts: Floats) -> float:
    """Bits of so many symbols, each with its entropy."""
    seen = counts[counts > 0]
    return float(np.sum(seen * np.log2(seen.sum() / seen)))
