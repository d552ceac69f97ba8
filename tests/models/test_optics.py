"""The thin lens, vignetting and colour errors: textbook values, limits, and rays traced here."""

from fractions import Fraction
from math import factorial

import numpy as np
import pytest

from simulations.models.chromatic import (
    LINE_C_UM,
    LINE_D_UM,
    LINE_F_UM,
    Glass,
    axial_chromatic_mm,
    focal_length_mm,
    lateral_chromatic_scale,
    refractive_index,
)
from simulations.models.optics import (
    circle_of_confusion_mm,
    depth_of_field,
    field_of_view_rad,
    hyperfocal,
    thin_lens_image_distance,
)
from simulations.models.vignetting import (
    disc_overlap_area,
    mechanical_vignetting,
    vignetting_cos4,
)

GLASS = Glass()


def test_an_object_at_twice_the_focal_length_is_imaged_there_too():
    np.testing.assert_allclose(thin_lens_image_distance(50, [100, np.inf, 50]), [100, 50, np.inf])


def test_an_object_inside_the_focal_length_has_no_real_image():
    with pytest.raises(ValueError, match=r"distance_mm 49\.9: .* virtual"):
        thin_lens_image_distance(50, [1000, 49.9])


@pytest.mark.parametrize(("focus", "depth"), [(2000.0, 5000.0), (3000.0, 700.0), (900.0, 60.0)])
def test_the_blur_disc_is_where_the_cone_behind_the_lens_meets_the_sensor(focus, depth):
    focal, f_number = 50.0, 2.0
    sensor, sharp = (thin_lens_image_distance(focal, z) for z in (focus, depth))
    cone = focal / f_number * abs(sensor - sharp) / sharp
    assert circle_of_confusion_mm(focal, f_number, focus, depth) == pytest.approx(cone)


def test_blur_is_right_at_both_infinities():
    assert circle_of_confusion_mm(50, 2, np.inf, np.inf) == 0.0
    assert circle_of_confusion_mm(50, 2, np.inf, 5000) == pytest.approx(25 * 50 / 5000)
    assert circle_of_confusion_mm(50, 2, 2000, np.inf) == pytest.approx(25 * 50 / 1950)
    assert circle_of_confusion_mm(50, 2, 2000, 0.0) == np.inf
    assert circle_of_confusion_mm(50, 2, np.inf, 1.0) == pytest.approx(25 * 50)


def test_in_focus_even_an_endless_aperture_is_sharp():
    assert circle_of_confusion_mm(50, 1e-310, 2000, 2000) == 0.0


def test_a_pinhole_blurs_nothing():
    np.testing.assert_array_equal(circle_of_confusion_mm(50, np.inf, 2000, [0, 1, np.inf]), 0.0)
    assert depth_of_field(50, np.inf, 2000, 0.03) == (0.0, np.inf)


def test_at_the_limits_of_the_depth_of_field_the_blur_is_the_tolerance():
    limits = depth_of_field(50, 2.8, 3000, 0.03)
    assert limits[0] < 3000 < limits[1]
    np.testing.assert_allclose(circle_of_confusion_mm(50, 2.8, 3000, limits), 0.03)


def test_focused_at_the_hyperfocal_distance_sharpness_runs_from_half_of_it_to_infinity():
    distance = hyperfocal(50, 8, 0.03)
    assert distance == pytest.approx(50**2 / (8 * 0.03) + 50)
    near, far = depth_of_field(50, 8, distance, 0.03)
    assert near == pytest.approx(distance / 2)
    assert far == np.inf
    for short in (1e-2, 1e-9, 1e-13):
        far = depth_of_field(50, 8, (1 - short) * distance, 0.03)[1]
        assert far == pytest.approx((distance - 50) / short, rel=0.02)


def test_a_tolerance_too_small_for_a_number_leaves_only_infinity_sharp():
    assert depth_of_field(1e200, 1.0, np.inf, 1e-300) == (np.inf, np.inf)


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ((0, 2, 2000, 1), "focal_mm"),
        ((50, 0, 2000, 1), "f_number"),
        ((50, np.nan, 2000, 1), "f_number"),
        ((50, 2, 50, 1), "focus_mm"),
        ((50, 2, 2000, -1), "depth_mm"),
        ((50, 2, 2000, np.nan), "depth_mm"),
    ],
)
def test_meaningless_lenses_are_refused_by_name(arguments, name):
    with pytest.raises(ValueError, match=name):
        circle_of_confusion_mm(*arguments)


def test_a_sensor_twice_as_wide_as_the_focal_length_sees_ninety_degrees():
    assert field_of_view_rad(18, 36) == pytest.approx(np.pi / 2)


