"""Pre-filters against closed forms and quadrature by SciPy."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import quad

from simulations.models.sampling import aliasing, prefilters

FREQUENCIES = np.linspace(0, 1.2, 25)


def test_the_box_has_the_transfer_of_a_pixel() -> None:
    found = prefilters.transfer(prefilters.prefilter("box"), FREQUENCIES)
    np.testing.assert_allclose(found, np.sinc(FREQUENCIES), atol=1e-6)
    np.testing.assert_allclose(np.abs(found), aliasing.box_mtf(FREQUENCIES), atol=1e-6)


def test_the_gaussian_has_a_gaussian_transfer_of_half_a_pixel() -> None:
    found = prefilters.transfer(prefilters.prefilter("gaussian"), FREQUENCIES.reshape(5, 5))
    expected = np.exp(-2 * np.square(np.pi * 0.5 * FREQUENCIES))
    np.testing.assert_allclose(found, expected.reshape(5, 5), atol=2e-6)


@pytest.mark.parametrize("frequency", [0.1, 0.37, 0.5, 0.8, 1.2])
def test_the_windowed_sinc_is_integrated_well_enough(frequency: float) -> None:
    def kernel(u: float) -> float:
        return np.sinc(u) * np.sinc(u / prefilters.LOBES)

    area = quad(kernel, -prefilters.LOBES, prefilters.LOBES)[0]
    wave = quad(
        kernel, -prefilters.LOBES, prefilters.LOBES, weight="cos", wvar=2 * np.pi * frequency
    )
    found = prefilters.transfer(prefilters.prefilter("sinc"), frequency)
    assert found == pytest.approx(wave[0] / area, abs=1e-4)


def test_a_pure_wave_only_changes_its_amplitude() -> None:
    kernel, x = prefilters.prefilter("box"), np.linspace(-3, 3, 40)
    wave = prefilters.filtered_wave(kernel, x, 0.4)
    expected = prefilters.transfer(kernel, 0.4) * np.exp(2j * np.pi * 0.4 * x)
    np.testing.assert_allclose(wave, expected, atol=1e-12)


def test_a_chirp_is_averaged_over_the_pixel() -> None:
    def over_pixel(part: Callable[[complex], float], x: float) -> float:
        return quad(lambda u: part(np.exp(1j * np.pi * 0.02 * u * u)), x - 0.5, x + 0.5)[0]

    x = 31.0
    wave = prefilters.filtered_wave(prefilters.prefilter("box"), x, 0.0, 0.02)
    assert wave.real == pytest.approx(over_pixel(np.real, x), abs=1e-6)
    assert wave.imag == pytest.approx(over_pixel(np.imag, x), abs=1e-6)


@pytest.mark.parametrize(("kind", "reach"), [("box", 0.5), ("gaussian", 2.5), ("sinc", 4.0)])
def test_each_filter_reaches_as_far_as_it_says_on_both_sides(kind: str, reach: float) -> None:
    kernel = prefilters.prefilter(kind)
    np.testing.assert_allclose(kernel.offsets_px, np.linspace(-reach, reach, 129), atol=1e-14)
    np.testing.assert_allclose(kernel.weights, kernel.weights[::-1], atol=1e-16)


@pytest.mark.parametrize("factor", [1, 2, 4, 8])
def test_points_in_a_pixel_have_the_transfer_of_their_comb(factor: int) -> None:
    """|sin πf / (n sin πf/n)|: the sum of n equal waves with a phase of 2πf/n between them."""
    frequencies = np.linspace(0.05, 0.95, 19)
    steps = np.sin(np.pi * frequencies / factor)
    expected = np.sin(np.pi * frequencies) / (factor * steps)
    found = prefilters.transfer(prefilters.supersample(factor), frequencies)
    np.testing.assert_allclose(found, expected, atol=1e-14)


def test_a_point_passes_all_waves_that_have_a_phase() -> None:
    waves = [-1e9, 0.0, 0.3, 1e7, 1e9]
    for point in (prefilters.supersample(1), prefilters.prefilter("none")):
        assert prefilters.transfer(point, waves).tolist() == [1] * 5


@pytest.mark.parametrize(("frequency", "chirp"), [(1e9, -1e9), (-1e9, 1e9)])
def test_any_wave_of_up_to_a_billion_cycles_is_1_where_it_starts(
    frequency: float, chirp: float
) -> None:
    assert prefilters.filtered_wave(prefilters.supersample(1), 0.0, frequency, chirp) == 1
