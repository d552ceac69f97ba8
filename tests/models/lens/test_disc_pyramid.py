"""Discs on a coarser grid: the right amount of blur, nearly the right shape."""

import numpy as np
import pytest
from numpy.typing import NDArray

from simulations.models.arrays import Floats
from simulations.models.lens.disc_blur import disc_blur
from simulations.models.lens.disc_pyramid import double, halve, pyramid_blur


def spread_of(radius: float, offset: int = 0, size: int = 161) -> tuple[Floats, NDArray[np.int64]]:
    """A point of light (size, size) after the blur, and the columns counted from the point."""
    light = np.zeros((1, size, size), np.float32)
    light[0, size // 2, size // 2 + offset] = 1.0
    columns = np.arange(size) - size // 2 - offset
    return pyramid_blur(light, radius)[0].astype(float), columns


@pytest.mark.parametrize("radius", [8.01, 12.5, 15.9, 16.1, 30.0])
@pytest.mark.parametrize("offset", [0, 1, 3])
def test_blur_keeps_light_and_place_and_has_the_variance_of_a_disc(
    radius: float, offset: int
) -> None:
    spread, columns = spread_of(radius, offset)
    assert spread.sum() == pytest.approx(1, rel=1e-5)
    for line in (spread.sum(0), np.roll(spread, offset, axis=0).sum(1)):
        assert (line * columns).sum() == pytest.approx(0, abs=1e-3)
        assert (line * columns**2).sum() == pytest.approx(radius**2 / 4 + 1 / 12, rel=0.02)


def test_up_to_the_largest_reduced_radius_nothing_is_reduced() -> None:
    picture = np.random.default_rng(0).random((2, 20, 24)).astype(np.float32)
    for radius in (0.9, 3.0, 8.0):
        assert np.array_equal(pyramid_blur(picture, radius), disc_blur(picture, radius))
    assert pyramid_blur(picture, 0.0) is picture


@pytest.mark.parametrize("radius", [9.0, 20.0])
def test_flat_light_stays_flat_and_an_uneven_picture_keeps_its_size(radius: float) -> None:
    for shape in ((3, 23, 31), (1, 8, 7), (1, 1, 5)):
        blurred = pyramid_blur(np.full(shape, 0.4, np.float32), radius)
        assert blurred.shape == shape
        np.testing.assert_allclose(blurred, 0.4, atol=1e-6)


def test_it_is_near_the_exact_disc() -> None:
    picture = np.random.default_rng(0).random((1, 90, 90)).astype(np.float32)
    picture[:, 30:60, 30:60] += 3
    for radius in (8.5, 12.0, 20.0):
        off = pyramid_blur(picture, radius) - disc_blur(picture, radius)
        assert np.abs(off).max() < 0.03 * 4


def test_doubling_interpolates_and_holds_the_border() -> None:
    planes = np.array([[[0.0, 4.0, 8.0]]], np.float32)
    assert double(planes)[0].tolist() == [[0, 1, 3, 5, 7, 8]] * 2
    assert double(planes.swapaxes(1, 2))[0].T.tolist() == [[0, 1, 3, 5, 7, 8]] * 2


def test_halving_is_the_transpose_of_doubling() -> None:
    rng = np.random.default_rng(6)
    coarse, fine = rng.random((2, 3, 5)), rng.random((2, 6, 10))
    half = halve(fine.astype(np.float32))
    there = (double(coarse.astype(np.float32)) * fine).sum()
    assert there == pytest.approx(4 * (coarse * half).sum(), rel=1e-6)
    assert halve(np.zeros((2, 7, 8), np.float32)).shape == (2, 4, 4)
    assert halve(np.zeros((2, 8, 7), np.float32)).shape == (2, 4, 4)