def test_natural_vignetting_is_the_fourth_power_of_the_cosine():
    angle = np.linspace(-1.5, 1.5, 61)
    np.testing.assert_allclose(vignetting_cos4(np.tan(angle)), np.cos(angle) ** 4, atol=1e-15)
    np.testing.assert_array_equal(vignetting_cos4([1e300, -np.inf]), 0.0)


def test_mechanical_vignetting_runs_from_a_free_to_a_closed_aperture():
    np.testing.assert_allclose(
        mechanical_vignetting([0.0, 0.1, -0.1, 5.0, np.inf], 5.0, 6.0, 10.0), [1, 1, 1, 0, 0]
    )


def test_the_cats_eye_has_the_area_counted_on_a_fine_grid():
    axis = np.linspace(-5, 5, 1001)
    x, y = np.meshgrid(axis, axis)
    pupil = np.hypot(x, y) <= 5
    counted = (pupil & (np.hypot(x - 4, y) <= 6)).sum() / pupil.sum()
    assert mechanical_vignetting(0.4, 5.0, 6.0, 10.0) == pytest.approx(counted, abs=1e-3)


def test_a_rim_narrower_than_the_pupil_stops_the_lens_down_on_the_axis():
    assert mechanical_vignetting(0.0, 5.0, 2.5, 10.0) == pytest.approx(0.25)


def test_the_glass_has_its_catalogue_numbers():
    f, d, c = refractive_index(GLASS, [LINE_F_UM, LINE_D_UM, LINE_C_UM])
    assert d == pytest.approx(1.5168)
    assert (d - 1) / (f - c) == pytest.approx(64.2)


def test_blue_focuses_nearer_than_red():
    focal = focal_length_mm(GLASS, 50.0, [LINE_F_UM, LINE_D_UM, LINE_C_UM])
    assert focal[0] < focal[1] < focal[2]
    assert focal[1] == pytest.approx(50.0)


def test_a_glass_without_dispersion_has_no_colour_error():
    glass = Glass(abbe_number=np.inf)
    np.testing.assert_array_equal(axial_chromatic_mm(glass, 50, 2, [0.4, 0.7]), 0.0)
    np.testing.assert_array_equal(lateral_chromatic_scale(glass, 50, 10, [0.4, 0.7]), 1.0)


def test_the_axial_blur_is_where_the_coloured_cone_meets_the_sensor():
    blue = focal_length_mm(GLASS, 50, 0.45)
    assert axial_chromatic_mm(GLASS, 50, 2, 0.45) == pytest.approx(25 * (50 - blue) / blue)


def test_the_lateral_scale_agrees_with_a_ray_traced_through_the_stop():
    focal_d, stop, slope = 50.0, 15.0, 0.2

    def height_on_sensor(focal):
        at_lens = stop * slope
        return at_lens + focal_d * (slope - at_lens / focal)

    blue = focal_length_mm(GLASS, focal_d, 0.45)
    expected = height_on_sensor(blue) / height_on_sensor(focal_d)
    assert lateral_chromatic_scale(GLASS, focal_d, stop, 0.45) == pytest.approx(expected)
    assert lateral_chromatic_scale(GLASS, focal_d, 0.0, 0.45) == 1.0


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: Glass(index_d=1.0), "index_d"),
        (lambda: Glass(abbe_number=0.0), "abbe_number"),
        (lambda: refractive_index(GLASS, [0.5, 0.0]), "wavelength_um"),
        (lambda: mechanical_vignetting(0.1, 0.0, 1.0, 1.0), "pupil_radius_mm"),
        (lambda: mechanical_vignetting(0.1, 1.0, 1.0, -1.0), "separation_mm"),
    ],
)
def test_meaningless_parameters_are_refused_by_name(call, name):
    with pytest.raises(ValueError, match=name):
        call()


def test_an_object_nearer_than_infinity_is_imaged_behind_the_focus():
    """Newton's form of the thin lens: (Z − f)(Z' − f) = f²."""
    distance = np.array([51.0, 80.0, 400.0])
    image = thin_lens_image_distance(50, distance)
    np.testing.assert_allclose((distance - 50) * (image - 50), 2500)


@pytest.mark.parametrize("focal", [0.0, -1.0, np.inf, np.nan])
def test_no_formula_takes_a_focal_length_that_is_none(focal):
    for call in (
        lambda: thin_lens_image_distance(focal, 1e3),
        lambda: hyperfocal(focal, 2, 0.03),
        lambda: field_of_view_rad(focal, 36),
        lambda: depth_of_field(focal, 2, 1e3, 0.03),
    ):
        with pytest.raises(ValueError, match="focal_mm"):
            call()


