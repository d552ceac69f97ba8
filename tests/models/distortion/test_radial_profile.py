"""Odd rational functions of the radius: their slope and fold against analysis."""

import math

import numpy as np
import pytest
from support.radial_profiles import PROFILES

from simulations.models.arrays import Floats
from simulations.models.distortion.radial_profile import (
    RadialProfile,
    evaluate,
    fold_radius,
    largest_image_radius,
    nearest_turning_image,
    scale,
    scale_slope,
    slope,
    slope_towards,
)

RADII = np.linspace(0.0, 1.2, 25)


def by_hand(profile: RadialProfile, r: Floats) -> Floats:
    n = 1 + sum(a * r ** (2 * i) for i, a in enumerate(profile.numerator, start=1))
    d = 1 + sum(b * r ** (2 * i) for i, b in enumerate(profile.denominator, start=1))
    return r * n / d


@pytest.mark.parametrize("profile", PROFILES)
def test_the_function_is_its_quotient_of_sums(profile: RadialProfile) -> None:
    np.testing.assert_allclose(evaluate(profile, RADII), by_hand(profile, RADII), rtol=1e-14)
    factors = by_hand(profile, RADII[1:]) / RADII[1:]
    np.testing.assert_allclose(scale(profile, RADII[1:] ** 2), factors, rtol=1e-13)


@pytest.mark.parametrize("profile", PROFILES)
def test_slopes_agree_with_differences(profile: RadialProfile) -> None:
    step, radii = 1e-6, RADII[1:]
    rise = by_hand(profile, radii + step) - by_hand(profile, radii - step)
    np.testing.assert_allclose(slope(profile, radii), rise / (2 * step), atol=1e-8)
    square = radii**2
    rise = scale(profile, square + step) - scale(profile, square - step)
    np.testing.assert_allclose(scale_slope(profile, square), rise / (2 * step), atol=1e-8)
    assert slope(profile, 0.0) == 1.0


@pytest.mark.parametrize("profile", PROFILES)
def test_the_slope_towards_an_image_is_the_slope_where_the_image_is_that(
    profile: RadialProfile,
) -> None:
    radii = np.linspace(0.05, 0.9, 7) * min(fold_radius(profile), 2.0)
    towards = slope_towards(profile, radii, evaluate(profile, radii))
    np.testing.assert_allclose(towards, slope(profile, radii), rtol=1e-12, atol=1e-14)


def test_nothing_set_is_neutral_and_anything_set_is_not() -> None:
    assert RadialProfile((0.0, 0.0), (0.0,)).neutral
    assert not RadialProfile((0.0, 1e-9)).neutral
    assert not RadialProfile((), (1e-9,)).neutral


@pytest.mark.parametrize(
    ("profile", "fold", "image"),
    [
        (RadialProfile((-1 / 3,)), 1.0, 2 / 3),  # r − r³/3
        (RadialProfile((0.0, -0.2)), 1.0, 0.8),  # r − r⁵/5
        (RadialProfile((0.0, 0.0, -1 / 7)), 1.0, 6 / 7),  # r − r⁷/7
        (RadialProfile((), (1.0,)), 1.0, 0.5),  # r / (1 + r²) peaks at 1
        (RadialProfile((), (-0.25,)), 2.0, math.inf),  # a pole
        (RadialProfile((), (0.0, -1 / 16)), 2.0, math.inf),  # another
        (RadialProfile((1.0,), (10.0,)), 0.2**0.5, 0.4 * 0.2**0.5),  # (1 − 2 r²)(1 − 5 r²) / D²
        (RadialProfile((-2 / 3, 0.2)), 1.0, 8 / 15),  # slope (1 − r²)² touches zero
        (RadialProfile((-13 / 12, 0.45)), 2 / 3, 0.4049382716),  # (1 − 9/4 r²)(1 − r²)
        (RadialProfile((1e9, -6e6)), 10.0, 10 * (1 + 4e10)),  # however high, a peak is no pole
        (RadialProfile(), math.inf, math.inf),
        (PROFILES[0], math.inf, math.inf),
        (RadialProfile((1.0, 1.0), (0.1,)), math.inf, math.inf),
    ],
)
def test_the_fold_is_where_the_slope_first_vanishes(
    profile: RadialProfile, fold: float, image: float
) -> None:
    assert fold_radius(profile) == pytest.approx(fold, rel=1e-6)
    assert largest_image_radius(profile) == pytest.approx(image, rel=1e-6)


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e8, 1e149])
def test_a_pole_and_a_peak_are_told_apart_at_any_scale(size: float) -> None:
    peak, pole = RadialProfile((-1 / 3 / size**2,)), RadialProfile((), (-1 / size**2,))
    assert fold_radius(peak) == pytest.approx(size)
    assert largest_image_radius(peak) == pytest.approx(2 / 3 * size)
    assert fold_radius(pole) == pytest.approx(size)
    assert largest_image_radius(pole) == math.inf


@pytest.mark.parametrize("least", [1e-12, 1e-14])
def test_a_slope_that_stays_above_zero_is_no_fold_however_little(least: float) -> None:
    """1 − 2 s + (1 + δ) s² is δ at its least."""
    assert fold_radius(RadialProfile((-2 / 3, (1 + least) / 5))) == math.inf
    assert fold_radius(RadialProfile((-2 / 3, (1 - least) / 5))) == pytest.approx(1, rel=1e-5)


@pytest.mark.parametrize(
    ("profile", "image"),
    [
        (RadialProfile(), math.inf),
        (RadialProfile((0.0,)), math.inf),
        (RadialProfile((-1 / 3,)), 4 / 9),  # the fold, at s = 1
        (RadialProfile((1 / 3,)), 4 / 9),  # the slope 1 + s, at s = −1, where g = 2/3
        (RadialProfile((1e-298,)), 4 / 27e-298),
        (RadialProfile((1e-310,)), math.inf),  # so far out that s is no number
        (RadialProfile((0.5, -0.2)), 0.245),  # (1 + 2 s)(1 − s/2): s = −1/2, where g = 0.7
        (RadialProfile((), (1.0,)), 1 / 4),  # the fold, at s = 1, where g = 1/2
        (RadialProfile((), (-1.0,)), 1 / 4),  # 1 + s, at s = −1, where g = 1/2
        (RadialProfile((1.0,), (2.0,)), 1 / math.sqrt(8)),  # s = (−1 ± i√7)/4, where |g|² = 1/2
        (RadialProfile((1.0,), (1.0,)), math.inf),  # nothing but a pole that a zero cancels
    ],
)
def test_the_inverse_bends_nearest_where_the_slope_vanishes_for_real_or_complex_radii(
    profile: RadialProfile, image: float
) -> None:
    """s is the squared radius and g = f/r, so that f² is s g²."""
    assert nearest_turning_image(profile) == pytest.approx(image)


def test_zeros_at_the_end_change_nothing_not_even_where_squares_overflow() -> None:
    assert evaluate(RadialProfile((0.1, 0.0)), 1e160) == math.inf
    assert evaluate(RadialProfile((0.1, 0.0, 0.0), (0.0, 0.0)), 2.0) == 2.8
