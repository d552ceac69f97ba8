"""Sampling and resizing against OpenCV, SciPy and Pillow, and against what kernels reproduce."""

from collections.abc import Sequence

import numpy as np
import pytest
from PIL import Image
from scipy.ndimage import map_coordinates

from simulations.models.sampling.resampling import (
    KERNELS,
    gather,
    gather_source,
    gather_table,
    resize,
    sample,
)

RNG = np.random.default_rng(3)
PICTURE = RNG.random((40, 50)).astype(np.float32)
INTERIOR = np.stack((RNG.uniform(4, 45, 300), RNG.uniform(4, 35, 300)), axis=-1)
ANYWHERE = RNG.uniform(-0.5, 39.5, (300, 2))


def test_bilinear_with_a_repeated_border_agrees_with_scipy() -> None:
    x, y = ANYWHERE.T
    expected = map_coordinates(PICTURE, (y, x), order=1, mode="nearest")
    np.testing.assert_allclose(sample(PICTURE, ANYWHERE, fill=None), expected, atol=1e-6)


@pytest.mark.parametrize(
    "outside",
    [[-0.51, 3], [49.5, 3], [3, -0.51], [3, 39.5], [3, 1e300], [np.nan, 3], [-np.inf, 0]],
)
def test_off_the_picture_the_fill_value_stands(outside: list[float]) -> None:
    colour = np.stack((PICTURE, 1 - PICTURE), -1)
    assert not gather_table(outside, (40, 50)).inside
    assert sample(PICTURE, outside) == gather(gather_table(outside, (40, 50)), PICTURE) == 0
    np.testing.assert_array_equal(sample(colour, outside, fill=0.25), [0.25, 0.25])


@pytest.mark.parametrize(
    ("place", "pixel"), [([-0.5, 3], [3, 0]), ([49.49, 3], [3, 49]), ([3, -0.5], [0, 3])]
)
def test_inside_is_up_to_half_a_pixel_beyond_the_outer_centres(
    place: list[float], pixel: list[int]
) -> None:
    assert sample(PICTURE, place, fill=9.0) == pytest.approx(PICTURE[*pixel], abs=1e-6)


@pytest.mark.parametrize("kernel", KERNELS)
def test_one_table_serves_pictures_and_channels_alike(kernel: str) -> None:
    table = gather_table(INTERIOR.reshape(20, 15, 2), (40, 50), kernel)
    colour = np.stack((PICTURE, 1 - PICTURE), -1)
    both = gather(table, colour)
    assert both.shape == (20, 15, 2)
    assert both.dtype == np.float32
    np.testing.assert_array_equal(both[..., 0], gather(table, PICTURE))


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


@pytest.mark.parametrize(
    ("kernel", "distances", "weights"),
    [
        ("nearest", [-0.51, -0.5, 0.0, 0.49, 0.5], [0, 1, 1, 1, 0]),
        ("bilinear", [-1.0, -0.25, 0.0, 0.75, 1.2], [0, 0.75, 1, 0.25, 0]),
        (
            "bicubic",
            [0.0, 0.5, -0.5, 1.0, 1.5, -1.5, 2.0],
            [1, 9 / 16, 9 / 16, 0, -1 / 16, -1 / 16, 0],
        ),
        ("lanczos3", [0.0, 0.5, 1.0, -2.5, 3.0], [1, 6 / np.pi**2, 0, 0.0243171, 0]),
    ],
)
def test_each_kernel_has_its_textbook_weights(
    kernel: str, distances: list[float], weights: Sequence[float]
) -> None:
    np.testing.assert_allclose(KERNELS[kernel].weigh(np.array(distances)), weights, atol=1e-7)


@pytest.mark.parametrize("kernel", [name for name in KERNELS if name != "spline"])
def test_a_value_is_the_weighted_sum_of_the_pixels_around_it(kernel: str) -> None:
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
def test_beyond_the_border_the_border_repeats(kernel: str) -> None:
    wide = np.pad(PICTURE, 8, mode="edge")
    places = np.array(
        [[-0.4, 3.3], [49.3, 20.2], [49.49, 7.4], [10.1, -0.3], [30.7, 39.4], [0.2, 39.1]]
    )
    found = sample(PICTURE, places, kernel, fill=None)
    np.testing.assert_allclose(found, sample(wide, places + 8, kernel), atol=1e-6)


def test_half_a_pixel_belongs_to_the_right_also_when_a_picture_shrinks() -> None:
    assert resize([[1.0, 4.0, 6.0]], 1, 2, "nearest").tolist() == [[1, 5]]


@pytest.mark.parametrize("kernel", KERNELS)
def test_pictures_in_float64_are_weighed_in_float64(kernel: str) -> None:
    """Weights in float32 were off by 0.04 among values of ten million."""
    y, x = np.mgrid[:40, :50].astype(float)
    found = sample(1e7 + 0.25 * x - 0.125 * y, INTERIOR, kernel)
    px, py = np.floor(INTERIOR.T + 0.5) if kernel == "nearest" else INTERIOR.T
    # With any weights Lanczos only nearly follows a ramp, and the spline feels where it ends.
    off = {"lanczos3": 1e-2, "spline": 2e-4}.get(kernel, 2e-8)
    np.testing.assert_allclose(found, 1e7 + 0.25 * px - 0.125 * py, rtol=0, atol=off)
    if kernel != "nearest":
        lifted = sample(1e7 + PICTURE.astype(float), INTERIOR, kernel) - 1e7
        np.testing.assert_allclose(
            lifted, sample(PICTURE.astype(float), INTERIOR, kernel), atol=1e-7
        )


def test_a_table_of_single_weights_serves_single_pictures_alone() -> None:
    single = gather_table(INTERIOR, (40, 50), "bicubic", np.float32)
    assert single.across.dtype == single.down.dtype == np.float32
    np.testing.assert_array_equal(gather(single, PICTURE), sample(PICTURE, INTERIOR, "bicubic"))
    np.testing.assert_array_equal(
        gather(gather_table(INTERIOR, (40, 50), "bicubic"), PICTURE), gather(single, PICTURE)
    )


def test_channels_are_resized_each_on_its_own() -> None:
    colour = np.stack((PICTURE, 1 - PICTURE, PICTURE**2), -1)
    resized = resize(colour, 13, 17, "bicubic")
    assert resized.shape == (13, 17, 3)
    for channel in range(3):
        np.testing.assert_allclose(
            resized[..., channel], resize(colour[..., channel], 13, 17, "bicubic"), atol=1e-6
        )


@pytest.mark.parametrize("kernel", KERNELS)
def test_a_picture_made_ready_once_is_read_as_the_picture_is(kernel: str) -> None:
    picture = np.random.default_rng(3).random((7, 9, 3), np.float32)
    table = gather_table([[2.3, 4.6], [-0.4, 0.1]], (7, 9), kernel, np.float32)
    ready = gather_source(picture, kernel)
    np.testing.assert_array_equal(gather(table, ready), gather(table, picture))
