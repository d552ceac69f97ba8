"""Distances from one picture: the book's room with its truth, and the reader's photograph."""

import json
import math
from typing import Any

import numpy as np
import pytest
from scipy.ndimage import map_coordinates
from support.frames import frame_of, texts_of

from simulations.engine.controls import PointLists
from simulations.engine.photograph import Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.reading import Reading
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import encode_srgb
from simulations.models.distortion.lens_model import Distortion
from simulations.models.projection.level_ground import pose_above_ground
from simulations.models.projection.picture_lens import PictureLens
from simulations.pictures.checker_room import checker_room
from simulations.scenes.single_view.files import as_fspy, as_json
from simulations.scenes.single_view.lines import (
    AXES,
    EYE_M,
    FOCAL_PX,
    LISTS,
    ROOMS,
    SIZE,
    drawn_lines,
    start_of,
)
from simulations.scenes.single_view.measuring import lens_of, sheet
from simulations.scenes.single_view.scene import SCENE

EMPTY = ";" * len(LISTS)


def outputs(photograph: Photograph | None = None, **given: object) -> Any:
    return SCENE.run(SCENE.check(given), "", StageCache(), photograph).outputs


def plain_photograph(height: int = 400, width: int = 600, **facts: float) -> Photograph:
    return Photograph(1, np.full((height, width, 3), 90, np.uint8), "room.jpg", facts)


def true_lists(picture: str) -> tuple[tuple[tuple[float, ...], ...], ...]:
    """The book's lines without noise."""
    shares = [(ends.reshape(-1, 2) + 0.5) / SIZE for ends in ROOMS[picture].drawn]
    return tuple(tuple(map(tuple, each.tolist())) for each in shares)


def text_of(picture: str, *lists: Any) -> str:
    return PointLists(picture, 0, lists).text


TRUE = text_of("corner", *true_lists("corner"))


@pytest.mark.parametrize("name", SCENE.instrument.samples)
def test_sample_comes_with_its_lines(name: str) -> None:
    photograph = Photograph(1, SCENE.instrument.samples[name](), name)
    view = outputs(photograph)["view"].view
    assert view.focal_px == pytest.approx(FOCAL_PX, rel=0.1)


def test_room_is_seen_by_the_texts_camera_with_its_lines_inside() -> None:
    pose = pose_above_ground(EYE_M, *map(math.radians, (33, 21, 2)))
    np.testing.assert_allclose(ROOMS["corner"].turn @ AXES.T, pose[:3, :3], atol=1e-12)
    for room in ROOMS.values():
        ends = np.concatenate(room.drawn)
        assert (ends > 8.0).all()
        assert (ends < np.array(SIZE) - 8.0).all()


def test_lines_without_noise_give_the_true_room() -> None:
    found = outputs(lines=TRUE)
    view, lengths = found["view"].view, found["lengths"]
    assert view.focal_px == pytest.approx(FOCAL_PX, rel=1e-3)
    assert np.degrees((view.pitch, view.roll)) == pytest.approx((21.0, 2.0), abs=0.02)
    true_floor, true_height = found["truth"]
    np.testing.assert_allclose([pair[0] for pair in lengths.floor], true_floor, rtol=1e-3)
    np.testing.assert_allclose([pair[0] for pair in lengths.height], true_height, rtol=1e-3)
    lists = true_lists("corner")
    by_height = outputs(lines=text_of("corner", *lists[:3], (), lists[4]), known=2.3)
    for made in (lengths, by_height["lengths"]):
        assert made.distance[0] == pytest.approx(EYE_M, rel=2e-3)


@pytest.mark.parametrize("take", [0, 12])
def test_depths_are_unknown_in_a_frontal_picture(take: int) -> None:
    found = outputs(picture="front", take=take)
    assert not found["view"].knows_focal
    (_, depth, width), (height,) = found["lengths"].floor, found["lengths"].height
    assert depth[1] > 0.3 * depth[0]
    assert width[0] == pytest.approx(1.5, abs=0.1)
    assert height[0] == pytest.approx(2.3, abs=0.15)
    shown = texts_of(frame_of(SCENE, picture="front", take=take))
    assert shown["focal"] == shown["length"] == "cannot be told"


def test_line_on_the_wrong_edge_is_detected_by_its_scatter() -> None:
    lists = true_lists("corner")
    swapped = text_of("corner", lists[0][:6] + lists[1][:2], *lists[1:])
    assert [outputs(lines=lines)["view"].misfits for lines in (TRUE, swapped)] == [False, True]


