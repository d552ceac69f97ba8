"""The depth-of-field figure: numbers by hand, limits, refusals, and the blur in the picture."""

import math

import numpy as np
import pytest

from simulations.engine.controls import check_values
from simulations.engine.pipeline import StageCache
from simulations.models import optics
from simulations.scenes.camera_lens import PITCH_MM
from simulations.scenes.depth_of_field import (
    FAR_M,
    LARGEST_DRAWN_PX,
    SCENE,
    drawn_focus_m,
    sharpness,
)
from simulations.scenes.depth_of_field_drawing import disc_scale, half_opening


def frame(cache=None, **given):
    return SCENE.render(check_values(SCENE.controls, given), "", cache or StageCache())


def texts(**given):
    return {item.name: item.text for item in frame(**given).readouts}


def detail(raster, rows, columns):
    """Root mean square of the steps between neighbouring pixels."""
    return np.diff(raster[rows, columns, 1].astype(float), axis=1).std()


def test_the_worked_example_of_the_chapter():
    shown = texts(focal_length=50, aperture=1.4, focus=3.2)
    assert (shown["far_mm"], shown["far_px"]) == ("0.340", "2.5")
    assert shown["near_px"] == "3.0"


def test_the_sensor_stands_where_the_thin_lens_equation_puts_it():
    sharp = sharpness(50, 2, 1.0)
    assert 1 / sharp.image_mm == pytest.approx(1 / 50 - 1 / 1000)


def test_at_the_limits_of_depth_of_field_the_disc_is_one_pixel():
    sharp = sharpness(85, 2.8, 3.0)
    for limit_m in (sharp.near_limit_m, sharp.far_limit_m):
        disc = optics.circle_of_confusion_mm(85, 2.8, 3000, 1000 * limit_m)
        assert disc == pytest.approx(PITCH_MM)


def test_from_the_hyperfocal_distance_on_infinity_is_sharp():
    hyperfocal_m = optics.hyperfocal(24, 8, PITCH_MM) / 1000
    assert math.isfinite(sharpness(24, 8, 0.99 * hyperfocal_m).far_limit_m)
    assert math.isinf(sharpness(24, 8, 1.01 * hyperfocal_m).far_limit_m)
    assert texts(focal_length=24, aperture=8, focus=2)["far_limit"] == "∞"


@pytest.mark.parametrize(("focus", "word"), [(0.05, "inside"), (0.10, "at")])
def test_focus_at_or_inside_the_focal_length_is_refused_with_the_reason(focus, word):
    shown = frame(focal_length=100, focus=focus)
    assert f"lies {word} the focal length of 100 mm" in shown.description
    assert {item.text for item in shown.readouts[:7]} == {"—"}
    assert [panel.name for panel in shown.panels] == ["lens", "picture"]


def test_focus_decides_which_part_of_the_picture_has_detail():
    near = frame(focal_length=50, focus=1.85).panels[1].raster
    far = frame(focal_length=50, focus=8).panels[1].raster
    chart = (slice(15, 60), slice(115, 160))
    assert detail(far, *chart) > 1.5 * detail(near, *chart)


def test_stopping_down_sharpens_what_is_out_of_focus():
    chart = (slice(15, 60), slice(115, 160))
    wide, narrow = (frame(aperture=n, focus=1.85).panels[1].raster for n in (1.4, 16))
    assert detail(narrow, *chart) > 1.5 * detail(wide, *chart)


@pytest.mark.parametrize("focal", [24, 135])
def test_the_drawn_blur_stops_at_its_limit(focal):
    drawn = drawn_focus_m(focal, 1.4, 0.15)
    disc = optics.circle_of_confusion_mm(focal, 1.4, 1000 * drawn, 1000 * FAR_M) / PITCH_MM
    assert disc <= LARGEST_DRAWN_PX + 1e-9
    if drawn > 0.15:
        assert disc == pytest.approx(LARGEST_DRAWN_PX)
    assert drawn_focus_m(focal, 1.4, 3.2) == 3.2


@pytest.mark.parametrize("largest_mm", [1e-12, 0.03, 0.4, 7, 900])
def test_the_scale_is_a_round_number_and_the_largest_disc_fits(largest_mm):
    half = half_opening(20)
    scale = disc_scale(largest_mm, half)
    assert scale * largest_mm <= 0.7 * half * (1 + 1e-9)
    mantissa = scale / 10 ** math.floor(math.log10(scale) + 1e-9)
    assert round(mantissa, 6) in (1, 2, 5)


@pytest.mark.parametrize("focal", [24, 135])
@pytest.mark.parametrize("aperture", [1.4, 22])
@pytest.mark.parametrize("focus", [0.05, 0.15, 10])
def test_every_extreme_can_be_drawn_in_the_same_layout(focal, aperture, focus):
    shown = frame(focal_length=focal, aperture=aperture, focus=focus)
    assert [item.name for item in shown.readouts] == list(texts())


def test_aperture_reuses_the_lit_scene():
    cache = StageCache()
    frame(cache)
    again = frame(cache, aperture=2)
    assert [s.name for s in again.stages if s.status == "computed"] == [
        "defocus",
        "overlay",
        "encoded",
    ]


def test_the_draft_is_a_coarser_picture_of_the_same_size_with_the_same_numbers():
    values = check_values(SCENE.controls, {"aperture": 16})
    draft, settled = (SCENE.render(values, tier, StageCache()) for tier in ("draft", "layers"))
    coarse, fine = (shown.panels[1].raster.astype(float) for shown in (draft, settled))
    assert coarse.shape == fine.shape
    assert 0 < np.abs(coarse - fine).mean() < 6
    assert draft.readouts == settled.readouts