@pytest.mark.parametrize("f_number", [0.0, -2.0, np.nan])
def test_no_formula_takes_an_f_number_that_is_none(f_number):
    for call in (
        lambda: hyperfocal(50, f_number, 0.03),
        lambda: depth_of_field(50, f_number, 1e3, 0.03),
        lambda: axial_chromatic_mm(GLASS, 50, f_number, 0.5),
    ):
        with pytest.raises(ValueError, match="f_number"):
            call()


def test_a_tolerance_and_a_sensor_are_positive():
    for call, name in (
        (lambda: hyperfocal(50, 2, 0.0), "coc_mm"),
        (lambda: depth_of_field(50, 2, 1e3, 0.0), "coc_mm"),
        (lambda: field_of_view_rad(50, 0.0), "sensor_mm"),
    ):
        with pytest.raises(ValueError, match=name):
            call()


def test_on_the_lens_at_its_focus_and_focused_at_infinity_limits_are_legal():
    assert circle_of_confusion_mm(50, 2, 2000, 2000.0) == 0
    assert circle_of_confusion_mm(50, 2, np.inf, 0.0) == np.inf
    near, far = depth_of_field(50, 8, np.inf, 0.03)
    assert near == pytest.approx(50**2 / (8 * 0.03))
    assert far == np.inf


@pytest.mark.parametrize(("focal", "sensor"), [(50, 36), (24, 36), (18, 12)])
def test_the_field_of_view_is_twice_the_angle_to_its_edge(focal, sensor):
    assert np.tan(field_of_view_rad(focal, sensor) / 2) == pytest.approx(sensor / 2 / focal)


def test_the_fraunhofer_lines_are_where_fraunhofer_saw_them():
    """Micrometres, from any glass catalogue; BK7 has n_F 1.52238 and n_C 1.51432."""
    assert (LINE_F_UM, LINE_D_UM, LINE_C_UM) == (0.4861, 0.5876, 0.6563)
    f, c = refractive_index(GLASS, [0.4861, 0.6563])
    assert f == pytest.approx(1.52238, abs=2e-4)
    assert c == pytest.approx(1.51432, abs=2e-4)


