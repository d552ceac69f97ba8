"""The calibration figure: simulated photographs, the reader's photographs, and the exported files;
and the board to print."""

import io
import json
import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import asdict, replace

import cv2
import numpy as np
import pytest
from pypdf import PdfReader
from pypdf.generic import ContentStream
from support.chequerboards import SIZE, TRUTH, bent_views, facing_board, photographs
from support.frames import frame_of, pixels_of, texts_of

from simulations.engine.frame import Frame
from simulations.engine.photograph import Photograph
from simulations.engine.reading import Reading, Readings, UnfitError
from simulations.engine.stages import Outputs, StageCache
from simulations.models.calibration.camera import PINHOLE, Camera
from simulations.models.chequerboard.board import POINTS, Board
from simulations.models.chequerboard.find_board import find_board
from simulations.models.error_measures import root_mean_square
from simulations.pictures.chequerboard import Look, photograph_of, true_corners
from simulations.scenes.calibration import boards
from simulations.scenes.calibration.boards import SIGMA_PX, read, rendered, simulated_sitting
from simulations.scenes.calibration.contact_sheet import middle_of, number_at
from simulations.scenes.calibration.results import measured, sheet
from simulations.scenes.calibration.scene import SCENE
from simulations.scenes.calibration.settings import ERRORS, Settings
from simulations.scenes.chequerboard import SCENE as CHEQUERBOARD


@pytest.mark.parametrize(("series", "paper"), [("iso", (297.0, 210.0)), ("us", (279.4, 215.9))])
def test_printed_board_has_squares_and_a_bar_of_true_size(
    series: str, paper: tuple[float, float]
) -> None:
    settings = CHEQUERBOARD.check({"side": 23, "across": 10, "down": 6, "series": series})
    pdf, svg = (export.make(settings, {}) for export in CHEQUERBOARD.instrument.exports)
    assert ET.fromstring(svg).get("width") == "276mm"
    reader = PdfReader(io.BytesIO(pdf.encode("ascii")), strict=True)
    (page,) = reader.pages
    assert np.array(page.mediabox[2:], float) / POINTS == pytest.approx(paper, abs=1e-3)
    drawn = ContentStream(page.get_contents(), reader).operations
    numbers = {
        name: np.array([given for given, operator in drawn if operator == name], float)
        for name in (b"cm", b"re", b"m", b"l")
    }
    (scale,) = numbers[b"cm"] / POINTS
    assert scale == pytest.approx((1.0, 0.0, 0.0, -1.0, 0.0, paper[1]), abs=1e-3)
    squares = numbers[b"re"]
    assert len(squares) == 30
    assert squares[:, 2:] == pytest.approx(23.0, abs=0.01)
    assert np.ptp(squares[:, :2], axis=0) == pytest.approx((9 * 23.0, 5 * 23.0), abs=0.01)
    bar = numbers[b"l"][0] - numbers[b"m"][0]
    assert bar == pytest.approx((100.0, 0.0), abs=0.01)
    places = np.vstack((squares[:, :2], squares[:, :2] + squares[:, 2:], numbers[b"l"]))
    assert places.min() > 5.0
    assert (places.max(axis=0) < np.array(paper) - 5.0).all()
    assert "100 mm, 23 mm a square" in page.extract_text()


FACTS = {"focal_mm": 4.0, "focal_35mm_mm": 26.0, "make": "Acme", "model": "A1"}


def readings(count: int, *, size: tuple[int, int] = SIZE, first: int = 0) -> Readings:
    """Photographs by the tests' camera, as `read` would return them."""
    sitting = photographs(count, seed=8)
    data = {
        "width": size[0],
        "height": size[1],
        "indices": sitting.board.indices.astype(int).tolist(),
        "facts": FACTS,
    }
    corners = sitting.views(0.05).pixels.tolist()
    return tuple(
        Reading(first + index, f"{index}.jpg", {**data, "corners": each})
        for index, each in enumerate(corners)
    )


def with_facts(given: Readings, *facts: Mapping[str, object]) -> Readings:
    pairs = zip(given, facts, strict=False)
    return tuple(replace(each, data={**each.data, "facts": own}) for each, own in pairs)


def outputs_of(settings: Settings, given: Readings = ()) -> Outputs:
    return SCENE.run(settings, "", StageCache(), None, given).outputs


