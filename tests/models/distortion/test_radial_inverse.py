"""The slow and sure inverse of a radial profile: to all digits, and knowing where there is none."""

import math
from fractions import Fraction

import numpy as np
import pytest
from support.radial_profiles import PROFILES

from simulations.models.arrays import Floats
from simulations.models.distortion import radial_inverse
from simulations.models.distortion.radial_inverse import invert_bracketed
from simulations.models.distortion.radial_profile import (
    RadialProfile,
    evaluate,
    fold_radius,
    largest_image_radius,
    slope_towards,
)


@pytest.mark.parametrize("profile", [*PROFILES, RadialProfile((-1 / 3,)), RadialProfile((3.0,))])
@pytest.mark.parametrize("reach", [1e-6, 0.9, 40.0])
def test_the_inverse_returns_the_radius_to_all_digits(profile: RadialProfile, reach: float) -> None:
    radii = np.linspace(0.0, min(reach, 0.95 * fold_radius(profile)), 201).reshape(3, 67)
    found, valid = invert_bracketed(profile, evaluate(profile, radii))
    assert valid.all()
    np.testing.assert_allclose(found, radii, rtol=1e-12, atol=1e-15)


BARREL, IDENTITY = RadialProfile((-1 / 3,)), RadialProfile((0.0,))
NAN, INF = math.nan, math.inf


@pytest.mark.parametrize(
    ("profile", "images", "radii", "valid"),
    [  # what has no radius is put on the fold, or without a fold on the axis
        (BARREL, [0.67, -0.1, NAN, INF], [1, 1, 1, 1], False),
        (BARREL, [largest_image_radius(BARREL)], [1], False),
        (IDENTITY, [-0.1, NAN, INF], [0, 0, 0], False),
        (PROFILES[0], [-0.1, NAN, INF], [0, 0, 0], False),
        (IDENTITY, [0.0, 1e-300, 1e300], [0, 1e-300, 1e300], True),
        (RadialProfile((2.0,)), [2e30, 2e60], [1e10, 1e20], True),
        (RadialProfile((), (-0.25,)), [1e20], [2], False),  # the radius rounds to the pole
        (RadialProfile((), (-1e-301,)), [1e155], [0], False),  # a pole too far out to be found
    ],
)
def test_what_has_a_radius_is_valid_however_far_and_the_rest_is_not(
    profile: RadialProfile, images: list[float], radii: list[float], valid: bool
) -> None:
    found, known = invert_bracketed(profile, images)
    assert known.tolist() == [valid] * len(images)
    np.testing.assert_allclose(found, radii, rtol=1e-12)


def test_the_search_goes_on_for_as_long_as_sixth_powers_are_numbers() -> None:
    """The curve tends to r/2."""
    profile = RadialProfile((1.0,), (2.0,))
    found, valid = invert_bracketed(profile, [1e30, 2.0**148 * (1 - 1e-9), 2.0**148 * (1 + 1e-9)])
    assert valid.tolist() == [True, True, False]
    np.testing.assert_allclose(found, [2e30, 2.0**149, 0.0], rtol=1e-8)


@pytest.fixture
def steps(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """One entry for each step of Newton's: it is those that need a slope."""
    made: list[float] = []

    def noted(profile: RadialProfile, radius: Floats, image: Floats) -> Floats:
        made.append(radius.size)
        return slope_towards(profile, radius, image)

    monkeypatch.setattr(radial_inverse, "slope_towards", noted)
    return made


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e4])
@pytest.mark.parametrize("short_of_it", [1e-9, 1e-12, 1e-14, 1e-15, 3e-16])
def test_up_to_the_last_digits_before_the_fold_it_ends_after_a_few_steps(
    steps: list[float], size: float, short_of_it: float
) -> None:
    profile = RadialProfile((-1 / 3 / size**2,))
    radius, valid = invert_bracketed(profile, 2 / 3 * size * (1.0 - short_of_it))
    if valid:  # the largest image is known up to rounding, and so is what lies before it
        # 2/3 − f(r) is (1 − r)² near the fold of r − r³/3.
        expected = size * (1.0 - np.sqrt(2 / 3 * short_of_it))
        assert radius == pytest.approx(expected, abs=size * max(1e-8, short_of_it))
    assert valid or short_of_it < 1e-15
    assert len(steps) <= 14


def test_a_search_for_what_lies_too_far_out_ends_when_halving_has_run_out_of_floats(
    steps: list[float],
) -> None:
    assert not invert_bracketed(RadialProfile((0.5,)), 1e200)[1]
    assert len(steps) <= np.finfo(float).nmant + 2


@pytest.mark.parametrize("level", [1e-12, 1e-8, 1e-6])
def test_on_a_nearly_level_stretch_it_takes_a_few_steps_more(
    steps: list[float], level: float
) -> None:
    """The slope 1 − 2 s + (1 + δ) s² is δ at its least, at s = 1: a matter of rounding there."""
    profile = RadialProfile((-2 / 3, (1 + level) / 5))
    middle = float(evaluate(profile, 1.0))
    nearest = middle * (1 + np.finfo(float).eps * np.arange(-13, 14))
    for image in (*nearest, middle * (1 + 1e-9)):
        radius, valid = invert_bracketed(profile, image)
        assert valid
        assert evaluate(profile, radius) == pytest.approx(image, rel=1e-14)
    assert len(steps) / 28 < 14  # on the mean


@pytest.mark.parametrize("numerator", [0.0, 0.3])
def test_close_to_a_pole_every_image_has_its_radius(numerator: float) -> None:
    """Images are made in exact fractions: in floats the pole would distort them."""
    short = [Fraction(1, 10**power) for power in range(1, 15)]
    radii = [Fraction(float(2 * (1 - each))) for each in short]
    a = Fraction(numerator)
    images = [float(r * (1 + a * r * r) / (1 - r * r / 4)) for r in radii]
    found, valid = invert_bracketed(RadialProfile((numerator,), (-0.25,)), images)
    assert valid.all()
    np.testing.assert_allclose(found, [float(r) for r in radii], rtol=1e-15)
