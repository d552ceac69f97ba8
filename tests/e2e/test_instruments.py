"""The reader's photographs in the instruments of a page; results agree with CPython."""

import io
import json
import struct
from base64 import b64encode
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from PIL.PngImagePlugin import PngInfo
from playwright.sync_api import Dialog, Locator, expect
from pypdf import PdfReader
from support.charts import as_srgb, gaussian_edge, gaussian_half, light_of, pairs_of
from support.dng import dng
from support.engines import ENGINES, open_engine
from support.engines.engine import Engine, wait_for
from support.limits import limit_ms
from support.reader import Reader
from support.static_server import StaticServer
from support.steps import step

from simulations.engine.controls import PointLists
from simulations.engine.photograph import Codes, Mosaic, Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.reading import Reading
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import encode_srgb
from simulations.pictures.checker_room import checker_room
from simulations.registry import load_scene
from simulations.scenes.calibration.boards import rendered
from simulations.scenes.single_view.files import as_json
from simulations.scenes.single_view.lines import FOCAL_PX, ROOMS, SIZE

pytestmark = pytest.mark.browser

PAGE = "measure-your-camera/"
CORNER = ROOMS["corner"]


def edge(angle_deg: float, sigma_px: float) -> Codes:
    """A photograph (H, W, 3) of an edge."""
    light = gaussian_edge(480, 640, angle_deg, sigma_px)
    return np.repeat(np.rint(60.0 + 120.0 * light).astype(np.uint8)[..., None], 3, axis=2)


EDGES = {"soft.png": edge(5.0, 1.2), "sharp.png": edge(-4.0, 0.7)}

LEVELS = (20.0, 60.0, 110.0, 170.0)
EVEN = [as_srgb(light_of(level, 2 * k + i)) for k, level in enumerate(LEVELS) for i in (0, 1)]
"""Four pairs of photographs of even light."""
BLACK = (64.0, 70.0, 67.0, 73.0)
RAW = [
    np.minimum(frame + np.tile(np.array([[0, 6], [3, 9]], np.uint16), (75, 75)), 4095)
    for pair in pairs_of(150, 5, count=8)[1:5]
    for frame in pair
]
"""Four pairs of raw mosaics, each colour above its own black level."""


