"""Lines over a picture in the browser: drawn by hand and by keys, taken back, and measured in a
photograph of the reader's as in CPython."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Locator, expect
from support.hands import drag, middle
from support.reader import Reader

from simulations.engine.controls import PointLists
from simulations.engine.photograph import Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import encode_srgb
from simulations.pictures.checker_room import checker_room
from simulations.scenes.single_view.lines import FOCAL_PX, ROOMS, SIZE
from simulations.scenes.single_view.measuring import as_json
from simulations.scenes.single_view.scene import SCENE

pytestmark = pytest.mark.browser

PAGE = "measure-your-camera/"
ID = "figure-single-view"


def lists(figure: Locator) -> PointLists:
    return PointLists.from_text(figure.locator("input[name=lines]").input_value())


def press(reader: Reader, figure: Locator, button: str) -> None:
    frames = reader.frames(figure)
    figure.get_by_role("button", name=button, exact=True).click()
    reader.wait_frame(figure, frames)
    reader.settle(figure)


def test_a_line_is_added_and_placed_by_keys_alone_and_taken_back(guest: Reader, book: Any) -> None:
    figure = guest.stay_at_figure(book, "single-view")
    guest.put_back(figure)
    press(guest, figure, "Clear")
    assert not any(lists(figure).lists)
    press(guest, figure, "Add a line")
    before = lists(figure).lists[1]
    end = figure.locator('[data-handle="end-0"]')
    expect(end).to_be_focused()
    for key in ("ArrowRight", "Shift+ArrowUp"):
        frames = guest.frames(figure)
        guest.page.keyboard.press(key)
        guest.wait_frame(figure, frames)
        guest.settle(figure)
    moved = (np.array(lists(figure).lists[1]) - before) * SIZE
    np.testing.assert_allclose(moved, [(1, -10), (0, 0)], atol=0.51)
    press(guest, figure, "Undo")
    press(guest, figure, "Undo")
    assert lists(figure).lists[1] == before


def test_an_end_follows_the_hand_and_undo_brings_it_back(guest: Reader, book: Any) -> None:
    figure = guest.stay_at_figure(book, "single-view")
    guest.put_back(figure)
    shown = guest.shown(figure)
    end = figure.locator('[data-handle="end-2"]')
    end.scroll_into_view_if_needed()
    frames, (x, y) = guest.frames(figure), middle(end)
    drag(guest, (x, y), (x - 30, y + 20))
    guest.wait_frame(figure, frames)
    guest.settle(figure)
    assert lists(figure).touched == 2
    assert guest.shown(figure) != shown
    press(guest, figure, "Undo")
    assert figure.locator("input[name=lines]").input_value() == ""


@pytest.fixture
def photograph(tmp_path: Path) -> tuple[Path, Photograph]:
    """Of the book's room, as a file and as Python gets it."""
    codes = to_rgba8(encode_srgb(checker_room(*SIZE, FOCAL_PX, ROOMS["corner"].turn)))[..., :3]
    path = tmp_path / "room.png"
    Image.fromarray(codes).save(path)
    return path, Photograph(1, codes, path.name)


def test_a_photograph_is_measured_as_in_cpython(
    visitor: Reader, tmp_path: Path, photograph: tuple[Path, Photograph]
) -> None:
    path, same = photograph
    noisy = [
        ends + np.random.default_rng(1).normal(size=ends.shape) for ends in ROOMS["corner"].drawn
    ]
    shares = [np.clip((ends.reshape(-1, 2) + 0.5) / SIZE, 0, 1) for ends in noisy]
    lines = PointLists("own", 0, tuple(tuple(map(tuple, each)) for each in shares)).text
    visitor.turn_to_unlinked(f"{PAGE}?{ID}.lines={lines}&{ID}.sigma=1#{ID}")
    figure = visitor.figure("single-view")
    frames = visitor.frames(figure)
    place = visitor.page.locator(f"#{ID}")
    place.locator(".intake input[type=file]").set_input_files(path)
    visitor.wait_frame(figure, frames)
    visitor.settle(figure)
    settings = SCENE.check({"lines": lines, "sigma": 1.0})
    frame = SCENE.render(settings, "", StageCache(), same)
    for readout in frame.readouts:
        shown = figure.locator(f"output[name={readout.name}]").text_content()
        assert shown == readout.text, readout.name
    with visitor.page.expect_download() as download:
        place.get_by_role("button", name="Distances as JSON").click()
    download.value.save_as(tmp_path / "made.json")
    made = json.loads((tmp_path / "made.json").read_text("utf-8"))
    expected = json.loads(as_json(settings, SCENE.run(settings, "", StageCache(), same).outputs))
    assert made["photograph"] == "room.png"
    assert made["camera"]["focal_px"]["value"] == pytest.approx(
        expected["camera"]["focal_px"]["value"], rel=1e-9
    )
    assert made["lines_px"] == expected["lines_px"]
