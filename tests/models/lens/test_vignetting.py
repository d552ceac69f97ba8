"""Vignetting: cosines, the area that two discs share, and cat's eyes."""

from collections.abc import Callable
from fractions import Fraction
from math import factorial

import numpy as np
import pytest

from simulations.models.lens.chromatic_aberration import (
    Glass,
    focal_length_mm,
    lateral_chromatic_scale,
    refractive_index,
)
from simulations.models.lens.vignetting import (
    disc_overlap_area,
    mechanical_vignetting,
    vignetting_cos4,
)

GLASS = Glass()


def test_natural_vignetting_is_the_fourth_power_of_the_cosine() -> None:
    angle = np.linspace(-1.5, 1.5, 61)
    np.testing.assert_allclose(vignetting_cos4(np.tan(angle)), np.cos(angle) ** 4, atol=1e-15)
    np.testing.assert_array_equal(vignetting_cos4([1e300, -np.inf]), 0.0)


def test_mechanical_vignetting_runs_from_a_free_to_a_closed_aperture() -> None:
    np.testing.assert_allclose(
        mechanical_vignetting([0.0, 0.1, -0.1, 5.0, np.inf], 5.0, 6.0, 10.0), [1, 1, 1, 0, 0]
    )


def test_a_rim_at_the_aperture_itself_hides_no_more_at_a_right_angle_than_elsewhere() -> None:
    seen = mechanical_vignetting([0.0, 1e300, np.inf, -np.inf], 5.0, 4.0, 0.0)
    np.testing.assert_allclose(seen, 0.64)
    assert np.isnan(mechanical_vignetting(np.nan, 5.0, 4.0, 0.0))


def test_the_cats_eye_has_the_area_counted_on_a_fine_grid() -> None:
    axis = np.linspace(-5, 5, 1001)
    x, y = np.meshgrid(axis, axis)
    pupil = np.hypot(x, y) <= 5
    counted = (pupil & (np.hypot(x - 4, y) <= 6)).sum() / pupil.sum()
    left, right = mechanical_vignetting([-0.4, 0.4], 5.0, 6.0, 10.0)
    assert left == right == pytest.approx(counted, abs=1e-3)


def test_a_rim_narrower_than_the_pupil_stops_the_lens_down_on_the_axis() -> None:
    assert mechanical_vignetting(0.0, 5.0, 2.5, 10.0) == pytest.approx(0.25)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: Glass(index_d=1.0), "index_d"),
        (lambda: Glass(abbe_number=0.0), "abbe_number"),
        (lambda: refractive_index(GLASS, [0.5, 0.0]), "wavelength_um"),
        (lambda: mechanical_vignetting(0.1, 0.0, 1.0, 1.0), "pupil_radius_mm"),
        (lambda: mechanical_vignetting(0.1, 1.0, 1.0, -1.0), "separation_mm"),
        (lambda: Glass(index_d=10.5), "index_d"),
        (lambda: Glass(index_d=np.nan), "index_d"),
        (lambda: Glass(abbe_number=0.99), "abbe_number"),
        (lambda: Glass(abbe_number=np.nan), "abbe_number"),
        (lambda: refractive_index(GLASS, 0.099), "wavelength_um"),
        (lambda: focal_length_mm(GLASS, 0.0, 0.5), "focal_d_mm"),
        (lambda: focal_length_mm(GLASS, 0.9e-9, 0.5), "focal_d_mm"),
        (lambda: focal_length_mm(GLASS, 1.1e12, 0.5), "focal_d_mm"),
        (lambda: lateral_chromatic_scale(GLASS, 50, 1.1e12, 0.5), "stop_distance_mm"),
        (lambda: lateral_chromatic_scale(GLASS, 50, -1.1e12, 0.5), "stop_distance_mm"),
        (lambda: lateral_chromatic_scale(GLASS, 50, np.nan, 0.5), "stop_distance_mm"),
        (lambda: mechanical_vignetting(0.1, np.inf, 1.0, 1.0), "pupil_radius_mm"),
        (lambda: mechanical_vignetting(0.1, 1.0, 0.0, 1.0), "rim_radius_mm"),
        (lambda: mechanical_vignetting(0.1, 1.0, np.inf, 1.0), "rim_radius_mm"),
        (lambda: mechanical_vignetting(0.1, 1.0, 1.0, np.inf), "separation_mm"),
    ],
)
def test_parameters_out_of_range_are_refused_by_name(call: Callable[[], object], name: str) -> None:
    with pytest.raises(ValueError, match=name):
        call()


@pytest.mark.parametrize(("a", "b"), [(1.0, 1.0), (3.0, 2.0), (2.0, 3.0), (5.0, 0.5)])
def test_two_discs_share_all_of_the_smaller_nothing_or_a_lens(a: float, b: float) -> None:
    """The lens by the integral of the chords that both discs have."""
    apart = np.array([0.0, 0.9 * abs(a - b), abs(a - b), a + b, 2 * (a + b)])
    smaller = np.pi * min(a, b) ** 2
    np.testing.assert_allclose(
        disc_overlap_area(apart, a, b), [smaller, smaller, smaller, 0, 0], atol=1e-9
    )
    for d in (abs(a - b) + 0.1, 0.5 * (abs(a - b) + a + b), a + b - 0.1):
        x = np.linspace(-a - b, a + 2 * b, 400_001)
        half = [np.sqrt(np.maximum(r * r - (x - at) ** 2, 0)) for r, at in ((a, 0.0), (b, d))]
        area = 2 * np.minimum(*half).sum() * (x[1] - x[0])
        assert disc_overlap_area(d, a, b) == pytest.approx(area, rel=1e-5)


