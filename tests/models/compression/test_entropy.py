"""Bits of JPEG's symbols by hand and against the files of Pillow."""

import io
import math

import numpy as np
import pytest
import skimage.data
from numpy.typing import NDArray
from PIL import Image

from simulations.models.compression import jpeg
from simulations.models.compression.entropy import LARGEST, run_symbols, size, symbol_bits
from simulations.models.compression.zigzag import ZIGZAG

PHOTO = skimage.data.astronaut()[:192, 100:340]


def one_block(codes: dict[int, int]) -> NDArray[np.int64]:
    """A block with ``codes`` {place in zigzag order: code}."""
    block = np.zeros(64, np.int64)
    for place, code in codes.items():
        block[ZIGZAG[place]] = code
    return block.reshape(1, 1, 8, 8)


@pytest.mark.parametrize(
    ("codes", "bits"),
    [
        ({}, 0),
        # Mean 5 (3 bits), then 17 zeros and a 1 (1 bit), then the end. Its symbols are one length
        # of the mean, which is certain and free, and three others at log2(3) bits each.
        ({0: 5, 18: 1}, 3 + 1 + 3 * math.log2(3)),
        (dict.fromkeys(range(1, 64), -1), 63),  # one symbol, certain and free; no end is needed
        ({1: LARGEST}, 15 + 2),
        ({1: -LARGEST}, 15 + 2),
    ],
    ids=["grey", "by hand", "full", "largest", "least"],
)
def test_bits_are_counted_as_by_hand(codes: dict[int, int], bits: float) -> None:
    assert symbol_bits([one_block(codes)]) == pytest.approx(bits)


def test_means_are_kept_as_differences_to_the_block_before() -> None:
    """Means 4, 4, 4: lengths 3, 0, 0, at 1.58 + 2 · 0.58 bits, and three bits for the 4."""
    blocks = np.concatenate([one_block({0: 4})] * 3, axis=1)
    entropy = math.log2(3) + 2 * math.log2(3 / 2)
    assert symbol_bits([blocks]) == pytest.approx(3 + entropy)


def test_planes_that_share_their_tables_share_the_rarity_of_symbols() -> None:
    flat, edge = np.zeros((1, 3, 8, 8), np.int64), one_block({0: 1})
    apart = symbol_bits([flat]) + symbol_bits([edge])
    assert apart == 1
    assert symbol_bits([flat, edge]) == pytest.approx(1 + 2 + 3 * math.log2(4 / 3))


def symbols(codes: list[dict[int, int]]) -> tuple[dict[int, int], float]:
    """{symbol: count} and bits of blocks given as {place: code} of the 63 after the mean."""
    blocks = np.zeros((len(codes), 63), np.int64)
    for block, given in zip(blocks, codes, strict=True):
        block[list(given)] = list(given.values())
    counts, bits = run_symbols(blocks)
    return {int(k): int(counts[k]) for k in np.flatnonzero(counts)}, bits


@pytest.mark.parametrize(
    ("codes", "expected", "bits"),
    [
        pytest.param({}, {0x00: 1}, 0, id="end-only"),
        pytest.param({0: 1}, {0x01: 1, 0x00: 1}, 1, id="no-zeros-before"),
        pytest.param({3: -6}, {0x33: 1, 0x00: 1}, 3, id="three-zeros-then-three-bits"),
        pytest.param({0: 2, 4: 7}, {0x02: 1, 0x33: 1, 0x00: 1}, 5, id="run-from-the-last"),
        pytest.param({15: 1}, {0xF1: 1, 0x00: 1}, 1, id="fifteen-zeros"),
        pytest.param({16: 1}, {0xF0: 1, 0x01: 1, 0x00: 1}, 1, id="sixteen-zeros"),
        pytest.param({34: 1}, {0xF0: 2, 0x21: 1, 0x00: 1}, 1, id="thirty-four-zeros"),
        pytest.param({62: -1}, {0xF0: 3, 0xE1: 1}, 1, id="to-the-very-end"),
        pytest.param({61: 1}, {0xF0: 3, 0xD1: 1, 0x00: 1}, 1, id="all-but-the-end"),
    ],
)
def test_symbols_are_those_of_the_standard(
    codes: dict[int, int], expected: dict[int, int], bits: int
) -> None:
    assert symbols([codes]) == (expected, bits)


def test_a_run_of_zeros_ends_with_its_block() -> None:
    assert symbols([{62: 1}, {2: 1}]) == ({0xF0: 3, 0xE1: 1, 0x21: 1, 0x00: 1}, 2)


@pytest.mark.parametrize("quality", [50, 75, 90])
@pytest.mark.parametrize("subsampling", ["4:4:4", "4:2:0"])
def test_the_bits_of_a_photograph_are_those_of_pillows_file(quality: int, subsampling: str) -> None:
    """Huffman's code spends whole bits on each symbol: a little more than its entropy."""
    file = io.BytesIO()
    kind = {"4:4:4": 0, "4:2:0": 2}[subsampling]
    Image.fromarray(PHOTO).save(file, "JPEG", quality=quality, subsampling=kind, optimize=True)
    data = file.getvalue()
    scan = data.index(b"\xff\xda")
    header = 2 + int.from_bytes(data[scan + 2 : scan + 4])
    theirs = 8 * len(data[scan + header : -2].replace(b"\xff\x00", b"\xff"))
    ours = size(jpeg.encode(jpeg.to_planes(PHOTO / 255), quality, subsampling))
    assert 0.96 * theirs < ours.bits < 1.005 * theirs


def test_coefficients_are_counted_in_all_three_planes() -> None:
    coded = jpeg.encode(np.full((3, 8, 8), 8.0), 50)
    assert size(coded).nonzero == 3
