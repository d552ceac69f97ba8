"""What a process may know no more once code has changed, and what it forgets then."""

import importlib
import sys
from collections.abc import Iterator
from pathlib import Path
from time import time_ns

import pytest

from site_builder.kept import code
from site_builder.kept.keeper import Keeper, keeping, kept_as, reads_code

SOURCES = {
    "__init__": "",
    "low": "class Thing:\n    pass\n",
    "middle": "from toy_code.low import Thing\n\n\ndef made(): return Thing()\n",
    "aside": "def told(): return 1\n",
}


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """``middle`` imports ``low``; ``aside`` stands alone."""
    folder = tmp_path / "toy_code"
    folder.mkdir()
    for name, text in SOURCES.items():
        (folder / f"{name}.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    code._root.cache_clear()
    for name in SOURCES:
        importlib.import_module(f"toy_code.{name}".removesuffix(".__init__"))
    yield folder
    code._root.cache_clear()
    for name in [name for name in sys.modules if name.startswith("toy_code")]:
        del sys.modules[name]


def test_who_imports_what_has_changed_is_counted_with_it(package: Path) -> None:
    found = Keeper().importers([package / "low.py"])
    assert found == frozenset({"toy_code.low", "toy_code.middle"})


def test_what_lies_in_a_package_changes_with_it(package: Path) -> None:
    found = Keeper().importers([package / "__init__.py"])
    assert found == frozenset({"toy_code", "toy_code.low", "toy_code.middle", "toy_code.aside"})


def test_what_was_written_since_the_start_counts_though_nobody_tells_of_it(package: Path) -> None:
    keeper = Keeper(since_ns=time_ns() + 10**9)
    (package / "aside.py").touch()
    assert keeper.importers([package / "low.py"]) == frozenset({"toy_code.low", "toy_code.middle"})
    keeper.since_ns = (package / "aside.py").stat().st_mtime_ns
    found = keeper.importers([package / "low.py"]) or frozenset()
    assert "toy_code.aside" in found


def test_of_a_file_that_no_module_was_imported_from_nothing_can_be_told(package: Path) -> None:
    (package / "new.py").touch()
    assert Keeper().importers([package / "new.py"]) is None


def test_where_a_file_is_gone_nothing_can_be_told(package: Path) -> None:
    keeper = Keeper(since_ns=time_ns())
    keeper.importers([])
    (package / "aside.py").unlink()
    assert keeper.importers([package / "low.py"]) is None


@pytest.mark.usefixtures("package")
def test_what_holds_a_thing_of_a_forgotten_module_is_made_again_and_all_else_is_not() -> None:
    """Though its key says nothing of that module: in the store it would be the new one."""
    middle, aside = sys.modules["toy_code.middle"], sys.modules["toy_code.aside"]

    def ask() -> None:
        kept_as("holding", 1, lambda: (middle.made(),), __name__)
        kept_as("aside", 1, lambda: (aside.told(),), __name__)

    keeper = Keeper()
    with keeping(keeper):
        ask()
    keeper.made.clear()
    keeper.forget(["toy_code.low", "toy_code.middle"])
    with keeping(keeper):
        ask()
    assert [name.rpartition(".")[2] for name in keeper.made] == ["holding"]


def test_forgotten_code_is_hashed_as_it_is_now(package: Path) -> None:
    told = sys.modules["toy_code.aside"].told

    def ask() -> None:
        def run() -> int:
            reads_code(told)
            return int(told())

        kept_as("run", "", run, __name__)

    keeper = Keeper()
    with keeping(keeper):
        ask()
        (package / "aside.py").write_text("def told(): return 2\n")
        keeper.made.clear()
        ask()
        assert keeper.made == []  # it has imported what was there
        keeper.forget(["toy_code.aside"])
        ask()
        assert len(keeper.made) == 1
