"""Python's library and numpy, cut into parts and compiled by the browser's own interpreter."""

import zipfile
from collections.abc import Mapping
from pathlib import Path

import pytest
from support.places import WAVES
from support.waves import LADDERS, SCENES

from site_builder.runtime import store
from site_builder.runtime.fetch import fetch_runtime
from site_builder.runtime.freeze import INTERPRETER, FreezeError, Frozen, freeze_libraries
from site_builder.runtime.imports import imports_of, outside, reach
from site_builder.runtime.modules import ENTRY
from site_builder.runtime.pack import book_modules, page_modules
from site_builder.runtime.pinned import NUMPY_WHEEL, PYTHON_LIBRARY

FETCHED = fetch_runtime()


def freeze(folder: Path, at_once: Mapping[str, str], later: Mapping[str, str]) -> Frozen:
    interpreter = {name: FETCHED[name] for name in INTERPRETER}
    python, numpy = FETCHED[PYTHON_LIBRARY.name], FETCHED[NUMPY_WHEEL.name]
    return freeze_libraries(interpreter, python, numpy, at_once, later, folder)


def freeze_for_waves(folder: Path) -> Frozen:
    imports = imports_of(book_modules(WAVES / "simulations"))
    at_once = outside(imports, reach(imports, ENTRY))
    return freeze(folder, at_once, outside(imports, page_modules(imports, SCENES, LADDERS)))


@pytest.fixture(scope="module")
def frozen() -> Frozen:
    """What the book on waves needs, which is kept between builds."""
    return freeze_for_waves(store.default_store())


def members(archive: Path) -> list[str]:
    with zipfile.ZipFile(archive) as opened:
        assert opened.testzip() is None
        return opened.namelist()


def test_what_is_needed_at_once_is_told_from_what_can_wait(frozen: Frozen) -> None:
    assert {"numpy", "numpy.linalg", "numpy._core._multiarray_umath"} <= {*frozen.modules["numpy"]}
    assert {"numpy.fft", "numpy.fft._pocketfft_umath"} <= {*frozen.modules["numpy-fft"]}
    assert {"numpy.random", "numpy.random._pcg64"} <= {*frozen.modules["numpy-random"]}
    assert {"numpy.ma", "numpy.f2py"} <= {*frozen.modules["numpy-rest"]}
    assert {"os", "json", "asyncio", "_pyodide._base"} <= {*frozen.modules["python"]}
    assert "turtle" not in frozen.modules["python"]
    assert {"ssl", "compression.zstd"} <= {*frozen.modules["python-rest"]}


def test_nothing_is_lost_but_tests(frozen: Frozen) -> None:
    with zipfile.ZipFile(FETCHED[NUMPY_WHEEL.name]) as wheel:
        modules = {name for name in wheel.namelist() if name.endswith((".py", ".so"))}
    sources = {n for n in modules if "/tests/" not in n and not n.endswith("conftest.py")}
    parts = [part for part in frozen.archives if part.startswith("numpy")]
    packed = [name for part in parts for name in members(frozen.archives[part])]
    assert sorted(name.replace(".pyc", ".py") for name in packed) == sorted(sources)


def test_machine_code_that_is_loaded_at_once_lies_apart_and_an_empty_file_in_its_place(
    frozen: Frozen,
) -> None:
    libraries = {path for path in members(frozen.archives["numpy"]) if path.endswith(".so")}
    assert libraries == {*frozen.libraries}
    with zipfile.ZipFile(frozen.archives["numpy"]) as archive:
        assert not any(archive.read(path) for path in libraries)
    with zipfile.ZipFile(FETCHED[NUMPY_WHEEL.name]) as wheel:
        for path, file in frozen.libraries.items():
            assert file.read_bytes() == wheel.read(path)
            assert file.suffix == ".wasm", "hosts know what to call it"


def test_what_the_page_waits_for_is_byte_code_of_the_browsers_python(frozen: Frozen) -> None:
    for part in ("python", "numpy", "numpy-fft"):
        with zipfile.ZipFile(frozen.archives[part]) as archive:
            codes = [n for n in archive.namelist() if not n.endswith(".so")]
            assert all(name.endswith(".pyc") for name in codes)
            head = archive.read(codes[0])[:8]
        magic, flags = int.from_bytes(head[:2], "little"), int.from_bytes(head[4:], "little")
        assert 3600 <= magic < 3650, "the numbers of Python 3.14"
        assert flags == 1, "by hash, and never checked: there is no source to check against"


@pytest.mark.deep
def test_what_was_made_is_taken_again_and_after_damage_made_again(
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


def test_a_module_that_the_browser_lacks_is_told_with_its_place(tmp_path: Path) -> None:
    with pytest.raises(FreezeError, match=r"scenes/waves\.py:2: imports scipy, which"):
        freeze(tmp_path, {"json": "browser.py:1"}, {"scipy": "scenes/waves.py:2"})
