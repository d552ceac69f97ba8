"""A result is made again where anything that it depends on has changed, and only there."""

import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

from site_builder.kept import code
from site_builder.kept.keeper import (
    Keeper,
    keeping,
    kept,
    kept_as,
    reads_code,
    reads_file,
    reads_folder,
    reads_unknown,
)

HERE = __name__


class Shelf:
    """A store in memory."""

    def __init__(self) -> None:
        self.entries: dict[bytes, bytes] = {}

    def get(self, key: bytes) -> bytes | None:
        return self.entries.get(key)

    def put(self, entries: Mapping[bytes, bytes]) -> None:
        self.entries.update(entries)

    def reopened(self) -> "Shelf":
        return self


@kept
def doubled(text: str) -> str:
    return text * 2


@kept
def first_line(file: Path) -> str:
    reads_file(file)
    return file.read_text(encoding="utf-8").partition("\n")[0] if file.is_file() else ""


@kept
def shouted(file: Path) -> str:
    return first_line(file).upper()


def made(store: Shelf, ask: Callable[[], object], **options: Any) -> list[str]:
    """Names of the functions that ran in a new process, as it were."""
    keeper = Keeper(store, **options)
    with keeping(keeper):
        ask()
    return [name.rpartition(".")[2] for name in keeper.made]


def test_without_a_keeper_a_function_runs() -> None:
    assert doubled("a") == "aa"


def test_a_result_is_found_in_the_same_process_and_in_the_next() -> None:
    store = Shelf()
    assert made(store, lambda: (doubled("a"), doubled("a"), doubled("b"))) == ["doubled", "doubled"]
    assert made(store, lambda: doubled("a")) == []


def test_the_store_is_asked_once_in_a_build_for_what_it_has_not() -> None:
    class Counting(Shelf):
        def get(self, key: bytes) -> bytes | None:
            asked.append(key)
            return super().get(key)

    asked: list[bytes] = []
    keeper = Keeper(Counting())
    for _ in range(2):
        asked.clear()
        with keeping(keeper):
            for _ in range(2):
                assert keeper.lacks(lambda: doubled("many"))
        assert len(asked) == len(set(asked)) > 0


def test_a_file_that_is_read_is_depended_on_through_others(tmp_path: Path) -> None:
    store, file = Shelf(), tmp_path / "a"
    assert made(store, lambda: shouted(file)) == ["first_line", "shouted"]
    file.write_text("one")
    assert made(store, lambda: shouted(file)) == ["first_line", "shouted"]
    assert made(store, lambda: shouted(file)) == []
    (tmp_path / "b").write_text("another file")
    assert made(store, lambda: shouted(file)) == []
    file.write_text("two")
    assert made(store, lambda: shouted(file)) == ["first_line", "shouted"]
    file.write_text("one")
    assert made(store, lambda: shouted(file)) == []


def test_a_folder_that_is_read_is_depended_on(tmp_path: Path) -> None:
    def ask() -> list[str]:
        def listed() -> list[str]:
            reads_folder(tmp_path)
            return sorted(file.name for file in tmp_path.iterdir())

        return kept_as("listed", "", listed)[0]

    store = Shelf()
    assert made(store, ask) == ["listed"]
    assert made(store, ask) == []
    (tmp_path / "new").touch()
    assert made(store, ask) == ["listed"]


def test_what_changes_while_it_is_read_is_not_kept(tmp_path: Path) -> None:
    file = tmp_path / "a"
    file.write_text("one")

    def ask() -> None:
        def read() -> str:
            reads_file(file)
            file.write_text(file.read_text() + "!")
            return file.read_text()

        kept_as("read", "", read)

    store = Shelf()
    assert made(store, ask) == made(store, ask) == ["read"]


def test_what_depends_on_nobody_knows_what_is_not_kept() -> None:
    def ask() -> None:
        kept_as("outer", "", lambda: kept_as("inner", "", reads_unknown))

    store = Shelf()
    assert made(store, ask) == made(store, ask) == ["inner", "outer"]


def test_an_error_is_not_kept() -> None:
    @kept
    def inverse(number: float) -> float:
        return 1 / number

    store = Shelf()
    for _ in range(2):
        with pytest.raises(ZeroDivisionError):
            made(store, lambda: inverse(0.0))
    assert made(store, lambda: inverse(2.0)) == ["inverse"]


def test_a_damaged_entry_is_made_anew() -> None:
    store = Shelf()
    made(store, lambda: doubled("a"))
    store.entries = dict.fromkeys(store.entries, b"\x80damaged")
    assert made(store, lambda: doubled("a")) == ["doubled"]


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A package whose module ``top`` imports ``middle``, which imports ``low.deep``."""
    for name, text in {
        "__init__": "",
        "top": "from toy_kept import middle\ndef shown(): return 1\n",
        "middle": "import toy_kept.low.deep\n",
        "low/__init__": "",
        "low/deep": "",
        "aside": "",
    }.items():
        file = tmp_path / "toy_kept" / f"{name}.py"
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    code._root.cache_clear()
    yield tmp_path / "toy_kept"
    code._root.cache_clear()
    for name in [name for name in sys.modules if name.startswith("toy_kept")]:
        del sys.modules[name]


@pytest.mark.parametrize(
    ("changed", "again"),
    [
        ("top", True), ("middle", True), ("low/deep", True), ("low/__init__", True),
        ("__init__", True), ("aside", False),
    ],
)  # fmt: skip
def test_code_is_depended_on_with_all_that_it_imports(
    package: Path, changed: str, again: bool
) -> None:
    from toy_kept.top import shown  # type: ignore[import-not-found]

    def ask() -> None:
        def run() -> int:
            reads_code(shown)
            return int(shown())

        kept_as("run", "", run)

    store = Shelf()
    assert made(store, ask) == ["run"]
    file = package / f"{changed}.py"
    file.write_text(file.read_text() + "# changed\n")
    assert made(store, ask) == (["run"] if again else [])


def test_what_code_did_that_was_written_after_the_start_is_not_stored(package: Path) -> None:
    newest = (package / "top.py").stat().st_mtime_ns
    from toy_kept.top import shown

    def ask() -> None:
        kept_as("run", shown, lambda: shown())

    store = Shelf()
    assert made(store, ask, since_ns=newest) == made(store, ask, since_ns=newest) == ["run"]


def test_what_code_did_that_was_written_meanwhile_is_not_stored(package: Path) -> None:
    from toy_kept.top import shown

    def ask() -> None:
        kept_as("run", shown, lambda: shown())
        (package / "low" / "deep.py").write_text("# not what was looked at\n")

    store = Shelf()
    made(store, ask)
    assert store.entries == {}


def test_what_nobody_asked_for_lately_leaves_the_memory() -> None:
    keeper = Keeper()
    with keeping(keeper):
        doubled("a")
    for _ in range(9):
        with keeping(keeper):
            doubled("b")
    with keeping(keeper):
        doubled("b")
        doubled("a")
    assert [name.rpartition(".")[2] for name in keeper.made] == ["doubled"] * 3
