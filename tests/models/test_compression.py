"""Block-DCT compression against scipy's transform and Pillow's JPEG."""

import io

import numpy as np
import pytest
import scipy.fft
import skimage.data
from PIL import Image

from simulations.models import compression


def test_block_dct_agrees_with_scipy_and_comes_back():
    blocks = np.random.default_rng(0).normal(size=(5, 8, 8))
    theirs = scipy.fft.dctn(blocks, axes=(1, 2), norm="ortho")
    np.testing.assert_allclose(compression.block_dct(blocks), theirs, atol=1e-12)
    np.testing.assert_allclose(compression.inverse_block_dct(theirs), blocks, atol=1e-12)


@pytest.mark.parametrize("quality", [1, 10, 50, 90, 100])
def test_tables_are_those_of_pillow(quality):
    file = io.BytesIO()
    Image.new("RGB", (8, 8)).save(file, "JPEG", quality=quality)
    theirs = Image.open(file).quantization
    for index, table in enumerate((compression.LUMINANCE_TABLE, compression.CHROMINANCE_TABLE)):
        ours = compression.quantisation_table(table, quality)
        np.testing.assert_array_equal(ours.reshape(-1), theirs[index])


@pytest.mark.parametrize("quality", [20, 75])
def test_a_photograph_comes_out_as_from_pillow(quality):
    photo = skimage.data.astronaut()[:128, 160:288]
    file = io.BytesIO()
    Image.fromarray(photo).save(file, "JPEG", quality=quality, subsampling=0)
    theirs = np.asarray(Image.open(file), float)
    ours = 255 * compression.compress(photo / 255, quality)[0]
    assert np.sqrt(np.mean((ours - theirs) ** 2)) < 1.0


def test_lower_quality_leaves_more_zeros():
    photo = skimage.data.astronaut()[:64, :64] / 255
    zeros = [compression.compress(photo, quality)[1] for quality in (95, 50, 5)]
    assert zeros == sorted(zeros)
    assert zeros[2] > 0.9


@pytest.mark.parametrize("shape", [(1, 1), (9, 17), (8, 8)])
def test_any_size_keeps_its_size_and_grey_stays_grey(shape):
    grey = np.full((*shape, 3), 128 / 255)
    np.testing.assert_allclose(compression.compress(grey, 50)[0], grey, atol=0.5 / 255)


def test_quality_outside_its_range_is_refused():
    with pytest.raises(ValueError, match="1 to 100"):
        compression.quantisation_table(compression.LUMINANCE_TABLE, 0)
