"""A uniform disc: its weights against exact areas, its moments, its continuity, its convolution."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import integrate, ndimage

from simulations.models.arrays import Floats
from simulations.models.lens.disc_blur import (
    NARROW_RADIUS,
    disc_blur,
    disc_kernel,
    fast_length,
)

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
def test_each_weight_is_the_area_that_the_disc_covers_of_its_pixel(radius: float) -> None:
    kernel = disc_kernel(radius)
    for x, y, weight in zip(
        *(values.ravel() for values in (*offsets(kernel), kernel)), strict=True
    ):
        assert weight * math.pi * radius**2 == pytest.approx(covered(radius, x, y), abs=2e-6)


@settings(deadline=None)
@given(radius=st.floats(0, 60))
def test_weights_add_up_to_one_and_look_the_same_from_all_sides(radius: float) -> None:
    kernel = disc_kernel(radius)
    assert kernel.sum(dtype=float) == pytest.approx(1, abs=1e-6)
    assert kernel.min() >= 0
    for seen in (kernel.T, kernel[::-1], kernel[:, ::-1]):
        np.testing.assert_allclose(kernel, seen, atol=1e-8)


@settings(deadline=None)
@given(radius=st.floats(NARROW_RADIUS, 60))
def test_the_variance_is_that_of_a_disc_and_of_a_pixel(radius: float) -> None:
    """Alike along the axes and the diagonals."""
    kernel = disc_kernel(radius)
    x, y = offsets(kernel)
    off = 0.146 if radius < 1.5 else 0.068
    for along in (x, y, (x + y) / math.sqrt(2), (x - y) / math.sqrt(2)):
        assert mean(kernel, along**2) == pytest.approx(radius**2 / 4 + 1 / 12, abs=off)
    assert mean(kernel, x * y) == pytest.approx(0, abs=1e-5)


@pytest.mark.parametrize(
    "radius", [0.1, 0.5, NARROW_RADIUS, 0.75, 1.5, 2.5, 3.5, 6.0, 7.0, 12.0, 14.0]
)
def test_the_blur_changes_with_the_radius_without_a_jump(radius: float) -> None:
    """A weight gains what the disc's edge, 2πR long, sweeps over, and loses by 1/(πR²) falling."""
    light = np.zeros((1, 61, 61), np.float32)
    light[0, 30, 30] = 1.0
    step = 1e-5
    smaller, larger = disc_blur(light, radius - step), disc_blur(light, radius + step)
    assert np.abs(larger - smaller).max() < 2 * step * (2 / radius + 2 / radius) + 1e-6


def test_a_disc_of_no_width_is_a_point_and_returns_the_very_picture() -> None:
    picture = np.ones((3, 4, 4), np.float32)
    assert disc_kernel(0.0).tolist() == [[1.0]]
    assert disc_blur(picture, 0.0) is picture


@given(radius=st.floats(1e-6, NARROW_RADIUS))
def test_a_narrow_disc_has_the_variance_of_the_disc_alone(radius: float) -> None:
    kernel = disc_kernel(radius)
    columns, _ = offsets(kernel)
    assert mean(kernel, columns**2) == pytest.approx(radius**2 / 4, rel=1e-3)


@pytest.mark.parametrize("radius", [0.2, 0.52, 1.5, 1.51, 2.4, 4.9, 6.0, 6.1, 9.3, 24.0])
def test_blur_is_convolution_with_the_weights(radius: float) -> None:
    picture = RNG.random((2, 20, 24)).astype(np.float32)
    kernel = disc_kernel(radius).astype(float)
    wanted = [ndimage.convolve(plane, kernel, mode="nearest") for plane in picture.astype(float)]
    np.testing.assert_allclose(disc_blur(picture, radius), wanted, atol=2e-6)


@pytest.mark.parametrize("radius", [3.0, 20.0])
def test_darkness_stays_dark_and_no_mean_exceeds_what_it_is_taken_of(radius: float) -> None:
    light = np.zeros((2, 70, 70), np.float32)
    light[0, 35:, 35:] = 1.0
    blurred = disc_blur(light, radius)
    assert blurred.min() >= 0
    assert blurred.max() <= 1
    assert not blurred[1].any()


@pytest.mark.parametrize("length", [1, 2, 3, 40])
@pytest.mark.parametrize("radius", [3.0, 9.0])
def test_a_line_of_pixels_is_blurred_as_a_picture_of_that_line_repeated(
    length: int, radius: float
) -> None:
    line = np.random.default_rng(5).random((1, 1, length)).astype(np.float32)
    repeated = disc_blur(np.repeat(line, 33, axis=1), radius)
    assert disc_blur(line, radius)[0, 0] == pytest.approx(repeated[0, 16], abs=2e-6)
    upright = np.repeat(line, 33, axis=1).swapaxes(1, 2)
    assert disc_blur(line.swapaxes(1, 2), radius)[0, :, 0] == pytest.approx(
        disc_blur(upright, radius)[0, :, 16], abs=2e-6
    )


@pytest.mark.parametrize(
    ("least", "length"), [(1, 1), (5, 5), (7, 8), (11, 12), (13, 15), (241, 243), (301, 320)]
)
def test_grids_have_no_prime_factor_above_five(least: int, length: int) -> None:
    assert fast_length(least) == length
