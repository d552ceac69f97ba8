"""A kind of control is one folder of the engine, and one line of its list."""

import re
from typing import Any, get_args

import pytest

from simulations.engine.controls import KINDS, Control
from site_builder.guide.book import SCENE, guide_files
from site_builder.pages.views.control import FOLDER

FILES = {"__init__.py", "kind.py", "kind.html", "kind.ts", "kind.css"}


def test_every_folder_is_a_kind_and_every_kind_a_folder() -> None:
    assert {file.parent.name for file in FOLDER.glob("*/kind.*")} == set(KINDS)


@pytest.mark.parametrize("kind", get_args(Control.__value__), ids=lambda kind: kind.kind)
def test_a_kind_has_all_its_files_and_lies_in_its_folder(kind: Any) -> None:
    assert {file.name for file in (FOLDER / kind.kind).glob("*.*")} >= FILES
    assert kind.__module__.endswith(f".controls.{kind.kind}.kind")


@pytest.mark.parametrize("kind", KINDS)
def test_its_native_element_has_the_name_of_the_setting(kind: str) -> None:
    template = (FOLDER / kind / "kind.html").read_text(encoding="utf-8")
    assert re.search(r'<(input|select|button)[^>]* name="{{ control.name }}"', template)


def test_the_guide_shows_how_a_scene_states_each_kind() -> None:
    rows = re.findall(r"^\| `(\w+)\(", guide_files()[SCENE].decode(), re.MULTILINE)
    assert rows == list(KINDS)
