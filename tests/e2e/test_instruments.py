"""The reader's photographs go into an instrument, and its results come out."""

import io
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Locator, expect
from support.edges import gaussian_edge
from support.reader import Reader

from simulations.engine.photograph import Codes, Photograph
from simulations.engine.stages import StageCache
from simulations.registry import load_scene

pytestmark = pytest.mark.browser

PAGE = "measure-your-camera/"
SCENE = "slanted-edge"


def edge(angle_deg: float, sigma_px: float) -> Codes:
    """(H, W, 3) a photograph of an edge."""
    light = gaussian_edge(480, 640, angle_deg, sigma_px)
    return np.repeat(np.rint(60.0 + 120.0 * light).astype(np.uint8)[..., None], 3, axis=2)


EDGES = {"soft.png": edge(5.0, 1.2), "sharp.png": edge(-4.0, 0.7)}


@pytest.fixture
def files(tmp_path: Path) -> list[Path]:
    """Two photographs, and two files that are none."""
    for name, codes in EDGES.items():
        Image.fromarray(codes).save(tmp_path / name)
    Image.new("RGB", (1, 1)).save(tmp_path / "dot.png")
    (tmp_path / "phone.heic").write_bytes(b"\0\0\0\x18ftypheic" + bytes(64))
    return [tmp_path / name for name in (*EDGES, "dot.png", "phone.heic")]


class Instrument:
    """One instrument of the page."""

    def __init__(self, reader: Reader, scene: str) -> None:
        self.reader = reader
        self.figure = reader.page.locator(f"simulation-figure[data-simulation={scene}]")
        self.box = reader.page.locator("figure", has=self.figure).locator(".intake")
        self.photographs = self.box.locator(".intake-photo")

    def add(self, files: Sequence[Path]) -> None:
        reader, frames = self.reader, self.reader.frames(self.figure)
        self.box.locator("input[type=file]").set_input_files(files)
        reader.wait_frame(self.figure, frames)
        expect(self.box.locator(".intake-said")).to_contain_text("ready")

    def states(self) -> list[str]:
        return [one.get_attribute("data-state") or "" for one in self.photographs.all()]

    def readout(self, name: str) -> Locator:
        return self.figure.locator(f"output[name={name}]")


@pytest.fixture
def instrument(reader: Reader) -> Instrument:
    reader.open(PAGE)
    found = Instrument(reader, SCENE)
    reader.bring(found.box)
    reader.settle(found.figure)
    return found


def saved_part(instrument: Instrument) -> dict[str, Any]:
    """What the data sheet, saved as JSON, says of the one instrument that is used."""
    page = instrument.reader.page
    with page.expect_download() as saved:
        page.locator(".data-sheet").get_by_role("button", name="Save as JSON").click()
    (part,) = json.loads(saved.value.path().read_text(encoding="utf-8"))["instruments"]
    return {**part, "lines": [(line["label"], line["text"]) for line in part["lines"]]}


def measured(name: str, given: dict[str, Any]) -> list[tuple[str, str]]:
    """The lines of the data sheet by this Python."""
    scene, codes = load_scene(SCENE), EDGES[name]
    facts = {"full_width": codes.shape[1], "full_height": codes.shape[0]}
    settings, own = scene.check(given), Photograph(1, codes, name, facts)
    outputs = scene.run(settings, "", StageCache(), own).outputs
    assert scene.sheet
    return [(line.label, line.text) for line in scene.sheet(settings, outputs)]


def test_photographs_go_in_the_data_sheet_comes_out_and_the_book_s_picture_after_the_last(
    instrument: Instrument, files: list[Path], tmp_path: Path
) -> None:
    """Then a file with damaged notes of the camera is measured, and one that is here already is
    named."""
    reader, figure = instrument.reader, instrument.figure
    before = instrument.readout("measured").inner_text()
    instrument.add(files)
    assert instrument.states() == ["ready", "ready", "refused", "refused"]
    expect(instrument.photographs.nth(2)).to_contain_text("it needs at least 16 each way")
    expect(instrument.photographs.nth(3)).to_contain_text("Use JPEG or PNG")
    expect(instrument.box.locator(".intake-said")).to_contain_text("2 are refused")
    expect(reader.page.locator(".data-sheet tbody")).to_contain_text("soft.png")
    frames = reader.frames(figure)
    figure.get_by_role("button", name="Keep this place").click()
    reader.wait_frame(figure, frames)
    part = saved_part(instrument)
    assert part["photographs"] == ["soft.png"]
    assert part["settings"]["kept"]
    assert part["lines"] == measured("soft.png", part["settings"])

    soft = instrument.readout("measured").inner_text()
    frames = reader.frames(figure)
    instrument.photographs.nth(1).locator(".intake-look").click()
    reader.wait_frame(figure, frames)
    assert float(instrument.readout("measured").inner_text()) > float(soft)
    frames = reader.frames(figure)
    instrument.photographs.nth(1).locator(".intake-remove").click()
    reader.wait_frame(figure, frames)
    expect(instrument.readout("measured")).to_have_text(soft)
    frames = reader.frames(figure)
    instrument.box.locator(".intake-clear").click()
    reader.wait_frame(figure, frames)
    expect(instrument.readout("measured")).to_have_text(before)
    expect(instrument.photographs).to_have_count(0)
    damaged = tmp_path / "damaged.jpg"
    beyond = b"Exif\0\0II*\0\xff\xff\xff\xff"  # where its directory would begin
    Image.fromarray(EDGES["soft.png"]).save(damaged, quality=95, exif=beyond)
    instrument.add([damaged])
    assert instrument.states() == ["ready"]
    instrument.box.locator("input[type=file]").set_input_files([damaged, files[0]])
    expect(instrument.photographs).to_have_count(2)
    said = instrument.box.locator(".intake-said")
    expect(said).to_have_text("2 of 2 photographs are ready. “damaged.jpg” is here already.")
    instrument.box.locator(".intake-clear").click()
    reading_stops_and_goes_on(instrument, tmp_path)


