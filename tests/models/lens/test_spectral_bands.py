"""Quadrature of a channel's bell curve, against its moments."""

import numpy as np
import pytest

from simulations.models.lens.spectral_bands import Band, chosen_wavelengths, even_wavelengths

PEAKS, WIDTH = (0.6, 0.54, 0.46), 0.03


def mean(band: Band, power: int, about: float) -> float:
    return float(band.shares @ (band.wavelengths_um - about) ** power)


@pytest.mark.parametrize("count", [1, 2, 3, 5])
def test_chosen_wavelengths_have_the_moments_of_the_bell_curve(count: int) -> None:
    """Exact up to the power 2n − 1: 1, 0, σ², 0, 3σ⁴ ..."""
    band = chosen_wavelengths(0.54, WIDTH, count)
    moments = [1, 0, WIDTH**2, 0, 3 * WIDTH**4, 0, 15 * WIDTH**6, 0, 105 * WIDTH**8, 0]
    for power, moment in enumerate(moments[: 2 * count]):
        assert mean(band, power, 0.54) == pytest.approx(moment, rel=1e-9, abs=1e-15)


def test_a_single_wavelength_is_the_peak() -> None:
    band = chosen_wavelengths(0.46, WIDTH, 1)
    assert (band.wavelengths_um.tolist(), band.shares.tolist()) == ([0.46], [1.0])


def test_three_wavelengths_are_the_known_ones() -> None:
    """0 and ±√3 standard deviations, with shares 2/3 and 1/6 each."""
    band = chosen_wavelengths(0.5, 0.1, 3)
    np.testing.assert_allclose(band.wavelengths_um, 0.5 + 0.1 * np.sqrt(3) * np.array([-1, 0, 1]))
    np.testing.assert_allclose(band.shares, [1 / 6, 2 / 3, 1 / 6])


def test_even_wavelengths_stand_in_the_middles_of_equal_parts_for_all_channels() -> None:
    bands = even_wavelengths(PEAKS, WIDTH, 0.4, 0.7, 3)
    assert len(bands) == 3
    for band in bands:
        np.testing.assert_allclose(band.wavelengths_um, [0.45, 0.55, 0.65])


def test_many_even_wavelengths_have_the_moments_of_each_bell() -> None:
    bands = even_wavelengths(PEAKS, WIDTH, 0.3, 0.8, 60)
    for band, peak in zip(bands, PEAKS, strict=True):
        assert band.shares.sum() == pytest.approx(1)
        assert mean(band, 1, peak) == pytest.approx(0, abs=1e-7)
        assert mean(band, 2, peak) == pytest.approx(WIDTH**2, rel=1e-4)


def test_shares_fall_off_as_the_bell_does() -> None:
    (band,) = even_wavelengths([0.5], WIDTH, 0.5 - 0.03, 0.5 + 0.09, 2)
    np.testing.assert_allclose(band.wavelengths_um, [0.5, 0.56])
    assert band.shares[1] / band.shares[0] == pytest.approx(np.exp(-2))


@pytest.mark.parametrize(("width", "count"), [(0.03, 0), (0.99e-9, 3), (-1.0, 3), (np.inf, 3)])
def test_no_wavelength_and_no_width_are_refused(width: float, count: int) -> None:
    with pytest.raises(ValueError, match=r"(count 0|width_um .*); legal: .*(1 or more|1e-9)"):
        chosen_wavelengths(0.5, width, count)
    with pytest.raises(ValueError, match=r"(count 0|width_um .*); legal: .*(1 or more|1e-9)"):
        even_wavelengths(PEAKS, width, 0.4, 0.7, count)


def test_a_curve_between_two_wavelengths_is_taken_at_the_nearest() -> None:
    narrow, far = even_wavelengths((0.6, 60.0), 1e-5, 0.38, 0.72, 3)
    np.testing.assert_array_equal(narrow.shares, [0, 1, 0])
    np.testing.assert_array_equal(far.shares, [0, 0, 1])


@pytest.mark.parametrize("peak", [np.nan, np.inf, 1.001e9, -1.001e9])
def test_a_peak_that_is_no_wavelength_is_refused(peak: float) -> None:
    with pytest.raises(ValueError, match="legal: finite, at most 1e9"):
        even_wavelengths((0.5, peak), 0.03, 0.38, 0.72, 3)
    with pytest.raises(ValueError, match="legal: finite, at most 1e9"):
        chosen_wavelengths(peak, 0.03, 3)


def test_the_narrowest_band_and_the_longest_wave_are_legal() -> None:
    band = chosen_wavelengths(1.0, 1e-9, 3)
    np.testing.assert_allclose((band.wavelengths_um - 1) * 1e9, np.sqrt(3) * np.arange(-1, 2), 1e-6)
    for peak in (-1e9, 1e9):
        assert chosen_wavelengths(peak, 0.03, 1).wavelengths_um == [peak]


def test_a_hundred_wavelengths_can_be_chosen_and_no_more() -> None:
    assert chosen_wavelengths(0.5, 0.03, 100).shares.sum() == pytest.approx(1)
    with pytest.raises(ValueError, match="count 101; legal: whole numbers, 1 to 100"):
        chosen_wavelengths(0.5, 0.03, 101)