def dng_files() -> list[bytes]:
    """These mosaics as DNG files."""
    return [dng(codes, black=BLACK, exposure_s=0.01 * (k // 2)) for k, codes in enumerate(RAW, 2)]


def transfer_sheet(photographs: Sequence[Photograph]) -> list[list[str]]:
    """The lines of the photon-transfer data sheet, computed in CPython."""
    scene = load_scene("photon-transfer")
    assert scene.instrument.read
    assert scene.instrument.sheet
    readings = tuple(
        Reading(one.number, one.name, scene.instrument.read(one)) for one in photographs
    )
    settings = scene.check({})
    outputs = scene.run(settings, "", StageCache(), None, readings).outputs
    return [[line.label, line.text] for line in scene.instrument.sheet(settings, outputs)]


def sheet_of_even_light() -> list[list[str]]:
    return transfer_sheet([Photograph(index, codes) for index, codes in enumerate(EVEN)])


def sheet_of_raw() -> list[list[str]]:
    picture = np.zeros((8, 8, 3), np.uint8)
    mosaics = [Mosaic(codes, "RGGB", BLACK, 4095) for codes in RAW]
    camera: dict[str, float | str] = {"make": "Example", "model": "Simulated sensor", "iso": 100.0}
    facts = [{"exposure_s": 0.01 * (k // 2 + 1), **camera} for k in range(len(RAW))]
    numbered = enumerate(zip(facts, mosaics, strict=True))
    return transfer_sheet([Photograph(k, picture, "", *each) for k, each in numbered])


def png(codes: Codes) -> bytes:
    """A PNG file whose gamma chunk, claiming linear codes, must be ignored."""
    file, info = io.BytesIO(), PngInfo()
    info.add(b"gAMA", struct.pack(">I", 100_000))
    Image.fromarray(codes).save(file, "PNG", pnginfo=info)
    return file.getvalue()


def write_files(folder: Path, contents: dict[str, bytes]) -> list[Path]:
    for name, content in contents.items():
        (folder / name).write_bytes(content)
    return [folder / name for name in contents]


class Instrument:
    """One instrument of the page."""

    def __init__(self, reader: Reader, scene: str) -> None:
        self.reader = reader
        self.figure = reader.page.locator(f"simulation-figure[data-simulation={scene}]")
        self.whole = reader.page.locator("figure", has=self.figure)
        self.box = self.whole.locator(".intake")
        self.status = self.box.locator(".intake-said")
        self.photographs = self.box.locator(".intake-photo")
        reader.scroll_to(self.box)
        reader.settle(self.figure)

    def give(self, files: Sequence[Path]) -> None:
        self.box.locator("input[type=file]").set_input_files(files)

    def add(self, files: Sequence[Path]) -> None:
        with self.reader.next_frame(self.figure):
            self.give(files)
        expect(self.status).to_contain_text("ready")

    def click(self, button: Locator) -> None:
        """Click, and wait for the frame that this makes."""
        with self.reader.next_frame(self.figure):
            button.click()

    def clear(self) -> None:
        self.box.locator(".intake-clear").click()

    def states(self) -> list[str]:
        return [one.get_attribute("data-state") or "" for one in self.photographs.all()]

    def readout(self, name: str) -> Locator:
        return self.figure.locator(f"output[name={name}]")

    def sheet(self) -> Any:
        """The data sheet's part for the only instrument in use, saved as JSON."""
        page = self.reader.page
        with page.expect_download() as download:
            page.locator(".data-sheet").get_by_role("button", name="Save as JSON").click()
        text = download.value.path().read_text(encoding="utf-8")
        (part,) = json.loads(text)["instruments"]
        return {**part, "lines": [[line["label"], line["text"]] for line in part["lines"]]}


@pytest.fixture
def instrument(reader: Reader) -> Instrument:
    reader.open(PAGE)
    return Instrument(reader, "slanted-edge")


def edge_files(folder: Path) -> list[Path]:
    """Two photographs, and four invalid files."""
    dot = png(np.zeros((1, 1, 3), np.uint8))
    huge = dot[:16] + struct.pack(">II", 20_000, 20_000) + dot[24:]
    heic = b"\0\0\0\x18ftypheic" + bytes(64)
    edges = {name: png(codes) for name, codes in EDGES.items()}
    bomb = io.BytesIO()
    Image.new("L", (8, 8)).save(bomb, "JPEG")
    few = bomb.getvalue().replace(struct.pack(">HH", 8, 8), struct.pack(">HH", 20_000, 20_001))
    broken = {"dot.png": dot, "phone.heic": heic, "huge.png": huge, "huge.jpg": few}
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
    with step("the reader's files replace them, and unfit ones say why they are refused"):
        instrument.add(files)  # the samples make room
        assert instrument.states() == ["ready", "ready", *(4 * ["refused"])]
        expect(photographs.nth(2)).to_contain_text("it needs at least 16 each way")
        expect(photographs.nth(3)).to_contain_text("Use JPEG or PNG")
        expect(photographs.nth(4)).to_contain_text("20000")  # known before it is decoded
        expect(photographs.nth(5)).to_contain_text("20001")
        expect(status).to_contain_text("4 are refused")
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
        beyond = b"Exif\0\0II*\0\xff\xff\xff\xff"  # where its directory would begin
        Image.fromarray(EDGES["soft.png"]).save(damaged, quality=95, exif=beyond)
        instrument.add([damaged])
        instrument.give([damaged, files[0]])
        expect(photographs).to_have_count(2)
        expect(status).to_have_text("2 of 2 photographs are ready. “damaged.jpg” is here already.")
        instrument.clear()

    with step("reading is stopped and continued"):
        reader.page.evaluate(SLOW_TO_OPEN)
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
        wait_stored(reader, 6)
        reader.open(PAGE)
        expect(photographs).to_have_count(6)
        assert instrument.states() == ["ready", "ready", *(4 * ["refused"])]
        expect(instrument.readout("per_px")).to_have_text(soft)
    with step("leaving asks first once nothing is stored, and then all is gone"):
        keep.uncheck()
        wait_stored(reader, 0)
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
    with step("a photograph that was being read at a reload is read after it"):
        reader.page.evaluate(SLOW_TO_OPEN)
        instrument.give(many[:1])
        expect(photographs).to_have_attribute("data-state", "reading")
        keep.check()
        wait_stored(reader, 1)
        reader.open(PAGE)
        expect(photographs).to_have_attribute("data-state", "ready")


SLOW_TO_OPEN = """() => {
  const open = createImageBitmap;
  const allowed = new Promise((resolve) => { window.open_pictures = resolve; });
  createImageBitmap = async (...given) => {
    await allowed;
    return open(...given);
  };
}"""
"""The browser opens no picture before `open_pictures()` is called."""


def wait_stored(reader: Reader, count: int) -> None:
    """Wait until the browser stores this number of photographs."""
    assert reader.page.evaluate(STORES, [count, limit_ms()])


STORES = """async ([count, ms]) => {
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


def test_boards_pairs_and_raw_files_give_the_results_of_cpython(
    reader: Reader, tmp_path: Path
) -> None:
    """Too few boards give no file, the interpreter that reads them ends afterwards, and the browser
    has no storage."""
    requests = reader.record_requests(".wasm")
    reader.page.add_init_script("delete IDBFactory.prototype.open")
    reader.open(PAGE)
    page = reader.page
    calibration = Instrument(reader, "calibration")
    boards = [np.repeat(rendered(index), 3, axis=-1) for index in range(3)]
    shots = [*boards, np.full_like(boards[0], 120)]
    files = write_files(tmp_path, {f"board {k}.png": png(codes) for k, codes in enumerate(shots)})
    make = calibration.whole.get_by_role("button", name="JSON", exact=True)
    with step("one board is too few for a file"):
        calibration.give(files[:1])
        expect(calibration.readout("focal")).to_have_text("not determined")
        make.click()
        message = calibration.whole.locator(".made-files-said")
        expect(message).to_contain_text(": At least 3 photographs")
        calibration.clear()
        expect(message).to_have_text("")
    with step("three boards give the camera of CPython, and a picture without a board is refused"):
        calibration.give(files)
        expect(calibration.status).to_contain_text("3 of 4")
        expect(calibration.photographs.last).to_contain_text("No chequerboard found")
        expect(calibration.whole.locator("input[name=photographs]")).to_have_value("3")
        expect(calibration.readout("supported")).not_to_have_text("")
        with page.expect_download() as download:
            make.click()
        theirs = json.loads(download.value.path().read_text(encoding="utf-8"))
        ours = calibration_file(boards)
        assert [one["name"] for one in theirs["photographs"]] == [file.name for file in files[:3]]
        for part in ("camera", "standard_errors"):
            assert theirs[part] == pytest.approx(ours[part], rel=1e-6, abs=1e-9)
        assert len(page.workers) == 1
    with step("the distances use the calibrated lens"):
        distances = Instrument(reader, "single-view")
        distances.give(write_files(tmp_path, {"room.png": png(shots[-1])}))  # of the boards' shape
        expect(distances.readout("lens")).to_contain_text("calibrated on this page")
        calibration.clear()
        expect(distances.readout("lens")).to_contain_text("by the lines alone")
        distances.clear()

    with step("pairs of even light give the sheet of CPython"):
        transfer = Instrument(reader, "photon-transfer")
        uneven = EVEN[2].copy()
        uneven[:, 90:] //= 2
        pairs = [*EVEN, uneven]
        files = write_files(tmp_path, {f"{k}.png": png(codes) for k, codes in enumerate(pairs)})
        transfer.give(files)
        expect(transfer.status).to_contain_text(f"{len(EVEN)} of {len(files)}")
        expect(transfer.photographs.last).to_contain_text("not evenly lit")
        expect(transfer.readout("gain_true")).to_contain_text("unknown")
        expect(page.locator(".data-sheet-parts")).to_contain_text("Conversion gain")
        assert transfer.sheet()["lines"] == sheet_of_even_light()
        assert not any("libraw" in url for url in requests)
        transfer.clear()
    with step("raw files give the sheet of CPython, and one that is cut off is refused"):
        raw = dng_files()
        cut = [*raw, raw[0][:5000]]
        transfer.give(write_files(tmp_path, {f"{k}.dng": data for k, data in enumerate(cut)}))
        expect(transfer.status).to_contain_text(f"{len(RAW)} of {len(cut)} photographs are ready")
        expect(transfer.photographs.last).to_contain_text("damaged or cut off")
        expect(page.locator(".data-sheet-parts")).to_contain_text("green, row 0")
        reader.settle(transfer.figure)
        assert any("libraw" in url for url in requests)
        assert transfer.sheet()["lines"] == sheet_of_raw()
    with step("the data sheet is printed on one page"):
        page.evaluate("() => { window.print = () => { window.is_printing = true; }; }")
        page.locator(".data-sheet").get_by_role("button", name="Print").click()
        page.wait_for_function("() => window.is_printing")
        paper = PdfReader(io.BytesIO(page.pdf(format="A4")))
        assert len(paper.pages) == 1
        assert "green, row 0" in paper.pages[0].extract_text()

    with step("the developed picture of a raw file has its sharpness"):
        # The other instruments get the developed picture, which clips no white.
        light = 0.05 + 0.85 * gaussian_edge(360, 480, 5.0, 1.0)
        grain = np.random.default_rng(2).normal(0.0, 3.0, light.shape)
        cells = np.rint(64 + 4031 * light + grain).astype(np.uint16)
        slanted = Instrument(reader, "slanted-edge")
        slanted.give(write_files(tmp_path, {"edge.dng": dng(cells, black=BLACK[:1])}))
        expect(slanted.status).to_contain_text("1 of 1 photograph is ready")
        keep = slanted.box.get_by_label("Keep on this device")
        keep.click()
        expect(slanted.status).to_contain_text("keeps no photographs")
        expect(keep).not_to_be_checked()
        reader.settle(slanted.figure)
        per_px = slanted.readout("per_px").inner_text().split()[0]
        assert float(per_px) == pytest.approx(gaussian_half(1.0), rel=0.01)


def calibration_file(boards: Sequence[Codes]) -> dict[str, Any]:
    """The calibration's JSON file, computed in CPython."""
    scene = load_scene("calibration")
    assert scene.instrument.read
    readings = tuple(
        Reading(index, f"board {index}.png", scene.instrument.read(Photograph(index, codes)))
        for index, codes in enumerate(boards)
    )
    settings = scene.check({"photographs": 20, "lens": "supported"})
    outputs = scene.run(settings, "", StageCache(), None, readings).outputs
    (made,) = (export for export in scene.instrument.exports if export.suffix == ".json")
    read: dict[str, Any] = json.loads(made.make(settings, outputs))
    return read


def test_drawn_lines_can_be_undone_and_give_the_results_of_cpython(
    visitor: Reader, book: Any, tmp_path: Path
) -> None:
    keyboard, figure = visitor.page.keyboard, visitor.turn_to_figure(book, "single-view")
    field = figure.locator("input[name=lines]")

    def lists() -> PointLists:
        return PointLists.from_text(field.input_value())

    def press(button: str) -> None:
        with visitor.next_frame(figure):
            figure.get_by_role("button", name=button, exact=True).click()
        visitor.settle(figure)

    visitor.restore(figure)
    with step("an end is dragged, and put back by Undo"):
        shown = visitor.content(figure)
        end = figure.locator('[data-handle="end-2"]')
        visitor.scroll_to(end)
        x, y = visitor.middle(end)
        with visitor.next_frame(figure):
            visitor.drag((x, y), (x - 30, y + 20))
        visitor.settle(figure)
        assert lists().touched == 2
        assert visitor.content(figure) != shown
        press("Undo")
        assert field.input_value() == ""

    with step("a line is added and moved by keys, and put back by Undo"):
        press("Clear")
        assert not any(lists().lists)
        press("Add a line")
        before = lists().lists[1]
        expect(figure.locator('[data-handle="end-0"]')).to_be_focused()
        for key in ("ArrowRight", "Shift+ArrowUp"):
            with visitor.next_frame(figure):
                keyboard.press(key)
            visitor.settle(figure)
        moved = (np.array(lists().lists[1]) - before) * SIZE
        np.testing.assert_allclose(moved, [(1, -10), (0, 0)], atol=0.51)
        press("Undo")
        press("Undo")
        assert lists().lists[1] == before

    with step("a link with lines measures the reader's photograph as CPython does"):
        codes = to_rgba8(encode_srgb(checker_room(*SIZE, FOCAL_PX, CORNER.turn)))[..., :3]
        same = Photograph(1, codes, "room.png")
        noisy = [ends + np.random.default_rng(1).normal(size=ends.shape) for ends in CORNER.drawn]
        shares = [np.clip((ends.reshape(-1, 2) + 0.5) / SIZE, 0, 1) for ends in noisy]
        lines = PointLists("own", 0, tuple(tuple(map(tuple, each)) for each in shares)).text
        place = "figure-single-view"
        visitor.turn_to_unlinked(f"{PAGE}?{place}.lines={lines}&{place}.sigma=1#{place}")
        whole = visitor.page.locator(f"#{place}")
        with visitor.next_frame(figure):
            whole.locator(".intake input[type=file]").set_input_files(
                write_files(tmp_path, {"room.png": png(codes)})
            )
        visitor.settle(figure)
        scene = load_scene("single-view")
        settings = scene.check({"lines": lines, "sigma": 1.0})
        for readout in scene.render(settings, "", StageCache(), same).readouts:
            assert figure.locator(f"output[name={readout.name}]").text_content() == readout.text
    with step("the exported file has the numbers of CPython"):
        with visitor.page.expect_download() as download:
            whole.get_by_role("button", name="Distances as JSON").click()
        theirs = json.loads(download.value.path().read_text("utf-8"))
        ours = json.loads(as_json(settings, scene.run(settings, "", StageCache(), same).outputs))
        assert theirs["photograph"] == "room.png"
        focal_px = ours["camera"]["focal_px"]["value"]
        assert theirs["camera"]["focal_px"]["value"] == pytest.approx(focal_px, rel=1e-9)
        assert theirs["lines_px"] == ours["lines_px"]


BOX = "document.querySelector('figure:has([data-simulation=photon-transfer]) .intake')"
CHOOSE = f"""(files) => {{
  const box = {BOX};
  box.scrollIntoView({{behavior: 'instant'}});
  const chosen = new DataTransfer();
  for (const [name, base64] of Object.entries(files)) {{
    chosen.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
  }}
  const input = box.querySelector('input[type=file]');
  input.files = chosen.files;
  input.dispatchEvent(new Event('change', {{bubbles: true}}));
}}"""
READS = """(lines) => {
  const rows = [...document.querySelectorAll('.data-sheet tr')].map(({cells}) => [...cells]);
  rows.unshift(['what', 'number'].map((part) => document.querySelector(`.data-sheet-${part}`)));
  return rows.length === lines.length && rows.every(([what, value], index) =>
    what?.textContent === lines[index][0] && value.textContent.startsWith(lines[index][1]));
}"""
"""Whether the sheet has these lines; units follow the values."""


@pytest.mark.deep
@pytest.mark.parametrize("name", ENGINES)
def test_photographs_and_raw_files_are_measured_in_other_engines(
    name: str, site_server: StaticServer, tmp_path: Path
) -> None:
    with open_engine(name, tmp_path) as engine:
        engine.open(site_server.url + PAGE)
        wait_for(engine, f"() => Boolean({BOX})")
        choose(engine, {f"{index}.png": png(codes) for index, codes in enumerate(EVEN)})
        wait_for(engine, READS, sheet_of_even_light())
        engine.evaluate(f"() => {BOX}.querySelector('.intake-clear').click()")
        choose(engine, {f"{index}.dng": data for index, data in enumerate(dng_files())})
        wait_for(engine, READS, sheet_of_raw())
        assert not engine.errors()


def choose(engine: Engine, files: dict[str, bytes]) -> None:
    """Choose files without the picker, which no driver can open."""
    engine.evaluate(CHOOSE, {name: b64encode(data).decode() for name, data in files.items()})
