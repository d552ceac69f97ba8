"""The calibration figure: simulated photographs, the reader's, and the files that it makes."""

import json
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from support.frames import frame_of, texts_of
from support.sittings import SIZE, TRUTH, photographs

from simulations.engine.photograph import Photograph
from simulations.engine.reading import Reading, Readings, UnfitError
from simulations.engine.stages import StageCache
from simulations.models.calibration.left_out import Growth
from simulations.models.chequerboard.find_board import find_board
from simulations.models.error_measures import root_mean_square
from simulations.scenes.calibration import boards
from simulations.scenes.calibration.boards import SIGMA_PX, rendered, simulated_sitting
from simulations.scenes.calibration.plots import growth_plot
from simulations.scenes.calibration.scene import SCENE
from simulations.scenes.calibration.settings import ERRORS, LEAST, MOST, Settings

frame = partial(frame_of, SCENE)


def readings(count: int, *, size: tuple[int, int] = SIZE, first: int = 0) -> Readings:
    """Of photographs by the tests' camera, as `read` would return them."""
    sat = photographs(count, seed=8)
    views = sat.views(0.05)
    return tuple(
        Reading(
            first + index,
            f"{index}.jpg",
            {
                "width": size[0],
                "height": size[1],
                "corners": views.pixels[index].tolist(),
                "indices": sat.board.indices.astype(int).tolist(),
                "facts": {"focal_mm": 4.0, "focal_35mm_mm": 26.0, "make": "Acme", "model": "A1"},
            },
        )
        for index in range(count)
    )


def outputs_of(settings: Settings, given: Readings = ()) -> dict[str, object]:
    return dict(SCENE.run(settings, "", StageCache(), None, given).outputs)


@pytest.mark.parametrize("count", [5, 12, 20])
def test_the_right_model_gives_the_true_focal_length_within_three_standard_errors(
    count: int,
) -> None:
    shown = texts_of(frame(photographs=count, lens="p1p2"))
    off = float(shown["focal"]) - boards.TRUTH.fx
    assert abs(off) < 3.0 * float(shown["focal_error"]) + 0.05


def test_k3_is_supported_by_no_count_of_photographs_and_p1_p2_from_six_on() -> None:
    cache = StageCache()
    names = [
        texts_of(SCENE.render(SCENE.check({"photographs": count}), "", cache))["supported"]
        for count in range(LEAST, MOST + 1)
    ]
    assert names == ["k₁ and k₂"] * 3 + ["k₁, k₂, p₁, p₂"] * 15


def test_corners_of_the_rendered_photographs_are_as_noisy_as_the_simulated_ones() -> None:
    off = []
    for index in range(4):
        true = simulated_sitting().pixels[index]
        places = find_board(rendered(index)[..., 0]).places
        near = np.hypot(*np.moveaxis(places[:, None] - true, -1, 0)).argmin(axis=1)
        off.append(places - true[near])
    assert root_mean_square(np.concatenate(off)) == pytest.approx(SIGMA_PX, rel=0.25)


def test_a_photograph_that_was_not_used_is_marked() -> None:
    used, unused = (frame(photographs=5, shown=shown).panels[0].overlay for shown in (5, 6))
    assert "not used" in unused
    assert "not used" not in used


def test_the_errors_of_all_photographs_used_can_be_drawn_at_once() -> None:
    one, every = (frame(photographs=8, arrows=arrows).panels[0].overlay for arrows in ERRORS)
    assert one.count("<circle") == 54
    assert every.count("M") == 2 * 8 * 54


def test_right_of_the_dividing_line_the_board_is_straight() -> None:
    before, after = (frame(lens="k1k2", share=share).panels[0].raster for share in (1.0, 0.0))
    assert before is not None
    assert after is not None
    assert after.shape == before.shape
    assert (after != before).any()


def test_the_readers_corners_take_the_place_of_the_simulated_ones() -> None:
    given = readings(8)
    out = SCENE.render(
        SCENE.check({"photographs": 8, "lens": "p1p2"}), "", StageCache(), None, given
    )
    shown = texts_of(out)
    assert float(shown["focal"]) == pytest.approx(TRUTH.fx, abs=4 * float(shown["focal_error"]))
    assert "true" not in out.description
    assert out.panels[0].raster is None


def test_photographs_of_another_size_are_left_out() -> None:
    given = readings(5) + readings(3, size=(480, 640), first=50)
    found = boards.boards(given)
    assert len(found.views) == 5
    assert found.size == SIZE
    assert "3 of another size are" in found.notes[0]
    assert "1 of another size is" in boards.boards(given[:6]).notes[0]
    assert SCENE.measured
    assert SCENE.measured(outputs_of(Settings(), given)) == found.numbers
    three = replace(Settings(), photographs=3)
    assert SCENE.measured(outputs_of(three, given)) == found.numbers[:3]


