"""The thin lens: textbook values, limits, traced rays, and chromatic aberration."""

from fractions import Fraction

import numpy as np
import pytest

from simulations.models.lens.chromatic_aberration import (
    LINE_C_UM,
    LINE_D_UM,
    LINE_F_UM,
    Glass,
    axial_chromatic_mm,
    focal_length_mm,
    lateral_chromatic_scale,
    refractive_index,
)
from simulations.models.lens.spectral_bands import Band, chosen_wavelengths, even_wavelengths
from simulations.models.lens.thin_lens import (
    circle_of_confusion_mm,
    depth_of_field,
    hyperfocal,
    thin_lens_image_distance,
)


@pytest.mark.parametrize(("focus", "depth"), [(2000.0, 5000.0), (3000.0, 700.0), (900.0, 60.0)])
def test_blur_disc_is_the_cone_behind_the_lens_cut_by_the_sensor(
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
        (1e-310, 2000, 2000, 0.0),  # in focus even an infinite aperture is sharp
        (np.inf, 2000, np.inf, 0.0),
    ],
)
def test_blur_is_correct_in_focus_and_at_its_limits(
    f_number: float, focus: float, depth: float, blur: float
) -> None:
    assert circle_of_confusion_mm(50, f_number, focus, depth) == pytest.approx(blur)


def test_blur_at_the_limits_of_the_depth_of_field_is_the_tolerance() -> None:
    limits = depth_of_field(50, 2.8, 3000, 0.03)
    assert limits[0] < 3000 < limits[1]
    np.testing.assert_allclose(circle_of_confusion_mm(50, 2.8, 3000, limits), 0.03)


def test_focus_at_the_hyperfocal_distance_is_sharp_from_half_of_it_on() -> None:
    distance = hyperfocal(50, 8, 0.03)
    assert distance == pytest.approx(50**2 / (8 * 0.03) + 50)
    near, far = depth_of_field(50, 8, distance, 0.03)
    assert near == pytest.approx(distance / 2)
    assert far == np.inf
    assert depth_of_field(50, 8, np.inf, 0.03) == pytest.approx((distance - 50, np.inf))
    for short in (1e-2, 1e-9, 1e-13):
        far = depth_of_field(50, 8, (1 - short) * distance, 0.03)[1]
        assert far == pytest.approx((distance - 50) / short, rel=0.02)


@pytest.mark.parametrize("beyond", [1e-3, 1e-6, 1e-10])
def test_object_near_the_focal_point_has_an_exact_image_distance(beyond: float) -> None:
    distance = 50.0 * (1.0 + beyond)
    exact = 50 * Fraction(distance) / (Fraction(distance) - 50)
    assert thin_lens_image_distance(50.0, distance) == pytest.approx(float(exact), rel=1e-15)


GLASS = Glass()


@pytest.mark.parametrize("wavelength", [0.45, 0.7])
def test_axial_blur_is_the_coloured_cone_cut_by_the_sensor(wavelength: float) -> None:
    focal = focal_length_mm(GLASS, 50, wavelength)
    blur = axial_chromatic_mm(GLASS, 50, 2, wavelength)
    assert blur == pytest.approx(25 * abs(50 - focal) / focal)


def test_lateral_scale_agrees_with_a_ray_through_the_stop() -> None:
    focal_d, stop, slope = 50.0, 15.0, 0.2

    def height_on_sensor(focal: float) -> float:
        at_lens = stop * slope
        return at_lens + focal_d * (slope - at_lens / focal)

    blue = float(focal_length_mm(GLASS, focal_d, 0.45))
    expected = height_on_sensor(blue) / height_on_sensor(focal_d)
    assert lateral_chromatic_scale(GLASS, focal_d, stop, 0.45) == pytest.approx(expected)
    assert lateral_chromatic_scale(GLASS, focal_d, 0.0, 0.45) == 1.0


def test_fraunhofer_lines_and_bk7_have_their_catalogue_values() -> None:
    """Micrometres, from any glass catalogue; BK7 has n_F 1.52238 and n_C 1.51432."""
    assert (LINE_F_UM, LINE_D_UM, LINE_C_UM) == (0.4861, 0.5876, 0.6563)
    f, c = refractive_index(GLASS, [0.4861, 0.6563])
    assert f == pytest.approx(1.52238, abs=2e-4)
    assert c == pytest.approx(1.51432, abs=2e-4)
    assert (1.5168 - 1) / (f - c) == pytest.approx(64.2)
    assert focal_length_mm(GLASS, 50.0, LINE_D_UM) == pytest.approx(50.0)


PEAKS, WIDTH = (0.6, 0.54, 0.46), 0.03


def moment_about(band: Band, power: int, about: float) -> float:
    return float(band.shares @ (band.wavelengths_um - about) ** power)


@pytest.mark.parametrize("count", [1, 2, 3, 5])
def test_chosen_wavelengths_have_the_moments_of_the_bell_curve(count: int) -> None:
    """Exact up to the power 2n − 1: 1, 0, σ², 0, 3σ⁴ ..."""
    band = chosen_wavelengths(0.54, WIDTH, count)
    moments = [1, 0, WIDTH**2, 0, 3 * WIDTH**4, 0, 15 * WIDTH**6, 0, 105 * WIDTH**8, 0]
    for power, moment in enumerate(moments[: 2 * count]):
        assert moment_about(band, power, 0.54) == pytest.approx(moment, rel=1e-9, abs=1e-15)


def test_many_even_wavelengths_have_the_moments_of_each_bell() -> None:
    bands = even_wavelengths(PEAKS, WIDTH, 0.3, 0.8, 60)
    for band, peak in zip(bands, PEAKS, strict=True):
        assert band.shares.sum() == pytest.approx(1)
        assert moment_about(band, 1, peak) == pytest.approx(0, abs=1e-7)
        assert moment_about(band, 2, peak) == pytest.approx(WIDTH**2, rel=1e-4)


def test_curve_between_two_wavelengths_is_taken_at_the_nearest() -> None:
    narrow, far = even_wavelengths((0.6, 60.0), 1e-5, 0.38, 0.72, 3)
    np.testing.assert_array_equal(narrow.shares, [0, 1, 0])
    np.testing.assert_array_equal(far.shares, [0, 0, 1])
