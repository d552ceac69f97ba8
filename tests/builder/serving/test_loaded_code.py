"""A process lets go of modules, and imports them as they are then."""

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from site_builder.serving.loaded_code import let_go, may_let_go


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    folder = tmp_path / "lent"
    folder.mkdir()
    (folder / "__init__.py").touch()
    (folder / "number.py").write_text("VALUE = 1\n")
    (folder / "asking.py").write_text("from lent import number\nTWICE = 2 * number.VALUE\n")
    monkeypatch.syspath_prepend(tmp_path)
    yield folder
    let_go([name for name in sys.modules if name == "lent" or name.startswith("lent.")])


def test_a_module_and_who_imports_it_are_executed_anew(package: Path) -> None:
    before = importlib.import_module("lent.asking")
    (package / "number.py").write_text("VALUE = 7\n")  # as long, and within the same second
    let_go(["lent.number", "lent.asking"])
    after = importlib.import_module("lent.asking")
    assert (before.TWICE, after.TWICE) == (2, 14)


@pytest.mark.usefixtures("package")
def test_what_is_let_go_of_is_no_more_an_attribute_of_its_package() -> None:
    importlib.import_module("lent.number")
    let_go(["lent.number"])
    assert not hasattr(sys.modules["lent"], "number")


def test_a_module_that_was_never_imported_can_be_let_go_of() -> None:
    let_go(["simulations.scenes.of_another_book"])


def test_what_the_builder_imports_cannot_be_let_go_of() -> None:
    assert may_let_go(["simulations.scenes.camera.scene", "simulations.models.light.lamp"])
    assert not may_let_go(["simulations.engine.frame", "site_builder.pages.initial_frames"])