def test_different_focal_lengths_in_the_files_and_too_many_photographs_are_noted() -> None:
    given = readings(3) * 8
    zoomed = replace(given[0], data={**given[0].data, "facts": {"focal_mm": 8.0}})
    notes = boards.boards((*given, zoomed)).notes
    assert notes == ("The first 20 are used.",)
    assert "4 to 8 mm" in boards.boards((zoomed, *given)).notes[1]


def test_too_few_of_one_size_name_those_of_another() -> None:
    given = readings(4, size=(480, 640))[2:] + readings(1)
    out = SCENE.render(Settings(), "", StageCache(), None, given)
    for panel in out.panels[1:]:
        assert "At least 3" in panel.overlay
        assert "another size" in " ".join(re.findall(r">([^<]+)<", panel.overlay))
    assert SCENE.sheet
    problem, note = SCENE.sheet(Settings(), outputs_of(Settings(), given))
    assert "At least 3" in problem.text
    assert "another size" in note.text


def test_different_cameras_are_noted() -> None:
    given = readings(4)
    other = {"make": "Maker", "model": "Two"}
    facts = [{"make": "Maker", "model": "One"}, other, other, {}]
    mixed = tuple(
        replace(r, data={**r.data, "facts": f}) for r, f in zip(given, facts, strict=True)
    )
    (note,) = boards.boards(mixed).notes
    assert "Maker One and Maker Two" in note
    assert boards.boards(mixed[1:]).notes == ()


@pytest.mark.parametrize("count", [1, 2])
def test_too_few_photographs_say_so(count: int) -> None:
    given = readings(count)
    out = SCENE.render(Settings(), "", StageCache(), None, given)
    assert "At least 3" in out.description
    assert texts_of(out)["focal"] == "not determined"
    sheet = SCENE.sheet
    assert sheet is not None
    (line,) = sheet(Settings(), outputs_of(Settings(), given))
    assert "At least 3" in line.text
    with pytest.raises(UnfitError, match="At least 3"):
        SCENE.exports[0].make(Settings(), outputs_of(Settings(), given))


def test_the_chosen_photograph_of_the_reader_is_shown_smaller_with_its_own_errors() -> None:
    given = readings(6)
    codes = np.full((240, 320, 3), 90, np.uint8)
    settings = Settings(photographs=6, lens="p1p2", share=0.5)
    out = SCENE.render(settings, "", StageCache(), Photograph(4, codes), given)
    raster = out.panels[0].raster
    assert raster is not None
    assert raster.shape == (240, 320, 4)
    assert float(texts_of(out)["rms_shown"]) < 0.2


def test_files_and_sheet_hold_the_same_numbers() -> None:
    settings, given = Settings(photographs=8, lens="p1p2"), readings(8)
    outputs = outputs_of(settings, given)
    yaml, text, xml = (export.make(settings, outputs) for export in SCENE.exports)
    read = json.loads(text)
    assert f"{read['camera']['fx']:.17g}" in yaml
    assert [p["name"] for p in read["photographs"]] == [f"{index}.jpg" for index in range(8)]
    lens = ET.fromstring(xml).find("lens")
    assert lens is not None
    assert lens.findtext("maker") == "Acme"
    assert float(lens.findtext("cropfactor") or "") == 6.5
    sheet = SCENE.sheet
    assert sheet is not None
    lines = {line.name: line.text for line in sheet(settings, outputs)}
    assert lines["fx"].startswith(f"{read['camera']['fx']:.2f} ± ")
    assert lines["photographs"] == "8"
    worst = max(read["photographs"], key=lambda photograph: photograph["rms_px"])
    assert lines["worst"] == f"{worst['rms_px']:.3f} px, {worst['name']}"
    assert float(lines["stated"]) == pytest.approx(26 * 800 / 43.27, abs=1)


def test_a_whole_photograph_is_developed_at_its_own_size() -> None:
    develop = SCENE.develop
    assert develop is not None
    settings, given = Settings(photographs=6, lens="p1p2"), readings(6)
    outputs = outputs_of(settings, given)
    codes = np.random.default_rng(0).integers(0, 255, (960, 1280, 3)).astype(np.uint8)
    made = develop(Photograph(0, codes), settings, outputs)
    assert made.shape == codes.shape


def test_the_focal_length_of_a_few_photographs_fits_into_its_plot() -> None:
    grown = Growth((3, 4), np.array([1359.9, 1359.8]), np.array([0.3, 0.12]))
    axis = growth_plot(grown, None).y
    assert axis.low < 1359.8 - 0.12
    assert axis.high > 1359.8 + 0.12
