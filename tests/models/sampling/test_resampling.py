"""Sampling and resizing against OpenCV, SciPy and Pillow, and against what kernels reproduce."""

from collections.abc import Callable, Sequence

import cv2
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


def test_bilinear_agrees_with_opencv() -> None:
    x, y = INTERIOR.T.astype(np.float32)
    expected = cv2.remap(PICTURE, x[None], y[None], cv2.INTER_LINEAR)[0]
    np.testing.assert_allclose(sample(PICTURE, INTERIOR), expected, atol=1e-5)


def test_bilinear_with_a_repeated_border_agrees_with_scipy() -> None:
    x, y = ANYWHERE.T
    expected = map_coordinates(PICTURE, (y, x), order=1, mode="nearest")
    np.testing.assert_allclose(sample(PICTURE, ANYWHERE, fill=None), expected, atol=1e-6)


@pytest.mark.parametrize("kernel", KERNELS)
def test_pixel_centres_are_returned_unchanged(kernel: str) -> None:
    x, y = np.meshgrid(np.arange(50), np.arange(40))
    np.testing.assert_allclose(sample(PICTURE, np.stack((x, y), -1), kernel), PICTURE, atol=1e-6)


@pytest.mark.parametrize("kernel", KERNELS)
def test_a_flat_picture_stays_flat(kernel: str) -> None:
    flat = np.full((7, 9), 0.7)
    np.testing.assert_allclose(sample(flat, ANYWHERE % 7, kernel, fill=None), 0.7, atol=1e-6)


def test_keys_cubic_reproduces_quadratics() -> None:
    y, x = np.mgrid[:40, :50].astype(float)
    quadratic = 0.01 * x * x - 0.02 * y * y + 0.03 * x
    px, py = INTERIOR.T
    expected = 0.01 * px * px - 0.02 * py * py + 0.03 * px
    np.testing.assert_allclose(sample(quadratic, INTERIOR, "bicubic"), expected, atol=2e-5)


def test_off_the_picture_the_fill_value_stands() -> None:
    outside = [[-0.51, 3], [49.5, 3], [3, 1e300], [np.nan, 3], [-np.inf, 0]]
    np.testing.assert_array_equal(sample(PICTURE, outside, fill=0.25), 0.25)
    assert sample(PICTURE, [-0.5, 3], fill=9.0) == PICTURE[3, 0]


@pytest.mark.parametrize("kernel", KERNELS)
def test_one_table_serves_pictures_and_channels_alike(kernel: str) -> None:
    table = gather_table(INTERIOR.reshape(20, 15, 2), (40, 50), kernel)
    colour = np.stack((PICTURE, 1 - PICTURE), -1)
    both = gather(table, colour)
    assert both.shape == (20, 15, 2)
    assert both.dtype == np.float32
    np.testing.assert_array_equal(both[..., 0], gather(table, PICTURE))


@pytest.mark.parametrize("kernel", KERNELS)
def test_a_single_pixel_can_be_sampled(kernel: str) -> None:
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
def test_resizing_agrees_with_pillow(
    kernel: str, filter_: Image.Resampling, size: tuple[int, int]
) -> None:
    expected = Image.fromarray(PICTURE).resize(size[::-1], filter_)
    np.testing.assert_allclose(resize(PICTURE, *size, kernel), np.asarray(expected), atol=2e-6)


def test_shrinking_by_a_whole_factor_with_the_box_takes_means() -> None:
    expected = PICTURE.reshape(10, 4, 10, 5).mean(axis=(1, 3))
    np.testing.assert_allclose(resize(PICTURE, 10, 10, "nearest"), expected, atol=1e-6)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: sample(PICTURE, [0, 0], "cubic"), "cubic"),
        (lambda: resize(PICTURE, 0, 5), "legal: 1 or more"),
        (lambda: resize(PICTURE, 0, 5), "height 0"),
        (lambda: resize(PICTURE, 5, 0), "legal: 1 or more"),
        (lambda: resize(np.ones((2, 2, 3, 1)), 5, 5), r"image of shape \(2, 2, 3, 1\)"),
        (lambda: resize(np.ones(4), 5, 5), r"image of shape \(4,\)"),
        (lambda: resize(np.ones((0, 3)), 5, 5), r"image of shape \(0, 3\)"),
        (lambda: gather_table([0, 0], (0, 5)), "source_shape"),
        (lambda: gather_table([0, 0], (5, 0)), "source_shape"),
        (lambda: gather(gather_table([0, 0], (4, 5)), PICTURE), "shape"),
    ],
)
def test_meaningless_requests_are_named(call: Callable[[], object], name: str) -> None:
    with pytest.raises(ValueError, match=name):
        call()


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


