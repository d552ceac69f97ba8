"""The thin lens, vignetting and colour errors: textbook values, limits, and rays traced here."""

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
from simulations.models.vignetting import mechanical_vignetting, vignetting_cos4

GLASS = Glass()


def test_an_object_at_twice_the_focal_length_is_imaged_there_too():
    np.testing.assert_allclose(thin_lens_image_distance(50, [100, np.inf, 50]), [100, 50, np.inf])


def test_an_object_inside_the_focal_length_has_no_real_image():
    with pytest.raises(ValueError, match="virtual"):
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
    assert depth_of_field(50, 8, 0.99 * distance, 0.03)[1] < np.inf


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
