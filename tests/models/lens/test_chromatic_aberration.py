"""Glass and the colour errors of lenses: catalogues, Fraunhofer's lines, and rays traced here."""

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

GLASS = Glass()


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


def test_the_fraunhofer_lines_are_where_fraunhofer_saw_them() -> None:
    """Micrometres, from any glass catalogue; BK7 has n_F 1.52238 and n_C 1.51432."""
    assert (LINE_F_UM, LINE_D_UM, LINE_C_UM) == (0.4861, 0.5876, 0.6563)
    f, c = refractive_index(GLASS, [0.4861, 0.6563])
    assert f == pytest.approx(1.52238, abs=2e-4)
    assert c == pytest.approx(1.51432, abs=2e-4)
    assert (1.5168 - 1) / (f - c) == pytest.approx(64.2)
    assert focal_length_mm(GLASS, 50.0, LINE_D_UM) == pytest.approx(50.0)
