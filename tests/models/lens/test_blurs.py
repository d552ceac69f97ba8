"""Disc blurs against exact areas and SciPy’s convolution; pyramids, layers and screen blurs."""

import math

import numpy as np
import pytest
import scipy.ndimage
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy import integrate, ndimage

from simulations.models.arrays import Floats
from simulations.models.lens.depth_of_field import Layer, blur_by_depth, composite
from simulations.models.lens.disc_blur import NARROW_RADIUS, disc_blur, disc_kernel
from simulations.models.lens.disc_pyramid import double, halve, pyramid_blur
from simulations.models.lens.screen_blur import binned_gaussian, gather_discs

RNG = np.random.default_rng(0)


def offsets(kernel: Floats) -> tuple[Floats, Floats]:
    """Columns and rows of a kernel, from its middle."""
    reach = kernel.shape[0] // 2
    away = np.arange(-reach, reach + 1.0)
    columns, rows = np.meshgrid(away, away)
    return columns, rows


def mean(kernel: Floats, values: Floats) -> float:
    return float((kernel.astype(float) * values).sum())


def covered(radius: float, x: float, y: float) -> float:
    """Area of the disc within the unit square around (x, y), by adaptive quadrature."""

    def height(at: float) -> float:
        half = math.sqrt(max(radius**2 - at**2, 0.0))
        return max(min(half, y + 0.5) - max(-half, y - 0.5), 0.0)

    kinks = [
        sign * math.sqrt(radius**2 - edge**2)
        for edge in (y - 0.5, y + 0.5)
        for sign in (-1, 1)
        if radius > abs(edge)
    ]
    inside = [at for at in (*kinks, -radius, radius) if x - 0.5 < at < x + 0.5]
    area, _ = integrate.quad(height, x - 0.5, x + 0.5, points=inside or None, epsabs=1e-11)
    return area


@pytest.mark.parametrize("radius", [0.62, 0.8, 1.0, 1.5, 2.2, 3.4, 3.6])
def test_each_weight_is_the_area_of_the_pixel_covered_by_the_disc(radius: float) -> None:
    kernel = disc_kernel(radius)
    for x, y, weight in zip(
        *(values.ravel() for values in (*offsets(kernel), kernel)), strict=True
    ):
        assert weight * math.pi * radius**2 == pytest.approx(covered(radius, x, y), abs=2e-6)


@given(radius=st.floats(1e-6, NARROW_RADIUS))
def test_narrow_kernel_has_the_variance_of_its_disc(radius: float) -> None:
    kernel = disc_kernel(radius)
    columns, _ = offsets(kernel)
    assert mean(kernel, columns**2) == pytest.approx(radius**2 / 4, rel=1e-3)


@pytest.mark.parametrize("radius", [0.2, 0.52, 1.5, 1.51, 2.4, 4.9, 6.0, 6.1, 9.3, 24.0])
def test_disc_blur_is_convolution_with_its_kernel(radius: float) -> None:
    picture = RNG.random((2, 20, 24)).astype(np.float32)
    kernel = disc_kernel(radius).astype(float)
    wanted = [ndimage.convolve(plane, kernel, mode="nearest") for plane in picture.astype(float)]
    np.testing.assert_allclose(disc_blur(picture, radius), wanted, atol=2e-6)


