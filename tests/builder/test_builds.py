"""Building: the same bytes from the same sources on any machine and with any cache, and no site
where there is a mistake."""

import multiprocessing
import os
import re
import shutil
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from support.little_book import FIXTURES, OUTLINE, MakeBook, rendered
from support.places import ROOT

from simulations.registry import load_scene
from site_builder.build import Options, check_site, render_site
from site_builder.cache import hashing
from site_builder.cache import results as cache
from site_builder.cache.hashing import UnhashableError, hash_of, imports_hash, source_hash
from site_builder.cache.results import FILE, Cache, cached, cached_reading, using
from site_builder.diagnostics.diagnostic import BuildError, Diagnostics
from site_builder.sources.outline import OWN_FOLDERS

BOOK = FIXTURES / "small_book"
ONE = {"TZ": "UTC", "LC_ALL": "C.UTF-8", "PYTHONHASHSEED": "1"}
OTHER = {"TZ": "Pacific/Auckland", "LC_ALL": "C", "PYTHONHASHSEED": "77"}
PLAIN = "import sys; from pathlib import Path; from site_builder.build import Options, build_site; "
PLAIN += "build_site(Options(Path(sys.argv[1]), runtime=False), Path(sys.argv[2]))"
REVERSED = f"""
import os

scan, names = os.scandir, os.listdir

class ReversedScan:
    def __init__(self, *folder):
        with scan(*folder) as entries:
            self.entries = iter(sorted(entries, key=lambda entry: entry.name, reverse=True))
    def __iter__(self): return self.entries
    def __next__(self): return next(self.entries)
    def __enter__(self): return self
    def __exit__(self, *_): pass

os.scandir = ReversedScan
os.listdir = lambda *folder: sorted(names(*folder), reverse=True)
{PLAIN}
"""
"""The same build on a machine whose folders list their files in reverse order."""
OUTSIDE = ("address", "source", "hero")
"""Keys whose pictures are slow to draw: cards for other sites, and the cover."""
EDITS = (
    ("content/00-first.md", "Öl is", "Oil is"),
    ("content/00-first.md", "## A section", "## A section, renamed {#a-section}"),
    ("content/01-second.md", "title: Second", "title: The second"),
    ("content/01-second.md", ":amount: 20", ":amount: 25"),
    ("content/images/plan.svg", "0 0 40 30", "0 0 80 30"),
    ("content/references.bib", "{T}", "{Another}"),
    ("content/glossary.toml", "It flows.", "It runs."),
    ("content/book.toml", "Small Book", "Little Book"),
    ("content/01-second.md", "{ref}`a-section`", "{ref}`no-section`"),
)
"""Ways to change the small book; the last is a mistake."""


def test_book_without_figures_ships_neither_interpreter_nor_editor(make_book: MakeBook) -> None:
    options = make_book("Text.\n", {"content/book.toml": OUTLINE})
    files = rendered(Options(options.root, search=False))
    licences = files["licences/index.html"].decode()
    assert not [path for path in files if path.startswith("runtime/") or "/js/editor/" in path]
    assert [name for name in ("Pyodide", "CodeMirror", "NumPy") if name in licences] == []


def test_every_folder_of_the_site_is_reserved(make_book: MakeBook) -> None:
    quiz = ":::{quiz} q\nWhich?\n- [x] A\n  : Yes.\n- [ ] B\n  : No.\n:::\n"
    body = f":::{{source}} simulations.models.thing:double\n:::\n\n{{cite}}`k`\n\n{quiz}"
    lists = {
        "references.bib": "@misc{k, author = {A, B}, title = {T}, year = 2000}\n",
        "glossary.toml": '[text]\nsays = "Words."\nexplained = "second#a-section"\n',
        "symbols.toml": "[book]\n",
        "lecture-plan.toml": 'intro = "I."\n[[section]]\nnumber = "2"\ntitle = "T"\nnote = "N."\n'
        'taught = ["second#a-section"]\n',
    }
    site = render_site(make_book(body, {f"content/{name}": text for name, text in lists.items()}))
    folders = {path.split("/")[0] for path in site if "/" in path} - {"first", "second"}
    assert folders | {"cards", "embed", "runtime", "search"} == set(OWN_FOLDERS)


