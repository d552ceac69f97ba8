"""The intake of an instrument: photographs are read, refused, viewed, removed and stored."""

import io
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Dialog, Page, expect
from support.charts import gaussian_edge
from support.instruments import PAGE, Instrument, png, write_files
from support.limits import limit_ms
from support.reader import Reader, step
from support.static_server import StaticServer

from simulations.engine.photograph import Codes, Photograph
from simulations.engine.stages import StageCache
from simulations.registry import load_scene

pytestmark = pytest.mark.browser


def edge(angle_deg: float, sigma_px: float) -> Codes:
    """A photograph (H, W, 3) of an edge."""
    light = gaussian_edge(480, 640, angle_deg, sigma_px)
    return np.repeat(np.rint(60.0 + 120.0 * light).astype(np.uint8)[..., None], 3, axis=2)


EDGES = {"soft.png": edge(5.0, 1.2), "sharp.png": edge(-4.0, 0.7)}


@pytest.fixture
def instrument(reader: Reader) -> Instrument:
    reader.open(PAGE)
    return Instrument(reader, "slanted-edge")


def edge_files(folder: Path) -> list[Path]:
    """Two photographs, and five invalid files."""
    dot = png(np.zeros((1, 1, 3), np.uint8))
    huge = dot[:16] + struct.pack(">II", 20_000, 20_000) + dot[24:]
    heic = b"\0\0\0\x18ftypheic" + bytes(64)
    edges = {name: png(codes) for name, codes in EDGES.items()}
    bomb = io.BytesIO()
    Image.new("L", (8, 8)).save(bomb, "JPEG")
    few = bomb.getvalue().replace(struct.pack(">HH", 8, 8), struct.pack(">HH", 20_000, 20_001))
    broken = {"dot.png": dot, "phone.heic": heic, "huge.png": huge, "huge.jpg": few}
    chunk = struct.pack(">I4sI", 0, b"teXt", zlib.crc32(b"teXt"))
    soft = edges["soft.png"]
    broken["chunks.png"] = soft[:33] + 300_000 * chunk + soft[33:]
    return write_files(folder, {**edges, **broken})


def slanted_edge_sheet(name: str, given: dict[str, Any]) -> list[list[str]]:
    """The lines of the slanted-edge data sheet, computed in CPython."""
    scene, codes = load_scene("slanted-edge"), EDGES[name]
    facts = {"full_width": codes.shape[1], "full_height": codes.shape[0]}
    settings, own = scene.check(given), Photograph(1, codes, name, facts)
    outputs = scene.run(settings, "", StageCache(), own).outputs
    assert scene.instrument.sheet
    return [[line.label, line.text] for line in scene.instrument.sheet(settings, outputs)]


