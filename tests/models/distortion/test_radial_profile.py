"""Radial profiles: slope, fold and inverse, to all digits, and where no inverse exists."""

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import pytest

from simulations.models.arrays import Floats
from simulations.models.distortion import cubic_inverse
from simulations.models.distortion.lens_model import Distortion, undistort
from simulations.models.distortion.radial_inverse import invert_bracketed
from simulations.models.distortion.radial_profile import (
    RadialProfile,
    evaluate,
    fold_radius,
    largest_image_radius,
    nearest_turning_image,
    scale,
    scale_slope,
    slope,
)
from simulations.models.distortion.radial_table import (
    cell_of,
    grid_for,
    image_squared_at,
    shrinkage,
)

PROFILES = [
    RadialProfile((0.1,)),
    RadialProfile((-0.05, 0.02, 0.01)),
    RadialProfile((0.2, 0.1), (0.3, 0.05, 0.01)),
    RadialProfile((), (0.1, 0.02)),
    RadialProfile((0.0, 0.2)),
    RadialProfile((0.0, 0.0, 0.1), (0.0, 0.2)),
    RadialProfile((1.0,), (2.0,)),  # rises for ever, and tends to r/2
]
"""The third and the fourth fold."""


def series(coefficients: Sequence[float], s: Floats) -> Floats:
    total = np.zeros_like(s)
    for coefficient in (*reversed(coefficients), 1.0):
        total = total * s + np.longdouble(coefficient)
    return total


def bisect(profile: RadialProfile, image_radius: Floats) -> Floats:
    """The ideal radius, by bisection until floats run out.

    In 80-bit floats; 64 bits, as with some compilers, also suffice.
    """
    wanted = np.asarray(image_radius).astype(np.longdouble)
    low = np.zeros_like(wanted)
    high = np.full_like(wanted, min(fold_radius(profile), 100.0))
    for _ in range(80):
        middle = (low + high) / 2
        s = middle * middle
        beyond = middle * series(profile.numerator, s) > wanted * series(profile.denominator, s)
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return low


RADII = np.linspace(0.0, 1.2, 25)


def by_hand(profile: RadialProfile, r: Floats) -> Floats:
    n = 1 + sum(a * r ** (2 * i) for i, a in enumerate(profile.numerator, start=1))
    d = 1 + sum(b * r ** (2 * i) for i, b in enumerate(profile.denominator, start=1))
    return r * n / d


@pytest.mark.parametrize("profile", PROFILES)
def test_profile_is_the_quotient_of_its_sums(profile: RadialProfile) -> None:
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
def test_fold_is_where_the_slope_first_vanishes(
    profile: RadialProfile, fold: float, image: float
) -> None:
    assert fold_radius(profile) == pytest.approx(fold, rel=1e-6)
    assert largest_image_radius(profile) == pytest.approx(image, rel=1e-6)


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
def test_nearest_turn_of_the_inverse_is_at_a_real_or_complex_zero_slope(
    profile: RadialProfile, image: float
) -> None:
    """s is the squared radius and g = f/r, so that f² is s g²."""
    assert nearest_turning_image(profile) == pytest.approx(image)


FOLDS_AT_1, IDENTITY = RadialProfile((-1 / 3,)), RadialProfile((0.0,))
NAN, INF = math.nan, math.inf


@pytest.mark.parametrize(
    ("profile", "images", "radii", "valid"),
    [  # an image without a radius is put on the fold, or on the axis where there is no fold
        (FOLDS_AT_1, [0.67, -0.1, NAN, INF], [1, 1, 1, 1], False),
        (FOLDS_AT_1, [largest_image_radius(FOLDS_AT_1)], [1], False),
        (IDENTITY, [-0.1, NAN, INF], [0, 0, 0], False),
        (PROFILES[0], [-0.1, NAN, INF], [0, 0, 0], False),
        (IDENTITY, [0.0, 1e-300, 1e300], [0, 1e-300, 1e300], True),
        (RadialProfile((2.0,)), [2e30, 2e60], [1e10, 1e20], True),
        (RadialProfile((), (-0.25,)), [1e20], [2], False),  # the radius rounds to the pole
        (RadialProfile((), (-1e-301,)), [1e155], [0], False),  # a pole too far out to be found
    ],
)
def test_only_images_with_an_ideal_radius_are_valid(
    profile: RadialProfile, images: list[float], radii: list[float], valid: bool
) -> None:
    found, known = invert_bracketed(profile, images)
    assert known.tolist() == [valid] * len(images)
    np.testing.assert_allclose(found, radii, rtol=1e-12)


@pytest.mark.parametrize("numerator", [0.0, 0.3])
def test_images_close_to_a_pole_have_their_radius(numerator: float) -> None:
    """Images are computed in exact fractions, as the pole magnifies rounding errors."""
    short = [Fraction(1, 10**power) for power in range(1, 15)]
    radii = [Fraction(float(2 * (1 - each))) for each in short]
    a = Fraction(numerator)
    images = [float(r * (1 + a * r * r) / (1 - r * r / 4)) for r in radii]
    found, valid = invert_bracketed(RadialProfile((numerator,), (-0.25,)), images)
    assert valid.all()
    np.testing.assert_allclose(found, [float(r) for r in radii], rtol=1e-15)


