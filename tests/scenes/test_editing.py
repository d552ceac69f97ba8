"""Edited code of a figure: a copy of the program with the edits, and the place of mistakes."""

import io
import json
import sys
from typing import Any

import numpy as np
import pytest

from simulations import browser
from simulations.editing.definitions import definitions, module_source
from simulations.editing.program import RefusedEditError, edition_of, load_copy, splice
from simulations.engine.frame import content
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_scene

SAMPLE = ("jpeg", "lens-distortion", "single-view")
JPEG = SCENE_MODULES["jpeg"]
STAGE, ORIGINAL, STAGES = (f"{JPEG}:{name}" for name in ("fidelity", "rounded_codes", "STAGES"))
HEAD = "def fidelity(decoded, original):\n"
DARK = "def rounded_codes():\n    return 0.2 * balloon()"


def source_of(definition: str) -> str:
    module, _, name = definition.partition(":")
    source = module_source(module)
    found = definitions(source)[name]
    return "\n".join(source.split("\n")[found.first - 1 : found.last])


def copy_with(module: str, edits: dict[str, str]) -> Scene[Any]:
    scene: Scene[Any] = load_copy(module, edition_of(edits).sources).SCENE
    return scene


def content_of(scene: Scene[Any]) -> object:
    return content(scene.render(scene.clamp({}), scene.accuracy.cheapest, StageCache()))


@pytest.mark.parametrize(
    "scene_id",
    [pytest.param(s, marks=[] if s in SAMPLE else pytest.mark.deep) for s in SCENE_MODULES],
)
def test_copy_without_edits_draws_the_same_frame(scene_id: str) -> None:
    assert content_of(copy_with(SCENE_MODULES[scene_id], {})) == content_of(load_scene(scene_id))


SPOILS = (
    "def rounded_codes():\n    picture = balloon()\n    picture.flags.writeable = True\n"
    "    picture[:] = 0\n    return np.zeros_like(picture, np.float64)\n"
)


@pytest.mark.parametrize(
    ("definition", "old", "new"),
    [
        (STAGE, "255 * decoded", "200 * decoded"),
        ("simulations.models.compression.jpeg:to_planes", "-= 128", "-= 90"),
        (STAGES, "jpeg.from_planes", "lambda planes: jpeg.from_planes(planes) / 2"),
        (
            STAGE,
            None,
            f"from math import tau\n\ndef half(x):\n    return x / 2\n\n{HEAD}    return half(tau)",
        ),
        (ORIGINAL, None, SPOILS),
    ],
    ids=["stage", "model", "constant", "new imports and helpers", "spoiled array"],
)
def test_edit_changes_the_copy_and_leaves_the_book_unchanged(
    definition: str, old: str | None, new: str
) -> None:
    book, modules = content_of(load_scene("jpeg")), dict(sys.modules)
    package = dict(vars(sys.modules["simulations"]))
    text = source_of(definition).replace(old, new) if old else new
    assert text != source_of(definition)
    assert content_of(copy_with(JPEG, {definition: text})) != book
    assert content_of(load_scene("jpeg")) == book
    assert dict(sys.modules) == modules
    assert vars(sys.modules["simulations"]) == package


def test_failed_copy_leaves_the_modules_of_the_book_unchanged() -> None:
    load_scene("jpeg")
    before, finders = dict(sys.modules), list(sys.meta_path)
    with pytest.raises(ZeroDivisionError):
        copy_with(JPEG, {STAGES: "STAGES = 1 / 0"})
    assert (dict(sys.modules), sys.meta_path) == (before, finders)


def test_spliced_edits_keep_their_place_in_the_module() -> None:
    source = "A = 1\nB = 2\nC = 3\n"
    text, places = splice("m", source, {"C": "C = 5", "A": "x = 1\nA = (\n    4\n)"})
    assert text == "x = 1\nA = (\n    4\n)\nB = 2\nC = 5\n"
    found = [(place.definition, place.first, place.count) for place in places]
    assert found == [("m:A", 1, 4), ("m:C", 6, 1)]