@pytest.mark.parametrize(
    ("ends", "counts"),
    [
        (start_of(1, 0), False),
        (((0.1, 0.2), start_of(1, 0)[1]), False),
        (((0.1, 0.2), (0.3, 0.3)), True),
        (((0.1, 0.2), (0.1, 0.2)), False),
    ],
)
def test_new_line_counts_once_both_ends_have_moved(ends: object, counts: bool) -> None:
    found = outputs(plain_photograph(), lines=text_of("own", (), ends))["lines"]
    assert len(found.ends[1]) == 1
    assert len(found.counted(1)) == counts


def test_buttons_add_lines_until_the_list_is_full_and_clear_all() -> None:
    settings, photograph = SCENE.check({"lines": EMPTY}), plain_photograph()
    for count in (1, 2, 3, 4, 5, 6, 6):
        added = SCENE.pull(settings, "add", (0, 0), "", photograph)
        settings = SCENE.clamp({"lines": settings.lines, **added})
        points = PointLists.from_text(settings.lines)
        assert points.picture == "own"
        assert len(points.lists[1]) == 2 * count
    cleared = SCENE.clamp(SCENE.pull(settings, "clear", (0, 0), "", photograph))
    assert PointLists.from_text(cleared.lines).lists == ((),) * len(LISTS)


@pytest.mark.parametrize(
    "shape", [(400, 600), (600, 400), (300, 400), (1, 1), (4000, 2), (1500, 2400)]
)
def test_end_moves_by_a_pixel_in_pictures_of_any_shape(shape: tuple[int, int]) -> None:
    photograph = plain_photograph(*shape)
    settings = SCENE.clamp(SCENE.pull(SCENE.check({}), "add", (0, 0), "", photograph))
    frame = SCENE.render(settings, "", StageCache(), photograph)
    raster = frame.panels[0].raster
    assert raster is not None
    assert raster.shape[1] <= max(1000, shape[1])
    assert raster.shape[0] * 4 == pytest.approx(raster.shape[1] * 3, abs=4)
    place = {each.name: each for each in frame.handles}["end-0"]
    pulled = SCENE.pull(settings, "end-0", (place.x + place.step, place.y), "", photograph)
    before, after = (
        outputs(photograph, lines=lines)["lines"].ends[1][0, 0]
        for lines in (settings.lines, SCENE.clamp(pulled).lines)
    )
    nearest = np.clip(np.rint(before + (1.0, 0.0)), 0, np.array(shape[::-1]) - 1)  # noqa: RUF005
    assert np.abs(after - nearest).max() <= 1.0


def test_file_and_sheet_give_each_number_with_its_error() -> None:
    settings, found = SCENE.check({}), outputs()
    saved = json.loads(as_json(settings, found))
    assert saved["camera"]["focal_px"]["value"] == pytest.approx(found["view"].view.focal_px)
    assert saved["camera"]["focal_px"]["standard_error"] > 0
    assert len(saved["camera"]["vanishing_points"]) == 3
    assert saved["lengths_m"][0] == {"value": 2.0, "standard_error": 0.0}
    lines = {each.name: each.text for each in sheet(settings, found)}
    assert {"focal", "pitch", "roll", "distance", "length", "height"} <= lines.keys()
    assert all("±" in text for text in lines.values())


def test_file_and_sheet_are_empty_without_lines() -> None:
    settings, found = SCENE.check({}), outputs(plain_photograph())
    saved = json.loads(as_json(settings, found))
    assert (saved["camera"], saved["photograph"]) == (None, "room.jpg")
    assert sheet(settings, found) == ()
    (by_file,) = sheet(settings, outputs(plain_photograph(focal_35mm_mm=26.0)))
    assert (by_file.name, by_file.text) == ("focal_by_file", "433")


def barrel() -> tuple[Photograph, str, float]:
    """The book's room through a distorting lens, lines drawn within a pixel, and the true k₁."""
    lens, size = Distortion(k1=-0.05), np.array(SIZE)
    middle = (size - 1) / 2
    bent = PictureLens((middle[0], middle[1]), (FOCAL_PX, FOCAL_PX), lens)
    rows, columns = np.indices(SIZE[::-1])
    seen = bent.straight(np.stack([columns, rows], axis=-1).astype(float))
    room = checker_room(*SIZE, FOCAL_PX, ROOMS["corner"].turn)
    light = np.stack([map_coordinates(room[..., k], seen[..., ::-1].transpose(2, 0, 1), order=1,
                                      mode="nearest") for k in range(3)], axis=-1)  # fmt: skip
    codes = to_rgba8(encode_srgb(np.clip(light, 0, 1)))[..., :3]
    rng, lists = np.random.default_rng(3), []
    for ends in ROOMS["corner"].drawn:
        shares = (bent.bent(ends) + rng.normal(0, 1, ends.shape) + 0.5).reshape(-1, 2) / size
        lists.append(tuple(map(tuple, shares.tolist())))
    return Photograph(9, codes, "barrel.png"), text_of("own", *lists), lens.k1


