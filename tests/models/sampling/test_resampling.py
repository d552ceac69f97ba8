"""Sampling and resizing against OpenCV, SciPy and Pillow."""

from typing import Literal

import numpy as np
import pytest
from numpy.typing import ArrayLike
from PIL import Image
from scipy import ndimage
from scipy.ndimage import map_coordinates

from simulations.models.arrays import Floats
from simulations.models.sampling.bspline import coefficients
from simulations.models.sampling.cubic_warp import cubic_warp, warp
from simulations.models.sampling.magnification import magnify
from simulations.models.sampling.resampling import KERNELS, gather, gather_table, resize, sample

RNG = np.random.default_rng(3)
PICTURE = RNG.random((40, 50)).astype(np.float32)
ANYWHERE = RNG.uniform(-0.5, 39.5, (300, 2))


def test_bilinear_with_a_repeated_border_agrees_with_scipy() -> None:
    x, y = ANYWHERE.T
    expected = map_coordinates(PICTURE, (y, x), order=1, mode="nearest")
    np.testing.assert_allclose(sample(PICTURE, ANYWHERE, fill=None), expected, atol=1e-6)


@pytest.mark.parametrize(
    "outside", [[-0.51, 3], [49.5, 3], [3, -0.51], [3, 39.5], [3, 1e300], [np.nan, 3], [-np.inf, 0]]
)
def test_sample_off_the_picture_is_the_fill_value(outside: list[float]) -> None:
    colour = np.stack((PICTURE, 1 - PICTURE), -1)
    assert not gather_table(outside, (40, 50)).inside
    assert sample(PICTURE, outside) == gather(gather_table(outside, (40, 50)), PICTURE) == 0
    np.testing.assert_array_equal(sample(colour, outside, fill=0.25), [0.25, 0.25])


@pytest.mark.parametrize(
    ("place", "pixel"), [([-0.5, 3], [3, 0]), ([49.49, 3], [3, 49]), ([3, -0.5], [0, 3])]
)
def test_picture_extends_half_a_pixel_beyond_the_outer_centres(
    place: list[float], pixel: list[int]
) -> None:
    assert sample(PICTURE, place, fill=9.0) == pytest.approx(PICTURE[*pixel], abs=1e-6)


@pytest.mark.parametrize("size", [(13, 17), (80, 120), (1, 1), (41, 7)])
@pytest.mark.parametrize(
    ("kernel", "filter_"),
    [
        ("bilinear", Image.Resampling.BILINEAR),
        ("bicubic", Image.Resampling.BICUBIC),
        ("lanczos3", Image.Resampling.LANCZOS),
    ],
)
def test_resizing_agrees_with_pillow(
    kernel: str, filter_: Image.Resampling, size: tuple[int, int]
) -> None:
    expected = Image.fromarray(PICTURE).resize(size[::-1], filter_)
    np.testing.assert_allclose(resize(PICTURE, *size, kernel), np.asarray(expected), atol=2e-6)


@pytest.mark.parametrize("kernel", [name for name in KERNELS if name != "spline"])
def test_sample_is_the_weighted_sum_of_the_pixels_around_it(kernel: str) -> None:
    x, y = 20.3, 17.8
    chosen = KERNELS[kernel]
    row, column = chosen.weigh(np.arange(40) - y), chosen.weigh(np.arange(50) - x)
    if kernel == "nearest":  # half a pixel belongs to the pixel on its right
        assert sample(PICTURE, [x, y], kernel) == PICTURE[18, 20]
        assert sample(PICTURE, [20.5, 17.5], kernel) == PICTURE[18, 21]
        assert sample(PICTURE, [20.49, 17.49], kernel) == PICTURE[17, 20]
        return
    expected = (row / row.sum()) @ PICTURE @ (column / column.sum())
    assert sample(PICTURE, [x, y], kernel) == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("kernel", KERNELS)
def test_border_is_repeated_where_there_is_no_fill_value(kernel: str) -> None:
    wide = np.pad(PICTURE, 8, mode="edge")
    places = np.array(
        [[-0.4, 3.3], [49.3, 20.2], [49.49, 7.4], [10.1, -0.3], [30.7, 39.4], [0.2, 39.1]]
    )
    found = sample(PICTURE, places, kernel, fill=None)
    np.testing.assert_allclose(found, sample(wide, places + 8, kernel), atol=1e-6)


DRAWS = np.random.default_rng(4)
NORMAL = DRAWS.normal(size=(33, 41))


@pytest.mark.parametrize("order", ["C", "F"])
def test_spline_coefficients_agree_with_scipy_far_from_the_border(order: Literal["C", "F"]) -> None:
    oracle = ndimage.spline_filter(np.pad(NORMAL, 30, mode="edge"), order=3, mode="mirror")
    ours = coefficients(np.pad(NORMAL, 2, mode="edge").astype(float, order=order))
    np.testing.assert_allclose(ours, oracle[28:-28, 28:-28], atol=1e-13)


UNIFORM = np.random.default_rng(11)
HEIGHT, WIDTH = 23, 31
PLANES = UNIFORM.random((3, HEIGHT, WIDTH)).astype(np.float32)
X, Y = UNIFORM.uniform(1, WIDTH - 2, (9, 14)), UNIFORM.uniform(1, HEIGHT - 2, (9, 14))


def read(planes: Floats, x: ArrayLike = X, y: ArrayLike = Y) -> Floats:
    return warp(cubic_warp(x, y, (HEIGHT, WIDTH)), planes)


def test_cubic_warp_agrees_with_the_bicubic_sampler() -> None:
    expected = sample(PLANES.transpose(1, 2, 0), np.stack((X, Y), -1), "bicubic")
    np.testing.assert_allclose(read(PLANES), expected.transpose(2, 0, 1), atol=1e-6)


def test_magnified_ramp_stays_a_ramp() -> None:
    ramp = np.add.outer(np.arange(40.0), 3 * np.arange(60.0)).astype(np.float32)
    expected = ramp.mean() + (ramp - ramp.mean()) / 1.02
    assert magnify(ramp, 1.02)[4:-4, 4:-4] == pytest.approx(expected[4:-4, 4:-4], abs=1e-3)