LONGEST_FOCAL_PX = 2000.0

FURTHEST = 1.2
"""Ideal radius, 50° off the axis, up to which lenses without a fold are tried."""

LENSES = {
    "slight barrel": Distortion(k1=-0.05),
    "barrel": Distortion(k1=-0.2),
    "strong barrel": Distortion(k1=-0.5),
    "barrel that recovers": Distortion(k1=-0.3, k2=0.1),
    "action camera": Distortion(k1=-0.28, k2=0.07, k3=-0.009),
    "moustache": Distortion(k1=-0.2, k2=0.2),
    "pincushion": Distortion(k1=0.2),
    "strong pincushion": Distortion(k1=1.0),
    "strongest pincushion": Distortion(k1=2.0),
    "pincushion of three terms": Distortion(k1=0.4, k2=0.3, k3=0.2),
    "pincushion that folds": Distortion(k1=0.2, k2=-0.05, k3=-0.01),
    "strong pincushion that folds": Distortion(k1=1.0, k2=-0.5),
    "k3 alone": Distortion(k3=-0.1),
    "rational": Distortion(k1=0.1, k2=0.02, k3=0.01, k4=0.3, k5=0.05, k6=0.01),
    "rational that folds": Distortion(k4=1.0),
    "pole": Distortion(k4=-0.25),
    "hardly any": Distortion(k1=1e-13),
    "hardly any barrel": Distortion(k1=-1e-13),
}


def images_up_to_99_percent(profile: RadialProfile) -> Floats:
    """Image radii up to 99 % of the fold, in ideal radius as well as in the picture."""
    fold = fold_radius(profile)
    return np.linspace(0.0, evaluate(profile, min(0.99 * fold, max(FURTHEST, 0.99))), 4001)


@pytest.mark.parametrize("name", LENSES)
def test_inverse_is_precise_to_1e_9_px_within_99_percent_of_the_fold(name: str) -> None:
    lens = LENSES[name]
    image_radius = images_up_to_99_percent(lens.radial)
    turn = np.linspace(0.0, 20.0, image_radius.size)
    seen = image_radius[:, None] * np.stack((np.cos(turn), np.sin(turn)), axis=-1)
    ideal, valid = undistort(seen, lens)
    assert valid.all()
    # The radius to compare with is the rounded point's.
    x, y = seen.T.astype(np.longdouble)
    radius = np.hypot(x, y)
    ratio = np.divide(bisect(lens.radial, radius), radius, out=np.ones_like(x), where=radius > 0)
    off = np.hypot(ideal[:, 0] - x * ratio, ideal[:, 1] - y * ratio)
    assert LONGEST_FOCAL_PX * off.max() <= 1e-9  # a thousandth of the table's promise


def test_inverse_is_right_where_the_table_ends_at_a_nearly_flat_curve() -> None:
    """The slope 1 − 0.9 s + 0.2025001 s² comes within 4e-7 of zero, at r² = 2.22."""
    profile, flat = RadialProfile((-0.3, 0.04050002)), np.sqrt(0.9 / 0.405)
    image_radius = np.linspace(0.0, evaluate(profile, 2.0), 5000)
    known = shrinkage(profile, image_radius**2)[1]
    ends = image_radius[known].max()
    assert 0.9 * evaluate(profile, flat) < ends < evaluate(profile, flat)
    seen = image_radius[:, None] * [1.0, 0.0]
    ideal, valid = undistort(seen, Distortion(k1=-0.3, k2=0.04050002))
    assert valid.all()
    np.testing.assert_allclose(evaluate(profile, ideal[:, 0]), image_radius, rtol=1e-12)


BARREL, PINCUSHION, HARDLY = (RadialProfile((k,)) for k in (-1 / 3, 1 / 3, 1e-6))
"""The first folds at f² = 4/9, the inverse of the second turns at f² = −4/9, the third nowhere."""

CASES = [(BARREL, 1.0), (BARREL, 0.25), (PINCUSHION, 1.0), (PINCUSHION, 64.0), (HARDLY, 2.0)]


@pytest.mark.parametrize(("profile", "reach"), CASES)
@pytest.mark.parametrize("cells", [1, 256])
def test_each_place_of_the_table_is_found_in_its_cell(
    profile: RadialProfile, reach: float, cells: int
) -> None:
    grid = grid_for(profile, largest_image_radius(profile), reach, cells)
    places = np.linspace(0.0, cells, 1001)
    images = image_squared_at(grid, places)
    np.testing.assert_allclose(cell_of(grid, images), places, atol=1e-10)
    last = min(reach, largest_image_radius(profile) ** 2)
    np.testing.assert_allclose(sorted(images[[0, -1]]), [0.0, last], rtol=1e-13, atol=1e-14)


def test_cubic_inverse_is_unknown_at_the_fold_and_beyond() -> None:
    profile = RadialProfile((-1 / 3,))  # folds at 1, whose image is 2/3
    images = np.array([0.1, 0.666, 2 / 3, 0.7, np.inf, np.nan])
    factor, known = cubic_inverse.shrinkage(profile, images**2)
    assert known.tolist() == [True, True, False, False, False, False]
    assert factor[2:].tolist() == [1.0] * 4
    np.testing.assert_allclose((factor * images)[:2], [0.10034, 0.97407], rtol=1e-3)
