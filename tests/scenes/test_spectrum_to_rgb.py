"""The spectrum figure shows what light, surface and sensor make of each other."""

from functools import partial

import numpy as np
import pytest
from support.frames import frame_of

from simulations.engine.frame import Frame
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import encode_srgb
from simulations.scenes._spectra.choices import LIGHTS
from simulations.scenes._spectra.patches import CELL, LEFT, UNIT
from simulations.scenes.spectrum_to_rgb.scene import SCENE
from simulations.scenes.spectrum_to_rgb.stages import CHART, Colours

DAY: dict[str, object] = {"light": "daylight", "temperature": 6500}


frame = partial(frame_of, SCENE)


def colours(**given: object) -> Colours:
    found: Colours = SCENE.run(SCENE.check(given), "", StageCache()).outputs["colours"]
    return found


def texts(shown: Frame) -> dict[str, str]:
    return {item.name: item.text for item in shown.readouts}


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("sensor", ["camera", "eye"])
@pytest.mark.parametrize("matrix", ["daylight", "own"])
def test_a_grey_surface_comes_out_grey_in_every_light(light: str, sensor: str, matrix: str) -> None:
    white = colours(light=light, sensor=sensor, matrix=matrix).srgb[0, -1]
    assert np.ptp(white) < 0.05 * white.mean()


def test_the_eyes_own_curves_make_no_error_in_the_light_that_the_matrix_is_made_for() -> None:
    assert colours(**DAY, sensor="eye").error[0].max() < 0.05


@pytest.mark.parametrize("light", ["planck", "fluorescent", "diode"])
def test_a_matrix_made_for_the_light_errs_less_over_the_chart(light: str) -> None:
    own, other = (colours(light=light, matrix=each).error[0, 1:] for each in ("own", "daylight"))
    assert own.mean() < 0.7 * other.mean()


def test_the_twins_are_one_colour_to_the_eye_in_daylight_and_two_to_the_camera() -> None:
    day = colours(**DAY)
    np.testing.assert_allclose(day.meant[0], day.meant[1], atol=1e-9)
    assert np.abs(day.srgb[0] - day.srgb[1]).max() > 0.02


def test_the_patches_show_each_step_of_the_chosen_surface_and_its_twin_below() -> None:
    raster = frame(light="fluorescent", twin=True).panels[0].raster
    assert raster is not None
    found = colours(light="fluorescent")
    for row, step in enumerate((found.raw, found.balanced, found.srgb, found.meant)):
        for half in (0, 1):
            y = (CHART.top(row) + CHART.row * (0.25 + 0.5 * half)) / UNIT
            for column in (1, 8):
                x = (LEFT + (column + 0.5) * CELL) / UNIT
                expected = 255 * np.clip(encode_srgb(step[half, column]), 0, 1)
                shown = raster[int(y), int(x), :3]
                np.testing.assert_allclose(shown, expected, atol=0.51, err_msg=CHART.rows[row][0])


def test_gains_read_out_make_white_of_the_raw_white() -> None:
    shown = texts(frame(surface="white"))
    red, green, blue = (float(each) for each in shown["raw"].split(" / "))
    assert red * float(shown["gain_red"]) == pytest.approx(green, rel=0.02)
    assert blue * float(shown["gain_blue"]) == pytest.approx(green, rel=0.02)
