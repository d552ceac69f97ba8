"""Parts of a library that are fetched when one of their modules is first imported."""

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


class Store:
    """The store from which parts are fetched."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.fetched: set[str] = set()
        self.offline = False

    def fetch(self, part: str) -> None:
        if self.offline:
            raise OSError("404")
        with suppress(ModuleNotFoundError):  # unpacking may itself import from this part
            import_module(MODULES[part][-1])
        self.fetched.add(part)
        for name, text in CONTENT[part].items():
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text(text)


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Store]:
    """The store, the installed finder, and a package with one module outside the fetched part."""
    elsewhere, folder = tmp_path / "lean", tmp_path / "site"
    folder.mkdir()
    (elsewhere / "near_tools").mkdir(parents=True)
    (elsewhere / "near_tools" / "__init__.py").write_text("")
    monkeypatch.setattr(sys, "path", [str(elsewhere), str(folder), *sys.path])
    monkeypatch.setattr(sys, "meta_path", list(sys.meta_path))
    store = Store(folder)
    fetch_missing(json.dumps(MODULES), store.fetch, str(folder))
    yield store
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
def test_part_is_fetched_when_its_module_is_imported(
    store: Store, name: str, attribute: str, fetched: set[str]
) -> None:
    assert store.fetched == set()
    assert getattr(import_module(name), attribute) in (42, 3, "near_tools")
    assert store.fetched == fetched


@pytest.mark.parametrize("name", ["no_such_tools", "far_tools.hammer"])
def test_module_in_no_part_stays_missing(store: Store, name: str) -> None:
    with pytest.raises(ModuleNotFoundError, match=name):
        import_module(name)
    assert "near-rest" not in store.fetched


def test_unreachable_part_is_named_and_can_be_retried(store: Store) -> None:
    store.offline = True
    with pytest.raises(ImportError, match=r"tools-far: 404"):
        import_module("far_tools")
    store.offline = False
    assert import_module("far_tools.saw").TEETH == 42
