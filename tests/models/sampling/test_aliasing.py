"""Aliasing, pre-filters and fine detail against closed forms and SciPy."""

from collections.abc import Callable

import numpy as np
import pytest
import scipy.ndimage
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from simulations.models.sampling import aliasing, prefilters
from simulations.models.sampling.fine_detail import FINE, fine_detail
from simulations.models.sampling.first_fall import first_fall


@pytest.mark.parametrize(
    ("spokes", "turns", "seen", "certain"),
    [
        (8, 3.0, 0.0, True),
        (8, 2.9, -0.1, True),
        (8, 1.5, -1.5, False),
        (8, 0.2, 0.2, True),
        (1, 25.0, 1.0, True),
        (1, 36.0, -12.0, False),
        (1, 12.1, -11.9, True),
        (1, 12.0 * (1 - 1e-6), 12.0, True),
        (1, 12.0 * (1 - 1e-11), 12.0, False),  # half a spacing per frame, to a billionth
    ],
)
def test_apparent_wheel_speed_is_folded(
    spokes: int, turns: float, seen: float, certain: bool
) -> None:
    speed, sure = aliasing.apparent_wheel_speed(turns, spokes, 24.0)
    assert speed == pytest.approx(seen, abs=2e-5)
    assert sure == certain


def test_alias_frequency_is_folded_at_any_rate() -> None:
    found = aliasing.alias_frequency([5.0, 7.9, 8.1, -5.0, -4.0, 4.0, 3.9, 1e17], 8.0)
    np.testing.assert_allclose(found, [-3, -0.1, 0.1, 3, -4, -4, 3.9, 1e17 % 8], atol=1e-12)
    smallest = 5e-324
    assert aliasing.alias_frequency(smallest, 3 * smallest) == smallest


@given(st.one_of(st.floats(1e-6, 1.0), st.floats(1.0, 300.0)))
def test_gaussian_kernel_has_the_requested_standard_deviation(sigma: float) -> None:
    taps = aliasing.gaussian_kernel(sigma)
    squares = (np.arange(taps.size) - taps.size // 2) ** 2
    assert np.sqrt(taps @ squares) == pytest.approx(sigma, rel=1e-3)
    np.testing.assert_allclose(taps, taps[::-1])


def test_filtering_is_a_convolution_with_the_kernel() -> None:
    """An asymmetric kernel distinguishes convolution from correlation."""
    image, taps = np.random.default_rng(6).random((9, 12)), np.array([0.7, 0.2, 0.1, 0.0, 0.0])
    theirs = image
    for axis in (0, 1):
        theirs = scipy.ndimage.convolve1d(theirs, taps, axis=axis, mode="reflect")
    np.testing.assert_allclose(aliasing.filter_and_sample(image, 1, taps), theirs, atol=1e-12)


def test_contrasts_agree_with_the_textbook() -> None:
    np.testing.assert_allclose(aliasing.box_mtf([0.25, -0.25], 2.0), 2 / np.pi)
    np.testing.assert_allclose(aliasing.box_mtf([0.5, 1.0]), [2 / np.pi, 0], atol=1e-15)
    assert aliasing.contrast([1.0, 3.0, 2.0]) == pytest.approx(0.5)
    assert aliasing.contrast([0.0, 0.0]) == 0
    assert aliasing.contrast([0.0, 2.0]) == 1


FREQUENCIES = np.linspace(0, 1.2, 25)


def test_gaussian_prefilter_has_a_gaussian_transfer_of_half_a_pixel() -> None:
    found = prefilters.transfer(prefilters.prefilter("gaussian"), FREQUENCIES.reshape(5, 5))
    expected = np.exp(-2 * np.square(np.pi * 0.5 * FREQUENCIES))
    np.testing.assert_allclose(found, expected.reshape(5, 5), atol=2e-6)


@pytest.mark.parametrize("frequency", [0.1, 0.37, 0.5, 0.8, 1.2])
def test_transfer_of_the_windowed_sinc_agrees_with_quadrature(frequency: float) -> None:
    def kernel(u: float) -> float:
        return np.sinc(u) * np.sinc(u / prefilters.LOBES)

    area = quad(kernel, -prefilters.LOBES, prefilters.LOBES)[0]
    wave = quad(
        kernel, -prefilters.LOBES, prefilters.LOBES, weight="cos", wvar=2 * np.pi * frequency
    )
    found = prefilters.transfer(prefilters.prefilter("sinc"), frequency)
    assert found == pytest.approx(wave[0] / area, abs=1e-4)


def test_box_filtered_chirp_is_averaged_over_the_pixel() -> None:
    def over_pixel(part: Callable[[complex], float], x: float) -> float:
        return quad(lambda u: part(np.exp(1j * np.pi * 0.02 * u * u)), x - 0.5, x + 0.5)[0]

    x = 31.0
    wave = prefilters.filtered_wave(prefilters.prefilter("box"), x, 0.0, 0.02)
    assert wave.real == pytest.approx(over_pixel(np.real, x), abs=1e-6)
    assert wave.imag == pytest.approx(over_pixel(np.imag, x), abs=1e-6)


def test_share_of_a_wave_in_place_is_the_cosine_of_its_shift() -> None:
    x, _ = np.meshgrid(np.arange(64.0), np.arange(64.0))
    wave, moved = (np.cos(2 * np.pi * 0.25 * (x - s)) for s in (0.0, 0.5))
    detail = fine_detail(moved, wave)
    assert (detail.present, detail.in_place) == pytest.approx((1, np.cos(np.pi / 4)))


def test_coarse_waves_are_not_fine_detail() -> None:
    x, _ = np.meshgrid(np.arange(64.0), np.arange(64.0))
    coarse, fine = (np.cos(2 * np.pi * f * x) for f in (0.125, 0.25))
    assert fine_detail(coarse, coarse + fine).present == pytest.approx(0, abs=1e-12)
    assert 0.125 < FINE < 0.25


def test_first_fall_is_interpolated_and_precedes_later_falls() -> None:
    assert first_fall([0, 10, 20, 30, 40], [1, 0.75, 0.25, 0.75, 0], 0.5) == 15
    assert first_fall([0, 10, 20, 40], [1, 0.9, 0.4, 0.3], 0.5) == pytest.approx(18)
    assert first_fall([0, 10, 20], [1, 0.5, 0.7], 0.5) == 10
    assert first_fall([0, 10], [1, 0.6], 0.5) == np.inf