def test_what_is_kept_is_there_again_after_a_reload_and_gone_once_it_is_not_kept(
    instrument: Instrument, files: list[Path], tmp_path: Path
) -> None:
    """A photograph that was being read when the page was left is read then."""
    reader = instrument.reader
    instrument.add(files)
    soft = instrument.readout("measured").inner_text()
    keep = instrument.box.get_by_label("Keep on this device")
    keep.check()
    wait_stored(reader, 4)
    reader.open(PAGE)
    expect(instrument.photographs).to_have_count(4)
    assert instrument.states() == ["ready", "ready", "refused", "refused"]
    expect(instrument.readout("measured")).to_have_text(soft)
    keep.uncheck()
    wait_stored(reader, 0)
    reader.open(PAGE)
    expect(instrument.photographs).to_have_count(0)
    path = tmp_path / "large.png"
    path.write_bytes(noise())
    # The browser is slow to open the picture.
    reader.page.evaluate("() => { createImageBitmap = () => new Promise(() => {}); }")
    instrument.box.locator("input[type=file]").set_input_files(path)
    expect(instrument.photographs).to_have_attribute("data-state", "reading")
    keep.check()
    wait_stored(reader, 1)
    reader.open(PAGE)
    expect(instrument.photographs).to_have_attribute("data-state", "ready")


def wait_stored(reader: Reader, count: int) -> None:
    """Until the browser keeps so many photographs."""
    for _ in range(200):
        if reader.page.evaluate(STORED) == count:
            return
        reader.page.wait_for_timeout(50)
    pytest.fail(f"{reader.page.evaluate(STORED)} photographs are stored")


STORED = """async () => {
  const names = (await indexedDB.databases()).map(({ name }) => name);
  const name = names.find((name) => name.endsWith('photographs'));
  if (!name) return 0;
  const database = await new Promise((resolve) => {
    indexedDB.open(name).onsuccess = ({ target }) => resolve(target.result);
  });
  const request = database.transaction('photographs').objectStore('photographs').count();
  return new Promise((resolve) => {
    request.onsuccess = () => { database.close(); resolve(request.result); };
  });
}"""


def test_without_storage_photographs_are_measured_all_the_same(
    reader: Reader, files: list[Path]
) -> None:
    reader.page.add_init_script("delete IDBFactory.prototype.open")
    reader.open(PAGE)
    instrument = Instrument(reader, SCENE)
    reader.settle(instrument.figure)
    instrument.add(files)
    keep = instrument.box.get_by_label("Keep on this device")
    keep.click()
    expect(instrument.box.locator(".intake-said")).to_contain_text("keeps no photographs")
    expect(keep).not_to_be_checked()
    assert instrument.states()[0] == "ready"
    frames = reader.frames(instrument.figure)
    instrument.photographs.nth(1).locator(".intake-look").click()
    reader.wait_frame(instrument.figure, frames)
    expect(instrument.box.locator(".intake-said")).to_contain_text("ready")
    expect(instrument.box.locator(".intake-said")).to_contain_text("keeps no photographs")


def noise() -> bytes:
    buffer = io.BytesIO()
    codes = np.random.default_rng(2).integers(0, 256, (1500, 2000, 3), np.uint8)
    Image.fromarray(codes).save(buffer, "PNG")
    return buffer.getvalue()


def reading_stops_and_goes_on(instrument: Instrument, folder: Path) -> None:
    content, many = noise(), [folder / f"{number}.png" for number in range(8)]
    for path in many:
        path.write_bytes(content)
    instrument.box.locator("input[type=file]").set_input_files(many)
    instrument.box.get_by_role("button", name="Stop").click()
    said = instrument.box.locator(".intake-said")
    expect(said).to_have_text("Stopped. What is ready stays.")
    expect(instrument.box.locator("[data-state=reading]")).to_have_count(0)
    assert "waiting" in instrument.states()
    instrument.box.get_by_role("button", name="Continue").click()
    expect(said).to_have_text("8 of 8 photographs are ready.")
