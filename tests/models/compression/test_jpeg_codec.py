"""JPEG’s planes, subsampled colours and pictures against Pillow, OpenCV and scikit-image."""

import io

import cv2
import numpy as np
import pytest
import skimage.data
import skimage.transform
from numpy.typing import NDArray
from PIL import Image

from simulations.models.arrays import Floats
from simulations.models.color.srgb import encode_srgb
from simulations.models.compression import blocks, jpeg
from simulations.models.compression.chroma_subsampling import coarsen
from simulations.models.compression.chroma_upsampling import GRAIN_CODES, KERNELS, refine
from simulations.pictures.balloon import balloon

PILLOW_SUBSAMPLING = {"4:4:4": 0, "4:2:2": 1, "4:2:0": 2}
PHOTO = skimage.data.astronaut()[:128, 160:288]


def by_pillow(photo: NDArray[np.uint8], quality: int, subsampling: str = "4:4:4") -> Image.Image:
    file = io.BytesIO()
    Image.fromarray(photo).save(
        file, "JPEG", quality=quality, subsampling=PILLOW_SUBSAMPLING[subsampling]
    )
    return Image.open(file)


def decoded(coded: jpeg.Coded, upsampling: str = "triangle") -> Floats:
    planes = jpeg.fill_in_colour(jpeg.restore(coded), coded.subsampling, upsampling)
    return jpeg.from_planes(planes)


def test_planes_agree_with_opencv() -> None:
    theirs = np.moveaxis(cv2.cvtColor(PHOTO, cv2.COLOR_RGB2YCrCb).astype(float), -1, 0) - 128
    ours = jpeg.to_planes(PHOTO / 255)[[0, 2, 1]]
    assert np.abs(ours - theirs).max() <= 1
    assert np.mean(ours[0] != theirs[0]) < 0.01
    assert np.mean(ours != theirs) < 0.2  # OpenCV takes the differences to a luma already rounded


@pytest.mark.parametrize("quality", [20, 75, 95])
def test_subsampled_colour_agrees_with_pillow(quality: int) -> None:
    """A file decoded at half size gives the subsampled differences as stored.

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
def test_strong_colours_are_upsampled_like_pillow(subsampling: str, quality: int) -> None:
    """With the triangle, within about a code; repetition is at least twice as far off."""
    picture = np.rint(255 * encode_srgb(balloon())).astype(np.uint8)
    theirs = np.asarray(by_pillow(picture, quality, subsampling), float)
    coded = jpeg.encode(jpeg.to_planes(picture / 255), quality, subsampling)
    off = {
        name: np.sqrt(np.mean((255 * decoded(coded, name) - theirs) ** 2))
        for name in ("triangle", "repeated")
    }
    assert off["triangle"] < 1.5
    assert off["repeated"] > 2 * off["triangle"]


@pytest.mark.parametrize("subsampling", PILLOW_SUBSAMPLING)
@pytest.mark.parametrize("shape", [(1, 1), (9, 17), (8, 8)])
def test_grey_picture_of_any_size_is_unchanged(shape: tuple[int, int], subsampling: str) -> None:
    grey = np.full((*shape, 3), 128 / 255)
    coded = jpeg.encode(jpeg.to_planes(grey), 50, subsampling)
    np.testing.assert_allclose(decoded(coded), grey, atol=0.5 / 255)


@pytest.mark.parametrize("factor", [(1, 1), (1, 2), (2, 1), (2, 2), (3, 4)])
def test_subsampling_agrees_with_scikit_image(factor: tuple[int, int]) -> None:
    rows, columns = factor
    plane = np.random.default_rng(0).normal(0, 50, (6 * rows, 5 * columns))
    theirs = skimage.transform.downscale_local_mean(plane, factor)
    np.testing.assert_allclose(coarsen(plane, factor), theirs, rtol=1e-12)


FACTORS = [(1, 1), (1, 2), (2, 1), (2, 2)]
RANDOM = np.random.default_rng(0)


def luma_for(plane: Floats, factor: tuple[int, int]) -> Floats:
    rows, columns = (side * cells for side, cells in zip(plane.shape, factor, strict=True))
    return RANDOM.normal(0, 50, (rows, columns))


@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize(
    ("method", "theirs"), [("repeated", cv2.INTER_NEAREST), ("triangle", cv2.INTER_LINEAR)]
)
def test_repetition_and_triangle_agree_with_opencv(
    method: str, theirs: int, factor: tuple[int, int]
) -> None:
    plane = RANDOM.normal(0, 50, (6, 5))
    luma = luma_for(plane, factor)
    expected = cv2.resize(plane, luma.shape[::-1], interpolation=theirs)
    np.testing.assert_allclose(refine(plane, factor, luma, method), expected, atol=1e-12)


def test_parabola_is_exact_for_means_of_a_parabola() -> None:
    """Means over cells and over half cells of 3 + 2t − t²/2, from its integral."""

    def means(edges: Floats) -> Floats:
        integral = 3 * edges + edges**2 - edges**3 / 6
        return np.diff(integral) / np.diff(edges)

    coarse, fine = means(np.arange(0.0, 9.0)), means(np.arange(0.0, 8.25, 0.5))
    ours = refine(coarse[None], (1, 2), np.zeros((1, 16)), "parabola")[0]
    np.testing.assert_allclose(ours[2:-2], fine[2:-2], atol=1e-12)


def test_cubic_weights_are_catmull_and_roms() -> None:
    """(−t + 2t² − t³)/2 and so on, at t = ¾."""
    t = 0.75
    expected = (
        (-t + 2 * t**2 - t**3) / 2,
        (2 - 5 * t**2 + 3 * t**3) / 2,
        (t + 4 * t**2 - 3 * t**3) / 2,
        (-(t**2) + t**3) / 2,
    )
    assert KERNELS["cubic"] == pytest.approx(expected)


def test_guided_slope_is_a_regression_damped_by_grain() -> None:
    """Cell by cell, by numpy's covariance of the 3 x 3 cells around it."""
    luma = RANDOM.normal(0, 30, (10, 12))
    coarse = coarsen(luma, (2, 2))
    plane = 0.5 * coarse + RANDOM.normal(0, 10, coarse.shape)
    slope = np.empty_like(plane)
    light, colour = np.pad(coarse, 1, mode="edge"), np.pad(plane, 1, mode="edge")
    for row, column in np.ndindex(plane.shape):
        around = (slice(row, row + 3), slice(column, column + 3))
        covariance = np.cov(light[around].ravel(), colour[around].ravel(), bias=True)
        slope[row, column] = covariance[0, 1] / (covariance[0, 0] + GRAIN_CODES**2)
    base, detail, scale = (
        refine(each, (2, 2), luma, "parabola") for each in (plane, coarse, slope)
    )
    expected = base + scale * (luma - detail)
    np.testing.assert_allclose(refine(plane, (2, 2), luma, "guided"), expected, atol=1e-10)
