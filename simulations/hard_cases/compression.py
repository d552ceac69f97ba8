"""Blocks that do not fit, qualities that do not exist, pictures out of range."""

import numpy as np

from simulations.engine.hard_cases import (
    HardCase,
    HardCases,
    LibraryAnswer,
    exactly,
    near,
    refused,
)
from simulations.models.compression import (
    blocks,
    chroma_subsampling,
    chroma_upsampling,
    entropy,
    jpeg,
)

JPEG = (
    "max(max(t) for t in (lambda b: [Image.new('L', (8, 8)).save(b, 'JPEG', quality={}), "
    "Image.open(b).quantization.values()][1])(__import__('io').BytesIO()))"
)

TABLE = HardCases(
    id="compression",
    title="Compression",
    names={
        **vars(blocks),
        **vars(chroma_subsampling),
        **vars(chroma_upsampling),
        **vars(jpeg),
        **vars(entropy),
        "inf": np.inf,
        "nan": np.nan,
    },
    cases=(
        HardCase(
            id="single-pixel",
            call="compress_plane([[100.0]], np.ones((8, 8)))[0]",
            why="One pixel is not a block.",
            returns="100: the border is repeated to a whole block and cut off again.",
            expected=near([[100.0]], 1e-9),
        ),
        HardCase(
            id="nine-columns",
            call="compress_plane(np.ones((8, 9)), LUMINANCE_TABLE)[0].shape",
            why="The second block holds one column of picture and seven of nothing.",
            returns="(8, 9) again.",
            expected=exactly((8, 9)),
        ),
        HardCase(
            id="flat-block",
            call="compress_plane(np.full((8, 8), 64.0), LUMINANCE_TABLE)",
            why="63 of 64 coefficients are 0, up to the rounding of cosines.",
            returns="Exactly flat, and 63/64 zeros.",
            expected=lambda got: np.allclose(got[0], 64) and got[1] == 63 / 64,
        ),
        HardCase(
            id="black-block",
            call="compress_plane(np.zeros((8, 8)), LUMINANCE_TABLE)[1]",
            why="Nothing but zeros.",
            returns="All of the coefficients are 0.",
            expected=exactly(1.0),
        ),
        HardCase(
            id="quality-zero",
            call="quantisation_table(LUMINANCE_TABLE, 0)",
            why="5000 divided by the quality.",
            returns="Refused; 1 is the coarsest.",
            expected=refused("quality 0"),
            naive="np.int64(5000) / 0",
        ),
        HardCase(
            id="quality-beyond",
            call="quantisation_table(LUMINANCE_TABLE, 101)",
            why="200 − 2·101 is negative: steps below 0.",
            returns="Refused.",
            expected=refused("quality 101"),
            naive="(16 * (200 - 2 * 101) + 50) // 100",
        ),
        HardCase(
            id="quality-between",
            call="quantisation_table(LUMINANCE_TABLE, 50.5)",
            why="A quality between two: its steps would be fractions, and no file holds them.",
            returns="Refused.",
            expected=refused("quality 50.5", "whole numbers"),
            naive="np.clip((16 * (200 - 2 * 50.5) + 50) // 100, 1, 255)",
        ),
        HardCase(
            id="coarsest",
            call="quantisation_table(LUMINANCE_TABLE, 1).max()",
            why="121 · 50 is 6050, but a step must fit into a byte.",
            returns="255.",
            expected=exactly(255),
            naive="(121 * 5000 + 50) // 100",
            library=LibraryAnswer(JPEG.format(1), "255"),
        ),
        HardCase(
            id="finest",
            call="quantisation_table(LUMINANCE_TABLE, 100).min()",
            why="0 % of 16: a step of zero divides by zero.",
            returns="1.",
            expected=exactly(1),
            naive="(16 * 0 + 50) // 100",
            library=LibraryAnswer(JPEG.format(100), "1"),
        ),
        HardCase(
            id="step-zero",
            call="compress_plane(np.ones((8, 8)), np.zeros((8, 8)))",
            why="A table with a step of zero.",
            returns="Refused.",
            expected=refused("table", "0.0"),
            naive="np.rint(np.divide(1.0, 0.0)) * 0",
        ),
        HardCase(
            id="nan-pixel",
            call="compress_plane([[nan]], np.ones((8, 8)))",
            why="One NaN reaches all 64 coefficients of its block.",
            returns="Refused: it would blot out a square of the picture.",
            expected=refused("plane", "finite"),
        ),
        HardCase(
            id="out-of-range",
            call="compress(np.full((8, 8, 3), 2.0), 90)[0].max()",
            why="Brighter than white.",
            returns="1: what is decoded is clipped.",
            expected=exactly(1.0),
        ),
        HardCase(
            id="empty",
            call="compress_plane(np.zeros((0, 8)), np.ones((8, 8)))",
            why="No pixels.",
            returns="Refused.",
            expected=refused("(0, 8)"),
        ),
        HardCase(
            id="energy",
            call="np.sum(block_dct(np.eye(8)) ** 2)",
            why="Without the factor √½ for frequency 0 the transform changes the energy.",
            returns="8, the sum of squares of the block: the basis is orthonormal.",
            expected=near(8.0),
            library=LibraryAnswer("np.sum(scipy.fft.dctn(np.eye(8), norm='ortho') ** 2)", "8"),
        ),
        HardCase(
            id="odd-colour",
            call="coarsen([[1.0, 3.0, 5.0]], (2, 2))",
            why="Three columns and one row: the last cell of 2 × 2 holds one pixel of picture.",
            returns="[2, 5]: the border is repeated, so that the mean is of pixels that exist.",
            expected=exactly(np.array([[2.0, 5.0]])),
            naive="np.array([[1.0, 3.0, 5.0]]).reshape(0, 2, 1, 2).mean(axis=(1, 3))",
        ),
        HardCase(
            id="one-pixel-of-colour",
            call="decode(encode(np.full((3, 1, 1), 16.0), 100, '4:2:0')).shape",
            why="A picture of one pixel, at a quarter of its colours.",
            returns="One pixel again.",
            expected=exactly((1, 1, 3)),
        ),
        HardCase(
            id="colour-beyond-the-border",
            call="refine([[10.0, 20.0]], (2, 2), np.zeros((1, 3)), 'triangle')",
            why="Three pixels, the last of which has its cell to itself and no next one.",
            returns="[10, 12.5, 17.5]: the border is repeated, and what is beyond it cut off.",
            expected=near([[10.0, 12.5, 17.5]]),
        ),
        HardCase(
            id="colour-without-luma",
            call="refine([[10.0, 20.0]], (2, 2), np.zeros((1, 4)), 'guided')",
            why="Luma does not vary at all: a regression on it divides 0 by 0.",
            returns="The slope is 0, and colour is filled in without luma.",
            expected=near([[8.75, 11.25, 18.75, 21.25]]),
            naive="np.divide(0.0, 0.0)",
        ),
        HardCase(
            id="unknown-subsampling",
            call="compress(np.zeros((8, 8, 3)), 50, '4:1:0')",
            why="A name that some video formats use, but no JPEG of ours.",
            returns="Refused, with the names there are.",
            expected=refused("4:1:0", "4:2:0"),
        ),
        HardCase(
            id="stripes-of-colour",
            call="np.ptp(to_planes(compress(np.where(np.arange(16)[:, None] % 2, [0.6, 0.4, 0.4], "
            "[0.4, 0.4, 0.6]) * np.ones((16, 1, 1)), 100, '4:2:0')[0])[1:], axis=(1, 2))",
            why="Columns of two colours in turns, finer than the cells, at the best quality.",
            returns="Rounding is all that is left of differences of 35 and 30 codes: both get "
            "their mean, and only luma still tells them apart.",
            expected=lambda got: got.max() <= 2,
        ),
        HardCase(
            id="nothing-to-say",
            call="symbol_bits([np.zeros((4, 4, 8, 8), int)])",
            why="One symbol only: its rarity is 1, and 0 · log 0 is lost in all the others.",
            returns="0 bits: what is certain need not be said.",
            expected=exactly(0.0),
            naive="-np.sum(np.array([1.0, 0.0]) * np.log2([1.0, 0.0]))",
        ),
        HardCase(
            id="code-without-symbol",
            call="symbol_bits([np.full((1, 1, 8, 8), 2**15)])",
            why="A symbol has four bits for the length of its coefficient, and this one has 16.",
            returns="Refused: it would be counted as another symbol.",
            expected=refused("32768", "legal"),
        ),
    ),
)
