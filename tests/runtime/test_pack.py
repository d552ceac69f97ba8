"""The simulations' wheel and the lock file: complete, reproducible, independent of the place."""

import json
import os
import shutil
import zipfile
from pathlib import Path

import pytest

from site_builder.runtime import store
from site_builder.runtime.pack import build_wheel, lock_file
from site_builder.runtime.pinned import NUMPY_VERSION, NUMPY_WHEEL

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A small package of that name, with what an editor and an interpreter leave in it."""
    folder = tmp_path / "simulations"
    (folder / "models").mkdir(parents=True)
    (folder / "__init__.py").write_text("")
    (folder / "models" / "__init__.py").write_text("ANSWER = 42\n")
    (folder / "__pycache__").mkdir()
    (folder / "__pycache__" / "x.pyc").write_bytes(b"compiled")
    (folder / ".draft.py").write_text("unfinished")
    return folder


def test_equal_sources_give_equal_bytes(package: Path, tmp_path: Path) -> None:
    copy = tmp_path / "elsewhere" / "simulations"
    shutil.copytree(package, copy)
    for file in copy.rglob("*"):
        os.utime(file, (1_000_000_000, 1_000_000_000))
    first = build_wheel(package, tmp_path / "first")
    second = build_wheel(copy, tmp_path / "second")
    assert first.name == second.name
    assert first.read_bytes() == second.read_bytes()


def test_a_changed_source_changes_the_lock_file(package: Path, tmp_path: Path) -> None:
    before = lock_file(build_wheel(package, tmp_path / "before"))
    (package / "models" / "__init__.py").write_text("ANSWER = 43\n")
    assert lock_file(build_wheel(package, tmp_path / "after")) != before


def test_the_wheel_holds_the_package_and_no_leftovers(package: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(build_wheel(package, tmp_path)) as wheel:
        names = [name for name in wheel.namelist() if name.startswith("simulations/")]
        assert sorted(names) == ["simulations/__init__.py", "simulations/models/__init__.py"]


def test_the_real_wheel_holds_every_module_that_a_page_can_ask_for(tmp_path: Path) -> None:
    modules = {path.relative_to(ROOT).as_posix() for path in (ROOT / "simulations").rglob("*.py")}
    printed_only = {name for name in modules if name.startswith("simulations/extremes/")}
    with zipfile.ZipFile(build_wheel(ROOT / "simulations", tmp_path)) as wheel:
        packed = {name for name in wheel.namelist() if name.startswith("simulations/")}
    assert packed == modules - printed_only


def test_the_lock_file_pins_both_packages_by_hash(package: Path, tmp_path: Path) -> None:
    wheel = build_wheel(package, tmp_path)
    packages = json.loads(lock_file(wheel))["packages"]
    assert set(packages) == {"numpy", "simulations"}
    assert packages["numpy"]["version"] == NUMPY_VERSION
    assert packages["numpy"]["sha256"] == NUMPY_WHEEL.sha256
    assert packages["simulations"]["sha256"] == store.sha256(wheel.read_bytes())
    assert packages["simulations"]["file_name"] == wheel.name
    assert packages["simulations"]["depends"] == ["numpy"]


def test_browser_and_host_run_the_same_numpy() -> None:
    import numpy as np

    assert np.__version__ == NUMPY_VERSION