@pytest.mark.parametrize(
    ("call", "name"),
    [
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
def test_what_lies_beyond_the_range_of_glass_and_lenses_is_refused(call, name):
    with pytest.raises(ValueError, match=name):
        call()


def test_the_ends_of_the_range_of_glass_and_lenses_are_legal():
    assert refractive_index(Glass(10.0, 1.0), LINE_D_UM) == 10.0
    assert refractive_index(GLASS, 0.1) > 1.5168
    for focal in (1e-9, 1e12):
        assert focal_length_mm(GLASS, focal, LINE_D_UM) == pytest.approx(focal)
    for stop in (-1e12, 1e12):
        assert lateral_chromatic_scale(GLASS, 50, stop, LINE_D_UM) == pytest.approx(1)


@pytest.mark.parametrize(("a", "b"), [(1.0, 1.0), (3.0, 2.0), (2.0, 3.0), (5.0, 0.5)])
def test_two_discs_share_all_of_the_smaller_nothing_or_a_lens(a, b):
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


def test_touching_discs_of_very_different_size_do_not_lose_digits():
    assert disc_overlap_area(0.0, 1e6, 1e-6) == pytest.approx(np.pi * 1e-12)
    assert mechanical_vignetting(0.1, 1e-40, 1.0, 1.0) == 1.0
    assert mechanical_vignetting(0.1, 1e40, 1.0, 1.0) == pytest.approx(0, abs=1e-70)


def test_all_distances_must_be_legal_and_not_only_one():
    with pytest.raises(ValueError, match="depth_mm"):
        circle_of_confusion_mm(50, 2, 2000, [10.0, -1.0])


def test_red_is_blurred_by_a_positive_disc_too():
    red = focal_length_mm(GLASS, 50, 0.7)
    assert axial_chromatic_mm(GLASS, 50, 2, 0.7) == pytest.approx(25 * (red - 50) / red)


def test_glass_may_bend_ever_so_little():
    assert refractive_index(Glass(1.05), LINE_D_UM) == 1.05


def test_lenses_faster_than_f_1_exist():
    assert depth_of_field(50, 0.95, 1e3, 0.03)[0] < 1e3
    assert circle_of_confusion_mm(50, 0.95, 1e3, 1e3) == 0
    assert hyperfocal(50, 0.5, 0.03) == pytest.approx(50**2 / 0.015 + 50)
    assert axial_chromatic_mm(GLASS, 50, 0.95, LINE_D_UM) == 0
    assert field_of_view_rad(0.5, 0.25) == pytest.approx(field_of_view_rad(50, 25))
    assert depth_of_field(0.5, 2, 10, 1e-3)[0] < 10


@pytest.mark.parametrize("separation", [0.0, 0.5])
def test_a_rim_may_lie_close_to_the_pupil_or_in_it(separation):
    free = mechanical_vignetting([0.0, 0.5], 5.0, 6.0, separation)
    np.testing.assert_array_equal(free, 1.0)


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_the_share_of_two_discs_does_not_depend_on_the_unit(unit):
    for apart in (0.0, 0.1, 1.0, 1.9):
        assert disc_overlap_area(apart * unit, unit, unit) == pytest.approx(
            disc_overlap_area(apart, 1.0, 1.0) * unit**2
        )


def test_discs_that_just_touch_from_within_or_without_share_a_finite_area():
    """Where rounding can take a cosine or a share beyond 1."""
    for a, b in np.random.default_rng(0).uniform(0.1, 3, (500, 2)):
        ends = np.array([np.nextafter(abs(a - b), 9), a + b, np.nextafter(a + b, 0)])
        area = disc_overlap_area(ends, a, b) / (np.pi * min(a, b) ** 2)
        np.testing.assert_allclose(area, [1, 0, 0], atol=1e-12)
        assert (area >= 0).all()
        assert (area <= 1).all()


def segment(sine_of_half):
    """x − sin x cos x, the area of a unit disc beyond a chord, from sin x/2; as a series."""
    turn = 4 * np.arcsin(sine_of_half)
    return sum(
        (-1) ** (k + 1) * turn ** (2 * k + 1) / (2 * factorial(2 * k + 1)) for k in range(1, 9)
    )


@pytest.mark.parametrize("overlap", [1e-3, 1e-5, 1e-8])
@pytest.mark.parametrize(("a", "b"), [(1.0, 1.0), (1.0, 1.3), (1.0, 0.2)])
def test_a_sliver_that_discs_share_keeps_its_digits(a, b, overlap):
    d = a + b - overlap
    exact_overlap = float(Fraction(a) + Fraction(b) - Fraction(d))
    halves = [
        np.sqrt(exact_overlap * (other - mine + d) / (4 * d * mine))
        for mine, other in ((a, b), (b, a))
    ]
    exact = a * a * segment(halves[0]) + b * b * segment(halves[1])
    assert disc_overlap_area(d, a, b) == pytest.approx(exact, rel=1e-14 / overlap, abs=1e-16)


@pytest.mark.parametrize("out", [1e-3, 1e-6])
def test_a_disc_that_hardly_sticks_out_of_another_loses_a_sliver(out):
    """The crescent: what the small disc has beyond the chord, less what the large one has."""
    d = 0.8 + out
    exact_out = float(Fraction(d) + Fraction(0.2) - 1)
    of_small = np.sqrt(exact_out * (d + 1.2) / (4 * d * 0.2))
    of_large = np.sqrt(exact_out * (1.2 - d) / (4 * d))
    crescent = 0.04 * segment(of_small) - segment(of_large)
    lost = np.pi * 0.04 - disc_overlap_area(d, 1.0, 0.2)
    assert lost == pytest.approx(crescent, abs=1e-15)


@pytest.mark.parametrize(("a", "b"), [(0.0, 1.0), (1.0, np.inf), (np.nan, 1.0), (1.0, -1.0)])
def test_discs_of_no_size_are_refused(a, b):
    with pytest.raises(ValueError, match="must be 1e-70 to 1e70"):
        disc_overlap_area(0.5, a, b)


@pytest.mark.parametrize("beyond", [1e-3, 1e-6, 1e-10])
def test_an_object_near_the_focal_point_is_imaged_as_far_off_as_it_should(beyond):
    distance = 50.0 * (1.0 + beyond)
    exact = 50 * Fraction(distance) / (Fraction(distance) - 50)
    assert thin_lens_image_distance(50.0, distance) == pytest.approx(float(exact), rel=1e-15)


@pytest.mark.parametrize("focus", [50.001, 1000.0, 1e6])
@pytest.mark.parametrize("off", [-1e-6, 1e-9, 1e-3])
def test_the_blur_of_what_is_nearly_in_focus_keeps_its_digits(focus, off):
    depth = focus * (1 + off)
    f, z, zf = Fraction(50), Fraction(depth), Fraction(focus)
    exact = f / 2 * f * zf / (zf - f) * abs(1 / z - 1 / zf)
    blur = circle_of_confusion_mm(50.0, 2.0, focus, depth)
    assert blur == pytest.approx(float(exact), rel=1e-14)


def test_the_cats_eye_is_the_same_on_both_sides_of_the_axis():
    left, right = mechanical_vignetting([-0.7, 0.7], 5.0, 6.0, 10.0)
    assert left == right < 0.6


@pytest.mark.parametrize("apart", [1e-5, 1e-10])
def test_discs_of_one_size_a_little_apart_share_all_but_a_strip(apart):
    assert disc_overlap_area(apart, 1.0, 1.0) == pytest.approx(np.pi - 2 * apart, abs=1e-13)
