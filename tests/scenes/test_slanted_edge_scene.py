"""The slanted edge: its readouts against the formulae, on photographs, and where it is silent."""

import csv
import io
import json
from functools import partial

import numpy as np
import pytest
from support.edges import gaussian_edge, gaussian_half, grain
from support.frames import computed_in, frame_of, outputs_of, pixels_of, texts_of

from simulations.engine.frame import Frame
from simulations.engine.photograph import Photograph
from simulations.engine.reading import UnfitError
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import encode_srgb
from simulations.models.sensor.resolution import pixel_pitch_um
from simulations.scenes.slanted_edge.rectangle import box_in
from simulations.scenes.slanted_edge.results import with_error
from simulations.scenes.slanted_edge.scene import SCENE

frame = partial(frame_of, SCENE)


@pytest.mark.parametrize("aperture", [4, 8, 11])
@pytest.mark.parametrize("angle", [3, 5, 14, 26.5, 40])
def test_the_edge_says_what_lens_and_pixel_say(aperture: float, angle: float) -> None:
    shown = texts_of(frame(angle=angle, aperture=aperture, noise=0.3))
    assert float(shown["measured"]) == pytest.approx(float(shown["true"]), rel=0.03)


def test_sharpening_raises_mtf50_and_is_named_once_it_leaves_halos() -> None:
    plain, mild, strong = (frame(sharpening=much) for much in (0, 0.5, 1))
    halves = [float(texts_of(each)["measured"]) for each in (plain, mild, strong)]
    assert halves == sorted(halves)
    named = ["sharpened" in texts_of(each)["overshoot"] for each in (plain, mild, strong)]
    assert named == [False, False, True]


def photograph(width: int, height: int, angle: float = 5.0, **facts: float) -> Photograph:
    """An edge through the middle of a file."""
    light = 0.05 + 0.8 * gaussian_edge(height, width, angle, 1.5)
    light += grain(light.shape, 0.005, 4)
    codes = np.rint(255 * encode_srgb(np.clip(light, 0, 1))).astype(np.uint8)
    return Photograph(1, np.repeat(codes[..., None], 3, axis=2), "edge.jpg", facts)


def shown_of(picture: Photograph, **given: object) -> Frame:
    return SCENE.render(SCENE.check(given), "", StageCache(), picture)


@pytest.mark.parametrize("size", [(320, 240), (240, 320), (500, 200)])
def test_the_edge_on_a_photograph_is_measured_in_its_own_pixels(size: tuple[int, int]) -> None:
    texts = texts_of(shown_of(photograph(*size)))
    assert float(texts["per_px"]) == pytest.approx(gaussian_half(1.5), rel=0.02)
    assert texts["true"] == "unknown"
    assert texts["place"] == "0"


def test_a_lying_edge_is_measured_along_the_columns() -> None:
    upright = photograph(300, 300)
    lying = Photograph(2, np.ascontiguousarray(upright.codes.transpose(1, 0, 2)))
    first, second = (float(texts_of(shown_of(each))["per_px"]) for each in (upright, lying))
    assert first == pytest.approx(second, rel=0.02)
    run = SCENE.run(SCENE.check({}), "", StageCache(), lying)
    assert run.outputs["sharpness"].reading.pixels.line.turned


def test_a_large_photograph_is_shown_small_and_measured_in_full() -> None:
    picture = photograph(3000, 2000)
    seen = shown_of(picture, width=10, height=10)
    assert max(pixels_of(seen).shape) <= 1200
    assert float(texts_of(seen)["per_px"]) == pytest.approx(gaussian_half(1.5), rel=0.02)


def test_the_rectangle_ends_where_the_picture_does() -> None:
    box = box_in((600, 300), (0.0, 37.5), (20.0, 30.0))
    assert (box.left, box.right) == (0, 60)
    assert (box.top, box.bottom) == (60, 240)
    nowhere = box_in((600, 300), (50.0, 0.0), (20.0, 1.0))
    assert nowhere.top == nowhere.bottom
    texts = texts_of(shown_of(photograph(600, 300), y=0, height=1))
    assert texts["measured"] == "not measurable"


def test_a_reduced_photograph_has_larger_pixels() -> None:
    whole, reduced = (photograph(300, 200, full_width=float(w)) for w in (300, 600))
    first, second = (float(texts_of(shown_of(each))["measured"]) for each in (whole, reduced))
    assert second == pytest.approx(first / 2, rel=0.01)


