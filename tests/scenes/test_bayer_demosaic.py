"""The Bayer figure: mosaic first, then reconstruction and its error."""

import numpy as np
import pytest

from simulations.engine.controls import check_values
from simulations.engine.pipeline import StageCache
from simulations.models.demosaicing import METHODS
from simulations.registry import load_ladder
from simulations.scenes.bayer_demosaic import METHOD_LABELS, SCENE


@pytest.fixture(scope="module")
def cache():
    return StageCache(depth=8)


def frame(cache, **values):
    return SCENE.render(check_values(SCENE.controls, values), "", cache)


def texts(shown):
    return {item.name: item.text for item in shown.readouts}


def test_each_pixel_of_the_mosaic_shows_one_colour(cache):
    cells = frame(cache).panels[0].raster[::2, ::2]
    assert np.count_nonzero(cells[..., :3], axis=2).max() == 1
    assert not cells[::2, ::2, 1:3].any()  # RGGB: red stands first


def test_the_whole_mosaic_has_two_samples_a_cell_and_is_smoothed(cache):
    """Any other scale than a whole number would beat with the pattern, seen on a screen."""
    whole, close = (frame(cache, view=view).panels[0] for view in ("whole", "close"))
    cells = whole.raster[::2, ::2]
    np.testing.assert_array_equal(cells.repeat(2, axis=0).repeat(2, axis=1), whole.raster)
    assert (whole.pixelated, close.pixelated) == (False, True)


def test_a_quarter_a_half_and_a_quarter_are_measured(cache):
    assert texts(frame(cache))["samples"] == "25 / 50 / 25"


@pytest.mark.parametrize("method", METHODS)
def test_pressing_demosaic_shows_the_error_of_the_method(cache, method):
    shown = frame(cache, demosaic=1, method=method)
    assert 15 < float(texts(shown)["psnr"]) < 60
    assert shown.panels[1].raster[..., :3].any()


def test_nearest_is_the_worst(cache):
    psnr = {m: float(texts(frame(cache, demosaic=1, method=m))["psnr"]) for m in METHODS}
    assert min(psnr, key=psnr.get) == "nearest"


@pytest.mark.parametrize("demosaic", [0, 1])
@pytest.mark.parametrize("view", ["whole", "close"])
def test_layout_never_changes(cache, demosaic, view):
    shown = frame(cache, demosaic=demosaic, view=view)
    assert [(p.name, p.width, p.height) for p in shown.panels] == [
        ("picture", 400, 320),
        ("error", 400, 320),
    ]
    assert list(texts(shown)) == ["samples", "guessed", "method", "psnr", "worst"]


def test_changing_the_method_keeps_picture_and_mosaic():
    cache = StageCache()
    frame(cache, demosaic=1)
    reports = frame(cache, demosaic=1, method="menon").stages
    assert [report.status for report in reports] == ["reused", "reused", "computed", "computed"]


def told(cache, **given):
    (estimate,) = SCENE.error(check_values(SCENE.controls, given), "", cache)
    return estimate


def test_the_method_is_the_rung_of_the_ladder_and_so_no_second_menu_is_offered():
    assert list(METHOD_LABELS) == [tier.id for tier in load_ladder(SCENE.ladder).tiers]
    assert SCENE.tiers == ()


@pytest.mark.parametrize("method", METHODS)
def test_the_error_by_colour_adds_up_to_the_psnr_read_out(cache, method):
    """PSNR is 10 log₁₀ of 255² over the mean of the three squared errors."""
    estimate = told(cache, demosaic=1, method=method)
    red, green, blue = (float(part) for part in estimate.text.split(", "))
    mean_square = (red**2 + green**2 + blue**2) / 3
    psnr = float(texts(frame(cache, demosaic=1, method=method))["psnr"])
    assert 10 * np.log10(255**2 / mean_square) == pytest.approx(psnr, abs=0.15)


def test_green_is_measured_twice_as_often_and_errs_least(cache):
    red, green, blue = (
        float(part) for part in told(cache, demosaic=1, method="bilinear").text.split(", ")
    )
    assert green < min(red, blue)


def test_the_error_of_a_colour_is_that_of_the_bytes_shown(cache):
    """The error picture shows four times the error, cut off at white."""
    given = {"demosaic": 1, "method": "malvar"}
    errors = frame(cache, **given).panels[1].raster[8:-8, 8:-8, :3] / 4.0
    seen = np.sqrt(np.mean(errors**2, axis=(0, 1)))
    parts = [float(part) for part in told(cache, **given).text.split(", ")]
    assert (seen <= np.array(parts) + 0.1).all()
    assert seen == pytest.approx(parts, rel=0.1)


def test_a_mosaic_has_no_error_to_tell(cache):
    estimate = told(cache, demosaic=0)
    assert estimate.text.startswith("none yet")
    assert estimate.unit == ""
