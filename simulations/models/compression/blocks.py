"""JPEG's lossy core for one plane: 8x8 blocks, a cosine transform, and quantisation by a table.

Whole pictures: `simulations.models.compression.jpeg`. Szeliski, 2nd ed., section 2.3.3; ITU-T T.81,
annex K, and the scaling of the tables by quality of the Independent JPEG Group.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from simulations.models.arrays import Floats, as_floats
from simulations.models.require import as_whole, require

type Codes = NDArray[np.int64]
type Transform = Callable[[Floats], Floats]
"""A transform of blocks (..., 8, 8) to 64 coefficients each."""

BLOCK = 8

LARGEST_CODE = 1e9
"""Largest code: far beyond any picture's, and small enough that sums of 64 cannot overflow."""

LUMINANCE_TABLE = np.array(
    [
        [16, 11, 10, 16, 24, 40, 51, 61],
        [12, 12, 14, 19, 26, 58, 60, 55],
        [14, 13, 16, 24, 40, 57, 69, 56],
        [14, 17, 22, 29, 51, 87, 80, 62],
        [18, 22, 37, 56, 68, 109, 103, 77],
        [24, 35, 55, 64, 81, 104, 113, 92],
        [49, 64, 78, 87, 103, 121, 120, 101],
        [72, 92, 95, 98, 112, 100, 103, 99],
    ]
)
"""Steps for luma at quality 50; rows are vertical frequencies."""
CHROMINANCE_TABLE = np.full((BLOCK, BLOCK), 99)
"""Steps for the colour differences at quality 50."""
CHROMINANCE_TABLE[:4, :4] = [[17, 18, 24, 47], [18, 21, 26, 66], [24, 26, 56, 99], [47, 66, 99, 99]]


TIE, TIE_FLOAT32 = 1e-9, 5e-4
"""Tolerance for sums of 64 products that are exactly a half, in either precision."""


def _dct_matrix() -> Floats:
    """Orthonormal DCT-II: row k is the cosine of frequency k / 16 cycles per sample.

    The angles, in sixteenths of a half turn, are reduced to the first quarter turn as whole
    numbers. As floats of up to 20 they would lose a digit and a half.
    """
    k, n = np.mgrid[:BLOCK, :BLOCK]
    sixteenths = (2 * n + 1) * k % (4 * BLOCK)
    folded = np.minimum(sixteenths, 4 * BLOCK - sixteenths)
    quarter = np.minimum(folded, 2 * BLOCK - folded)
    cosine = np.where(folded > BLOCK, -1.0, 1.0) * np.cos(np.pi * quarter / (2 * BLOCK))
    matrix = np.sqrt(2 / BLOCK) * cosine
    matrix[0] = np.sqrt(1 / BLOCK)
    return matrix


DCT = _dct_matrix()


def block_dct(blocks: ArrayLike) -> Floats:
    """Cosine transform of (..., 8, 8) blocks; preserves the sum of squares."""
    return DCT @ as_floats(blocks) @ DCT.T


def inverse_block_dct(coefficients: ArrayLike) -> Floats:
    """The inverse of `block_dct`."""
    return DCT.T @ as_floats(coefficients) @ DCT


