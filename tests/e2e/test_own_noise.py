"""Pairs of even photographs go in by the file picker; the sheet is that of this Python."""

import json
from pathlib import Path

import pytest
from PIL import Image
from playwright.sync_api import expect
from support.flat_fields import as_srgb, light_of
from support.reader import Reader

from simulations.engine.photograph import Photograph
from simulations.engine.reading import Reading
from simulations.engine.stages import StageCache
from simulations.scenes.photon_transfer.reading import read
from simulations.scenes.photon_transfer.results import sheet
from simulations.scenes.photon_transfer.scene import SCENE

pytestmark = pytest.mark.browser

LEVELS = (20.0, 60.0, 110.0, 170.0)
PHOTOGRAPHS = [
    as_srgb(light_of(level, 2 * k + i)) for k, level in enumerate(LEVELS) for i in (0, 1)
]


@pytest.fixture
def files(tmp_path: Path) -> list[Path]:
    """Four pairs, and a photograph with an edge."""
    edge = PHOTOGRAPHS[2].copy()
    edge[:, 90:] //= 2
    paths = [tmp_path / f"{index}.png" for index in range(len(PHOTOGRAPHS) + 1)]
    for path, codes in zip(paths, [*PHOTOGRAPHS, edge], strict=True):
        Image.fromarray(codes).save(path)
    return paths


def lines_of_sheet() -> list[list[str]]:
    readings = tuple(
        Reading(index, f"{index}.png", read(Photograph(index, codes)))
        for index, codes in enumerate(PHOTOGRAPHS)
    )
    settings = SCENE.check({})
    outputs = SCENE.run(settings, "", StageCache(), None, readings).outputs
    return [[line.label, line.text] for line in sheet(settings, outputs)]


def test_the_reader_s_pairs_measure_the_sensor_as_in_this_python(
    reader: Reader, files: list[Path]
) -> None:
    reader.open("measure-your-camera/")
    figure = reader.page.locator("simulation-figure[data-simulation=photon-transfer]")
    box = reader.page.locator("figure", has=figure).locator(".intake")
    reader.bring(box)
    reader.settle(figure)
    box.locator("input[type=file]").set_input_files(files)
    expect(box.locator(".intake-said")).to_contain_text(f"{len(PHOTOGRAPHS)} of {len(files)}")
    expect(box.locator(".intake-photo").last).to_contain_text("not evenly lit")
    expect(figure.locator("output[name=gain_true]")).to_contain_text("unknown")
    page = reader.page
    expect(page.locator(".data-sheet tbody")).to_contain_text("Conversion gain")
    with page.expect_download() as saved:
        page.locator(".data-sheet").get_by_role("button", name="Save as JSON").click()
    (part,) = json.loads(saved.value.path().read_text(encoding="utf-8"))["instruments"]
    assert [[line["label"], line["text"]] for line in part["lines"]] == lines_of_sheet()