def frame_from(given: Readings, **settings: object) -> Frame:
    return SCENE.render(SCENE.check(settings), "", StageCache(), None, given)


def test_reading_survives_json_and_a_photograph_without_board_is_refused() -> None:
    board = Board(8, 6, 25.0)
    view = facing_board(board, 480, 360, focal_px=420.0, tilt=(0.2, -0.3, 0.1), distance_mm=330.0)
    grey = photograph_of(board, view, Look(noise_codes=1.0))
    facts: dict[str, float | str] = {"focal_mm": 4.2, "model": "Box", "full_width": 480.0}
    photograph = Photograph(7, np.repeat(grey[..., None], 3, axis=2), "a.jpg", facts)
    kept = json.loads(json.dumps(read(photograph)))
    assert (kept["width"], kept["height"], kept["columns"], kept["rows"]) == (480, 360, 7, 5)
    assert kept["facts"] == facts
    place = {tuple(i): corner for i, corner in zip(kept["indices"], kept["corners"], strict=True)}
    ours = np.array([place[column, row] for column, row in board.indices.astype(int).tolist()])
    truth = true_corners(board, view)
    assert min(np.abs(found - truth).max() for found in (ours, ours[::-1])) < 0.05  # or turned
    with pytest.raises(UnfitError, match=r"^No chequerboard found; .*\.$"):
        read(Photograph(1, np.full((40, 30, 3), 200, np.uint8)))


@pytest.mark.parametrize("count", [5, 40])
def test_right_lens_model_gives_the_true_focal_length(count: int) -> None:
    """Within three standard errors."""
    shown = texts_of(frame_of(SCENE, photographs=count, lens="p1p2"))
    off = float(shown["focal"]) - boards.TRUTH.fx
    assert abs(off) < 3.0 * float(shown["focal_error"]) + 0.05


def test_corners_of_rendered_photographs_are_as_noisy_as_simulated_ones() -> None:
    off = []
    for index in range(4):
        true = simulated_sitting().pixels[index]
        places = find_board(rendered(index)[..., 0]).places
        near = np.hypot(*np.moveaxis(places[:, None] - true, -1, 0)).argmin(axis=1)
        off.append(places - true[near])
    assert root_mean_square(np.concatenate(off)) == pytest.approx(SIGMA_PX, rel=0.25)


def test_drawing_shows_errors_of_one_or_all_boards_and_marks_unused_ones() -> None:
    one, every = (frame_of(SCENE, photographs=8, arrows=arrows).panels[0] for arrows in ERRORS)
    assert one.overlay.count("<circle") == 54
    assert every.overlay.count("M") == 2 * 8 * 54
    used, unused = (frame_of(SCENE, shown=shown).panels[0].overlay for shown in (5, 6))
    assert ["not used" in overlay for overlay in (used, unused)] == [False, True]


def test_photograph_with_another_zoom_is_named_wherever_the_result_stands() -> None:
    given = readings(10)
    middle = np.array((TRUTH.cx, TRUTH.cy))
    other = ((np.array(given[4].data["corners"]) - middle) * 1.1 + middle).tolist()
    given = (*given[:4], replace(given[4], data={**given[4].data, "corners": other}), *given[5:])
    settings = Settings(photographs=10, lens="supported")
    for chosen, named in ((given, True), (readings(10), False)):
        lines = sheet(settings, outputs_of(settings, chosen))
        described = frame_from(chosen, **asdict(settings)).description
        for words in (" ".join(line.text for line in lines), described):
            assert ("4.jpg differs from the others" in words) == named


def test_readers_corners_replace_the_simulated_ones() -> None:
    given, settings = readings(8), {"photographs": 8, "lens": "p1p2", "share": 0.5}
    out = frame_from(given, **settings)
    shown = texts_of(out)
    assert float(shown["focal"]) == pytest.approx(TRUTH.fx, abs=4 * float(shown["focal_error"]))
    assert "true" not in out.description
    assert out.panels[0].raster is None
    chosen = Photograph(4, np.full((240, 320, 3), 90, np.uint8))
    out = SCENE.render(SCENE.check(settings), "", StageCache(), chosen, given)
    assert pixels_of(out).shape == (240, 320, 4)
    assert float(texts_of(out)["rms_shown"]) < 0.2


