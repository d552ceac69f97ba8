"""The thin lens: textbook values, limits, and rays traced here."""

from fractions import Fraction

import numpy as np
import pytest

from simulations.models.lens.thin_lens import (
    circle_of_confusion_mm,
    depth_of_field,
    hyperfocal,
    thin_lens_image_distance,
)


@pytest.mark.parametrize(("focus", "depth"), [(2000.0, 5000.0), (3000.0, 700.0), (900.0, 60.0)])
def test_the_blur_disc_is_where_the_cone_behind_the_lens_meets_the_sensor(
    focus: float, depth: float
) -> None:
    focal, f_number = 50.0, 2.0
    sensor, sharp = (thin_lens_image_distance(focal, z) for z in (focus, depth))
    cone = focal / f_number * abs(sensor - sharp) / sharp
    assert circle_of_confusion_mm(focal, f_number, focus, depth) == pytest.approx(cone)


@pytest.mark.parametrize(
    ("f_number", "focus", "depth", "blur"),
    [
        (2, np.inf, np.inf, 0.0),
        (2, np.inf, 5000, 25 * 50 / 5000),
        (2, np.inf, 1.0, 25 * 50),
        (2, np.inf, 0.0, np.inf),
        (2, 2000, np.inf, 25 * 50 / 1950),
        (2, 2000, 0.0, np.inf),
        (2, 2000, 2000.0, 0.0),
        (0.95, 1e3, 1e3, 0.0),
        (1e-310, 2000, 2000, 0.0),  # in focus even an endless aperture is sharp
        (np.inf, 2000, np.inf, 0.0),
    ],
)
def test_blur_is_right_at_both_infinities_and_in_focus(
    f_number: float, focus: float, depth: float, blur: float
) -> None:
    assert circle_of_confusion_mm(50, f_number, focus, depth) == pytest.approx(blur)


def test_at_the_limits_of_the_depth_of_field_the_blur_is_the_tolerance() -> None:
    limits = depth_of_field(50, 2.8, 3000, 0.03)
    assert limits[0] < 3000 < limits[1]
    np.testing.assert_allclose(circle_of_confusion_mm(50, 2.8, 3000, limits), 0.03)


def test_focused_at_the_hyperfocal_distance_sharpness_runs_from_half_of_it_to_infinity() -> None:
    distance = hyperfocal(50, 8, 0.03)
    assert distance == pytest.approx(50**2 / (8 * 0.03) + 50)
    near, far = depth_of_field(50, 8, distance, 0.03)
    assert near == pytest.approx(distance / 2)
    assert far == np.inf
    assert depth_of_field(50, 8, np.inf, 0.03) == pytest.approx((distance - 50, np.inf))
    for short in (1e-2, 1e-9, 1e-13):
        far = depth_of_field(50, 8, (1 - short) * distance, 0.03)[1]
        assert far == pytest.approx((distance - 50) / short, rel=0.02)


def test_a_tolerance_too_small_for_a_number_leaves_only_infinity_sharp() -> None:
    assert depth_of_field(1e200, 1.0, np.inf, 1e-300) == (np.inf, np.inf)


@pytest.mark.parametrize("beyond", [1e-3, 1e-6, 1e-10])
def test_an_object_near_the_focal_point_is_imaged_as_far_off_as_it_should(beyond: float) -> None:
    distance = 50.0 * (1.0 + beyond)
    exact = 50 * Fraction(distance) / (Fraction(distance) - 50)
    assert thin_lens_image_distance(50.0, distance) == pytest.approx(float(exact), rel=1e-15)


@pytest.mark.parametrize("focus", [50.001, 1000.0, 1e6])
@pytest.mark.parametrize("off", [-1e-6, 1e-9, 1e-3])
def test_the_blur_of_what_is_nearly_in_focus_keeps_its_digits(focus: float, off: float) -> None:
    depth = focus * (1 + off)
    f, z, zf = Fraction(50), Fraction(depth), Fraction(focus)
    exact = f / 2 * f * zf / (zf - f) * abs(1 / z - 1 / zf)
    blur = circle_of_confusion_mm(50.0, 2.0, focus, depth)
    assert blur == pytest.approx(float(exact), rel=1e-14)
