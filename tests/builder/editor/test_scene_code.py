"""The Python of a scene, as its readers open it."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support.small_package import PACKAGE, small_package

from simulations.editing import definitions
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.editor.scene_code import read_module, scene_sources, uses_of

ROOT = Path(__file__).resolve().parents[3]
OPTICS = """\
INDEX = 1.5


def bend(angle):
    return angle / INDEX


def spread(bend):
    return 2 * bend
"""
FIGURE = """\
from simulations.small import optics
from simulations.small.optics import spread as widened


def both(spread):
    return optics.bend(spread) + widened(spread)


def one(optics):
    return optics.bend
"""


def sources(scene_id: str) -> Any:
    return json.loads(scene_sources(load_scene(scene_id)))


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_every_definition_is_a_passage_of_its_file_at_its_line(scene_id: str) -> None:
    for item in sources(scene_id)["definitions"].values():
        lines = (ROOT / item["path"]).read_text(encoding="utf-8").split("\n")
        text = item["text"].split("\n")
        assert lines[item["line"] - 1 : item["line"] - 1 + len(text)] == text


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_all_that_a_scene_names_can_be_opened(scene_id: str) -> None:
    found = sources(scene_id)
    named = {found["draw"], *(stage["definition"] for stage in found["stages"])}
    named |= {key for item in found["definitions"].values() for key in item["uses"]}
    assert named == set(found["definitions"])
    assert [stage["name"] for stage in found["stages"]] == [
        stage.name for stage in load_scene(scene_id).stages
    ]


@pytest.fixture
def small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """Two modules that readers may rewrite; the name of their package."""
    monkeypatch.setattr(definitions, "ROOMS", ("small",))
    with small_package(tmp_path, {"optics": OPTICS, "figure": FIGURE}):
        yield PACKAGE


def test_what_a_definition_uses_is_found_through_imports_of_modules_and_names(small: str) -> None:
    assert list(uses_of(f"{small}.figure:both")) == [
        f"{small}.optics:bend",
        f"{small}.optics:spread",
    ]


def test_what_it_uses_of_its_own_module_is_found(small: str) -> None:
    assert list(uses_of(f"{small}.optics:bend")) == [f"{small}.optics:INDEX"]


def test_the_name_of_an_argument_is_no_use_of_what_the_module_calls_so(small: str) -> None:
    assert "optics" in read_module(f"{small}.figure").imported
    assert list(uses_of(f"{small}.figure:one")) == []
    assert list(uses_of(f"{small}.optics:spread")) == []
