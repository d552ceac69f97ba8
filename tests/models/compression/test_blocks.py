"""Cosine transforms, blocks and symbols of JPEG, against SciPy, Pillow and the standard."""

import io

import numpy as np
import pytest
import scipy.fft
import skimage.data
from numpy.typing import DTypeLike
from PIL import Image
from PIL.JpegImagePlugin import JpegImageFile
from scipy.fft import dctn

from simulations.models.arrays import Floats
from simulations.models.compression import blocks as compression
from simulations.models.compression import jpeg
from simulations.models.compression.blocks import RANK, ZIGZAG, first_in_order
from simulations.models.compression.cosine_transforms import exact_block_dct
from simulations.models.compression.entropy import run_symbols, size


def test_inverse_transform_agrees_with_scipy() -> None:
    blocks = np.random.default_rng(0).normal(size=(5, 8, 8))
    theirs = scipy.fft.idctn(blocks, axes=(1, 2), norm="ortho")
    np.testing.assert_allclose(compression.inverse_block_dct(blocks), theirs, atol=1e-12)


@pytest.mark.parametrize("quality", [1, 2, 7, 33, 49, 50, 51, 75, 99, 100])
def test_quantisation_tables_agree_with_pillow(quality: int) -> None:
    file = io.BytesIO()
    Image.new("RGB", (8, 8)).save(file, "JPEG", quality=quality)
    file.seek(0)
    theirs = JpegImageFile(file).quantization
    for index, table in enumerate((compression.LUMINANCE_TABLE, compression.CHROMINANCE_TABLE)):
        ours = compression.quantisation_table(table, quality)
        np.testing.assert_array_equal(ours.reshape(-1), theirs[index])


@pytest.mark.parametrize(("dtype", "tie"), [(np.float32, 5e-4), (np.float64, 1e-9)])
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("ties_off", "kept"), [(-1.05, 2), (-0.95, 3), (0, 3), (0.95, 3)])
def test_halves_are_recognised_within_the_transforms_precision(
    dtype: DTypeLike, tie: float, sign: int, ties_off: float, kept: int
) -> None:
    """With a transform whose result is off from 2.5 by a multiple of the tolerance for ties."""

    def transform(blocks: Floats) -> Floats:
        return np.full(blocks.shape, sign * (2.5 + ties_off * tie), dtype)

    codes = compression.quantise_plane(np.zeros((8, 8)), np.ones((8, 8)), transform)
    assert (codes == sign * kept).all()


CODES = np.random.default_rng(5).integers(-128, 128, (3, 50, 8, 8)).astype(float)
ORACLE = dctn(CODES, type=2, norm="ortho", axes=(-2, -1))


def test_exact_transform_agrees_with_scipy_and_keeps_more_digits() -> None:
    truth = exact_block_dct(CODES)
    assert truth.dtype == np.longdouble
    np.testing.assert_allclose(truth.astype(float), ORACLE, atol=1e-12)
    # An orthonormal transform keeps the sum of squares: here to the digits beyond float64's.
    kept = (truth**2).sum(axis=(-2, -1)) / (CODES**2).sum(axis=(-2, -1)).astype(np.longdouble)
    wider = float(np.finfo(np.longdouble).eps)
    assert float(np.abs(kept - 1).max()) < 100 * max(wider, 1e-19)


ASTRONAUT = skimage.data.astronaut()[:192, 100:340]


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
def test_run_symbols_agree_with_the_standard(
    codes: dict[int, int], expected: dict[int, int], bits: int
) -> None:
    assert symbols([codes]) == (expected, bits)


def test_run_of_zeros_ends_with_its_block() -> None:
    assert symbols([{62: 1}, {2: 1}]) == ({0xF0: 3, 0xE1: 1, 0x21: 1, 0x00: 1}, 2)


@pytest.mark.parametrize("quality", [50, 75, 90])
@pytest.mark.parametrize("subsampling", ["4:4:4", "4:2:0"])
def test_bits_of_a_photograph_agree_with_pillows_file(quality: int, subsampling: str) -> None:
    """Huffman's code spends whole bits on each symbol, a little more than the entropy."""
    file = io.BytesIO()
    kind = {"4:4:4": 0, "4:2:0": 2}[subsampling]
    Image.fromarray(ASTRONAUT).save(file, "JPEG", quality=quality, subsampling=kind, optimize=True)
    data = file.getvalue()
    scan = data.index(b"\xff\xda")
    header = 2 + int.from_bytes(data[scan + 2 : scan + 4])
    theirs = 8 * len(data[scan + header : -2].replace(b"\xff\x00", b"\xff"))
    ours = size(jpeg.encode(jpeg.to_planes(ASTRONAUT / 255), quality, subsampling))
    assert 0.96 * theirs < ours.bits < 1.005 * theirs


def test_zigzag_starts_as_in_the_standard_and_visits_every_place() -> None:
    assert ZIGZAG[:10].tolist() == [0, 1, 8, 16, 9, 2, 3, 10, 17, 24]
    assert ZIGZAG[-3:].tolist() == [55, 62, 63]
    assert RANK.ravel()[ZIGZAG].tolist() == list(range(64))


@pytest.mark.parametrize("count", [1, 3, 63, 64])
def test_first_coefficients_in_zigzag_order_are_kept(count: int) -> None:
    codes = np.arange(1, 129).reshape(2, 8, 8)
    kept = first_in_order(codes, count)
    assert np.count_nonzero(kept, axis=(1, 2)).tolist() == [count, count]
    np.testing.assert_array_equal(
        kept.reshape(2, 64)[:, ZIGZAG[:count]], codes.reshape(2, 64)[:, ZIGZAG[:count]]
    )