def test_touching_discs_of_very_different_size_do_not_lose_digits() -> None:
    assert disc_overlap_area(0.0, 1e6, 1e-6) == pytest.approx(np.pi * 1e-12)
    assert mechanical_vignetting(0.1, 1e-40, 1.0, 1.0) == 1.0
    assert mechanical_vignetting(0.1, 1e40, 1.0, 1.0) == pytest.approx(0, abs=1e-70)


@pytest.mark.parametrize("separation", [0.0, 0.5])
def test_a_rim_may_lie_close_to_the_pupil_or_in_it(separation: float) -> None:
    free = mechanical_vignetting([0.0, 0.5], 5.0, 6.0, separation)
    np.testing.assert_array_equal(free, 1.0)


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_the_share_of_two_discs_does_not_depend_on_the_unit(unit: float) -> None:
    for apart in (0.0, 0.1, 1.0, 1.9):
        assert disc_overlap_area(apart * unit, unit, unit) == pytest.approx(
            disc_overlap_area(apart, 1.0, 1.0) * unit**2
        )


def test_discs_that_just_touch_from_within_or_without_share_a_finite_area() -> None:
    """Where rounding can take a cosine or a share beyond 1."""
    for a, b in np.random.default_rng(0).uniform(0.1, 3, (500, 2)):
        ends = np.array([np.nextafter(abs(a - b), 9), a + b, np.nextafter(a + b, 0)])
        area = disc_overlap_area(ends, a, b) / (np.pi * min(a, b) ** 2)
        np.testing.assert_allclose(area, [1, 0, 0], atol=1e-12)
        assert (area >= 0).all()
        assert (area <= 1).all()


def segment(sine_of_half: float) -> float:
    """x − sin x cos x, the area of a unit disc beyond a chord, from sin x/2; as a series."""
    turn = 4 * np.arcsin(sine_of_half)
    return sum(
        (-1) ** (k + 1) * turn ** (2 * k + 1) / (2 * factorial(2 * k + 1)) for k in range(1, 9)
    )


@pytest.mark.parametrize("overlap", [1e-3, 1e-5, 1e-8])
@pytest.mark.parametrize(("a", "b"), [(1.0, 1.0), (1.0, 1.3), (1.0, 0.2)])
def test_a_sliver_that_discs_share_keeps_its_digits(a: float, b: float, overlap: float) -> None:
    d = a + b - overlap
    exact_overlap = float(Fraction(a) + Fraction(b) - Fraction(d))
    halves = [
        np.sqrt(exact_overlap * (other - mine + d) / (4 * d * mine))
        for mine, other in ((a, b), (b, a))
    ]
    exact = a * a * segment(halves[0]) + b * b * segment(halves[1])
    assert disc_overlap_area(d, a, b) == pytest.approx(exact, rel=1e-14 / overlap, abs=1e-16)


@pytest.mark.parametrize("out", [1e-3, 1e-6])
def test_a_disc_that_hardly_sticks_out_of_another_loses_a_sliver(out: float) -> None:
    """The crescent: what the small disc has beyond the chord, less what the large one has."""
    d = 0.8 + out
    exact_out = float(Fraction(d) + Fraction(0.2) - 1)
    of_small = np.sqrt(exact_out * (d + 1.2) / (4 * d * 0.2))
    of_large = np.sqrt(exact_out * (1.2 - d) / (4 * d))
    crescent = 0.04 * segment(of_small) - segment(of_large)
    lost = np.pi * 0.04 - disc_overlap_area(d, 1.0, 0.2)
    assert lost == pytest.approx(crescent, abs=1e-15)


def test_discs_may_be_from_1e_minus_70_to_1e70_wide() -> None:
    shared = disc_overlap_area([0.0, 2e70], 1e-70, 1e70)
    np.testing.assert_allclose(shared / (np.pi * 1e-140), [1, 0])


@pytest.mark.parametrize("large", [1e6, 1e12, 1e20, 1e60])
def test_a_disc_on_the_rim_of_one_that_is_many_times_as_large_is_halved(large: float) -> None:
    """The rim is a straight line, but for a strip of area 1/(3 R) that it bends away from."""
    halved = np.pi / 2 - 1 / (3 * large)
    assert disc_overlap_area(large, 1.0, large) == pytest.approx(halved, abs=1e-15)


@pytest.mark.parametrize("cut", [-0.96875, -0.5, 0.25, 0.9375])
def test_a_very_large_disc_cuts_another_as_a_straight_edge_does(cut: float) -> None:
    """What of a unit disc lies to the left of x = −cut: acos(cut) − cut √(1 − cut²)."""
    straight = np.arccos(cut) - cut * np.sqrt(1 - cut * cut)
    assert disc_overlap_area(2.0**46 + cut, 1.0, 2.0**46) == pytest.approx(straight, abs=1e-14)


def test_discs_share_as_much_to_either_side_of_each_other() -> None:
    left, right = disc_overlap_area([-0.7, 0.7], 1.0, 0.8)
    assert left == right < np.pi * 0.64


@pytest.mark.parametrize(
    ("a", "b"), [(0.99e-70, 1.0), (1.0, 1.01e70), (1.0, np.inf), (np.nan, 1.0), (1.0, -1.0)]
)
def test_discs_of_no_size_are_refused(a: float, b: float) -> None:
    with pytest.raises(ValueError, match="legal: 1e-70 to 1e70"):
        disc_overlap_area(0.5, a, b)


@pytest.mark.parametrize("apart", [1e-5, 1e-10])
def test_discs_of_one_size_a_little_apart_share_all_but_a_strip(apart: float) -> None:
    assert disc_overlap_area(apart, 1.0, 1.0) == pytest.approx(np.pi - 2 * apart, abs=1e-13)
