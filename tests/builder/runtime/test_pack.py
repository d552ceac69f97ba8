"""The archive of the simulations and the table of the runtime: complete, reproducible, exact."""

import base64
import hashlib
import json
import os
import shutil
import zipfile
from collections.abc import Collection
from io import BytesIO
from pathlib import Path

import pytest
from support.engine import Engine
from support.places import WAVES
from support.waves import LADDERS, SCENES

from site_builder.runtime.freeze import Frozen
from site_builder.runtime.imports import imports_of, module_files, reach, read_imports
from site_builder.runtime.modules import CORE, ENTRY, cut
from site_builder.runtime.pack import (
    book_modules,
    chunk_archive,
    chunks_of,
    page_modules,
    runtime_table,
)
from site_builder.runtime.pinned import NUMPY_VERSION


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A small package of that name, with what an editor and an interpreter leave in it."""
    folder = tmp_path / "simulations"
    (folder / "models").mkdir(parents=True)
    (folder / "__init__.py").write_text("")
    (folder / "models" / "__init__.py").write_text("ANSWER = 42\n")
    (folder / "models" / "noise.py").write_text("import numpy as np\nnp.random.default_rng(1)\n")
    (folder / "__pycache__").mkdir()
    (folder / "__pycache__" / "x.pyc").write_bytes(b"compiled")
    (folder / ".draft.py").write_text("unfinished")
    return folder


def names(archive: bytes) -> list[str]:
    with zipfile.ZipFile(BytesIO(archive)) as opened:
        return opened.namelist()


EVERY_MODULE = ("simulations", "simulations.models", "simulations.models.noise")


def archive(package: Path, modules: Collection[str] = EVERY_MODULE) -> bytes:
    return chunk_archive(module_files(package), modules)


def test_equal_sources_give_equal_bytes(package: Path, tmp_path: Path) -> None:
    copy = tmp_path / "elsewhere" / "simulations"
    shutil.copytree(package, copy)
    for file in copy.rglob("*"):
        os.utime(file, (1_000_000_000, 1_000_000_000))
    assert archive(package) == archive(copy)


def test_the_archive_holds_the_modules_and_nothing_else(package: Path) -> None:
    assert names(archive(package)) == [
        *("simulations/__init__.py", "simulations/models/__init__.py"),
        "simulations/models/noise.py",
    ]
    few = archive(package, EVERY_MODULE[:2])
    assert names(few) == ["simulations/__init__.py", "simulations/models/__init__.py"]


IMPORT_ALL = """
import json, sys
from simulations import browser, registry
from simulations.editing import copies  # these two by the worker, once they are asked for
from simulations.engine import conditions
for scene in registry.SCENE_MODULES: registry.load_scene(scene)
for ladder in registry.LADDER_MODULES: registry.load_ladder(ladder)
ours = [module for name, module in sys.modules.items() if name.startswith("simulations.")]
print(json.dumps([module.__name__ for module in ours if module.__file__]))
"""


def test_the_page_gets_just_the_modules_that_the_worker_scenes_and_ladders_import(
    engine: Engine,
) -> None:
    done = engine.run(WAVES, "-c", IMPORT_ALL)
    imports = imports_of(book_modules(WAVES / "simulations"))
    assert page_modules(imports, SCENES, LADDERS) == set(json.loads(done.stdout))


def test_the_table_tells_the_hash_of_each_archive(package: Path, tmp_path: Path) -> None:
    archive = tmp_path / "simulations.zip"
    archive.write_bytes(b"modules")
    table = runtime_table({archive.name: archive}, Frozen({}, {}, {}), read_imports(package))
    digest = base64.b64encode(hashlib.sha256(b"modules").digest()).decode()
    assert table["integrity"] == {"simulations.zip": f"sha256-{digest}"}


def test_a_module_needs_the_parts_that_it_imports_from(package: Path) -> None:
    modules = {"numpy-random": ("numpy.random", "numpy.random.mtrand"), "numpy-fft": ("numpy.fft",)}
    imports = read_imports(package)
    assert chunks_of(imports, "simulations.models.noise", modules) == ["numpy-random"]
    assert chunks_of(imports, "simulations.models", modules) == []


def test_browser_and_host_run_the_same_numpy() -> None:
    import numpy as np

    assert np.__version__ == NUMPY_VERSION


def test_a_part_and_the_core_have_all_that_a_scene_or_a_ladder_imports() -> None:
    imports = imports_of(book_modules(WAVES / "simulations"))
    parts = cut(imports, SCENES, LADDERS)
    wanted = {f"scene-{key}": name for key, name in SCENES.items()}
    wanted |= {f"ladder-{key}": name for key, name in LADDERS.items()}
    assert reach(imports, ENTRY) <= parts[CORE]
    for part, module in wanted.items():
        assert reach(imports, module) <= parts[part] | parts[CORE], part
        assert not parts[part] & parts[CORE], part
