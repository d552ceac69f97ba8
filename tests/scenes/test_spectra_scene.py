"""Figures on spectra: what light, surface, eye and sensor make of each other."""

import numpy as np
import pytest
from support.frames import frame_of, outputs_of, pixels_of, texts_at

from simulations.models.color.chromaticity import ILLUMINANT_A_XY
from simulations.models.color.srgb import encode_srgb
from simulations.scenes._spectra import CELL, FINE, LEFT, LIGHTS, PLOT, UNIT
from simulations.scenes.light_and_cloth import SCENE as CLOTH
from simulations.scenes.spectrum_to_rgb import CHART
from simulations.scenes.spectrum_to_rgb import SCENE as SENSOR

DAY: dict[str, object] = {"light": "daylight", "temperature": 6500}
OTHERS = [light for light in LIGHTS if light != "daylight"]


def test_twins_match_in_daylight_alone() -> None:
    assert outputs_of(CLOTH, **DAY)["seen"].apart.max() < 0.1
    for light in OTHERS:
        seen = outputs_of(CLOTH, light=light)["seen"]
        assert seen.apart.min() > 1, light
        np.testing.assert_allclose(seen.by_day[0], seen.by_day[1], atol=1e-9)


def test_the_white_of_a_lamp_lies_at_illuminant_a() -> None:
    white = outputs_of(CLOTH, temperature=2850)["seen"].white_xy
    assert white == pytest.approx(ILLUMINANT_A_XY, abs=0.002)


def test_the_area_in_colours_ends_at_the_light_sent_back() -> None:
    """White sends back nine tenths of the light; a narrow band, next to nothing away from it."""
    x, y = (round(FINE * each) for each in PLOT.at(650, 0.3))
    narrow = frame_of(CLOTH, surface="cloth", band=450, width=10, light="daylight")
    assert pixels_of(narrow)[y, x, 3] == 0
    assert pixels_of(frame_of(CLOTH, surface="white", **DAY))[y, x, 3] == 255


def test_rows_of_patches_touch_unless_twins_lie_between() -> None:
    for twin, rows in ((False, 1), (True, 2)):
        opaque = pixels_of(frame_of(CLOTH, twin=twin), 1)[..., 3].any(axis=1)
        assert np.count_nonzero(np.diff(opaque.astype(int)) == 1) == rows


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("sensor", ["camera", "eye"])
def test_a_grey_surface_comes_out_grey_and_a_matrix_for_the_light_errs_less(
    light: str, sensor: str
) -> None:
    errors = []
    for matrix in ("own", "daylight"):
        colours = outputs_of(SENSOR, light=light, sensor=sensor, matrix=matrix)["colours"]
        white = colours.srgb[0, -1]
        assert np.ptp(white) < 0.05 * white.mean()
        errors.append(colours.error[0, 1:].mean())
    assert errors[0] < 0.7 * errors[1] or light == "daylight"


def test_the_eye_s_own_curves_make_no_error_in_daylight_and_a_camera_s_do() -> None:
    assert outputs_of(SENSOR, **DAY, sensor="eye")["colours"].error[0].max() < 0.05
    day = outputs_of(SENSOR, **DAY)["colours"]
    np.testing.assert_allclose(day.meant[0], day.meant[1], atol=1e-9)
    assert np.abs(day.srgb[0] - day.srgb[1]).max() > 0.02


def test_the_patches_show_each_step_of_a_surface_and_its_twin_below() -> None:
    raster = pixels_of(frame_of(SENSOR, light="fluorescent", twin=True))
    found = outputs_of(SENSOR, light="fluorescent")["colours"]
    for row, step in enumerate((found.raw, found.balanced, found.srgb, found.meant)):
        for half, column in ((0, 1), (1, 1), (0, 8), (1, 8)):
            y = (CHART.top(row) + CHART.row * (0.25 + 0.5 * half)) / UNIT
            x = (LEFT + (column + 0.5) * CELL) / UNIT
            expected = 255 * np.clip(encode_srgb(step[half, column]), 0, 1)
            np.testing.assert_allclose(raster[int(y), int(x), :3], expected, atol=0.51)


def test_gains_read_out_make_white_of_the_raw_white() -> None:
    shown = texts_at(SENSOR, surface="white")
    red, green, blue = (float(each) for each in shown["raw"].split(" / "))
    assert red * float(shown["gain_red"]) == pytest.approx(green, rel=0.02)
    assert blue * float(shown["gain_blue"]) == pytest.approx(green, rel=0.02)
