"""Everything that the browser loads to run our Python: pinned files, our wheel, a lock file."""

import json
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from hatchling.builders.wheel import WheelBuilder
from pyodide_lock import PyodideLockSpec
from pyodide_lock.utils import add_wheels_to_spec

from site_builder.runtime import store as stores
from site_builder.runtime.fetch import fetch_runtime
from site_builder.runtime.pinned import (
    LOCK_INFO,
    NUMPY_VERSION,
    NUMPY_WHEEL,
    PYODIDE_VERSION,
    PYTHON_VERSION,
)

LOCK_NAME = "pyodide-lock.json"

PROJECT = f"""\
[project]
name = "simulations"
version = "1.0"
requires-python = ">=3.12"
dependencies = ["numpy=={NUMPY_VERSION}"]

[tool.hatch.build.targets.wheel]
packages = ["simulations"]
"""
"""The simulations as a package of their own: the browser needs none of the book's builder."""


@dataclass(frozen=True, slots=True)
class RuntimeVersions:
    """What the reader's browser runs."""

    pyodide: str
    python: str
    numpy: str


@dataclass(frozen=True, slots=True)
class RuntimeBundle:
    """The files of the site's runtime folder."""

    files: Mapping[str, Path]
    """Name in the site's runtime folder to where the file lies now."""
    versions: RuntimeVersions


VERSIONS = RuntimeVersions(PYODIDE_VERSION, PYTHON_VERSION, NUMPY_VERSION)


def pack_runtime(simulations: Path, store: Path | None = None) -> RuntimeBundle:
    """Fetch what is pinned and pack the package folder ``simulations`` beside it.

    Equal sources give equal bytes, so a hash over the files names the runtime.

    Raises
    ------
    RuntimeFetchError
        Where the pinned files are neither cached nor to be had.
    """
    folder = store or stores.default_store()
    fetched = fetch_runtime(folder)
    with tempfile.TemporaryDirectory() as scratch:
        wheel = build_wheel(simulations, Path(scratch))
        lock = lock_file(wheel)
        packed = {
            wheel.name: stores.put(folder, wheel.name, wheel.read_bytes()),
            LOCK_NAME: stores.put(folder, LOCK_NAME, lock.encode()),
        }
    return RuntimeBundle({**fetched, **packed}, VERSIONS)


def build_wheel(simulations: Path, scratch: Path) -> Path:
    """The wheel of the package folder ``simulations``, built in ``scratch`` without network.

    Without the tables of hard cases: they are asked when the book is built, not when it is read.
    """
    project = scratch / "project"
    shutil.copytree(
        simulations,
        project / "simulations",
        ignore=shutil.ignore_patterns("__pycache__", ".*", "extremes"),
    )
    (project / "pyproject.toml").write_text(PROJECT, encoding="utf-8")
    builder = WheelBuilder(str(project))
    return Path(next(builder.build(directory=str(scratch / "dist"), versions=["standard"])))


def lock_file(wheel: Path) -> str:
    """Pyodide's package table: numpy, as its release describes it, and our wheel."""
    numpy_entry = {
        "name": "numpy",
        "version": NUMPY_VERSION,
        "file_name": NUMPY_WHEEL.name,
        "install_dir": "site",
        "sha256": NUMPY_WHEEL.sha256,
        "package_type": "package",
        "imports": ["numpy"],
        "depends": [],
        "unvendored_tests": False,
    }
    base = PyodideLockSpec.from_dict({"info": LOCK_INFO, "packages": {"numpy": numpy_entry}})
    spec = add_wheels_to_spec(base, [wheel])
    return json.dumps(spec.to_dict(), indent=1, sort_keys=True)
