"""Sampling and resizing against OpenCV, SciPy and Pillow, and against what kernels reproduce."""

import cv2
import numpy as np
import pytest
from PIL import Image
from scipy.ndimage import map_coordinates

from simulations.models.resampling import KERNELS, gather, gather_table, resize, sample

RNG = np.random.default_rng(3)
PICTURE = RNG.random((40, 50)).astype(np.float32)
INTERIOR = np.stack((RNG.uniform(4, 45, 300), RNG.uniform(4, 35, 300)), axis=-1)
ANYWHERE = RNG.uniform(-0.5, 39.5, (300, 2))


def test_bilinear_agrees_with_opencv():
    x, y = INTERIOR.T.astype(np.float32)
    expected = cv2.remap(PICTURE, x[None], y[None], cv2.INTER_LINEAR)[0]
    np.testing.assert_allclose(sample(PICTURE, INTERIOR), expected, atol=1e-5)


def test_bilinear_with_a_repeated_border_agrees_with_scipy():
    x, y = ANYWHERE.T
    expected = map_coordinates(PICTURE, (y, x), order=1, mode="nearest")
    np.testing.assert_allclose(sample(PICTURE, ANYWHERE, fill=None), expected, atol=1e-6)


@pytest.mark.parametrize("kernel", KERNELS)
def test_pixel_centres_are_returned_unchanged(kernel):
    x, y = np.meshgrid(np.arange(50), np.arange(40))
    np.testing.assert_allclose(sample(PICTURE, np.stack((x, y), -1), kernel), PICTURE, atol=1e-6)


@pytest.mark.parametrize("kernel", KERNELS)
def test_a_flat_picture_stays_flat(kernel):
    flat = np.full((7, 9), 0.7)
    np.testing.assert_allclose(sample(flat, ANYWHERE % 7, kernel, fill=None), 0.7, atol=1e-6)


def test_keys_cubic_reproduces_quadratics():
    y, x = np.mgrid[:40, :50].astype(float)
    quadratic = 0.01 * x * x - 0.02 * y * y + 0.03 * x
    px, py = INTERIOR.T
    expected = 0.01 * px * px - 0.02 * py * py + 0.03 * px
    np.testing.assert_allclose(sample(quadratic, INTERIOR, "bicubic"), expected, atol=2e-5)


def test_off_the_picture_the_fill_value_stands():
    outside = [[-0.51, 3], [49.5, 3], [3, 1e300], [np.nan, 3], [-np.inf, 0]]
    np.testing.assert_array_equal(sample(PICTURE, outside, fill=0.25), 0.25)
    assert sample(PICTURE, [-0.5, 3], fill=9.0) == PICTURE[3, 0]


@pytest.mark.parametrize("kernel", KERNELS)
def test_one_table_serves_pictures_and_channels_alike(kernel):
    table = gather_table(INTERIOR.reshape(20, 15, 2), (40, 50), kernel)
    colour = np.stack((PICTURE, 1 - PICTURE), -1)
    both = gather(table, colour)
    assert both.shape == (20, 15, 2)
    assert both.dtype == np.float32
    np.testing.assert_array_equal(both[..., 0], gather(table, PICTURE))


@pytest.mark.parametrize("kernel", KERNELS)
def test_a_single_pixel_can_be_sampled(kernel):
    assert sample(np.array([[0.3]]), [0.2, -0.4], kernel) == pytest.approx(0.3)


@pytest.mark.parametrize("size", [(13, 17), (80, 120), (1, 1), (41, 7)])
@pytest.mark.parametrize(
    ("kernel", "filter_"),
    [
        ("bilinear", Image.Resampling.BILINEAR),
        ("bicubic", Image.Resampling.BICUBIC),
        ("lanczos3", Image.Resampling.LANCZOS),
    ],
)
def test_resizing_agrees_with_pillow(kernel, filter_, size):
    expected = Image.fromarray(PICTURE).resize(size[::-1], filter_)
    np.testing.assert_allclose(resize(PICTURE, *size, kernel), np.asarray(expected), atol=2e-6)


def test_shrinking_by_a_whole_factor_with_the_box_takes_means():
    expected = PICTURE.reshape(10, 4, 10, 5).mean(axis=(1, 3))
    np.testing.assert_allclose(resize(PICTURE, 10, 10, "nearest"), expected, atol=1e-6)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: sample(PICTURE, [0, 0], "cubic"), "cubic"),
        (lambda: resize(PICTURE, 0, 5), "height 0"),
        (lambda: gather_table([0, 0], (0, 5)), "source_shape"),
        (lambda: gather(gather_table([0, 0], (4, 5)), PICTURE), "shape"),
    ],
)
def test_meaningless_requests_are_named(call, name):
    with pytest.raises(ValueError, match=name):
        call()
