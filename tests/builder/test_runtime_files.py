"""Files of the browser's Python: fetched, verified, unpacked and packed, without a network."""

import json
import os
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from support.engine import Engine
from support.little_book import OUTLINE, MakeBook
from support.places import GERMAN_BOOK, LADDERS, ROOT, SCENES

from simulations.registry import SCENE_MODULES
from site_builder.build import render_site
from site_builder.diagnostics.diagnostic import BuildError
from site_builder.programs.node import Package
from site_builder.runtime import downloads, store
from site_builder.runtime.downloads import (
    PackageError,
    RuntimeFetchError,
    Source,
    differing,
    fetch_runtime,
    needed,
    read_package,
)
from site_builder.runtime.freeze import WheelError, unpack_for_browser
from site_builder.runtime.imports import (
    CORE,
    ENTRY,
    Table,
    cut,
    imports_of,
    module_files,
    outside,
    reach,
)
from site_builder.runtime.pack import book_modules, chunk_archive, pack_runtime, page_modules
from site_builder.runtime.store import NUMPY_VERSION, RuntimeFile

CONTENT = {"engine.wasm": b"machine code", "library.zip": b"modules"}
FILES = tuple(RuntimeFile(name, store.sha256(data)) for name, data in CONTENT.items())


def source_of(content: dict[str, bytes], requested: list[str]) -> Source:
    def source(wanted: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
        for file in wanted:
            requested.append(file.name)
            yield file, content[file.name]

    return source


def offline(_: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
    raise OSError("network is unreachable")


def broken_off(wanted: Sequence[RuntimeFile]) -> Iterator[tuple[RuntimeFile, bytes]]:
    yield wanted[0], CONTENT[wanted[0].name]
    raise ConnectionResetError("connection reset")


def fetch(folder: Path, *sources: Source) -> dict[str, bytes]:
    labelled = [(f"source {number}", source) for number, source in enumerate(sources)]
    paths = fetch_runtime(folder, labelled, FILES)
    return {name: path.read_bytes() for name, path in paths.items()}


@pytest.mark.parametrize("damage", [None, b"", b"machine c", b"machine codE"])
def test_files_are_fetched_once_and_damaged_ones_again(
    tmp_path: Path, damage: bytes | None
) -> None:
    fetch(tmp_path, source_of(CONTENT, []))
    if damage is not None:
        store.location(tmp_path, FILES[0]).write_bytes(damage)
    requested: list[str] = []
    assert fetch(tmp_path, source_of(CONTENT, requested)) == CONTENT
    assert requested == ([] if damage is None else ["engine.wasm"])
    assert sorted(path.name for path in tmp_path.rglob("*.*")) == sorted(CONTENT)


@pytest.mark.parametrize(
    ("first", "fetched"),
    [
        (offline, ["engine.wasm", "library.zip"]),
        (source_of(CONTENT | {"library.zip": b"mod"}, []), ["library.zip"]),
        (broken_off, ["library.zip"]),
    ],
    ids=["unreachable", "wrong bytes", "broken off"],
)
def test_next_source_supplies_the_files_that_the_first_did_not(
    tmp_path: Path, first: Source, fetched: list[str]
) -> None:
    requested: list[str] = []
    assert fetch(tmp_path, first, source_of(CONTENT, requested)) == CONTENT
    assert requested == fetched


def test_wrong_bytes_are_never_stored_and_the_message_gives_advice(tmp_path: Path) -> None:
    with pytest.raises(RuntimeFetchError, match=r"engine\.wasm has SHA-256 .* expected"):
        fetch(tmp_path, source_of(CONTENT | {"engine.wasm": b"something else"}, []))
    place = store.location(tmp_path, FILES[0])
    assert not place.exists()
    assert store.is_intact(tmp_path, FILES[1])
    with pytest.raises(RuntimeFetchError, match="network is unreachable") as raised:
        fetch(tmp_path, offline, offline)
    assert "Connect to the internet once" in str(raised.value)
    assert str(place) in str(raised.value)


def wheel(folder: Path, members: Mapping[str, bytes]) -> Path:
    """A wheel of a package ``lens`` with these members."""
    path = folder / "lens-1.0-cp314-cp314-pyemscripten_2026_0_wasm32.whl"
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return path


def unpacked(folder: Path, members: Mapping[str, bytes], *, with_tests: bool) -> set[str]:
    out = unpack_for_browser(wheel(folder, members), folder / "out", with_tests=with_tests)
    return {file.relative_to(out).as_posix() for file in out.rglob("*.*")}


def test_tests_are_removed_from_a_wheel_unless_already_removed(tmp_path: Path) -> None:
    fast = "lens/fast.cpython-314-wasm32-emscripten.so"
    members = {"lens/__init__.py": b"", fast: b"\0asm\x01\0\0\0", "lens/tests/test_fast.py": b""}
    assert unpacked(tmp_path, members, with_tests=True) == {"lens/__init__.py", fast}
    shutil.rmtree(tmp_path / "out")
    members = {"lens/__init__.py": b"", "lens/_trend_test.py": b""}
    assert unpacked(tmp_path, members, with_tests=False) == {*members}


def test_extensions_for_another_platform_are_refused_by_name(tmp_path: Path) -> None:
    path = wheel(tmp_path, {"lens/fast.cpython-314-x86_64-linux-gnu.so": b"\x7fELF\x02\x01\x01"})
    with pytest.raises(WheelError, match=r"lens-1.0.*: fast.*x86_64.* is not WebAssembly"):
        unpack_for_browser(path, tmp_path / "out")


LISTED = {
    "numpy": {"package_type": "package", "depends": []},
    "lens": {"package_type": "package", "depends": ["numpy", "glass"]},
    "glass": {"package_type": "package", "depends": []},
    "atlas": {"package_type": "package", "depends": ["libgeos"]},
    "libgeos": {"package_type": "shared_library", "depends": []},
}


def test_package_comes_with_its_dependencies_or_is_refused() -> None:
    assert needed(["lens"], LISTED) == ["glass", "lens"]
    for name, message in (("lense", "did you mean 'lens'"), ("atlas", "'libgeos' is a shared")):
        with pytest.raises(PackageError, match=message):
            needed([name], LISTED)


def test_wheel_has_licence_and_page_and_other_versions_are_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    metadata = "Name: lens\nVersion: 1.0\nLicense-Expression: MIT\nProject-URL: A, https://a.b/c\n"
    members = {
        "lens.py": b"",
        "lens-1.0.dist-info/METADATA": metadata.encode(),
        "lens-1.0.dist-info/licenses/LICENSE": b"Permission is granted.",
    }
    expected = Package("lens", "1.0", "MIT", "Permission is granted.", "https://a.b/c")
    assert read_package(wheel(tmp_path, members)) == expected
    monkeypatch.setattr(downloads, "version", {"lens": "1.1", "glass": "2.0"}.__getitem__)
    (found,) = differing([expected, Package("glass", "2.0", "", "")])
    assert found.startswith("lens is 1.1 here and 1.0 in the browser; better: ")
    assert np.__version__ == NUMPY_VERSION


@pytest.mark.deep
def test_scene_gets_the_package_that_it_imports(tmp_path: Path) -> None:
    room = tmp_path / "simulations" / "scenes" / "orbit"
    room.mkdir(parents=True)
    (room / "__init__.py").touch()
    (room / "scene.py").write_text("import six\n", encoding="utf-8")
    scenes = {"orbit": "simulations.scenes.orbit.scene"}
    folder = tmp_path / "simulations"
    bundle = pack_runtime(folder, None, scenes, {}, compiled=False, packages=["six"])
    assert [package.name for package in bundle.packages] == ["six"]
    table = json.loads(bundle.files["runtime.json"].read_text())
    assert table["scenes"]["orbit"] == ["scene-orbit", "package-six"]
    assert table["modules"]["package-six"] == ["six"]
    with zipfile.ZipFile(bundle.files["package-six.zip"]) as archive:
        assert archive.namelist() == ["six.pyc"]


@pytest.mark.deep
def test_unknown_package_is_reported_at_its_line(make_book: MakeBook) -> None:
    outline = OUTLINE + '[runtime]\npackages = ["sixx"]\n'
    options = make_book("::::{simulation} demo\nText.\n::::\n", {"content/book.toml": outline})
    with pytest.raises(BuildError, match=r"^content/book\.toml:6: unknown package 'sixx'"):
        render_site(replace(options, runtime=True))


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A small `simulations` package, with leftovers of an editor and an interpreter."""
    folder = tmp_path / "simulations"
    (folder / "models").mkdir(parents=True)
    (folder / "__pycache__").mkdir()
    for name, text in {
        "__init__.py": "",
        "scene.py": "import math\nfrom simulations.models import lens\n",
        "other.py": "import no_such_package\n",
        "models/__init__.py": "ANSWER = 42\n",
        "models/lens.py": "from collections.abc import Sequence\nimport numpy as np\n"
        "def noise(): return np.random.default_rng(np.pi)\ndef late():\n    import statistics\n",
        "__pycache__/x.pyc": "compiled",
        ".draft.py": "unfinished",
    }.items():
        (folder / name).write_text(text)
    return folder


def test_indirect_imports_are_found_with_their_place(package: Path) -> None:
    table = imports_of(module_files(package))
    reached = reach(table, "simulations.scene")
    models = {"simulations.models", "simulations.models.lens"}
    assert reached == {"simulations", "simulations.scene", *models}
    assert outside(table, reached) == {
        "math": "simulations/scene.py:1",
        "collections.abc": "simulations/models/lens.py:1",
        "numpy": "simulations/models/lens.py:2",
        "numpy.random": "simulations/models/lens.py:3",
        "statistics": "simulations/models/lens.py:5",
    }
    not_here = {"no_such_package": "simulations/other.py:1"}
    assert outside(table, ["simulations.other"]) == not_here


RENDER = "from simulations.browser import render; render('figure', sys.argv[1], '{}', '')"
PRINT_MODULES = (
    "print(*(name for name, one in sys.modules.items() if getattr(one, '__file__', '')))"
)
SAMPLE = ("aliasing", "jpeg", "photon-transfer")
"""Two of them import parts of numpy that other scenes do not need."""


def imported_by(code: str, *given: str) -> set[str]:
    """All modules with a file that the code imports."""
    command = [sys.executable, "-c", f"import sys; {code}; {PRINT_MODULES}", *given]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return set(done.stdout.split())


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param(scene, marks=[] if scene in SAMPLE else pytest.mark.deep)
        for scene in SCENE_MODULES
    ],
)
def test_rendering_a_scene_imports_only_modules_found_in_its_sources(
    scene: str, imports_of_the_book: Table
) -> None:
    imported = imported_by(RENDER, scene)
    known = reach(imports_of_the_book, "simulations.browser")
    known |= reach(imports_of_the_book, SCENE_MODULES[scene])
    assert {name for name in imported if name.startswith("simulations.")} <= known
    numpy = [name for name in imported if name.startswith("numpy.")]
    parts = {".".join(name.split(".")[:2]) for name in numpy}
    with_numpy = imported_by("import numpy, numpy.typing")
    assert parts <= with_numpy | set(outside(imports_of_the_book, known))


def archive(package: Path, modules: Collection[str]) -> bytes:
    return chunk_archive(module_files(package), modules)


def test_archive_has_only_its_modules_and_is_reproducible(package: Path, tmp_path: Path) -> None:
    modules = ("simulations", "simulations.models")
    made = archive(package, modules)
    with zipfile.ZipFile(BytesIO(made)) as opened:
        assert opened.namelist() == ["simulations/__init__.py", "simulations/models/__init__.py"]
    copy = shutil.copytree(package, tmp_path / "elsewhere" / "simulations")
    for file in copy.rglob("*"):
        os.utime(file, (1_000_000_000, 1_000_000_000))
    assert made == archive(copy, modules)


IMPORT_ALL = """
import json, sys
from simulations import browser, registry
from simulations.editing import copies, exercise  # imported by the worker on demand
from simulations.engine import conditions
for scene in registry.SCENE_MODULES: registry.load_scene(scene)
for ladder in registry.LADDER_MODULES: registry.load_ladder(ladder)
ours = [module for name, module in sys.modules.items() if name.startswith("simulations.")]
print(json.dumps([module.__name__ for module in ours if module.__file__]))
"""


def test_pages_get_exactly_the_modules_of_worker_scenes_and_ladders(engine: Engine) -> None:
    done = engine.run(GERMAN_BOOK, "-c", IMPORT_ALL)
    imports = imports_of(book_modules(GERMAN_BOOK / "simulations"))
    assert page_modules(imports, SCENES, LADDERS) == set(json.loads(done.stdout))
    parts = cut(imports, SCENES, LADDERS)
    wanted = {f"scene-{key}": name for key, name in SCENES.items()}
    wanted |= {f"ladder-{key}": name for key, name in LADDERS.items()}
    assert reach(imports, ENTRY) <= parts[CORE]
    for part, module in wanted.items():
        assert reach(imports, module) <= parts[part] | parts[CORE], part
        assert not parts[part] & parts[CORE], part
