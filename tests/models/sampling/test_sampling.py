"""Aliasing, pre-filters and contrast against their analytic values."""

import numpy as np
import pytest
import scipy.ndimage
from hypothesis import given
from hypothesis import strategies as st

from simulations.models.sampling import aliasing


@given(st.floats(-50, 50))
def test_an_alias_has_the_same_samples(frequency: float) -> None:
    alias = aliasing.alias_frequency(frequency)
    assert -0.5 <= alias < 0.5
    n = np.arange(32)
    turns = np.exp(2j * np.pi * frequency * n)
    np.testing.assert_allclose(np.exp(2j * np.pi * alias * n), turns, atol=1e-9)


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
def test_a_wagon_wheel_stands_still_or_turns_back(
    spokes: int, turns: float, seen: float, certain: bool
) -> None:
    speed, sure = aliasing.apparent_wheel_speed(turns, spokes, 24.0)
    assert speed == pytest.approx(seen, abs=2e-5)
    assert sure == certain


def test_aliasing_folds_at_any_rate() -> None:
    found = aliasing.alias_frequency([5.0, 7.9, 8.1, -5.0, -4.0, 4.0, 3.9, 1e17], 8.0)
    np.testing.assert_allclose(found, [-3, -0.1, 0.1, 3, -4, -4, 3.9, 1e17 % 8], atol=1e-12)
    smallest = 5e-324
    assert aliasing.alias_frequency(smallest, 3 * smallest) == smallest


def test_the_zone_plate_is_its_formula() -> None:
    x, y = np.array([0.0, 3.0, 0.0, 1.0]), np.array([0.0, 0.0, 2.0, 2.0])
    expected = 0.5 + 0.5 * np.cos(np.pi * np.array([0, 9, 4, 5]) / 8.0)
    np.testing.assert_allclose(aliasing.zone_plate(x, y, 8.0), expected, atol=1e-15)
    assert aliasing.zone_plate(1e200, 0, 8.0) == 0.5
    assert aliasing.zone_plate([0.0, 0.5], [0.0, 0.0], 0.5) == pytest.approx([1.0, 0.5])


@pytest.mark.parametrize("sigma", [0.3, 0.8, 1.0, 2.0])
def test_the_gaussian_ends_after_four_sigma_and_has_the_ratios_of_one(sigma: float) -> None:
    """The logarithm of the taps is a parabola; from 1 on that of sigma itself."""
    taps, reach = aliasing.gaussian_kernel(sigma), int(np.ceil(4 * sigma))
    squares = np.arange(-reach, reach + 1) ** 2
    fall = np.log(taps[reach] / taps)
    np.testing.assert_allclose(fall, squares * fall[reach + 1], rtol=1e-9)
    if sigma >= 1:
        assert fall[reach + 1] == pytest.approx(1 / (2 * sigma**2), rel=1e-12)


@given(st.one_of(st.floats(1e-6, 1.0), st.floats(1.0, 300.0)))
def test_the_gaussian_has_the_standard_deviation_asked_for(sigma: float) -> None:
    taps = aliasing.gaussian_kernel(sigma)
    squares = (np.arange(taps.size) - taps.size // 2) ** 2
    assert np.sqrt(taps @ squares) == pytest.approx(sigma, rel=1e-3)
    np.testing.assert_allclose(taps, taps[::-1])


def test_the_gaussian_changes_with_sigma_without_a_jump() -> None:
    below, above = (aliasing.gaussian_kernel(1.0 + step) for step in (-1e-9, 0.0))
    np.testing.assert_allclose(below, above, atol=1e-6)


@pytest.mark.parametrize("factor", [1, 2, 3, 4])
def test_filtering_keeps_the_sample_at_or_before_the_centre_of_each_block(factor: int) -> None:
    image = np.random.default_rng(5).random((12, 24))
    first = (factor - 1) // 2
    kept = aliasing.filter_and_sample(image, factor, [1.0])
    np.testing.assert_array_equal(kept, image[first::factor, first::factor])


def test_filtering_is_a_convolution_with_its_kernel_turned_over() -> None:
    """An uneven kernel tells convolution from correlation."""
    image, taps = np.random.default_rng(6).random((9, 12)), np.array([0.7, 0.2, 0.1, 0.0, 0.0])
    theirs = image
    for axis in (0, 1):
        theirs = scipy.ndimage.convolve1d(theirs, taps, axis=axis, mode="reflect")
    np.testing.assert_allclose(aliasing.filter_and_sample(image, 1, taps), theirs, atol=1e-12)


def test_contrasts_are_those_of_the_textbook() -> None:
    np.testing.assert_allclose(aliasing.box_mtf([0.25, -0.25], 2.0), 2 / np.pi)
    np.testing.assert_allclose(aliasing.box_mtf([0.5, 1.0]), [2 / np.pi, 0], atol=1e-15)
    assert aliasing.contrast([1.0, 3.0, 2.0]) == pytest.approx(0.5)
    assert aliasing.contrast([0.0, 0.0]) == 0
    assert aliasing.contrast([0.0, 2.0]) == 1
