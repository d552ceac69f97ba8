"""Chromatic aberration and vignetting of the figure against their formulas, and in its pixels."""

import math

import numpy as np
import pytest

from simulations.engine.controls import check_values
from simulations.engine.pipeline import StageCache, run
from simulations.models.chromatic import LINE_D_UM
from simulations.pictures.resolution_chart import resolution_chart
from simulations.scenes.lens_aberrations import (
    FOCAL_MM,
    FOCAL_PX,
    SCENE,
    STAGES,
    colours,
    light,
    magnify,
    stops,
)


def values(**given):
    return check_values(SCENE.controls, given)


def frame(cache=None, **given):
    return SCENE.render(values(**given), "", cache or StageCache())


def texts(**given):
    return {item.name: item.text for item in frame(**given).readouts}


def outputs(**given):
    return run(STAGES, values(**given), StageCache()).outputs


@pytest.mark.parametrize(("glass", "abbe"), [("crown", 64.2), ("flint", 36.4)])
def test_blue_and_red_differ_in_size_by_t_over_f_v(glass, abbe):
    scale = colours(glass, 12, 2.8).scale
    assert scale[0] - scale[2] == pytest.approx(12 / (FOCAL_MM * abbe))
    assert scale[1] == 1  # the d line is the measure


def test_moving_the_stop_behind_the_lens_swaps_red_and_blue():
    before, behind = (colours("crown", t, 2.8).scale - 1 for t in (10, -10))
    assert behind == pytest.approx(-before)
    assert float(texts(stop=0)["lateral"]) == 0


def test_axial_discs_are_inverse_to_the_f_number():
    wide, narrow = (colours("flint", 0, n).disc_px for n in (2, 8))
    assert wide == pytest.approx(4 * narrow)
    assert wide[1] == 0
    assert LINE_D_UM == 0.5876


def test_corners_lose_two_stops_to_cos4_at_every_aperture():
    for aperture in (1.4, 16):
        assert texts(aperture=aperture, rim=0)["natural_stops"] == "−2.00"
    assert texts(natural="false", rim=0)["corner_stops"] == "0.00"


def test_the_rim_cuts_wide_bundles_and_spares_narrow_ones():
    shares = [light(np.array([0.0, 1.0]), n, 6, False)[1] for n in (1.4, 2.8, 16)]
    assert all(share[0] == 1 for share in shares)
    assert shares[0][1] < shares[1][1] < shares[2][1] == 1


def test_no_light_is_minus_infinity_stops():
    assert stops(0) == -math.inf
    assert stops(0.25) == -2


def test_magnifying_agrees_with_a_chart_drawn_at_that_size():
    """Differential: interpolation against the analytic chart, whose scale is its focal length."""
    chart = resolution_chart(336, 256, FOCAL_PX)[..., 0]
    truth = resolution_chart(336, 256, FOCAL_PX * 1.02)[..., 0]
    before = np.abs(chart - truth)[8:-8, 8:-8]
    after = np.abs(magnify(chart, 1.02) - truth)[8:-8, 8:-8]
    assert after.mean() < 0.25 * before.mean()
    assert magnify(chart, 1.0) is chart


def test_magnifying_keeps_a_straight_ramp_to_the_last_digit():
    ramp = np.add.outer(np.arange(40.0), 3 * np.arange(60.0)).astype(np.float32)
    expected = ramp.mean() + (ramp - ramp.mean()) / 1.02
    assert magnify(ramp, 1.02)[4:-4, 4:-4] == pytest.approx(expected[4:-4, 4:-4], abs=1e-3)


def test_red_and_blue_edges_lie_apart_in_the_picture_by_the_shift_read_out():
    """An edge of the chart's border, 150 px right of the centre: where its area puts it."""
    planes = outputs(glass="flint", stop=15, aperture=16)["lateral"]
    edges = []
    for channel in (0, 2):
        row = planes[channel, 116:124, 302:316].mean(axis=0)
        bright, dark = row[:2].mean(), row[-2:].mean()
        edges.append(302 + ((row - dark) / (bright - dark)).sum())  # as if the edge were hard
    radius = np.mean(edges) - 159.5
    assert edges[1] - edges[0] == pytest.approx(-15 / (24 * 36.4) * radius, abs=0.1)


def test_an_ideal_lens_at_small_aperture_shows_the_chart_itself():
    planes = outputs(glass="ideal", aperture=16, rim=0, natural="false")
    chart = resolution_chart(336, 256, FOCAL_PX).transpose(2, 0, 1)[:, 8:-8, 8:-8]
    assert np.array_equal(planes["axial"], chart)
    assert (planes["vignetting"] == 1).all()


@pytest.mark.parametrize("aperture", [1.4, 16])
@pytest.mark.parametrize("stop", [-15, 15])
@pytest.mark.parametrize("rim", [0, 12])
def test_every_extreme_can_be_drawn_in_the_same_layout(aperture, stop, rim):
    shown = frame(aperture=aperture, stop=stop, rim=rim, glass="flint")
    assert [panel.name for panel in shown.panels] == ["picture", "corner", "profile"]


def test_the_rim_leaves_the_colours_alone():
    cache = StageCache()
    frame(cache)
    again = frame(cache, rim=0)
    assert [s.name for s in again.stages if s.status == "computed"] == ["vignetting", "encoded"]
