"""The planar cubic warp against Keys' published weights, OpenCV and `resampling`."""

import numpy as np
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


def test_the_last_legal_place_is_a_pixel_of_the_picture() -> None:
    x, y = np.array([[1.0, WIDTH - 2]]), np.array([[1.0, HEIGHT - 2]])
    expected = PLANES[:, [1, HEIGHT - 2], [1, WIDTH - 2]]
    np.testing.assert_array_equal(read(PLANES, x, y)[:, 0], expected)


def test_the_smallest_picture_has_as_many_pixels_as_the_kernel() -> None:
    picture = np.arange(16, dtype=np.float32).reshape(1, 4, 4)
    assert warp(cubic_warp([[1.0, 2.0]], [[1.0, 2.0]], (4, 4)), picture).tolist() == [[[5, 10]]]
    assert read(PLANES, np.empty((0, 4)), np.empty((0, 4))).shape == (3, 0, 4)


def test_one_table_serves_any_number_of_planes_and_any_layout() -> None:
    table = cubic_warp(X, Y, (HEIGHT, WIDTH))
    interleaved = np.ascontiguousarray(PLANES.transpose(1, 2, 0)).transpose(2, 0, 1)
    np.testing.assert_array_equal(warp(table, interleaved), warp(table, PLANES))
    np.testing.assert_array_equal(warp(table, PLANES[:1])[0], warp(table, PLANES)[0])
    assert warp(table, PLANES).shape == (3, 9, 14)
    assert warp(table, PLANES).dtype == np.float32
