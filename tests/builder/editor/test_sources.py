"""The Python of a scene, as its readers open it."""

import json
from pathlib import Path
from typing import Any

import pytest

from simulations.registry import SCENE_MODULES, load_scene
from site_builder.editor.sources import read_module, scene_sources, uses_of

ROOT = Path(__file__).resolve().parents[3]
STAGES = "simulations.scenes.bayer_demosaic.stages"


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


def test_what_a_definition_uses_is_found_through_imports_of_modules_and_names() -> None:
    assert list(uses_of("simulations.scenes.jpeg.stages:_coded")) == [
        "simulations.models.compression.jpeg:Coded",
        "simulations.models.compression.jpeg:encode",
        "simulations.models.compression.cosine_transforms:TRANSFORMS",
    ]


def test_the_name_of_an_argument_is_no_use_of_what_the_module_calls_so() -> None:
    module = read_module(STAGES)
    assert "demosaic" in module.imported
    assert "demosaic" not in {key.partition(":")[2] for key in uses_of(f"{STAGES}:_mosaic_alone")}
