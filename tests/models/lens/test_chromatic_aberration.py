"""Glass and the colour errors of lenses: catalogues, Fraunhofer's lines, and rays traced here."""

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
from simulations.models.lens.thin_lens import (
    circle_of_confusion_mm,
    depth_of_field,
    hyperfocal,
)

GLASS = Glass()


def test_the_glass_has_its_catalogue_numbers() -> None:
    f, d, c = refractive_index(GLASS, [LINE_F_UM, LINE_D_UM, LINE_C_UM])
    assert d == pytest.approx(1.5168)
    assert (d - 1) / (f - c) == pytest.approx(64.2)


def test_blue_focuses_nearer_than_red() -> None:
    focal = focal_length_mm(GLASS, 50.0, [LINE_F_UM, LINE_D_UM, LINE_C_UM])
    assert focal[0] < focal[1] < focal[2]
    assert focal[1] == pytest.approx(50.0)


def test_a_glass_without_dispersion_has_no_colour_error() -> None:
    glass = Glass(abbe_number=np.inf)
    np.testing.assert_array_equal(axial_chromatic_mm(glass, 50, 2, [0.4, 0.7]), 0.0)
    np.testing.assert_array_equal(lateral_chromatic_scale(glass, 50, 10, [0.4, 0.7]), 1.0)


@pytest.mark.parametrize("wavelength", [0.45, 0.7])
def test_the_axial_blur_is_where_the_coloured_cone_meets_the_sensor(wavelength: float) -> None:
    focal = focal_length_mm(GLASS, 50, wavelength)
    blur = axial_chromatic_mm(GLASS, 50, 2, wavelength)
    assert blur == pytest.approx(25 * abs(50 - focal) / focal)


def test_the_lateral_scale_agrees_with_a_ray_traced_through_the_stop() -> None:
    focal_d, stop, slope = 50.0, 15.0, 0.2

    def height_on_sensor(focal: float) -> float:
        at_lens = stop * slope
        return at_lens + focal_d * (slope - at_lens / focal)

    blue = float(focal_length_mm(GLASS, focal_d, 0.45))
    expected = height_on_sensor(blue) / height_on_sensor(focal_d)
    assert lateral_chromatic_scale(GLASS, focal_d, stop, 0.45) == pytest.approx(expected)
    assert lateral_chromatic_scale(GLASS, focal_d, 0.0, 0.45) == 1.0


@pytest.mark.parametrize("f_number", [0.0, -2.0, np.nan])
def test_no_formula_takes_an_f_number_that_is_none(f_number: float) -> None:
    for call in (
        lambda: hyperfocal(50, f_number, 0.03),
        lambda: depth_of_field(50, f_number, 1e3, 0.03),
        lambda: axial_chromatic_mm(GLASS, 50, f_number, 0.5),
    ):
        with pytest.raises(ValueError, match="f_number"):
            call()


def test_the_fraunhofer_lines_are_where_fraunhofer_saw_them() -> None:
    """Micrometres, from any glass catalogue; BK7 has n_F 1.52238 and n_C 1.51432."""
    assert (LINE_F_UM, LINE_D_UM, LINE_C_UM) == (0.4861, 0.5876, 0.6563)
    f, c = refractive_index(GLASS, [0.4861, 0.6563])
    assert f == pytest.approx(1.52238, abs=2e-4)
    assert c == pytest.approx(1.51432, abs=2e-4)


def test_the_ends_of_the_range_of_glass_and_lenses_are_legal() -> None:
    assert refractive_index(Glass(10.0, 1.0), LINE_D_UM) == 10.0
    assert refractive_index(Glass(1.05), LINE_D_UM) == 1.05
    assert refractive_index(GLASS, 0.1) > 1.5168
    for focal in (1e-9, 1e12):
        assert focal_length_mm(GLASS, focal, LINE_D_UM) == pytest.approx(focal)
    for stop in (-1e12, 1e12):
        assert lateral_chromatic_scale(GLASS, 50, stop, LINE_D_UM) == pytest.approx(1)


def test_lenses_faster_than_f_1_exist() -> None:
    assert depth_of_field(50, 0.95, 1e3, 0.03)[0] < 1e3
    assert circle_of_confusion_mm(50, 0.95, 1e3, 1e3) == 0
    assert hyperfocal(50, 0.5, 0.03) == pytest.approx(50**2 / 0.015 + 50)
    assert axial_chromatic_mm(GLASS, 50, 0.95, LINE_D_UM) == 0
    assert depth_of_field(0.5, 2, 10, 1e-3)[0] < 10