def test_photographs_are_measured_viewed_removed_refused_and_stored(
    instrument: Instrument, tmp_path: Path
) -> None:
    """Stored photographs are deleted when storing is turned off; a photograph that was being read
    when the page was left is read after a reload."""
    reader, figure, box = instrument.reader, instrument.figure, instrument.box
    photographs, status = instrument.photographs, instrument.status
    before = instrument.readout("per_px").inner_text()
    files = edge_files(tmp_path)
    with step("samples are read"):
        with reader.next_frame(figure):
            box.get_by_role("button", name="Try with samples").press("Enter")
        expect(status).to_have_text("6 of 6 photographs are ready.")
        expect(box.get_by_label("Keep on this device")).to_be_hidden()
    with step("the reader's files replace them, and invalid ones are refused with a reason"):
        instrument.add(files)  # replaces the samples
        assert instrument.states() == ["ready", "ready", *(5 * ["refused"])]
        expect(photographs.nth(2)).to_contain_text("it needs at least 16 each way")
        expect(photographs.nth(3)).to_contain_text("Use JPEG or PNG")
        expect(photographs.nth(4)).to_contain_text("20000")  # known before it is decoded
        expect(photographs.nth(5)).to_contain_text("20001")
        expect(photographs.nth(6)).to_contain_text("chunks.png")
        expect(status).to_contain_text("5 are refused")
        expect(reader.page.locator(".data-sheet-files")).to_have_text("soft.png")
    with step("the data sheet has the results of CPython"):
        instrument.click(figure.get_by_role("button", name="Keep this place"))
        part = instrument.sheet()
        assert part["photographs"] == ["soft.png"]
        assert part["settings"]["kept"]
        assert part["lines"] == slanted_edge_sheet("soft.png", part["settings"])
    with step("one photograph after the other is viewed, removed and cleared"):
        soft = instrument.readout("per_px").inner_text()
        instrument.click(photographs.nth(1).locator(".intake-look"))
        assert float(instrument.readout("per_px").inner_text()) > float(soft)
        instrument.click(photographs.nth(1).locator(".intake-remove"))
        expect(instrument.readout("per_px")).to_have_text(soft)
        instrument.click(box.locator(".intake-clear"))
        expect(instrument.readout("per_px")).to_have_text(before)
        expect(photographs).to_have_count(0)
    with step("damaged EXIF data does no harm, and a file is read only once"):
        damaged = tmp_path / "damaged.jpg"
        beyond = b"Exif\0\0II*\0\xff\xff\xff\xff"  # the offset of its directory
        Image.fromarray(EDGES["soft.png"]).save(damaged, quality=95, exif=beyond)
        instrument.add([damaged])
        instrument.give([damaged, files[0]])
        expect(photographs).to_have_count(2)
        expect(status).to_have_text("2 of 2 photographs are ready. “damaged.jpg” is here already.")
        instrument.clear()

    with step("reading is stopped and continued"):
        reader.page.evaluate(DELAY_OPENING)
        many = write_files(
            tmp_path, {f"{number}.png": png(EDGES["soft.png"]) for number in range(3)}
        )
        instrument.give(many)
        box.get_by_role("button", name="Stop").click()
        reader.page.evaluate("window.open_pictures()")
        expect(status).to_have_text("Stopped. What is ready stays.")
        expect(box.locator("[data-state=reading]")).to_have_count(0)
        assert "waiting" in instrument.states()
        box.get_by_role("button", name="Continue").click()
        expect(status).to_have_text("3 of 3 photographs are ready.")
        instrument.clear()

    with step("stored photographs are there after a reload"):
        instrument.add(files)
        keep = box.get_by_label("Keep on this device")
        keep.check()
        wait_stored(reader.page, 7)
        reader.open(PAGE)
        expect(photographs).to_have_count(7)
        assert instrument.states() == ["ready", "ready", *(5 * ["refused"])]
        expect(instrument.readout("per_px")).to_have_text(soft)
    with step("without storage, leaving needs a confirmation and discards the photographs"):
        keep.uncheck()
        wait_stored(reader.page, 0)
        dialogs = list[str]()

        def leave(dialog: Dialog) -> None:
            dialogs.append(dialog.type)
            dialog.accept()

        reader.page.once("dialog", leave)
        reader.page.locator("a", has_text="The Digital Sensor").first.click()
        reader.page.wait_for_url("**/digital-sensor/")
        assert dialogs == ["beforeunload"]
        reader.open(PAGE)
        expect(photographs).to_have_count(0)
    with step("a photograph being read is read again after a reload"):
        reader.page.evaluate(DELAY_OPENING)
        instrument.give(many[:1])
        expect(photographs).to_have_attribute("data-state", "reading")
        keep.check()
        wait_stored(reader.page, 1)
        reader.open(PAGE)
        expect(photographs).to_have_attribute("data-state", "ready")


def test_photographs_and_settings_of_two_tabs_are_stored_together(
    tabs: list[Page], site_server: StaticServer, tmp_path: Path
) -> None:
    for tab in tabs:
        tab.goto(site_server.url + PAGE)
    files = write_files(tmp_path, {name: png(codes) for name, codes in EDGES.items()})
    boxes = [tab.locator(f"figure:has({SLANTED}) .intake") for tab in tabs]
    for box, file in zip(boxes, files, strict=True):
        box.locator("input[type=file]").set_input_files(file)
        expect(box.locator(".intake-photo")).to_have_count(1)
    wait_stored(tabs[0], 2)
    for tab, name, value in zip(tabs, ("aperture", "pitch"), (11, 5), strict=True):
        tab.locator(SLANTED).evaluate(PAINTED_AT, [name, value])
    stored = tabs[0].evaluate(SESSION)
    assert (stored["aperture"], stored["pitch"]) == (11, 5)
    boxes[1].locator(".intake-remove").click()
    wait_stored(tabs[0], 1)
    assert tabs[0].evaluate(SESSION) == stored
    boxes[1].get_by_label("Keep on this device").evaluate("(box) => box.click()")
    wait_stored(tabs[0], 0)
    assert tabs[0].evaluate(SESSION) is None


SLANTED = "simulation-figure[data-simulation=slanted-edge]:not([data-with])"
PAINTED_AT = """(figure, [name, value]) => {
  figure.querySelector(`[name=${name}]`).value = value;
  figure.dispatchEvent(new Event('painted'));
}"""
SESSION = "() => JSON.parse(localStorage['image-formation:instrument:slanted-edge'] ?? 'null')"


DELAY_OPENING = """() => {
  const open = createImageBitmap;
  const allowed = new Promise((resolve) => { window.open_pictures = resolve; });
  createImageBitmap = async (...given) => {
    await allowed;
    return open(...given);
  };
}"""
"""The browser opens no picture before `open_pictures()` is called."""


def wait_stored(page: Page, count: int) -> None:
    """Wait until the browser stores this number of photographs."""
    assert page.evaluate(IS_STORED, [count, limit_ms()])


IS_STORED = """async ([count, ms]) => {
  const stored = async () => {
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
  };
  const end = performance.now() + ms;
  while (await stored() !== count) {
    if (performance.now() > end) return false;
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  return true;
}"""
