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


def test_a_curve_between_two_wavelengths_is_taken_at_the_nearest() -> None:
    narrow, far = even_wavelengths((0.6, 60.0), 1e-5, 0.38, 0.72, 3)
    np.testing.assert_array_equal(narrow.shares, [0, 1, 0])
    np.testing.assert_array_equal(far.shares, [0, 0, 1])
