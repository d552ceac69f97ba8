"""Aliasing, pre-filters and contrast against their analytic values."""

import numpy as np
import pytest
import scipy.ndimage
from hypothesis import given
from hypothesis import strategies as st

from simulations.models import sampling


@given(st.floats(-50, 50))
def test_an_alias_has_the_same_samples(frequency):
    alias = sampling.alias_frequency(frequency)
    assert -0.5 <= alias < 0.5
    n = np.arange(32)
    turns = np.exp(2j * np.pi * frequency * n)
    np.testing.assert_allclose(np.exp(2j * np.pi * alias * n), turns, atol=1e-9)


def test_seven_tenths_fold_to_minus_three_tenths():
    np.testing.assert_allclose(sampling.alias_frequency([0.7, 0.5, 0, -0.2]), [-0.3, -0.5, 0, -0.2])


def test_a_wagon_wheel_stands_still_or_turns_back():
    speed, certain = sampling.apparent_wheel_speed([3.0, 2.9, 1.5, 0.2], 8, 24.0)
    np.testing.assert_allclose(speed[[0, 1, 3]], [0, -0.1, 0.2], atol=1e-12)
    np.testing.assert_array_equal(certain, [True, True, False, True])


def test_zone_plate_rings_have_the_stated_frequency():
    r = np.linspace(29.5, 30.5, 20_001)
    ring = sampling.zone_plate(r, 0, 10.0)
    crossings = np.count_nonzero(np.diff(np.sign(ring - 0.5)))
    assert crossings / 2 == pytest.approx(3.0, abs=0.5)


@pytest.mark.parametrize("factor", [2, 4, 8])
def test_box_filter_takes_the_mean_of_blocks(factor):
    image = np.random.default_rng(0).random((16, 24))
    block = image[:factor, factor : 2 * factor].mean()
    assert sampling.box_filter(image, factor)[0, 1] == pytest.approx(block)


def test_more_filtering_leaves_less_alias():
    y, x = (np.mgrid[: 64 * 8, : 64 * 8] + 0.5) / 8
    phase = 2 * np.pi * 0.8 * x  # beyond Nyquist: nothing of it should remain
    fine = 0.5 + 0.5 * np.cos(phase) + 0 * y
    left = [
        np.std(fine[4::8, 4::8]),
        np.std(sampling.box_filter(fine, 8)),
        np.std(sampling.filter_and_sample(fine, 8, sampling.sinc_kernel(8))[:, 6:-6]),
    ]
    assert left[0] > 3 * left[1] > 9 * left[2]


def test_filtering_agrees_with_scipy():
    image = np.random.default_rng(1).random((12, 15))
    taps = sampling.gaussian_kernel(0.8)
    theirs = image
    for axis in (0, 1):
        theirs = scipy.ndimage.correlate1d(theirs, taps, axis=axis, mode="reflect")
    ours = sampling.filter_and_sample(image, 3, taps)
    np.testing.assert_allclose(ours, theirs[1::3, 1::3], atol=1e-12)


def test_flat_light_passes_every_filter_unchanged():
    flat = np.full((16, 16), 0.7)
    for kernel in (
        sampling.gaussian_kernel(0),
        sampling.gaussian_kernel(2),
        sampling.sinc_kernel(4),
    ):
        np.testing.assert_allclose(sampling.filter_and_sample(flat, 4, kernel), 0.7)


@pytest.mark.parametrize("factor", [3, 4])
def test_the_sinc_filter_samples_at_the_centre_of_each_block(factor):
    ramp = np.arange(40.0 * factor) + np.zeros((factor, 1))
    kept = sampling.filter_and_sample(ramp, factor, sampling.sinc_kernel(factor))
    centres = sampling.box_filter(ramp, factor)
    np.testing.assert_allclose(kept[:, 6:-6], centres[:, 6:-6], atol=1e-9)


def test_a_pixel_passes_two_over_pi_at_nyquist():
    assert sampling.box_mtf(0.5) == pytest.approx(2 / np.pi)
    assert sampling.box_mtf(1.0) == pytest.approx(0, abs=1e-15)


def test_gaussian_mtf_is_what_the_blur_does():
    x = np.arange(400)
    wave = 0.5 + 0.5 * np.cos(2 * np.pi * 0.1 * x)
    blurred = np.convolve(wave, sampling.gaussian_kernel(1.5), mode="valid")
    assert sampling.contrast(blurred) == pytest.approx(sampling.gaussian_mtf(0.1, 1.5), abs=1e-3)


@pytest.mark.parametrize(
    "call",
    [
        lambda: sampling.alias_frequency(1, rate=0),
        lambda: sampling.zone_plate(0, 0, 0),
        lambda: sampling.box_filter(np.zeros((9, 8)), 2),
        lambda: sampling.gaussian_kernel(-1),
        lambda: sampling.contrast([-1.0, 1.0]),
    ],
)
def test_meaningless_parameters_are_refused(call):
    with pytest.raises(ValueError, match="legal"):
        call()
