"""Distances from one picture: the book's room with its truth, and the reader's photograph."""

import json
import math
from typing import Any

import numpy as np
import pytest

from simulations.engine.controls import PointLists
from simulations.engine.photograph import Photograph
from simulations.engine.stages import StageCache
from simulations.models.projection.level_ground import pose_above_ground
from simulations.scenes.single_view.lines import start_of
from simulations.scenes.single_view.results import as_json, sheet
from simulations.scenes.single_view.room import CORNER, EYE_M, FOCAL_PX, ROOMS, SIZE
from simulations.scenes.single_view.scene import SCENE
from simulations.scenes.single_view.settings import LISTS

EMPTY = ";" * len(LISTS)


def outputs(photograph: Photograph | None = None, **given: object) -> Any:
    return SCENE.run(SCENE.check(given), "", StageCache(), photograph).outputs


def texts(photograph: Photograph | None = None, **given: object) -> dict[str, str]:
    frame = SCENE.render(SCENE.check(given), "", StageCache(), photograph)
    return {readout.name: readout.text for readout in frame.readouts}


def own(height: int = 400, width: int = 600) -> Photograph:
    return Photograph(1, np.full((height, width, 3), 90, np.uint8), "room.jpg")


def true_lines(picture: str) -> str:
    """The book's lines without noise."""
    lists = tuple(
        tuple((float(x), float(y)) for x, y in (ends.reshape(-1, 2) + 0.5) / SIZE)
        for ends in ROOMS[picture].drawn
    )
    return PointLists(picture, 0, lists).text


def test_the_room_s_camera_is_the_one_of_the_text() -> None:
    pose = pose_above_ground(EYE_M, *map(math.radians, (33, 21, 2)))
    np.testing.assert_allclose(CORNER.R, pose[:3, :3], atol=1e-12)


@pytest.mark.parametrize("picture", ROOMS)
def test_the_book_s_lines_lie_in_their_picture_and_apart(picture: str) -> None:
    for ends in ROOMS[picture].drawn:
        assert (ends > 8.0).all()
        assert (ends < np.array(SIZE) - 8.0).all()


def test_lines_without_noise_give_the_room() -> None:
    found = outputs(lines=true_lines("corner"))
    view, lengths = found["view"].view, found["lengths"]
    assert view.focal_px == pytest.approx(FOCAL_PX, rel=1e-3)
    assert math.degrees(view.pitch) == pytest.approx(21.0, abs=0.02)
    assert math.degrees(view.roll) == pytest.approx(2.0, abs=0.02)
    assert lengths.distance[0] == pytest.approx(EYE_M, rel=1e-3)
    true_floor, true_height = found["truth"]
    np.testing.assert_allclose([pair[0] for pair in lengths.floor], true_floor, rtol=1e-3)
    np.testing.assert_allclose([pair[0] for pair in lengths.height], true_height, rtol=1e-3)


def test_the_truth_is_within_the_stated_errors_about_as_often_as_stated() -> None:
    inside = []
    for take in range(20):
        found = outputs(take=take)
        view, lengths = found["view"], found["lengths"]
        inside.append(abs(math.log(view.view.focal_px / FOCAL_PX)) < view.focal_error)
        for pairs, true in (
            (lengths.floor[1:], found["truth"][0][1:]),
            (lengths.height, found["truth"][1]),
        ):
            inside += [abs(m - t) < e for (m, e), t in zip(pairs, true, strict=True)]
    assert 0.55 < np.mean(inside) < 0.8


def test_five_times_the_noise_is_five_times_the_error() -> None:
    small, large = (float(texts(sigma=sigma)["focal_error"]) for sigma in (1, 5))
    assert large / small == pytest.approx(5.0, rel=0.05)


@pytest.mark.parametrize("take", range(0, 20, 4))
def test_the_picture_straight_on_does_not_tell_depths(take: int) -> None:
    found = outputs(picture="front", take=take)
    assert not found["view"].knows_focal
    (_, depth, width), (height,) = found["lengths"].floor, found["lengths"].height
    assert depth[1] > 0.3 * depth[0]
    assert width[0] == pytest.approx(1.5, abs=0.1)
    assert height[0] == pytest.approx(2.3, abs=0.15)
    shown = texts(picture="front", take=take)
    assert shown["focal"] == shown["length"] == "cannot be told"


def test_a_known_height_gives_the_scale_where_no_length_is_drawn() -> None:
    lists = PointLists.from_text(true_lines("corner")).lists
    lines = PointLists("corner", 0, (*lists[:3], (), lists[4])).text
    assert outputs(lines=lines, known=2.3)["lengths"].distance[0] == pytest.approx(EYE_M, rel=2e-3)


def test_lines_on_the_wrong_edge_are_told_by_their_scatter() -> None:
    lists = PointLists.from_text(true_lines("corner")).lists
    swapped = PointLists("corner", 0, (lists[0][:6] + lists[1][:2], *lists[1:])).text
    assert not outputs(lines=true_lines("corner"))["view"].misfits
    assert outputs(lines=swapped)["view"].misfits