def test_press_on_a_photograph_excludes_it() -> None:
    given = readings(8)
    bad = np.array(given[4].data["corners"]) + np.random.default_rng(0).normal(0, 2, (54, 2))
    given = (*given[:4], replace(given[4], data={**given[4].data, "corners": bad}), *given[5:])
    settings = Settings(photographs=8, lens="p1p2", detail="sheet")
    outputs = outputs_of(settings, given)
    assert outputs["each"].argmax() == 4
    at = [
        place for place in frame_from(given, **asdict(settings)).handles if place.name == "left-out"
    ]
    assert [number_at((each.x, each.y)) for each in at] == [0]
    pressed = SCENE.pull(settings, "left-out", middle_of(5))
    assert pressed == {"without": 5}
    kept = replace(settings, without=5)
    found, all_of_them = outputs_of(kept, given)["result"].trial, outputs["result"].trial
    assert found.rms_px < 0.1 < all_of_them.rms_px
    assert measured(outputs_of(kept, given)) == (0, 1, 2, 3, 5, 6, 7)
    assert SCENE.pull(kept, "left-out", middle_of(0)) == {"without": 0}


def test_choices_that_leave_nothing_determined_can_be_changed_back_in_the_figure() -> None:
    two_of_three: dict[str, object] = {"without": 1, "detail": "sheet"}
    for handle, choices in (("left-out", two_of_three), ("model", {"lens": "rational"})):
        out = frame_from(readings(3), **choices)
        assert texts_of(out)["focal"] == "not determined"
        assert handle in [place.name for place in out.handles]


ONE, TWO = {"make": "Maker", "model": "One"}, {"make": "Maker", "model": "Two"}
HALF_TURN = {"orientation": 3.0}
OTHERS = readings(3, size=(480, 640), first=50)


@pytest.mark.parametrize(
    ("given", "notes"),
    [
        (readings(5) + OTHERS, ["3 of another size are left out"]),
        (readings(5) + OTHERS[:1], ["1 of another size is left out"]),
        (readings(3) * 14, ["The first 40 are used"]),
        (readings(3) * 14 + with_facts(readings(1), {"focal_mm": 8.0}), ["The first 40 are used"]),
        (
            with_facts(readings(1), {"focal_mm": 8.0}) + readings(3) * 14,
            ["The first 40 are used", "They were taken at 4 to 8 mm"],
        ),
        (
            with_facts(readings(4), ONE, TWO, TWO, {}),
            ["They were taken by Maker One and Maker Two"],
        ),
        (with_facts(readings(3), TWO, TWO, {}), []),
        (with_facts(readings(4), {}, {}, {}, HALF_TURN), ["The camera was turned for 3.jpg"]),
    ],
)
def test_differing_or_surplus_photographs_are_noted(given: Readings, notes: list[str]) -> None:
    found = boards.boards(given)
    assert found.size == SIZE
    assert [note[: len(ours)] for note, ours in zip(found.notes, notes, strict=True)] == notes
    for count in (3, 5):
        settings = SCENE.check({"photographs": count})
        assert measured(outputs_of(settings, given)) == found.numbers[:count]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (readings(1), ("At least 3",)),
        (readings(2), ("At least 3",)),
        (readings(1) + readings(2, size=(480, 640)), ("At least 3", "another size")),
    ],
)
def test_too_few_photographs_are_refused_everywhere(
    given: Readings, words: tuple[str, ...]
) -> None:
    out, outputs = frame_from(given), outputs_of(Settings(), given)
    assert texts_of(out)["focal"] == "not determined"
    lines = " ".join(line.text for line in sheet(Settings(), outputs))
    plots = [" ".join(re.findall(r">([^<]+)<", panel.overlay)) for panel in out.panels[1:]]
    for word in words:
        assert all(word in text for text in (out.description, lines, *plots))
    with pytest.raises(UnfitError, match="At least 3"):
        SCENE.instrument.exports[0].make(Settings(), outputs)


def test_sheet_and_readout_use_the_supported_model() -> None:
    outputs = outputs_of(Settings(photographs=8, lens="supported"), readings(8))
    lines = {line.name: line.text for line in sheet(Settings(), outputs)}
    assert lines["lens"] == lines["supported"]
    frame = SCENE.render(
        Settings(photographs=8, lens="supported"), "", StageCache(), None, readings(8)
    )
    assert texts_of(frame)["focal_error"] == lines["fx"].split(" ± ")[1]


