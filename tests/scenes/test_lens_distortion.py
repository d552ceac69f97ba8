"""The lens-distortion figure: its map, its correction, its margin, and its handles."""

import math

import numpy as np
import pytest
from support.frames import frame_of, pixels_of

from simulations.engine.settings import values_of
from simulations.engine.stages import StageCache, run
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.sampling.resampling import gather_source
from simulations.pictures.checker_room import checker_room
from simulations.scenes.lens_distortion.scene import SCENE
from simulations.scenes.lens_distortion.stages import (
    STAGES,
    Photo,
    _corrected,
    _map,
    _through_lens,
    needs_margin,
    pixel_radii,
)

TIER = SCENE.accuracy.default
UNUSED = Photo(np.zeros(()), np.zeros(()))  # only an ideal lens reads it


def test_linear_ramp_through_the_lens_shows_ideal_coordinates() -> None:
    y, x = np.mgrid[:420, :560].astype(np.float32)
    warp = _map(pixel_radii(), -0.2, 0.05, TIER, margin=True)
    seen = _through_lens(UNUSED, gather_source(np.stack((x, y), axis=-1)), warp).linear
    ideal = (seen - [279.5, 209.5]) / 200.0
    rows, columns = np.mgrid[:240, :320]
    expected = (np.stack((columns, rows), axis=-1) - [159.5, 119.5]) / 200.0
    covered = warp.coverage == 1.0
    assert covered.mean() > 0.99
    image = distort(ideal[covered], Distortion(k1=-0.2, k2=0.05))
    np.testing.assert_allclose(image, expected[covered], atol=2e-5)


def test_correction_restores_the_picture_within_the_photograph() -> None:
    pinhole = checker_room(560, 420, 200.0)
    warp = _map(pixel_radii(), -0.1, 0.0, TIER, margin=True)
    photo = _through_lens(UNUSED, gather_source(pinhole), warp)
    restored, truth = _corrected(photo, -0.1, 0.0), pinhole[90:330, 120:440]
    error = np.abs(restored.linear - truth)[restored.coverage > 0.99].mean()
    assert error < 0.15 * np.abs(photo.linear - truth).mean()


def test_picture_is_grey_past_the_fold() -> None:
    corners = pixels_of(frame_of(SCENE, k1=-0.5))[[0, 0, -1, -1], [0, -1, 0, -1], :3]
    np.testing.assert_array_equal(corners, corners[:1].repeat(4, axis=0))


@pytest.mark.parametrize("shown", ["room", "chart"])
@pytest.mark.parametrize(("k1", "k2"), [(0.0, 0.0), (0.01, 0.0), (0.0, 0.01), (0.5, 0.2)])
def test_margin_changes_nothing_without_a_barrel(shown: str, k1: float, k2: float) -> None:
    assert not needs_margin(k1, k2)
    settings = values_of(SCENE.check({"picture": shown, "k1": k1, "k2": k2}))
    given = {**settings, "tier": TIER, "photograph": None}
    tight, wide = (
        run(STAGES, {**given, "margin": margin}, StageCache()).outputs for margin in (False, True)
    )
    assert (tight["pinhole"].shape, wide["pinhole"].shape) == ((240, 320, 3), (420, 560, 3))
    difference = np.abs(tight["encoded"].astype(int) - wide["encoded"])
    assert difference.max() <= 1
    assert (difference > 0).mean() < 1e-3


MARKED = {"point", "outer"}
"""Handles of the marked points of the photograph."""


def test_handles_stay_inside_the_photograph_and_hide_once_corrected() -> None:
    points = [each for each in frame_of(SCENE, k1=0.5, k2=0.3).handles if each.name in MARKED]
    margins = [min(each.x, 400 - each.x, each.y, 300 - each.y) for each in points]
    assert margins == [pytest.approx(15)] * 2
    middle = [math.atan2(each.y - 150, each.x - 200) for each in points]
    assert middle == pytest.approx([math.atan2(0.45, 0.6), math.atan2(-0.54, 0.72)], abs=1e-4)
    corrected = frame_of(SCENE, k1=-0.2, correct=True).handles
    assert not {place.name for place in corrected} & MARKED
