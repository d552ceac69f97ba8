"""The Lens Distortion Simulator: its numbers by hand, its stages, and every corner of its range."""

import numpy as np
import pytest

from simulations.engine.controls import Slider
from simulations.engine.frame import Frame, Raster
from simulations.engine.handles import pulled
from simulations.engine.settings import values_of
from simulations.engine.stages import StageCache, run
from simulations.models.distortion.lens_model import Distortion, distort
from simulations.models.sampling.resampling import gather_source
from simulations.pictures.checker_room import checker_room
from simulations.scenes.lens_distortion.radii import TIERS, inversion_error_px, pixel_radii
from simulations.scenes.lens_distortion.scene import SCENE
from simulations.scenes.lens_distortion.settings import Settings
from simulations.scenes.lens_distortion.stages import (
    STAGES,
    Photo,
    _corrected,
    _map,
    _through_lens,
    needs_margin,
)

TIER = SCENE.default_tier
UNSEEN = Photo(np.zeros(()), np.zeros(()))
"""What a lens that is not ideal does not look at."""


def render(cache: StageCache | None = None, **given: object) -> Frame:
    return SCENE.render(SCENE.check(given), "", StageCache() if cache is None else cache)


def statuses(frame: Frame) -> dict[str, str]:
    return {stage.name: stage.status for stage in frame.stages}


def places_of(frame: Frame) -> set[str]:
    return {place.name for place in frame.handles}


def picture(frame: Frame) -> Raster:
    raster = next(panel.raster for panel in frame.panels if panel.name == "picture")
    assert raster is not None
    return raster


def test_the_ideal_lens_passes_on_the_pinhole_picture_untouched() -> None:
    frame = render()
    assert {statuses(frame)[name] for name in ("map", "through-lens", "corrected")} == {"skipped"}


def test_past_the_fold_the_picture_is_grey() -> None:
    frame = render(k1=-0.5)
    corners = picture(frame)[[0, 0, -1, -1], [0, -1, 0, -1], :3]
    assert len(np.unique(corners, axis=0)) == 1


def test_a_linear_ramp_through_the_lens_shows_the_ideal_coordinate() -> None:
    y, x = np.mgrid[:420, :560].astype(np.float32)
    ramp = np.stack((x, y), axis=-1)
    warp = _map(pixel_radii(), -0.2, 0.05, TIER, margin=True)
    seen = _through_lens(UNSEEN, gather_source(ramp), warp).linear
    ideal = (seen - [279.5, 209.5]) / 200.0
    rows, columns = np.mgrid[:240, :320]
    expected = (np.stack((columns, rows), axis=-1) - [159.5, 119.5]) / 200.0
    covered = warp.coverage == 1.0
    assert covered.mean() > 0.99
    image = distort(ideal[covered], Distortion(k1=-0.2, k2=0.05))
    np.testing.assert_allclose(image, expected[covered], atol=2e-5)


@pytest.mark.parametrize("tier", ["checked-table", "newton-bracketed"])
@pytest.mark.parametrize("k1", [-0.5, -0.3, 0.2, 0.5])
def test_the_careful_tiers_err_by_less_than_a_billionth_of_a_pixel_past_the_fold_too(
    tier: str, k1: float
) -> None:
    assert inversion_error_px(Distortion(k1=k1, k2=-0.1 * k1), tier) < 1e-9


@pytest.mark.parametrize("tier", [tier for tier in TIERS if tier.startswith(("fixed", "first"))])
def test_the_fixed_point_is_told_by_its_error(tier: str) -> None:
    assert inversion_error_px(Distortion(k1=0.5), tier) > 1e-3


def test_the_correction_restores_the_picture_where_the_photograph_had_it() -> None:
    pinhole = checker_room(560, 420, 200.0)
    warp = _map(pixel_radii(), -0.1, 0.0, TIER, margin=True)
    photo = _through_lens(UNSEEN, gather_source(pinhole), warp)
    restored = _corrected(photo, -0.1, 0.0)
    truth = pinhole[90:330, 120:440]
    error = np.abs(restored.linear - truth)[restored.coverage > 0.99]
    distorted_error = np.abs(photo.linear - truth).mean()
    assert error.mean() < 0.15 * distorted_error


@pytest.mark.parametrize("shown", ["room", "chart"])
@pytest.mark.parametrize(("k1", "k2"), [(0.0, 0.0), (0.01, 0.0), (0.0, 0.01), (0.5, 0.2)])
def test_without_a_barrel_the_margin_would_change_nothing(shown: str, k1: float, k2: float) -> None:
    assert not needs_margin(k1, k2)
    settings = values_of(SCENE.check({"picture": shown, "k1": k1, "k2": k2}))
    given = {"tier": TIER, "photograph": None}
    tight, wide = (
        run(STAGES, {**settings, **given, "margin": margin}, StageCache()).outputs
        for margin in (False, True)
    )
    assert tight["pinhole"].shape == (240, 320, 3)
    assert wide["pinhole"].shape == (420, 560, 3)
    difference = np.abs(tight["encoded"].astype(int) - wide["encoded"])
    assert difference.max() <= 1
    assert (difference > 0).mean() < 1e-3


def test_in_the_corrected_picture_nothing_has_moved_and_nothing_is_pulled() -> None:
    assert "point" in places_of(render(k1=-0.2))
    assert "point" not in places_of(render(k1=-0.2, correct=True))


@pytest.mark.parametrize(("name", "moved"), [("point", "k1"), ("outer", "k2"), ("crossing", "k1")])
@pytest.mark.parametrize("pull", [(-40.0, 0.0), (0.0, 40.0), (-28.0, -28.0)])
def test_no_pull_of_forty_pixels_runs_a_coefficient_to_its_stop(
    name: str, moved: str, pull: tuple[float, float]
) -> None:
    handle = next(each for each in SCENE.handles if each.name == name)
    settings = Settings(k1=0.05, k2=0.05)
    at = handle.at(settings, {})
    assert at is not None
    units = 1.1 if handle.panel == "grid" else 0.55  # of a panel 360 px wide, and of the lead
    place = (at[0] + units * pull[0], at[1] + units * pull[1])
    values = pulled(handle, settings, place, SCENE.controls, {})
    slider = next(each for each in SCENE.controls if each.name == moved)
    assert isinstance(slider, Slider)
    assert set(values) == {moved}
    assert slider.minimum < float(values[moved]) < slider.maximum


def test_the_outer_point_follows_the_hand_by_k2() -> None:
    handle = next(each for each in SCENE.handles if each.name == "outer")
    place = handle.at(Settings(k1=-0.2, k2=0.1), {})
    assert place is not None
    assert handle.pull(Settings(k1=-0.2), place)["k2"] == pytest.approx(0.1)


def test_a_point_that_leaves_the_photograph_is_held_inside_its_border() -> None:
    held = [place for place in render(k1=0.5, k2=0.3).handles if place.name != "crossing"]
    assert len(held) == 2
    for place in held:
        assert min(place.x, 400 - place.x, place.y, 300 - place.y) == pytest.approx(15)
