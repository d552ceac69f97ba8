"""The planar cubic warp against Keys' published weights, OpenCV and `resampling`."""

import cv2
import numpy as np
import pytest
from numpy.typing import ArrayLike

from simulations.models.arrays import Floats
from simulations.models.sampling.cubic_warp import cubic_warp, warp
from simulations.models.sampling.resampling import sample

RNG = np.random.default_rng(11)
HEIGHT, WIDTH = 23, 31
PLANES = RNG.random((3, HEIGHT, WIDTH)).astype(np.float32)
X, Y = RNG.uniform(1, WIDTH - 2, (9, 14)), RNG.uniform(1, HEIGHT - 2, (9, 14))


def read(planes: Floats, x: ArrayLike = X, y: ArrayLike = Y) -> Floats:
    return warp(cubic_warp(x, y, (HEIGHT, WIDTH)), planes)


def test_it_reads_what_the_bicubic_sampler_reads() -> None:
    expected = sample(PLANES.transpose(1, 2, 0), np.stack((X, Y), -1), "bicubic")
    np.testing.assert_allclose(read(PLANES), expected.transpose(2, 0, 1), atol=1e-6)


def test_at_half_pixels_it_weighs_as_keys_published() -> None:
    """−1/16, 9/16, 9/16, −1/16 each way: the coefficients of cubic convolution at a half."""
    weights = np.array([-1, 9, 9, -1]) / 16
    expected = weights @ PLANES[0, 4:8, 9:13] @ weights
    assert read(PLANES, [[10.5]], [[5.5]])[0, 0, 0] == pytest.approx(expected, abs=1e-6)


def test_an_integer_shift_agrees_with_opencv_to_the_last_bit() -> None:
    x, y = np.meshgrid(np.arange(2, 20), np.arange(1, 15))
    expected = cv2.remap(PLANES[1], x.astype(np.float32), y.astype(np.float32), cv2.INTER_NEAREST)
    np.testing.assert_array_equal(read(PLANES, x, y)[1], expected)


def test_the_last_legal_place_is_a_pixel_of_the_picture() -> None:
    x, y = np.array([[1.0, WIDTH - 2]]), np.array([[1.0, HEIGHT - 2]])
    expected = PLANES[:, [1, HEIGHT - 2], [1, WIDTH - 2]]
    np.testing.assert_array_equal(read(PLANES, x, y)[:, 0], expected)


def test_the_smallest_picture_has_as_many_pixels_as_the_kernel() -> None:
    picture = np.arange(16, dtype=np.float32).reshape(1, 4, 4)
    assert warp(cubic_warp([[1.0, 2.0]], [[1.0, 2.0]], (4, 4)), picture).tolist() == [[[5, 10]]]
    for shape in ((3, 4), (4, 3)):
        with pytest.raises(ValueError, match="legal: 4 x 4 or more"):
            cubic_warp([[1.0]], [[1.0]], shape)


def test_one_table_serves_any_number_of_planes_and_any_layout() -> None:
    table = cubic_warp(X, Y, (HEIGHT, WIDTH))
    interleaved = np.ascontiguousarray(PLANES.transpose(1, 2, 0)).transpose(2, 0, 1)
    np.testing.assert_array_equal(warp(table, interleaved), warp(table, PLANES))
    np.testing.assert_array_equal(warp(table, PLANES[:1])[0], warp(table, PLANES)[0])
    assert warp(table, PLANES).shape == (3, 9, 14)
    assert warp(table, PLANES).dtype == np.float32


@pytest.mark.parametrize("x", [0.99, WIDTH - 1.99, np.nan, np.inf])
def test_a_place_whose_neighbours_are_missing_is_refused(x: float) -> None:
    with pytest.raises(ValueError, match=rf"x_px from .*legal: 1 to {WIDTH - 2}, of {WIDTH}"):
        cubic_warp([[5.0, x]], [[5.0, 5.0]], (HEIGHT, WIDTH))
    with pytest.raises(ValueError, match="y_px"):
        cubic_warp([[5.0, 5.0]], [[5.0, x]], (WIDTH, HEIGHT))


@pytest.mark.parametrize("shape", [(HEIGHT, WIDTH), (3, WIDTH, HEIGHT), (3, HEIGHT, WIDTH + 1)])
def test_a_picture_of_another_size_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"legal: \(channels, 23, 31\)"):
        read(np.zeros(shape, np.float32))


def test_no_places_are_no_values() -> None:
    assert read(PLANES, np.empty((0, 4)), np.empty((0, 4))).shape == (3, 0, 4)
