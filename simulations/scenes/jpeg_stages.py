"""What the JPEG figure computes: planes → blocks → whole-number codes → planes → picture, and bits.

The steps are those of `simulations.models.compression`, taken apart so that the codes of a block
can be shown and counted.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from simulations.engine.pipeline import Stage
from simulations.models.color import encode_srgb, rgb_to_ycbcr, ycbcr_to_rgb
from simulations.models.compression import (
    BLOCK,
    CHROMINANCE_TABLE,
    LUMINANCE_TABLE,
    block_dct,
    inverse_block_dct,
    quantisation_table,
    round_outwards,
)
from simulations.models.demosaicing import psnr_db
from simulations.pictures.balloon import balloon

type Floats = NDArray[np.floating]
type Codes = NDArray[np.int64]

SUBSAMPLING = {"4:4:4": (1, 1), "4:2:2": (1, 2), "4:2:0": (2, 2)}
"""Rows and columns of luma to one colour difference."""


def _zigzag() -> NDArray[np.intp]:
    """Flat indices of a block along its antidiagonals: low frequencies first, by turns."""
    row, column = np.divmod(np.arange(BLOCK * BLOCK), BLOCK)
    diagonal = row + column
    along = np.where(diagonal % 2, row, column)
    return np.lexsort((along, diagonal))


ZIGZAG = _zigzag()


@dataclass(frozen=True, slots=True)
class Coded:
    """A picture as JPEG keeps it."""

    luma: Codes
    """(block rows, block columns, 8, 8) quantised coefficients; rows are vertical frequencies."""
    differences: tuple[Codes, Codes]
    """Likewise for blue and red difference, on their coarser grid."""


@dataclass(frozen=True, slots=True)
class Size:
    """What keeping a picture costs."""

    bits: float
    """Of an ideal entropy coder for JPEG's symbols, without headers."""
    nonzero: int
    """Coefficients other than 0, in all three planes."""


def to_blocks(plane: Floats) -> Floats:
    """(H, W) as (rows, columns, 8, 8), the border repeated to whole blocks."""
    height, width = plane.shape
    padded = np.pad(plane, ((0, -height % BLOCK), (0, -width % BLOCK)), mode="edge")
    rows, columns = padded.shape[0] // BLOCK, padded.shape[1] // BLOCK
    return padded.reshape(rows, BLOCK, columns, BLOCK).swapaxes(1, 2)


def from_blocks(blocks: Floats, height: int, width: int) -> Floats:
    """The inverse of `to_blocks`, cut to the plane's size."""
    rows, columns = blocks.shape[:2]
    plane = blocks.swapaxes(1, 2).reshape(rows * BLOCK, columns * BLOCK)
    return plane[:height, :width]


def coarsen(plane: Floats, factor: tuple[int, int]) -> Floats:
    """Means over cells of ``factor`` (rows, columns) samples, which must divide the plane."""
    rows, columns = factor
    height, width = plane.shape
    cells = plane.reshape(height // rows, rows, width // columns, columns)
    return np.asarray(cells.mean(axis=(1, 3)))


def encode(planes: Floats, quality: float, subsampling: str) -> Coded:
    """Transform, divide, round; ``planes`` (3, H, W) are Y, Cb, Cr in codes about 0."""
    fine = quantisation_table(LUMINANCE_TABLE, int(quality))
    coarse = quantisation_table(CHROMINANCE_TABLE, int(quality))
    factor = SUBSAMPLING[subsampling]
    blue, red = (_codes(coarsen(plane, factor), coarse) for plane in planes[1:])
    return Coded(_codes(planes[0], fine), (blue, red))


def _codes(plane: Floats, table: NDArray[np.integer]) -> Codes:
    return round_outwards(block_dct(to_blocks(plane)) / table).astype(np.int64)


def decode(coded: Coded, planes: Floats, quality: float, subsampling: str) -> Floats:
    """(H, W, 3) sRGB in [0, 1]; a coarse colour difference is repeated over its pixels."""
    height, width = planes.shape[1:]
    rows, columns = SUBSAMPLING[subsampling]
    fine = quantisation_table(LUMINANCE_TABLE, int(quality))
    coarse = quantisation_table(CHROMINANCE_TABLE, int(quality))
    luma = from_blocks(inverse_block_dct(coded.luma * fine), height, width)
    differences = (
        from_blocks(inverse_block_dct(codes * coarse), height // rows, width // columns)
        for codes in coded.differences
    )
    full = [np.repeat(np.repeat(plane, rows, axis=0), columns, axis=1) for plane in differences]
    ycbcr = np.stack([luma + 128, *full], axis=-1) / 255
    picture: Floats = np.clip(ycbcr_to_rgb(ycbcr), 0, 1)
    return picture


def size(coded: Coded) -> Size:
    """Bits by JPEG's own symbols, each at the cost of its entropy.

    A symbol is the number of zeros before a coefficient together with its length in bits; the
    bits follow as they are. Luma has its tables of symbols, the two differences share theirs.
    """
    planes = (coded.luma, *coded.differences)
    nonzero = sum(int(np.count_nonzero(codes)) for codes in planes)
    return Size(symbol_bits([coded.luma]) + symbol_bits(list(coded.differences)), nonzero)


def symbol_bits(planes: list[Codes]) -> float:
    """Bits of planes that share one table for their means and one for all other coefficients."""
    means, others = np.zeros(64), np.zeros(256)
    plain = 0.0
    for codes in planes:
        ordered = codes.reshape(-1, BLOCK * BLOCK)[:, ZIGZAG]
        lengths = _bit_length(np.diff(ordered[:, 0], prepend=0))
        means += np.bincount(lengths, minlength=64)
        symbols, extra = _run_symbols(ordered[:, 1:])
        others += symbols
        plain += float(lengths.sum()) + extra
    return plain + _entropy_bits(means) + _entropy_bits(others)


def _run_symbols(codes: Codes) -> tuple[Floats, float]:
    """Counts (256,) of the symbols 16 run + length of (N, 63) codes, and the bits that follow."""
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
    return np.asarray(np.frexp(np.abs(codes).astype(float))[1], np.intp)


def _entropy_bits(counts: Floats) -> float:
    """Bits of that many symbols when each costs the logarithm of its rarity."""
    seen = counts[counts > 0]
    return float(np.sum(seen * np.log2(seen.sum() / seen)))


def _original() -> Floats:
    """(H, W, 3) sRGB of the balloon, in whole codes of 255.

    Encoded in float64: powers of float32 differ between machines by enough to move a code.
    """
    return np.asarray(np.rint(255 * encode_srgb(balloon().astype(np.float64))) / 255)


def _planes(original: Floats) -> Floats:
    planes = round_outwards(255 * np.moveaxis(rgb_to_ycbcr(original), -1, 0))
    planes[0] -= 128
    return np.asarray(planes)


def _quality(decoded: Floats, original: Floats) -> float:
    return psnr_db(np.rint(255 * decoded) / 255, original, crop=0)


STAGES = (
    Stage("original", (), _original),
    Stage("planes", (), _planes, ("original",)),
    Stage("coded", ("quality", "subsampling"), encode, ("planes",)),
    Stage("decoded", ("quality", "subsampling"), decode, ("coded", "planes")),
    Stage("size", (), size, ("coded",)),
    Stage("psnr", (), _quality, ("decoded", "original")),
)
