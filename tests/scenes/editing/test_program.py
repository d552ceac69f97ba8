"""A copy of the program with edits: right in itself, and without a trace in the book's own."""

import sys
from collections.abc import Mapping
from typing import Any

import pytest

from simulations.editing.definitions import definitions, module_source
from simulations.editing.program import RefusedEditError, edition_of, load_copy, splice
from simulations.engine.frame import Frame, to_json
from simulations.engine.scene import Scene
from simulations.engine.stages import StageCache
from simulations.registry import SCENE_MODULES, load_scene

SAMPLE = ("jpeg", "lens-distortion", "single-view")
JPEG = SCENE_MODULES["jpeg"]
A_STAGE = "simulations.scenes.jpeg:fidelity"
A_MODEL = "simulations.models.compression.jpeg:to_planes"
A_CONSTANT = "simulations.scenes.jpeg:STAGES"


def source_of(definition: str) -> str:
    module, _, name = definition.partition(":")
    source = module_source(module)
    found = definitions(source)[name]
    return "\n".join(source.split("\n")[found.first - 1 : found.last])


def frame_of(scene: Scene[Any]) -> Frame:
    return scene.render(scene.clamp({}), scene.draft_tier, StageCache())


def same(a: Frame, b: Frame) -> bool:
    return to_json(a) == to_json(b) and pixels(a) == pixels(b)


def pixels(frame: Frame) -> list[bytes]:
    return [panel.raster.tobytes() for panel in frame.panels if panel.raster is not None]


def copy_with(module: str, edits: Mapping[str, str]) -> Scene[Any]:
    scene: Scene[Any] = load_copy(module, edition_of(edits).sources).SCENE
    return scene


@pytest.mark.parametrize(
    "scene_id",
    [
        pytest.param(scene_id, marks=[] if scene_id in SAMPLE else pytest.mark.deep)
        for scene_id in SCENE_MODULES
    ],
)
def test_a_copy_without_edits_draws_what_the_book_draws(scene_id: str) -> None:
    assert same(frame_of(copy_with(SCENE_MODULES[scene_id], {})), frame_of(load_scene(scene_id)))


@pytest.mark.parametrize(
    ("definition", "old", "new"),
    [
        (A_STAGE, "255 * decoded", "200 * decoded"),
        (A_MODEL, "-= 128", "-= 90"),
        (A_CONSTANT, "jpeg.from_planes", "lambda planes: jpeg.from_planes(planes) / 2"),
    ],
)
def test_an_edit_changes_the_copy_and_not_the_book(definition: str, old: str, new: str) -> None:
    book = frame_of(load_scene("jpeg"))
    text = source_of(definition)
    assert old in text
    assert not same(frame_of(copy_with(JPEG, {definition: text.replace(old, new)})), book)
    assert same(frame_of(load_scene("jpeg")), book)


def test_an_edit_may_bring_its_own_imports_and_helpers() -> None:
    text = "from math import tau\n\ndef half(x):\n    return x / 2\n\n"
    text += "def fidelity(decoded, original):\n    return half(tau)\n"
    readouts = frame_of(copy_with(JPEG, {A_STAGE: text})).readouts
    assert any(item.text.startswith("3.1") for item in readouts)


def test_what_a_copy_spoils_in_place_is_its_own() -> None:
    book = frame_of(load_scene("jpeg"))
    spoils = "def whole_codes():\n    picture = balloon()\n    picture.flags.writeable = True\n"
    spoils += "    picture[:] = 0\n    return np.zeros_like(picture, np.float64)\n"
    copy_with(JPEG, {"simulations.scenes.jpeg:whole_codes": spoils})
    frame_of(copy_with(JPEG, {"simulations.scenes.jpeg:whole_codes": spoils}))
    assert same(frame_of(load_scene("jpeg")), book)


def test_making_a_copy_leaves_every_module_of_the_book_in_place() -> None:
    load_scene("jpeg")
    before, package = dict(sys.modules), dict(vars(sys.modules["simulations"]))
    copy_with(JPEG, {A_STAGE: source_of(A_STAGE)})
    assert dict(sys.modules) == before
    assert vars(sys.modules["simulations"]) == package


def test_a_copy_that_fails_leaves_every_module_of_the_book_in_place() -> None:
    load_scene("jpeg")
    before, finders = dict(sys.modules), list(sys.meta_path)
    with pytest.raises(ZeroDivisionError):
        copy_with(JPEG, {A_CONSTANT: "STAGES = 1 / 0"})
    assert dict(sys.modules) == before
    assert sys.meta_path == finders


def test_edits_stand_in_their_module_where_they_are_said_to() -> None:
    source = "A = 1\nB = 2\nC = 3\n"
    text, places = splice("m", source, {"C": "C = 5", "A": "x = 1\nA = (\n    4\n)"})
    assert text == "x = 1\nA = (\n    4\n)\nB = 2\nC = 5\n"
    told = [(place.definition, place.first, place.count) for place in places]
    assert told == [("m:A", 1, 4), ("m:C", 6, 1)]


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("def fidelity(:\n    pass", 1, "SyntaxError: "),
        ('def fidelity():\n    """never closed', 2, "SyntaxError: unterminated"),
        ("x = 1\nreturn x", 2, "SyntaxError: 'return' outside function"),
        ("def quality():\n    pass", 1, r"undefined.*'fidelity'"),
        ("", 1, r"undefined.*'fidelity'"),
    ],
)
def test_a_text_that_cannot_stand_there_is_refused_with_its_line(
    text: str, line: int, words: str
) -> None:
    with pytest.raises(RefusedEditError, match=words) as caught:
        edition_of({A_STAGE: text})
    assert (caught.value.definition, caught.value.line) == (A_STAGE, line)


@pytest.mark.parametrize("definition", ["simulations.engine.stages:run", "os:remove", "nothing"])
def test_what_does_not_lie_in_an_editable_module_cannot_be_edited(definition: str) -> None:
    name = definition.partition(":")[2] or "x"
    with pytest.raises((ValueError, RefusedEditError)):
        edition_of({definition: f"{name} = 1"})
