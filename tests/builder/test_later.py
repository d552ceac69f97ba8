"""A module that is imported later is the same to whoever uses it."""

import sys
from pathlib import Path
from types import ModuleType

import pytest

from site_builder.later import import_later

NAME = "imported_later"


@pytest.fixture(autouse=True)
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / NAME
    folder.mkdir()
    (folder / "__init__.py").write_text("import sys\nsys.used_later = True\nVALUE = 7\n")
    (folder / "inside.py").write_text("VALUE = 8\n")
    monkeypatch.syspath_prepend(tmp_path)
    for name in (NAME, f"{NAME}.inside"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.delattr(sys, "used_later", raising=False)


def later() -> ModuleType:
    import_later(NAME)
    __import__(NAME)
    return sys.modules[NAME]


def was_used() -> bool:
    return hasattr(sys, "used_later")


def test_a_module_is_run_when_something_of_it_is_asked_for() -> None:
    module = later()
    assert not was_used()
    assert module.VALUE == 7
    assert was_used()


def test_what_lies_inside_can_be_imported() -> None:
    later()
    namespace: dict[str, object] = {}
    exec(f"from {NAME}.inside import VALUE", namespace)
    assert namespace["VALUE"] == 8


def test_what_it_lacks_is_missing_as_ever() -> None:
    with pytest.raises(AttributeError, match="nothing"):
        _ = later().nothing


def test_a_module_that_is_there_stays() -> None:
    before = sys.modules["json"]
    import_later("json")
    assert sys.modules["json"] is before