@pytest.mark.parametrize(
    ("definition", "text", "line"),
    [
        (STAGE, "def fidelity(:\n    pass", 1),
        (STAGE, 'def fidelity():\n    """never closed', 2),
        (STAGE, "x = 1\nreturn x", 2),
        (STAGE, "def quality():\n    pass", 1),
        (STAGE, "", 1),
        ("simulations.engine.stages:run", "run = 1", 0),
        ("os:remove", "remove = 1", 0),
    ],
)
def test_text_that_fits_no_definition_is_refused(definition: str, text: str, line: int) -> None:
    with pytest.raises((ValueError, RefusedEditError)) as caught:
        edition_of({definition: text})
    if isinstance(caught.value, RefusedEditError):
        assert (caught.value.definition, caught.value.line) == (STAGE, line)


def reply_to(edits: dict[str, str]) -> browser.EditedReply:
    return browser.render_edited("figure-edited", "jpeg", "{}", "", json.dumps(edits))


def problem_with(edits: dict[str, str]) -> Any:
    reply = reply_to(edits)
    assert reply.frame is None
    return json.loads(reply.problem)


def test_edits_leave_other_figures_unchanged_and_are_cached() -> None:
    before = browser.render("figure-other", "jpeg", "{}", "")
    reply, again = reply_to({ORIGINAL: DARK}), reply_to({ORIGINAL: DARK})
    assert reply.problem == "null"
    assert reply.frame
    assert again.frame
    assert reply.frame.meta != before.meta
    stages = json.loads(again.frame.meta)["stages"]
    assert {stage["status"] for stage in stages} <= {"reused", "skipped"}
    browser.render("figure-other", "jpeg", '{"quality": 11}', "")
    after = browser.render("figure-other", "jpeg", "{}", "")
    assert json.loads(after.meta)["readouts"] == json.loads(before.meta)["readouts"]
    pairs = zip(after.rasters, before.rasters, strict=True)
    assert all(np.array_equal(a, b) for a, b in pairs)


CODED = (
    "def coded(planes, quality, subsampling, tier):\n"
    "    return jpeg.encode(planes, -5, subsampling, TRANSFORMS[tier])"
)
NO_PSNR = "\n" * 7 + "def rounded_codes():\n    return balloon()\n\npsnr_db = None"
RAISED = next(
    n for n, text in enumerate(module_source(JPEG).split("\n"), 1) if "return psnr_db" in text
)


@pytest.mark.parametrize(
    ("edits", "definition", "line", "words"),
    [
        ({STAGE: f"{HEAD}    x = 1\n    return x / 0\n"}, STAGE, 3, "division by zero"),
        (
            {ORIGINAL: "\n" * 20 + DARK, STAGE: f"{HEAD}    raise SystemExit('enough')"},
            STAGE,
            2,
            "SystemExit: enough",
        ),
        ({STAGE: "def fidelity(a, b):\n  return (1"}, STAGE, 2, "SyntaxError"),
        ({STAGE: f"{HEAD}    raise type('E', (Exception,), {{'__str__': exit}})"}, STAGE, 2, "E'>"),
        ({STAGE: f"{HEAD}    return float(input())"}, STAGE, 2, "workshop.no_input"),
        ({f"{JPEG}:coded": CODED}, f"{JPEG}:coded", 2, "quality -5; legal"),
        ({STAGE: "def fidelity(decoded):\n    return 1.0"}, "", 0, "stage 'psnr' comes after"),
        ({ORIGINAL: NO_PSNR}, "", 0, f'"simulations/scenes/jpeg.py", "line": "{RAISED}"'),
    ],
    ids=["exception", "exit", "syntax", "no text", "input", "in a model", "outside", "in the book"],
)
def test_mistake_is_reported_on_its_line(
    edits: dict[str, str], definition: str, line: int, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO())
    found = problem_with(edits)
    assert words in json.dumps(found["message"], ensure_ascii=False)
    if definition:
        assert (found["definition"], found["line"]) == (definition, line)


def test_printed_text_is_returned_up_to_a_limit() -> None:
    text = f"{HEAD}    print('shape', decoded.shape)\n    return 1.0"
    assert reply_to({STAGE: text}).printed.startswith("shape (")
    text = text.replace("'shape'", "'x' * 10**6")
    assert len(reply_to({STAGE: text}).printed) == browser.MOST_PRINTED


def test_error_of_an_edited_frame_is_computed_with_the_edit() -> None:
    edits = json.dumps({"simulations.scenes.sensor_noise.sensor:FULL_WELL_E": "FULL_WELL_E = 50"})
    book = browser.error("figure-a", "sensor-noise", "{}", "")
    edited = browser.error("figure-a", "sensor-noise", "{}", "", edits)
    assert json.loads(book) != json.loads(edited)
