"""Block-DCT compression against scipy's transform and Pillow's JPEG."""

import io

import numpy as np
import pytest
import scipy.fft
from numpy.typing import DTypeLike
from PIL import Image
from PIL.JpegImagePlugin import JpegImageFile

from simulations.models.arrays import Floats
from simulations.models.compression import blocks as compression
from simulations.models.compression.cosine_transforms import exact_cosines


def test_the_inverse_transform_is_scipys() -> None:
    blocks = np.random.default_rng(0).normal(size=(5, 8, 8))
    theirs = scipy.fft.idctn(blocks, axes=(1, 2), norm="ortho")
    np.testing.assert_allclose(compression.inverse_block_dct(blocks), theirs, atol=1e-12)


def test_cosines_of_many_turns_keep_all_their_digits() -> None:
    """As floats the angles reach 20.6, whose own last digit is twenty times that of a cosine."""
    exact = exact_cosines()
    k, n = np.mgrid[:8, :8]
    truth = exact[(2 * n + 1) * k % 32] / 2
    truth[0] *= exact[4]
    assert np.abs(compression.DCT - truth).max() < 1.2e-16


@pytest.mark.parametrize(
    ("tie", "nearly", "rounded"),
    [
        (None, [2.5 - 1e-12, 2.5, -2.5 + 1e-12, 2.5 - 1e-7, 2.4, 0.0], [3, 3, -3, 2, 2, 0]),
        (5e-4, [2.5 - 4e-4, -2.5 + 4e-4, 2.5 - 6e-4, 0.5 - 4e-4], [3, -3, 2, 1]),
    ],
)
def test_halves_go_outwards_however_they_were_summed(
    tie: float | None, nearly: list[float], rounded: list[int]
) -> None:
    ties = () if tie is None else (tie,)
    np.testing.assert_array_equal(compression.round_outwards(nearly, *ties), rounded)


@pytest.mark.parametrize("quality", [1, 2, 7, 33, 49, 50, 51, 75, 99, 100])
def test_tables_are_those_of_pillow(quality: int) -> None:
    file = io.BytesIO()
    Image.new("RGB", (8, 8)).save(file, "JPEG", quality=quality)
    file.seek(0)
    theirs = JpegImageFile(file).quantization
    for index, table in enumerate((compression.LUMINANCE_TABLE, compression.CHROMINANCE_TABLE)):
        ours = compression.quantisation_table(table, quality)
        np.testing.assert_array_equal(ours.reshape(-1), theirs[index])


def test_a_flat_plane_is_rounded_to_an_eighth_of_the_first_step() -> None:
    """The first coefficient of a flat block is 8 times its value, in steps of 16."""
    flat = np.full((8, 8), 10.6)  # 84.8 / 16 = 5.3
    decoded, zeros = compression.compress_plane(flat, compression.LUMINANCE_TABLE)
    np.testing.assert_allclose(decoded, 5 * 16 / 8)
    assert zeros == 63 / 64


@pytest.mark.parametrize("shape", [(9, 12), (12, 9), (3, 16), (1, 5)])
def test_fine_steps_keep_a_plane_of_any_size(shape: tuple[int, int]) -> None:
    plane = np.random.default_rng(1).normal(0, 40, shape)
    decoded, zeros = compression.compress_plane(plane, np.full((8, 8), 1e-3))
    assert decoded.shape == shape
    np.testing.assert_allclose(decoded, plane, atol=0.5e-3 * 8)
    assert zeros < 0.9


def test_the_border_is_repeated_to_whole_blocks() -> None:
    plane = np.random.default_rng(3).normal(0, 40, (10, 13))
    whole = np.pad(plane, ((0, 6), (0, 3)), mode="edge")
    table = compression.CHROMINANCE_TABLE
    decoded, zeros = compression.compress_plane(plane, table)
    theirs, theirs_zeros = compression.compress_plane(whole, table)
    np.testing.assert_allclose(decoded, theirs[:10, :13], atol=1e-10)
    assert zeros == theirs_zeros


@pytest.mark.parametrize(("dtype", "tie"), [(np.float32, 5e-4), (np.float64, 1e-9)])
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(("ties_off", "kept"), [(-1.05, 2), (-0.95, 3), (0, 3), (0.95, 3)])
def test_halves_are_told_as_well_as_the_transforms_numbers_can(
    dtype: DTypeLike, tie: float, sign: int, ties_off: float, kept: int
) -> None:
    """A transform that comes out so many ties from the half of 2.5 that it should."""

    def transform(blocks: Floats) -> Floats:
        return np.full(blocks.shape, sign * (2.5 + ties_off * tie), dtype)

    codes = compression.quantise_plane(np.zeros((8, 8)), np.ones((8, 8)), transform)
    assert (codes == sign * kept).all()


def test_codes_are_the_coefficients_in_steps() -> None:
    plane = np.random.default_rng(4).normal(0, 40, (8, 16))
    codes = compression.quantise_plane(plane, compression.LUMINANCE_TABLE)
    theirs = scipy.fft.dctn(plane[:, 8:], norm="ortho") / compression.LUMINANCE_TABLE
    np.testing.assert_array_equal(codes[0, 1], np.rint(theirs))
    assert codes.dtype == np.int64
