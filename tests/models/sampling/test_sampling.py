"""Aliasing, pre-filters and contrast against their analytic values."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import scipy.ndimage
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from simulations.models.sampling import aliasing


@given(st.floats(-50, 50))
def test_an_alias_has_the_same_samples(frequency: float) -> None:
    alias = aliasing.alias_frequency(frequency)
    assert -0.5 <= alias < 0.5
    n = np.arange(32)
    turns = np.exp(2j * np.pi * frequency * n)
    np.testing.assert_allclose(np.exp(2j * np.pi * alias * n), turns, atol=1e-9)


def test_a_wagon_wheel_stands_still_or_turns_back() -> None:
    speed, certain = aliasing.apparent_wheel_speed([3.0, 2.9, 1.5, 0.2], 8, 24.0)
    np.testing.assert_allclose(speed[[0, 1, 3]], [0, -0.1, 0.2], atol=1e-12)
    np.testing.assert_array_equal(certain, [True, True, False, True])


def test_zone_plate_rings_have_the_stated_frequency() -> None:
    r = np.linspace(29.5, 30.5, 20_001)
    ring = aliasing.zone_plate(r, 0, 10.0)
    crossings = np.count_nonzero(np.diff(np.sign(ring - 0.5)))
    assert crossings / 2 == pytest.approx(3.0, abs=0.5)


def test_filtering_agrees_with_scipy() -> None:
    image = np.random.default_rng(1).random((12, 15))
    taps = aliasing.gaussian_kernel(0.8)
    theirs = image
    for axis in (0, 1):
        theirs = scipy.ndimage.correlate1d(theirs, taps, axis=axis, mode="reflect")
    ours = aliasing.filter_and_sample(image, 3, taps)
    np.testing.assert_allclose(ours, theirs[1::3, 1::3], atol=1e-12)


def test_flat_light_passes_every_filter_unchanged() -> None:
    flat = np.full((16, 16), 0.7)
    for sigma in (0, 2):
        kernel = aliasing.gaussian_kernel(sigma)
        np.testing.assert_allclose(aliasing.filter_and_sample(flat, 4, kernel), 0.7)


def test_a_pixel_passes_two_over_pi_at_nyquist() -> None:
    assert aliasing.box_mtf(0.5) == pytest.approx(2 / np.pi)
    assert aliasing.box_mtf(1.0) == pytest.approx(0, abs=1e-15)


def test_a_gaussian_blur_leaves_the_contrast_of_its_fourier_transform() -> None:
    x = np.arange(400)
    wave = 0.5 + 0.5 * np.cos(2 * np.pi * 0.1 * x)
    blurred = np.convolve(wave, aliasing.gaussian_kernel(1.5), mode="valid")
    left = np.exp(-2 * (np.pi * 1.5 * 0.1) ** 2)
    assert aliasing.contrast(blurred) == pytest.approx(left, abs=1e-3)


REFUSED: list[tuple[str, Callable[[Any], object], list[float]]] = [
    ("rate", lambda rate: aliasing.alias_frequency(1.0, rate), [0.0, -1.0, np.inf, np.nan]),
    ("frequency", lambda f: aliasing.alias_frequency([0.1, f]), [np.nan, np.inf]),
    ("spokes", lambda spokes: aliasing.apparent_wheel_speed(1.0, spokes, 24.0), [0]),
    ("scale", lambda scale: aliasing.zone_plate(0, 0, scale), [0.0, -1.0, np.inf, np.nan]),
    ("sigma", aliasing.gaussian_kernel, [-1e-9, 1.1e6, np.nan, np.inf]),
    ("light of 0 or more, finite", lambda light: aliasing.contrast([0.1, light]), [-1.0, np.inf]),
    ("finite", lambda frequency: aliasing.box_mtf([0.5, frequency]), [np.nan]),
    ("finite", lambda width: aliasing.box_mtf([0.5], width), [np.inf, np.nan]),
    ("a divisor", lambda f: aliasing.filter_and_sample(np.zeros((8, 9)), f, [1.0]), [0, 2]),
    ("a divisor", lambda f: aliasing.filter_and_sample(np.zeros((9, 8)), f, [1.0]), [2]),
    ("a divisor", lambda f: aliasing.filter_and_sample(np.zeros(8), f, [1.0]), [2]),
]


@pytest.mark.parametrize(
    ("says", "call", "value"),
    [(says, call, each) for says, call, values in REFUSED for each in values],
)
def test_what_has_no_meaning_is_refused(
    says: str, call: Callable[[Any], object], value: float
) -> None:
    with pytest.raises(ValueError, match=says) as refusal:
        call(value)
    assert "legal: " in str(refusal.value)


def test_aliasing_folds_at_any_rate() -> None:
    found = aliasing.alias_frequency([5.0, 7.9, 8.1, -5.0, -4.0, 4.0, 3.9, 1e17], 8.0)
    np.testing.assert_allclose(found, [-3, -0.1, 0.1, 3, -4, -4, 3.9, 1e17 % 8], atol=1e-12)
    smallest = 5e-324
    assert aliasing.alias_frequency(smallest, 3 * smallest) == smallest


def test_a_wheel_may_have_one_spoke() -> None:
    speed, certain = aliasing.apparent_wheel_speed([25.0, 12.0, 36.0, 12.1], 1, 24.0)
    np.testing.assert_allclose(speed, [1, -12, -12, -11.9], atol=1e-12)
    assert certain.tolist() == [True, False, False, True]


def test_half_a_spacing_per_frame_is_uncertain_to_a_billionth() -> None:
    near, nearer = 12.0 * (1 - 1e-6), 12.0 * (1 - 1e-11)
    certain = aliasing.apparent_wheel_speed([near, nearer], 1, 24.0)[1]
    assert certain.tolist() == [True, False]


def test_the_zone_plate_is_its_formula() -> None:
    x, y = np.array([0.0, 3.0, 0.0, 1.0]), np.array([0.0, 0.0, 2.0, 2.0])
    expected = 0.5 + 0.5 * np.cos(np.pi * np.array([0, 9, 4, 5]) / 8.0)
    np.testing.assert_allclose(aliasing.zone_plate(x, y, 8.0), expected, atol=1e-15)
    assert aliasing.zone_plate(1e200, 0, 8.0) == 0.5


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


def test_the_widest_gaussian_is_legal() -> None:
    assert aliasing.gaussian_kernel(1e6).size == 8_000_001


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


@pytest.mark.parametrize("kernel", [[0.5, 0.5], [[1.0]], []])
def test_only_a_kernel_of_odd_length_has_a_centre(kernel: ArrayLike) -> None:
    with pytest.raises(ValueError, match="legal: one axis of odd length"):
        aliasing.filter_and_sample(np.zeros((4, 4)), 1, kernel)


def test_contrasts_are_those_of_the_textbook() -> None:
    np.testing.assert_allclose(aliasing.box_mtf([0.25, -0.25], 2.0), 2 / np.pi)
    assert aliasing.contrast([1.0, 3.0, 2.0]) == pytest.approx(0.5)
    assert aliasing.contrast([0.0, 0.0]) == 0
    assert aliasing.contrast([0.0, 2.0]) == 1


def test_the_rings_of_a_zone_plate_may_be_finer_than_a_sample() -> None:
    """Scale 1/2: the phase at r = 1/2 is half a turn."""
    assert aliasing.zone_plate([0.0, 0.5], [0.0, 0.0], 0.5) == pytest.approx([1.0, 0.5])


@pytest.mark.parametrize("frequency", [0.25, 2.0, 23.5])
def test_single_precision_frequencies_are_treated_as_double_ones(frequency: float) -> None:
    single = np.array([frequency], np.float32)
    for function in (
        aliasing.box_mtf,
        lambda f: aliasing.alias_frequency(f, 24000 / 1001),
        lambda f: aliasing.apparent_wheel_speed(f, 7, 24000 / 1001)[0],
    ):
        np.testing.assert_array_equal(function(single), function([frequency]))


def test_sums_beyond_all_numbers_are_infinite_without_a_warning() -> None:
    bright = np.full((4, 4), 1e308)
    assert (aliasing.filter_and_sample(bright, 2, np.ones(3)) == np.inf).all()
