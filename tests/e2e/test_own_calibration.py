"""Photographs of a board go in by the file picker; the camera's file is that of this Python."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import expect
from support.reader import Reader

from simulations.engine.photograph import Photograph
from simulations.engine.reading import Reading
from simulations.engine.stages import StageCache
from simulations.scenes.calibration.boards import rendered
from simulations.scenes.calibration.scene import SCENE

pytestmark = pytest.mark.browser

COUNT = 4
BOARDS = [np.repeat(rendered(index), 3, axis=-1) for index in range(COUNT)]
SETTINGS = {"photographs": 20, "lens": "k1k2"}


@pytest.fixture
def files(tmp_path: Path) -> list[Path]:
    """The photographs of a board, and one without."""
    paths = [tmp_path / f"{index}.png" for index in range(COUNT + 1)]
    for path, codes in zip(paths, [*BOARDS, np.full_like(BOARDS[0], 120)], strict=True):
        Image.fromarray(codes).save(path)
    return paths


def calibrated() -> dict[str, Any]:
    """The JSON file by this Python."""
    assert SCENE.read
    readings = tuple(
        Reading(index, f"{index}.png", SCENE.read(Photograph(index, codes)))
        for index, codes in enumerate(BOARDS)
    )
    settings = SCENE.check(SETTINGS)
    outputs = SCENE.run(settings, "", StageCache(), None, readings).outputs
    (made,) = (export for export in SCENE.exports if export.suffix == ".json")
    read: dict[str, Any] = json.loads(made.make(settings, outputs))
    return read


def test_the_reader_s_boards_calibrate_the_camera_as_in_this_python(
    reader: Reader, files: list[Path]
) -> None:
    """Of too few no file can be made: it says what to do."""
    reader.open("measure-your-camera/")
    figure = reader.page.locator("simulation-figure[data-simulation=calibration]")
    whole = reader.page.locator("figure", has=figure)
    box = whole.locator(".intake")
    reader.bring(box)
    reader.settle(figure)
    whole.locator("input[type=file]").set_input_files(files[:1])
    expect(whole.locator("output[name=focal]")).to_have_text("not determined")
    whole.get_by_role("button", name="JSON", exact=True).click()
    expect(whole.locator(".made-files-said")).to_contain_text(": At least 3 photographs")
    box.locator(".intake-clear").click()
    expect(whole.locator(".made-files-said")).to_have_text("")
    whole.locator("input[type=file]").set_input_files(files)
    expect(box.locator(".intake-said")).to_contain_text(f"{COUNT} of {COUNT + 1}")
    expect(box.locator(".intake-photo").last).to_contain_text("No chequerboard found")
    expect(whole.locator("output[name=supported]")).not_to_have_text("")
    with reader.page.expect_download() as saved:
        whole.get_by_role("button", name="JSON", exact=True).click()
    theirs = json.loads(saved.value.path().read_text(encoding="utf-8"))
    ours = calibrated()
    assert [p["name"] for p in theirs["photographs"]] == [f"{index}.png" for index in range(COUNT)]
    for part in ("camera", "standard_errors"):
        assert theirs[part] == pytest.approx(ours[part], rel=1e-6, abs=1e-9)
    assert len(reader.page.workers) == 1, "the interpreter that read has ended"
