"""The Bayer figure: mosaic first, then reconstruction and its error."""

import numpy as np
import pytest

from simulations.engine.controls import check_values
from simulations.engine.pipeline import StageCache
from simulations.models.demosaicing import METHODS
from simulations.scenes.bayer_demosaic import SCENE


@pytest.fixture(scope="module")
def cache():
    return StageCache(depth=8)


def frame(cache, **values):
    return SCENE.render(check_values(SCENE.controls, values), "", cache)


def texts(shown):
    return {item.name: item.text for item in shown.readouts}


def test_each_pixel_of_the_mosaic_shows_one_colour(cache):
    raster = frame(cache).panels[0].raster
    assert np.count_nonzero(raster[..., :3], axis=2).max() == 1
    assert not raster[::2, ::2, 1:3].any()  # RGGB: red stands first


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
