"""Parts of a library that are fetched when something in them is first imported."""

import json
import sys
from collections.abc import Iterator
from contextlib import suppress
from importlib import import_module
from pathlib import Path

import pytest

from simulations.late_imports import fetch_missing

MODULES = {"tools-far": ["far_tools", "far_tools.saw"], "near-rest": ["near_tools.plane"]}
CONTENT = {
    "tools-far": {"far_tools/__init__.py": "", "far_tools/saw.py": "TEETH = 42"},
    "near-rest": {"near_tools/plane.py": "WIDTH = 3"},
}


class Shelf:
    """Where parts are fetched from."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.fetched: set[str] = set()
        self.out_of_reach = False

    def fetch(self, part: str) -> None:
        if self.out_of_reach:
            raise OSError("404")
        with suppress(ModuleNotFoundError):  # an option of whatever unpacks, in that very part
            import_module(MODULES[part][-1])
        self.fetched.add(part)
        for name, text in CONTENT[part].items():
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text(text)


@pytest.fixture
def shelf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Shelf]:
    """A package of which one module lies elsewhere than the rest will, and the finder in place."""
    elsewhere, folder = tmp_path / "lean", tmp_path / "site"
    folder.mkdir()
    (elsewhere / "near_tools").mkdir(parents=True)
    (elsewhere / "near_tools" / "__init__.py").write_text("")
    monkeypatch.setattr(sys, "path", [str(elsewhere), str(folder), *sys.path])
    monkeypatch.setattr(sys, "meta_path", list(sys.meta_path))
    shelf = Shelf(folder)
    fetch_missing(json.dumps(MODULES), shelf.fetch, str(folder))
    yield shelf
    for name in [name for name in sys.modules if name.split(".")[0].endswith("_tools")]:
        del sys.modules[name]


@pytest.mark.parametrize(
    ("name", "attribute", "fetched"),
    [
        ("far_tools.saw", "TEETH", {"tools-far"}),
        ("near_tools.plane", "WIDTH", {"near-rest"}),  # its package lies elsewhere
        ("near_tools", "__name__", set()),
    ],
)
def test_a_module_of_a_part_is_fetched_when_it_is_imported(
    shelf: Shelf, name: str, attribute: str, fetched: set[str]
) -> None:
    assert shelf.fetched == set()
    assert getattr(import_module(name), attribute) in (42, 3, "near_tools")
    assert shelf.fetched == fetched


@pytest.mark.parametrize("name", ["no_such_tools", "far_tools.hammer"])
def test_what_is_in_no_part_stays_missing(shelf: Shelf, name: str) -> None:
    with pytest.raises(ModuleNotFoundError, match=name):
        import_module(name)
    assert "near-rest" not in shelf.fetched


def test_a_part_out_of_reach_is_named_and_can_be_tried_again(shelf: Shelf) -> None:
    shelf.out_of_reach = True
    with pytest.raises(ImportError, match=r"tools-far: 404"):
        import_module("far_tools")
    shelf.out_of_reach = False
    assert import_module("far_tools.saw").TEETH == 42