def test_lens_distortion_is_found_from_edges_or_taken_from_calibration() -> None:
    photograph, lines, k1 = barrel()
    settings = SCENE.check({"lines": lines})
    done = SCENE.run(settings, "", StageCache(), photograph).outputs
    view = done["view"].view
    error = view.focal_px * done["view"].focal_error
    assert view.focal_px == pytest.approx(FOCAL_PX, abs=3 * error)
    shown = texts_of(SCENE.render(settings, "", StageCache(), photograph))["lens"]
    found, off = (float(shown.split()[k].strip(",").replace("−", "-")) for k in (2, 4))
    assert found == pytest.approx(k1, abs=3 * off)
    camera = {"fx": FOCAL_PX, "fy": FOCAL_PX, "cx": 399.5, "cy": 299.5, "k1": k1}
    data = {"width": SIZE[0], "height": SIZE[1], "camera": camera}
    settings = SCENE.check({"lines": lines, "calibration": "any"})
    done = SCENE.run(settings, "", StageCache(), photograph, (Reading(1, "lens", data),)).outputs
    assert done["lens"][1] == "calibrated on this page"
    assert done["view"].view.focal_px == pytest.approx(FOCAL_PX, rel=0.01)
    assert done["view"].focal_error <= 0.005  # of the calibration and of focus
    fspy = json.loads(as_fspy(settings, done))
    to_world = np.array(fspy["cameraTransform"]["rows"])
    np.testing.assert_allclose(to_world[:3, :3] @ to_world[:3, :3].T, np.eye(3), atol=1e-9)
    ray = to_world[:3, :3] @ (0.0, 0.0, -1.0)
    assert math.degrees(math.asin(-ray[2])) == pytest.approx(21.0, abs=1.0)  # it looks down


ACME = {"make": "Acme", "model": "A1", "lens": "L", "focal_mm": 4.0}


@pytest.mark.parametrize(
    ("taken", "facts", "calibration", "size", "how"),
    [
        (ACME, ACME, "same", SIZE, "calibrated on this page"),
        (ACME, ACME, "same", (3 * SIZE[0], 3 * SIZE[1]), "calibrated on this page"),
        (ACME, ACME, "none", SIZE, "by the lines alone"),
        (ACME, {**ACME, "make": "Other"}, "same", SIZE, "of another camera or lens"),
        (ACME, {**ACME, "model": "A2"}, "same", SIZE, "of another camera or lens"),
        (ACME, {**ACME, "lens": "M"}, "same", SIZE, "of another camera or lens"),
        (ACME, {**ACME, "focal_mm": 5.0}, "same", SIZE, "of another focal length"),
        (ACME, {}, "same", SIZE, "may be of another camera"),
        ({}, ACME, "same", SIZE, "may be of another camera"),
        ({}, {}, "any", SIZE, "calibrated on this page"),
        (ACME, ACME, "any", (SIZE[1], SIZE[0]), "of pictures of another shape"),
    ],
)
def test_calibration_is_used_for_photographs_of_the_same_camera_alone(
    taken: dict[str, float | str],
    facts: dict[str, float | str],
    calibration: str,
    size: tuple[int, int],
    how: str,
) -> None:
    """Where the files do not name the camera, the reader decides."""
    camera = {"fx": 500.0, "fy": 500.0, "cx": 399.5, "cy": 299.5, "k1": -0.1}
    data = {"width": size[0], "height": size[1], "camera": camera, "taken": taken}
    photograph = Photograph(1, np.full((*SIZE[::-1], 3), 90, np.uint8), "room.jpg", facts)
    lines = drawn_lines("", "own", 1.0, 0, photograph)
    reading = Reading(1, "lens", data)
    lens, words = lens_of(photograph.codes, lines, calibration, (reading,), photograph)
    assert how in words
    assert (lens.pinhole_errors is not None) == (how == "calibrated on this page")
    if lens.pinhole_errors and size == SIZE:
        assert lens.unit == (500.0, 500.0)