def test_files_sheet_and_developed_photograph_use_the_same_camera() -> None:
    settings, given = Settings(photographs=8, lens="p1p2"), readings(8)
    outputs = outputs_of(settings, given)
    yaml, text, xml, *_ = (export.make(settings, outputs) for export in SCENE.instrument.exports)
    saved = json.loads(text)
    assert f"{saved['camera']['fx']:.17g}" in yaml
    assert [p["name"] for p in saved["photographs"]] == [f"{index}.jpg" for index in range(8)]
    lens = ET.fromstring(xml).find("lens")
    assert lens is not None
    assert lens.findtext("maker") == "Acme"
    assert float(lens.findtext("cropfactor") or "") == 6.5
    lines = {line.name: line.text for line in sheet(settings, outputs)}
    focal, error = map(float, lines["fx"].split(" ± "))
    assert focal == pytest.approx(saved["camera"]["fx"], abs=error / 10)
    assert lines["photographs"] == "8"
    worst = max(saved["photographs"], key=lambda photograph: photograph["rms_px"])
    assert lines["worst"] == f"{worst['rms_px']:.3f} px, {worst['name']}"
    assert float(lines["stated"]) == pytest.approx(26 * 800 / 43.27, abs=1)
    codes = np.random.default_rng(0).integers(0, 255, (960, 1280, 3)).astype(np.uint8)
    assert SCENE.instrument.develop
    assert SCENE.instrument.develop(Photograph(0, codes), settings, outputs).shape == codes.shape


@pytest.mark.parametrize(("side", "unit"), [(0.0, "% of a square’s width"), (30.0, "mm")])
def test_board_is_measured_in_millimetres_only_if_a_square_is(side: float, unit: str) -> None:
    given = {"shape": "bent", "detail": "board", "side": side, "photographs": 12}
    frame = frame_of(SCENE, **given)
    words = " ".join((texts_of(frame)["board"], frame.description, frame.panels[2].overlay))
    assert unit in words
    assert ("mm" in words) == (side > 0)


def test_poses_in_the_files_belong_to_a_flat_board() -> None:
    """OpenCV's projection with the numbers of the file alone has the error that the file states."""
    settings = SCENE.check({"shape": "bent", "lens": "k1k2", "photographs": 40})
    _, views = bent_views({"sag_mm": 2.0}, np.random.default_rng(3))
    data = {"width": 1600, "height": 1200, "indices": views.board[0].astype(int).tolist()}
    given = tuple(
        Reading(n, f"{n}.jpg", {**data, "corners": pixels.tolist()})
        for n, pixels in enumerate(views.pixels)
    )
    outputs = SCENE.run(settings, "", StageCache(), None, given).outputs
    (make,) = (each.make for each in SCENE.instrument.exports if each.name == "camera-and-poses")
    read = json.loads(make(settings, outputs))
    camera = Camera(*(read["camera"][name] for name in PINHOLE))
    lens = np.array([read["camera"][name] for name in ("k1", "k2", "p1", "p2", "k3")])
    board = np.column_stack((views.board[0], np.zeros(len(views.board[0]))))
    squares = []
    for pose, pixels in zip(read["photographs"], views.pixels, strict=True):
        turn, shift = (np.array(pose[name]) for name in ("rotation_vector", "translation"))
        seen, _ = cv2.projectPoints(board, turn, shift, camera.matrix, lens)
        squares.append(np.sum((seen[:, 0] - pixels) ** 2, axis=-1))
        assert np.sqrt(np.mean(squares[-1])) == pytest.approx(pose["rms_px"], rel=1e-6)
    assert np.sqrt(np.mean(squares)) == pytest.approx(read["rms_px"], rel=1e-6)
    assert read["board_shape"]["rms_px"] < 0.5 * read["rms_px"]
    noise = np.sqrt(np.diag(read["covariance"]["matrix"]))
    errors = np.array([read["standard_errors"][each] for each in read["covariance"]["parameters"]])
    assert np.all((noise <= errors * (1 + 1e-9)) & (noise > 0.2 * errors))