def test_kernels_read_one_two_four_and_six_pixels_an_axis() -> None:
    assert {name: kernel.taps for name, kernel in KERNELS.items()} == {
        "nearest": 1, "bilinear": 2, "bicubic": 4, "spline": 4, "lanczos3": 6,
    }  # fmt: skip
    assert [kernel.radius for kernel in KERNELS.values()] == [0.5, 1, 2, 2, 3]


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


@pytest.mark.parametrize("kernel", KERNELS)
def test_off_the_picture_the_value_at_its_edge_is_repeated(kernel: str) -> None:
    away, edge = (
        [[-20.0, 3.3], [70.0, 20.2], [10.1, -1e9]],
        [[-0.5, 3.3], [49.5, 20.2], [10.1, -0.5]],
    )
    found, expected = (sample(PICTURE, places, kernel, fill=None) for places in (away, edge))
    np.testing.assert_array_equal(found, expected)
    assert sample(PICTURE, [np.nan, 3], kernel, fill=None) == sample(PICTURE, [0, 3], kernel)


def test_half_a_pixel_belongs_to_the_right_also_when_a_picture_shrinks() -> None:
    assert resize([[1.0, 4.0, 6.0]], 1, 2, "nearest").tolist() == [[1, 5]]


def test_inside_is_up_to_half_a_pixel_beyond_the_outer_centres() -> None:
    places = [
        [-0.5, 3],
        [49.49, 3],
        [3, -0.5],
        [3, 39.49],
        [-0.51, 3],
        [49.5, 3],
        [3, -0.51],
        [3, 39.5],
    ]
    assert gather_table(places, (40, 50)).inside.tolist() == [True] * 4 + [False] * 4


def test_a_table_holds_one_column_of_weights_for_each_place() -> None:
    for kernel, chosen in KERNELS.items():
        table = gather_table(INTERIOR.reshape(20, 15, 2), (40, 50), kernel)
        assert table.across.shape == table.down.shape == (chosen.taps, 300)
        assert table.corner.shape == (300,)
        assert table.shape == (20, 15)
        for weights in (table.across, table.down):
            assert weights.dtype == np.float64
            np.testing.assert_allclose(weights.sum(axis=0), 1, atol=1e-14)


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
    with pytest.raises(ValueError, match=r"^image of float64; legal: float32"):
        gather(single, PICTURE.astype(float))


def test_a_picture_is_not_resized_by_bumps_that_would_blur_it() -> None:
    with pytest.raises(
        ValueError, match=r"^kernel 'spline' .*; legal: nearest, bilinear, bicubic,"
    ):
        resize(PICTURE, 20, 20, "spline")


def test_off_the_picture_zero_stands_unless_the_border_is_asked_for() -> None:
    far = [[-20.0, 3.0], [np.nan, 3.0]]
    assert sample(PICTURE, far).tolist() == [0, 0]
    assert gather(gather_table(far, (40, 50)), PICTURE).tolist() == [0, 0]
    assert sample(PICTURE, far[0], fill=None) == PICTURE[3, 0]
    colour = np.stack((PICTURE, 1 - PICTURE), -1)
    np.testing.assert_array_equal(sample(colour, far, fill=0.5), [[0.5, 0.5]] * 2)


def test_only_float32_stays_single() -> None:
    assert sample(PICTURE.astype(float), INTERIOR).dtype == np.float64
    assert sample((255 * PICTURE).astype(np.uint8), INTERIOR).dtype == np.float64
    assert resize(PICTURE, 5, 5).dtype == np.float32
    assert resize((255 * PICTURE).astype(np.uint8), 5, 5).dtype == np.float64


@pytest.mark.parametrize("shape", [(4, 6), (5, 5), (4,), (4, 5, 3, 1)])
def test_a_table_fits_pictures_of_its_size_alone(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match="legal for the table"):
        gather(gather_table([0, 0], (4, 5)), np.zeros(shape))


def test_a_picture_of_one_row_or_column_can_be_sampled() -> None:
    assert gather_table([0, 0], (1, 1)).inside.all()
    assert sample(np.array([[1.0, 3.0]]), [0.5, 0.0]) == pytest.approx(2)


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


def test_a_picture_made_ready_for_another_kernel_is_refused() -> None:
    table = gather_table([[2.3, 4.6]], (7, 9), "bicubic")
    with pytest.raises(ValueError, match="another kernel"):
        gather(table, gather_source(np.zeros((7, 9)), "bilinear"))
