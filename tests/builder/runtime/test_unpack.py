"""Numpy's wheel, unpacked for the browser."""

import zipfile
from pathlib import Path

import pytest

from site_builder.runtime.unpack import WheelError, unpack_for_browser

WASM = b"\0asm\x01\0\0\0"


def wheel(folder: Path, members: dict[str, bytes]) -> Path:
    """A wheel of a package ``lens`` with these members."""
    path = folder / "lens-1.0-cp314-cp314-pyemscripten_2026_0_wasm32.whl"
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return path


def files(folder: Path) -> set[str]:
    return {file.relative_to(folder).as_posix() for file in folder.rglob("*.*")}


def test_modules_stay_and_tests_go(tmp_path: Path) -> None:
    fast = "lens/fast.cpython-314-wasm32-emscripten.so"
    members = {"lens/__init__.py": b"", fast: WASM, "lens/tests/test_fast.py": b""}
    folder = unpack_for_browser(wheel(tmp_path, members), tmp_path / "out")
    assert files(folder) == {"lens/__init__.py", fast}


def test_what_the_release_has_sifted_stays_as_it_is(tmp_path: Path) -> None:
    members = {"lens/__init__.py": b"", "lens/_trend_test.py": b""}
    given = wheel(tmp_path, members)
    assert files(unpack_for_browser(given, tmp_path / "out", with_tests=False)) == {*members}


def test_extensions_for_another_machine_are_refused_by_name(tmp_path: Path) -> None:
    path = wheel(tmp_path, {"lens/fast.cpython-314-x86_64-linux-gnu.so": b"\x7fELF\x02\x01\x01"})
    with pytest.raises(WheelError, match=r"lens-1.0.*: fast.*x86_64.* is not WebAssembly"):
        unpack_for_browser(path, tmp_path / "out")