def test_source_directive_shows_the_function_as_python_finds_it(make_book: MakeBook) -> None:
    code = '\ufeff"""One\u2028two."""\n\f\n\n\ndef half(x):\n    return x / 2\n'
    body = ":::{source} simulations.models.thing:half\n:::\n"
    site = rendered(make_book(body, {"simulations/models/thing.py": code}))
    shown = re.sub(r"<[^>]+>", "", site["first/index.html"].decode())
    assert "def half(x):\n    return x / 2" in shown


def built(
    options: Options, store: Cache | None = None, edit: Callable[[], object] = lambda: None
) -> Mapping[str, bytes] | str:
    """The files of the site, or its mistakes; with a cache, by a process that has checked the book
    before the edit."""
    try:
        with using(store):
            if store:
                check_site(options)
            edit()
            return rendered(options)
    except BuildError as error:
        return str(error)


@pytest.mark.usefixtures("bundled")
def test_cached_build_equals_a_clean_one_after_every_edit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hashing, "STARTED_NS", float("inf"))  # else sources may be too young
    root = shutil.copytree(BOOK, tmp_path / "book")
    outline = (BOOK / "content" / "book.toml").read_text(encoding="utf-8")
    inside = "".join(line for line in outline.splitlines(True) if not line.startswith(OUTSIDE))
    (root / "content" / "book.toml").write_text(inside, encoding="utf-8")
    options = Options(root, runtime=False, search=False, load_scene=load_scene)
    before = built(options, Cache(tmp_path / "cache"))
    assert before == built(options), "and a build is deterministic"
    for path, old, new in EDITS:
        text = (root / path).read_text(encoding="utf-8")
        assert old in text, old
        edit = partial((root / path).write_text, text.replace(old, new), encoding="utf-8")
        now = built(options, Cache(tmp_path / "cache"), edit)
        assert now != before, f"{path}: {new}"
        assert now == built(options), f"{path}: {new}"
        before = now
    assert isinstance(before, str)


def build_as(
    how: list[str], folder: Path, settings: dict[str, str], umask: int
) -> dict[str, bytes]:
    command = [sys.executable, *how, str(folder), str(folder / "site")]
    environment = {**os.environ, **settings, "PYTHONPATH": str(ROOT)}
    subprocess.run(command, env=environment, umask=umask, check=True, cwd=folder)
    files = (file for file in (folder / "site").rglob("*") if file.is_file())
    return {file.relative_to(folder / "site").as_posix(): file.read_bytes() for file in files}


@pytest.mark.deep
def test_two_different_machines_build_the_same_bytes(tmp_path: Path) -> None:
    one = shutil.copytree(BOOK, tmp_path / "one")
    other = tmp_path / "an öther" / "place"
    for file in sorted(BOOK.rglob("*.*"), reverse=True):
        copy = other / file.relative_to(BOOK)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, copy)
    first = build_as(["-c", PLAIN], one, ONE, 0o022)
    second = build_as(["-c", REVERSED], other, OTHER, 0o077)
    assert {"sitemap.xml", "feed.xml", "card.png"} <= set(first)
    assert sorted(first) == sorted(second)
    assert [name for name in first if first[name] != second[name]] == []


calls: list[object] = []


@cached
def double(value: int) -> int:
    calls.append(value)
    return 2 * value