def spread_of(radius: float, offset: int = 0, size: int = 161) -> tuple[Floats, NDArray[np.int64]]:
    """A point of light (size, size) after the blur, and the columns counted from the point."""
    light = np.zeros((1, size, size), np.float32)
    light[0, size // 2, size // 2 + offset] = 1.0
    columns = np.arange(size) - size // 2 - offset
    return pyramid_blur(light, radius)[0].astype(float), columns


@pytest.mark.parametrize("radius", [8.01, 12.5, 15.9, 16.1, 30.0])
@pytest.mark.parametrize("offset", [0, 1, 3])
def test_pyramid_blur_keeps_light_and_place_with_a_discs_variance(
    radius: float, offset: int
) -> None:
    spread, columns = spread_of(radius, offset)
    assert spread.sum() == pytest.approx(1, rel=1e-5)
    for line in (spread.sum(0), np.roll(spread, offset, axis=0).sum(1)):
        assert (line * columns).sum() == pytest.approx(0, abs=1e-3)
        assert (line * columns**2).sum() == pytest.approx(radius**2 / 4 + 1 / 12, rel=0.02)


def test_small_radii_are_blurred_without_reduction() -> None:
    picture = np.random.default_rng(0).random((2, 20, 24)).astype(np.float32)
    for radius in (0.9, 3.0, 8.0):
        assert np.array_equal(pyramid_blur(picture, radius), disc_blur(picture, radius))
    assert pyramid_blur(picture, 0.0) is picture


def test_halving_is_the_transpose_of_doubling() -> None:
    rng = np.random.default_rng(6)
    coarse, fine = rng.random((2, 3, 5)), rng.random((2, 6, 10))
    half = halve(fine.astype(np.float32))
    there = (double(coarse.astype(np.float32)) * fine).sum()
    assert there == pytest.approx(4 * (coarse * half).sum(), rel=1e-6)
    assert halve(np.zeros((2, 7, 8), np.float32)).shape == (2, 4, 4)
    assert halve(np.zeros((2, 8, 7), np.float32)).shape == (2, 4, 4)


@pytest.mark.parametrize("radius", [0.1, 0.2, 0.7, 2.0, 3.3, 11.0])
def test_blur_by_depth_is_the_disc_where_the_depth_is_uniform(radius: float) -> None:
    picture = np.random.default_rng(0).random((1, 30, 30)).astype(np.float32)
    assert blur_by_depth(picture, np.full((30, 30), radius)) == pytest.approx(
        disc_blur(picture, radius), abs=1e-6
    )


def test_pixel_mixes_the_two_blur_levels_next_to_its_radius() -> None:
    """Halfway between the squares of 2 and 4: half of each level's blur."""
    picture = np.random.default_rng(3).random((1, 30, 34)).astype(np.float32)
    column = np.arange(34) + np.zeros((30, 1))
    radius = np.where(column < 10, math.sqrt(10), np.where(column < 20, 0.0, 4.0))
    mixed = blur_by_depth(picture, radius)
    expected = 0.5 * (disc_blur(picture, 2.0) + disc_blur(picture, 4.0))
    assert mixed[..., :10] == pytest.approx(expected[..., :10], abs=1e-6)
    assert mixed[..., 10:20] == pytest.approx(picture[..., 10:20], abs=1e-6)
    assert mixed[..., 20:] == pytest.approx(disc_blur(picture, 4.0)[..., 20:], abs=1e-6)


def test_layers_are_composited_by_their_coverage() -> None:
    background = np.random.default_rng(1).random((3, 6, 7)).astype(np.float32)
    planes = np.random.default_rng(2).random((2, 4, 3, 4)).astype(np.float32) * 0.5
    missing = ((-3, 0), (6, 0), (0, -4), (0, 7), (9, 1), (1, -9))
    for top, left in ((0, 0), (2, 3), (-1, -2), (4, 5), (1, -1), (-2, 4), *missing):
        layers = [Layer(planes[0], top, left), Layer(planes[1], top, left)]
        expected = background.copy()
        for y, x in np.ndindex(6, 7):
            if 0 <= y - top < 3 and 0 <= x - left < 4:
                for layer in planes:
                    light = layer[:, y - top, x - left]
                    expected[:, y, x] = expected[:, y, x] * (1 - light[3]) + light[:3]
        np.testing.assert_allclose(composite(background, layers), expected, rtol=1e-6)


NOISE = np.random.default_rng(1).random((3, 40, 50)).astype(np.float32)


def gaussian(planes: Floats, sigma: float) -> Floats:
    return np.array([scipy.ndimage.gaussian_filter(plane, sigma, truncate=4) for plane in planes])


def test_binned_blur_takes_the_nearest_of_evenly_spaced_blurs() -> None:
    radius = np.zeros((40, 50))
    radius[:, 10:20], radius[:, 20:30], radius[:, 30:] = 0.9, 1.7, 4.0
    blurred = binned_gaussian(NOISE, radius, bins=3)  # of radius 0, 2 and 4
    np.testing.assert_array_equal(blurred[..., :20], NOISE[..., :20])
    np.testing.assert_allclose(blurred[..., 20:30], gaussian(NOISE, 1.0)[..., 20:30], atol=1e-5)
    np.testing.assert_allclose(blurred[..., 30:], gaussian(NOISE, 2.0)[..., 30:], atol=1e-5)


def test_gathering_weights_neighbours_by_their_discs_and_depth() -> None:
    """Computed from the definition, one pixel and one neighbour at a time."""
    rng = np.random.default_rng(5)
    light = rng.random((2, 6, 8)).astype(np.float32)
    radius, depth = rng.uniform(0.2, 3.0, (6, 8)), rng.integers(1, 4, (6, 8)).astype(float)
    expected = np.zeros_like(light)
    for y, x in np.ndindex(6, 8):
        total = weights = 0.0
        for v, u in np.ndindex(14, 16):
            at = min(max(v - 4, 0), 5), min(max(u - 4, 0), 7)
            own, spread = max(radius[y, x], 0.5), max(radius[at], 0.5)
            if depth[at] > depth[y, x]:
                spread = min(spread, own)
            away = np.hypot(v - 4 - y, u - 4 - x)
            weight = min(max(spread + 0.5 - away, 0.0), 1.0) / spread**2
            total, weights = total + weight * light[:, at[0], at[1]], weights + weight
        expected[:, y, x] = total / weights
    np.testing.assert_allclose(gather_discs(light, radius, depth), expected, atol=1e-5)
