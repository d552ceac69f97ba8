"""JPEG's planes and pictures against Pillow's, at every colour subsampling."""

import io

import cv2
import numpy as np
import pytest
import skimage.data
from numpy.typing import NDArray
from PIL import Image

from simulations.models.color.srgb import encode_srgb
from simulations.models.compression import blocks, jpeg
from simulations.pictures.balloon import balloon

PILLOW_SUBSAMPLING = {"4:4:4": 0, "4:2:2": 1, "4:2:0": 2}
PHOTO = skimage.data.astronaut()[:128, 160:288]


def by_pillow(photo: NDArray[np.uint8], quality: int, subsampling: str = "4:4:4") -> Image.Image:
    file = io.BytesIO()
    Image.fromarray(photo).save(
        file, "JPEG", quality=quality, subsampling=PILLOW_SUBSAMPLING[subsampling]
    )
    return Image.open(file)


def test_planes_are_those_of_opencv() -> None:
    theirs = np.moveaxis(cv2.cvtColor(PHOTO, cv2.COLOR_RGB2YCrCb).astype(float), -1, 0) - 128
    ours = jpeg.to_planes(PHOTO / 255)[[0, 2, 1]]
    assert np.abs(ours - theirs).max() <= 1
    assert np.mean(ours[0] != theirs[0]) < 0.01
    assert np.mean(ours != theirs) < 0.2  # OpenCV takes the differences to a luma already rounded


@pytest.mark.parametrize("quality", [20, 75, 95])
def test_coarse_colour_is_that_of_pillow(quality: int) -> None:
    """A file decoded at half size gives the coarse differences as they were kept.

    Pillow rounds the means of the cells to whole codes, so that now and then a coefficient
    falls on the other side of a half.
    """
    image = by_pillow(PHOTO, quality, "4:2:0")
    image.draft("YCbCr", (64, 64))
    theirs = np.moveaxis(np.asarray(image, float), -1, 0)[1:] - 128
    coded = jpeg.encode(jpeg.to_planes(PHOTO / 255), quality, "4:2:0")
    coarse = jpeg.tables(quality)[1]
    for codes, plane in zip(coded.differences, theirs, strict=True):
        restored = blocks.restore_plane(codes, coarse, 64, 64)
        assert np.sqrt(np.mean((restored - plane) ** 2)) < 1.0


@pytest.mark.parametrize("quality", [30, 75, 95])
@pytest.mark.parametrize("subsampling", ["4:2:2", "4:2:0"])
def test_strong_colours_are_filled_in_as_by_pillow(subsampling: str, quality: int) -> None:
    """By the triangle, and to about a code. Repetition is twice as far from that."""
    picture = np.rint(255 * encode_srgb(balloon())).astype(np.uint8)
    theirs = np.asarray(by_pillow(picture, quality, subsampling), float)
    coded = jpeg.encode(jpeg.to_planes(picture / 255), quality, subsampling)
    off = {
        name: np.sqrt(np.mean((255 * jpeg.decode(coded, name) - theirs) ** 2))
        for name in ("triangle", "repeated")
    }
    assert off["triangle"] < 1.5
    assert off["repeated"] > 2 * off["triangle"]


@pytest.mark.parametrize("subsampling", PILLOW_SUBSAMPLING)
@pytest.mark.parametrize("shape", [(1, 1), (9, 17), (8, 8)])
def test_any_size_keeps_its_size_and_grey_stays_grey(
    shape: tuple[int, int], subsampling: str
) -> None:
    grey = np.full((*shape, 3), 128 / 255)
    decoded, _ = jpeg.compress(grey, 50, subsampling)
    np.testing.assert_allclose(decoded, grey, atol=0.5 / 255)


def test_a_coded_picture_knows_how_to_be_decoded() -> None:
    coded = jpeg.encode(jpeg.to_planes(PHOTO[:20, :30] / 255), 60, "4:2:2")
    assert (coded.height, coded.width, coded.quality, coded.subsampling) == (20, 30, 60, "4:2:2")
    assert jpeg.decode(coded).shape == (20, 30, 3)
    assert [codes.shape[:2] for codes in coded.planes] == [(3, 4), (3, 2), (3, 2)]


def test_the_picture_is_clipped_and_its_zeros_are_those_of_all_channels() -> None:
    checks = np.zeros((8, 16, 3))
    checks[::2, ::2] = 1
    decoded, zeros = jpeg.compress(checks, 5)
    assert decoded.min() >= 0
    assert decoded.max() <= 1
    luma = np.rint(255 * checks[..., 0]) - 128
    coarse = blocks.quantisation_table(blocks.LUMINANCE_TABLE, 5)
    # Grey has no colour differences: those two channels are zero throughout.
    assert zeros == pytest.approx((blocks.compress_plane(luma, coarse)[1] + 2) / 3)