def quantisation_table(table: NDArray[np.integer], quality: int) -> NDArray[np.integer]:
    """The table scaled for a quality of 1 (coarsest) to 100 (all steps 1).

    Raises `ValueError` unless the quality is one of these whole numbers.
    """
    whole = as_whole("quality", quality, 1, 100)
    percent = 5000 // whole if whole < 50 else 200 - 2 * whole
    return np.clip((table * percent + 50) // 100, 1, 255)


def round_outwards(values: ArrayLike, tie: float = TIE) -> Floats:
    """The nearest whole numbers; halves are rounded away from zero, as in the JPEG group's library.

    Sums of 8-bit values often land exactly between two whole numbers, where the last bit would
    decide. Values within ``tie`` of a half count as halves, so that every machine agrees.
    """
    exact = np.asarray(values, float)
    return np.sign(exact) * np.floor(np.abs(exact) + (0.5 + tie))


def to_blocks(plane: ArrayLike) -> Floats:
    """(H, W) as (rows, columns, 8, 8), the border repeated to whole blocks."""
    values = as_floats(plane)
    height, width = values.shape
    padded = np.pad(values, ((0, -height % BLOCK), (0, -width % BLOCK)), mode="edge")
    rows, columns = padded.shape[0] // BLOCK, padded.shape[1] // BLOCK
    return padded.reshape(rows, BLOCK, columns, BLOCK).swapaxes(1, 2)


def from_blocks(blocks: ArrayLike, height: int, width: int) -> Floats:
    """The inverse of `to_blocks`, cut to the plane's size."""
    values = as_floats(blocks)
    rows, columns = values.shape[:2]
    plane = values.swapaxes(1, 2).reshape(rows * BLOCK, columns * BLOCK)
    return plane[:height, :width]


def quantise_plane(plane: ArrayLike, table: ArrayLike, transform: Transform = block_dct) -> Codes:
    """The whole numbers that JPEG stores for one channel in codes, -128 to 127.

    Parameters
    ----------
    plane : (H, W)
        Any size from 1x1: the border is repeated to whole blocks.
    table : (8, 8)
        Quantisation steps.
    transform
        The cosine transform, or a faster approximation of it.

    Returns
    -------
    (rows, columns, 8, 8) coefficients of each block, divided by their steps and rounded.

    Raises
    ------
    ValueError
        For an empty plane, for values that are not finite or too large (one would spoil its whole
        block), and for steps that are not positive.
    """
    values = as_floats(plane)
    require("plane", values.shape, values.ndim == 2 and values.size > 0, "(H, W), not empty")
    if not np.all(np.abs(values) <= LARGEST_CODE):
        raise ValueError(
            f"plane reaches {np.abs(values).max()}; legal: finite, to {LARGEST_CODE:g}"
        )
    steps = as_floats(table)
    if not np.all((steps >= 1e-3) & np.isfinite(steps)):
        raise ValueError(f"table has a step of {steps.min()}; legal: 0.001 or more, finite")
    coefficients = transform(to_blocks(values))
    tie = TIE_FLOAT32 if coefficients.dtype == np.float32 else TIE
    return round_outwards(coefficients / steps, tie).astype(np.int64)


def restore_plane(codes: NDArray[np.integer], table: ArrayLike, height: int, width: int) -> Floats:
    """The plane (H, W) decoded from the codes of `quantise_plane`. Raises `ValueError` for codes
    that are not whole numbers.
    """
    require("codes of type", codes.dtype, codes.dtype.kind in "iu", "whole numbers")
    return from_blocks(inverse_block_dct(codes * as_floats(table)), height, width)


def compress_plane(plane: ArrayLike, table: ArrayLike) -> tuple[Floats, float]:
    """The plane (H, W) as decoded, and the share of its coefficients that became 0.

    Parameters and errors as for `quantise_plane`.
    """
    codes = quantise_plane(plane, table)
    return restore_plane(codes, table, *np.shape(plane)), float(np.mean(codes == 0))


def _zigzag() -> NDArray[np.intp]:
    """Flat indices of a block along its antidiagonals: low frequencies first, by turns."""
    row, column = np.divmod(np.arange(BLOCK * BLOCK), BLOCK)
    diagonal = row + column
    along = np.where(diagonal % 2, row, column)
    return np.lexsort((along, diagonal))


ZIGZAG = _zigzag()
RANK: NDArray[np.intp] = np.argsort(ZIGZAG).reshape(BLOCK, BLOCK)
"""(8, 8) place of each coefficient in that order, from 0."""


def first_in_order(codes: Codes, count: int) -> Codes:
    """Codes (..., 8, 8) with all but the first ``count`` of each block set to 0.

    Raises `ValueError` unless ``count`` is a whole number from 1 to 64.
    """
    return np.where(as_whole("count", count, 1, BLOCK * BLOCK) > RANK, codes, 0)
