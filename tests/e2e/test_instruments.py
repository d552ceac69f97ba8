"""Results of the instruments from the reader's photographs agree with CPython."""

import io
import json
from base64 import b64encode
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import expect
from pypdf import PdfReader
from support.charts import as_srgb, gaussian_edge, gaussian_half, light_of, pairs_of
from support.dng import dng
from support.engines import ENGINES, open_engine
from support.engines.engine import Engine, wait_for
from support.instruments import PAGE, Instrument, png, write_files
from support.reader import Reader, step
from support.static_server import StaticServer

from simulations.engine.controls import PointLists
from simulations.engine.photograph import Codes, Mosaic, Photograph
from simulations.engine.raster import to_rgba8
from simulations.engine.reading import Reading
from simulations.engine.stages import StageCache
from simulations.models.color.srgb import decode_srgb, encode_srgb
from simulations.pictures.checker_room import checker_room
from simulations.registry import load_scene
from simulations.scenes.calibration.boards import rendered
from simulations.scenes.single_view.files import as_json
from simulations.scenes.single_view.lines import FOCAL_PX, ROOMS, SIZE

pytestmark = pytest.mark.browser
CORNER = ROOMS["corner"]

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
    calibration.whole.locator(".made-files summary").click()
    make = calibration.whole.get_by_role("button", name="JSON", exact=True)
    with step("one board is too few for a file"):
        calibration.give(files[:1])
        expect(calibration.readout("focal")).to_have_text("not determined")
        make.click()
        message = calibration.whole.locator(".made-files-status")
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
        expect(distances.readout("lens")).to_contain_text("may be of another camera")
        reader.choose(distances.figure, "calibration", "any")
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
        reader.settle(transfer.figure)
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

    with step("the green cells of a raw file have its sharpness"):
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
    with step("the data sheet names a raw photograph for which the camera was turned"):
        cells = np.rint(64 + 4031 * decode_srgb(boards[2][::-1, ::-1, 0] / 255)).astype(np.uint16)
        turned = write_files(tmp_path, {"turned.dng": dng(cells, black=BLACK[:1], orientation=3)})
        calibration.give([*(tmp_path / f"board {k}.png" for k in range(2)), *turned])
        expect(page.locator(".data-sheet-parts")).to_contain_text("turned for turned.dng")


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
            whole.locator(".made-files summary").click()
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
HAS_LINES = """(lines) => {
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
        wait_for(engine, HAS_LINES, sheet_of_even_light())
        engine.evaluate(f"() => {BOX}.querySelector('.intake-clear').click()")
        choose(engine, {f"{index}.dng": data for index, data in enumerate(dng_files())})
        wait_for(engine, HAS_LINES, sheet_of_raw())
        assert not engine.errors()


def choose(engine: Engine, files: dict[str, bytes]) -> None:
    """Choose files without the picker, which no driver can open."""
    engine.evaluate(CHOOSE, {name: b64encode(data).decode() for name, data in files.items()})