def test_the_pitch_follows_from_the_focal_length_and_its_equivalent() -> None:
    """A full-frame camera of 6000 × 4000 pixels, and a crop of 1.5."""
    assert pixel_pitch_um(50, 50, 6000, 4000) == pytest.approx(6.0, rel=1e-3)
    assert pixel_pitch_um(50, 75, 6000, 4000) == pytest.approx(4.0, rel=1e-3)
    facts = {"focal_mm": 4.2, "focal_35mm_mm": 26.0, "full_width": 4032.0, "full_height": 3024.0}
    picture = photograph(300, 200, **facts)
    run = SCENE.run(SCENE.check({}), "", StageCache(), picture)
    assert SCENE.sheet is not None
    lines = {line.name: line.text for line in SCENE.sheet(SCENE.check({}), run.outputs)}
    assert float(lines["pitch"]) == pytest.approx(1.39, abs=0.01)
    assert lines["mtf50_1"].startswith(f"{gaussian_half(1.5):.2f}")


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (46.82, 0.3, "46.8 ± 0.3"),
        (46.82, 0.012, "46.82 ± 0.01"),
        (46.82, 0.0, "46.8 ± 0.0"),
        (46.82, np.nan, "46.8 ± undefined"),
    ],
)
def test_a_small_error_is_not_rounded_to_zero(value: float, error: float, text: str) -> None:
    assert with_error(value, error, 1) == text


def test_a_refusal_is_said_in_the_figure_and_fills_no_sheet() -> None:
    away = frame(x=20)
    assert "no MTF. Too little contrast" in away.description
    assert "Too little contrast" in away.panels[0].overlay
    assert SCENE.sheet is not None
    assert SCENE.sheet(SCENE.check({"x": 20}), outputs_of(SCENE, x=20)) == ()


def test_files_hold_what_the_figure_shows() -> None:
    made = {e.name: e.make(SCENE.check({}), outputs_of(SCENE)) for e in SCENE.exports}
    texts = texts_of(frame())
    found = json.loads(made["sharpness"])
    assert f"{found['rectangle']['mtf50_cycles_per_px']:.3f}" == texts["per_px"]
    assert found["kept"] == []
    rows = list(csv.DictReader(io.StringIO(made["mtf"])))
    assert float(rows[0]["contrast"]) == 1.0
    assert float(rows[25]["cycles_per_px"]) == 0.5
    assert float(rows[25]["cycles_per_mm"]) == 125.0
    light = list(csv.DictReader(io.StringIO(made["esf"])))
    assert float(light[0]["light"]) == pytest.approx(0.0, abs=0.02)
    assert float(light[-1]["light"]) == pytest.approx(1.0, abs=0.02)
    with pytest.raises(UnfitError, match="contrast"):
        SCENE.exports[0].make(SCENE.check({"x": 20}), outputs_of(SCENE, x=20))


def test_places_that_are_kept_stand_in_the_picture_the_sheet_and_the_file() -> None:
    picture = photograph(320, 240)
    settings = SCENE.check({"y": 20, "height": 20})
    kept = {**SCENE.pull(settings, "keep", (0.0, 0.0)), "y": 60, "height": 20}
    kept = {**kept, **SCENE.pull(SCENE.check(kept), "keep", (0.0, 0.0)), "y": 37.5}
    now = SCENE.check(kept)
    run = SCENE.run(now, "", StageCache(), picture)
    first, second = run.outputs["places"]
    assert (first.box.top, first.box.bottom) == (32, 96)
    assert (second.box.top, second.box.bottom) == (160, 224)
    seen = SCENE.render(now, "", StageCache(), picture)
    for place in (first, second):
        assert f">{place.sharpness.half.frequency:.3f}<" in seen.panels[0].overlay
    assert SCENE.sheet is not None
    lines = [line for line in SCENE.sheet(now, run.outputs) if line.unit == "cycles/px"]
    assert [line.text[:6] for line in lines] == [
        f"{place.sharpness.half.frequency:.4f}" for place in (first, second)
    ]
    assert "28 % from the middle" in lines[0].label
    made = next(export for export in SCENE.exports if export.name == "sharpness")
    assert len(json.loads(made.make(now, run.outputs))["kept"]) == 2
    assert SCENE.pull(now, "forget", (0.0, 0.0)) == {"kept": ""}


def test_the_oldest_place_makes_room_for_a_ninth() -> None:
    settings = SCENE.check({})
    for x in range(20, 65, 5):
        kept = SCENE.pull(settings, "keep", (0.0, 0.0))
        settings = SCENE.check({**kept, "x": x})
    assert len(outputs_of(SCENE, kept=settings.kept)["places"]) == 8


def test_with_a_photograph_nothing_is_simulated_and_the_pitch_measures_nothing_anew() -> None:
    picture, cache = photograph(320, 240), StageCache()
    SCENE.render(SCENE.check({}), "", cache, picture)
    after = SCENE.render(SCENE.check({"pitch": 2}), "", cache, picture)
    assert "light" not in computed_in(after)
    assert "sharpness" not in computed_in(after)