def test_without_lines_the_figure_says_what_to_draw() -> None:
    frame = SCENE.render(SCENE.check({"lines": EMPTY}), "", StageCache())
    assert "two lines or more" in frame.description
    assert texts(lines=EMPTY)["focal"] == "lines missing"
    assert texts(lines=EMPTY, centre=True)["centre_at"] == "lines missing"


def test_lines_of_another_picture_are_not_drawn_over_this_one() -> None:
    drawn = true_lines("front")
    assert outputs(lines=drawn)["lines"].points == outputs()["lines"].points
    assert outputs(own(), lines=drawn)["lines"].points.lists == ((),) * len(LISTS)


def test_a_new_line_counts_once_both_ends_were_moved() -> None:
    start = start_of(1, 0)
    for ends, counts in (
        (start, False),
        (((0.1, 0.2), start[1]), False),
        (((0.1, 0.2), (0.3, 0.3)), True),
        (((0.1, 0.2), (0.1, 0.2)), False),
    ):
        lines = PointLists("own", 0, ((), ends)).text
        found = outputs(own(), lines=lines)["lines"]
        assert len(found.ends[1]) == 1
        assert len(found.counted(1)) == counts


def test_buttons_add_lines_until_the_list_is_full_and_take_all_away() -> None:
    settings, photograph = SCENE.check({"lines": EMPTY}), own()
    for count in (1, 2, 3, 4, 5, 6, 6):
        settings = SCENE.clamp(
            {"lines": settings.lines, **SCENE.pull(settings, "add", (0, 0), "", photograph)}
        )
        points = PointLists.from_text(settings.lines)
        assert points.picture == "own"
        assert len(points.lists[1]) == 2 * count
    cleared = SCENE.clamp(SCENE.pull(settings, "clear", (0, 0), "", photograph))
    assert PointLists.from_text(cleared.lines).lists == ((),) * len(LISTS)


@pytest.mark.parametrize("shape", [(400, 600), (600, 400), (300, 400), (1, 1), (4000, 2)])
def test_an_end_goes_to_the_pixel_where_it_is_pulled_in_pictures_of_any_shape(
    shape: tuple[int, int],
) -> None:
    photograph = own(*shape)
    settings = SCENE.clamp(SCENE.pull(SCENE.check({}), "add", (0, 0), "", photograph))
    frame = SCENE.render(settings, "", StageCache(), photograph)
    assert frame.panels[0].raster is not None
    place = {each.name: each for each in frame.handles}["end-0"]
    moved = SCENE.clamp(
        SCENE.pull(settings, "end-0", (place.x + place.step, place.y), "", photograph)
    )
    before, after = (
        outputs(photograph, lines=each.lines)["lines"].ends[1][0, 0] for each in (settings, moved)
    )
    pixels = np.array(shape[::-1])
    nearest = np.clip(np.rint(before + np.array([1.0, 0.0])), 0, pixels - 1)
    assert np.abs(after - nearest).max() <= 1.0


def test_a_photograph_of_many_pixels_is_shown_reduced() -> None:
    frame = SCENE.render(SCENE.check({}), "", StageCache(), own(1500, 2400))
    raster = frame.panels[0].raster
    assert raster is not None
    assert raster.shape[1] <= 1000
    assert raster.shape[0] * 4 == pytest.approx(raster.shape[1] * 3, abs=4)


def test_the_file_holds_what_was_measured() -> None:
    settings, found = SCENE.check({}), outputs()
    told = json.loads(as_json(settings, found))
    assert told["camera"]["focal_px"]["value"] == pytest.approx(found["view"].view.focal_px)
    assert told["camera"]["focal_px"]["standard_error"] > 0
    assert len(told["camera"]["vanishing_points"]) == 3
    assert told["lengths_m"][0] == {"value": 2.0, "standard_error": 0.0}
    unknown = json.loads(as_json(settings, outputs(own())))
    assert unknown["camera"] is None
    assert unknown["photograph"] == "room.jpg"


def test_the_sheet_has_each_number_with_its_error() -> None:
    lines = {each.name: each.text for each in sheet(SCENE.check({}), outputs())}
    assert {"focal", "pitch", "roll", "distance", "length", "height"} <= lines.keys()
    assert all("±" in text for text in lines.values())


def test_the_sheet_has_the_focal_length_of_the_file_beside_the_measured_one() -> None:
    photograph = Photograph(1, own().codes, "room.jpg", {"focal_35mm_mm": 26.0})
    lines = {each.name: each.text for each in sheet(SCENE.check({}), outputs(photograph))}
    assert lines["focal_by_file"] == "433"


def test_a_photograph_without_lines_fills_no_sheet() -> None:
    assert sheet(SCENE.check({}), outputs(own())) == ()