@cached
def scene_title(scene: object) -> str:
    calls.append(scene)
    return str(scene)


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder for a cache."""
    calls.clear()
    monkeypatch.setattr(hashing, "STARTED_NS", float("inf"))  # else sources may be too young
    yield tmp_path
    calls.clear()


def test_stored_result_is_used_until_its_sources_change(
    store: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for _ in range(2):
        with using(Cache(store)):
            assert double(1) == 2
            for name in ("camera", "camera", "lens-distortion"):
                scene_title(load_scene(name))
    assert len(calls) == 3, "a number and two scenes"
    with using(Cache(store)):
        monkeypatch.setattr(cache, "source_hash", lambda _module: b"other")
        double(1)
    assert len(calls) == 4


@pytest.mark.parametrize(
    ("written_ns", "count"), [(time.time_ns(), 2), (4 * 10**18, 1)], ids=["now", "in the future"]
)
def test_results_of_sources_newer_than_the_build_are_not_stored(
    store: Path, monkeypatch: pytest.MonkeyPatch, written_ns: int, count: int
) -> None:
    """A source from the future does not turn the cache off."""
    monkeypatch.setattr(hashing, "STARTED_NS", 0)
    monkeypatch.setattr(hashing, "_written_ns", [written_ns])
    with using(Cache(store)):
        assert (double(1), double(1)) == (2, 2)
    assert calls == [1] * count


def execute(file: Path, statement: str) -> None:
    with closing(sqlite3.connect(file)) as connection, connection:
        connection.execute(statement)


DAMAGES: dict[str, Callable[[Path], object]] = {
    "no database": lambda file: file.write_bytes(b"no database " * 1000),
    "gone": lambda file: file.unlink(),
    "no table": lambda file: execute(file, "DROP TABLE results"),
    "other columns": lambda file: execute(file, "ALTER TABLE results RENAME value TO other"),
    "damaged entries": lambda file: execute(file, "UPDATE results SET value = x'00'"),
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_build_works_with_a_damaged_cache(damage: Callable[[Path], object], store: Path) -> None:
    with using(Cache(store)):
        double(1)
    damage(store / FILE)
    for _ in range(2):
        with using(Cache(store)):
            assert double(1) == 2
    assert calls[1:]


def test_build_works_without_a_cache_folder(store: Path) -> None:
    (store / "file").write_text("")
    with using(Cache(store / "file" / "below")):
        assert double(1) == 2


def test_older_half_of_a_full_cache_is_deleted(store: Path) -> None:
    with closing(Cache(store)) as full:
        for number in range(200):
            full.put(bytes([number]), np.random.default_rng(number).bytes(1000))
    with closing(Cache(store, most_bytes=100_000)) as half:
        left = [number for number in range(200) if half.get(bytes([number])) is not None]
    assert left == [*range(100, 200)]
    assert (store / FILE).stat().st_size < 150_000


def write_many(folder: Path, begin: int) -> None:
    with closing(Cache(folder)) as own:
        for number in range(begin, begin + 200):
            own.put(str(number).encode(), str(number).encode() * 100)


def test_concurrent_builds_and_threads_store_all_their_results(store: Path) -> None:
    context = multiprocessing.get_context("spawn")
    builds = [context.Process(target=write_many, args=(store, begin)) for begin in (0, 100)]
    for process in builds:
        process.start()
    for process in builds:
        process.join()
    with closing(Cache(store)) as shared:
        assert all(shared.get(str(n).encode()) == str(n).encode() * 100 for n in range(300))
    with using(Cache(store)), ThreadPoolExecutor(8) as threads:
        for _ in range(2):
            assert list(threads.map(double, range(200))) == [2 * n for n in range(200)]
    assert sorted(map(str, calls)) == sorted(map(str, range(200)))


def test_warnings_are_stored_and_mistakes_are_not(store: Path) -> None:
    def read(problems: Diagnostics) -> int:
        calls.append("read")
        problems.warn("a.md", 1, "odd")
        return 1

    def fail(problems: Diagnostics) -> int:
        calls.append("fail")
        problems.add("a.md", 1, "wrong")
        return 1

    with using(Cache(store)):
        for reader in (read, read, fail, fail):
            problems = Diagnostics()
            cached_reading(reader.__name__, "a", problems, reader)
            assert [*problems.found, *problems.doubts]
    assert calls == ["read", "fail", "fail"]


@dataclass(frozen=True)
class Point:
    x: float
    y: float


VALUES = [
    None, True, 1, 1.0, "1", b"1", Path("1"), (), ("",), ("", ""), ("ab",), ("a", "b"),
    (("a",), "b"), {}, {"a": 1}, {"a": 1, "b": 2}, frozenset("ab"),
    np.zeros(2), np.zeros((2, 1)), np.ones(2), Point(1, 2), Point(2, 1), float("nan"),
]  # fmt: skip


def test_values_have_the_same_hash_exactly_where_they_are_equal() -> None:
    assert len({hash_of(value) for value in VALUES}) == len(VALUES)
    assert hash_of(Point(1, 2), {"a": [1]}) == hash_of(Point(1, 2), {"a": [1]})
    assert hash_of(frozenset("abcdef")) == hash_of(frozenset("fedcba"))
    names = ("frame", "scene", "controls")
    assert len({source_hash(f"simulations.engine.{name}") for name in names}) == len(names)
    programs = [f"    from simulations.engine import {name}" for name in names]
    assert len({imports_hash(program) for program in programs}) == len(names)


def test_function_with_a_closure_is_unhashable() -> None:
    def make(number: int) -> Callable[[], int]:
        return lambda: number

    with pytest.raises(UnhashableError):
        hash_of(make(1))
