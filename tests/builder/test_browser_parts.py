"""Optional parts of the site: the code editor, the search, and readable sources of figures. Their
packages are pinned, fetched once, and omitted with a warning where they are unavailable."""

import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from jinja2 import DictLoader, Environment
from support.little_book import PACKAGE, MakeBook, small_package
from support.places import ROOT

from simulations.editing import definitions
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.assets import browser_parts
from site_builder.assets import browser_parts as browser_python
from site_builder.build import render_site
from site_builder.diagnostics.diagnostic import Diagnostic
from site_builder.editor.scene_code import read_module, scene_sources, uses_of
from site_builder.files import folders
from site_builder.files.engine import ENGINE
from site_builder.languages.words import ENGLISH, languages
from site_builder.output.scripts import EditorBundle
from site_builder.output.writer import content_bytes
from site_builder.pages.environment import CompiledTemplates
from site_builder.programs import node
from site_builder.programs.node import NodeError
from site_builder.runtime.pack import RuntimeBundle
from site_builder.runtime.store import VERSIONS
from site_builder.search.index import STEMMERS, Record, SearchLibrary, fetch_library, index_of


def test_every_package_is_pinned_by_hash_and_no_lock_names_an_address() -> None:
    for lock in (ENGINE / "site_builder").rglob("package-lock.json"):
        locked = json.loads(lock.read_text(encoding="utf-8"))["packages"]
        packages = [item for name, item in locked.items() if name]
        assert all(item["integrity"].startswith("sha512-") for item in packages), lock
        assert not any("resolved" in item for item in packages), lock


LOCK = {"packages": {"": {}, "node_modules/a": {}, "node_modules/elsewhere": {"os": ["none"]}}}


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], Path]:
    """A function that installs a package of two files, without npm."""
    (tmp_path / "package-lock.json").write_text(json.dumps(LOCK), encoding="utf-8")

    def install(_lock: Path, target: Path) -> None:
        package = target / "node_modules" / "a"
        package.mkdir(parents=True)
        for name in ("package.json", "index.js"):
            (package / name).write_text(name, encoding="utf-8")

    monkeypatch.setattr(node, "install_packages", install)
    return lambda: node.installed_packages(tmp_path, tmp_path / "cache")


def rewrite(file: Path) -> None:
    """Change the content of a file, but neither its size nor its time."""
    times = file.stat().st_mtime_ns
    file.write_text(file.read_text(encoding="utf-8").upper(), encoding="utf-8")
    os.utime(file, ns=(times, times))


DAMAGES: dict[str, Callable[[Path], object]] = {
    "changed file": lambda package: rewrite(package / "index.js"),
    "truncated file": lambda package: (package / "index.js").write_bytes(b""),
    "extra file": lambda package: (package / "more.js").write_bytes(b"1"),
    "missing file": lambda package: (package / "index.js").unlink(),
    "missing folder": lambda package: shutil.rmtree(package),
    "truncated list": lambda package: [
        file.write_bytes(b"{") for file in package.parents[2].glob("*.json")
    ],
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_packages_damaged_in_the_cache_are_installed_again(
    damage: Callable[[Path], object], installed: Callable[[], Path]
) -> None:
    folder = installed()
    assert installed() == folder
    package = folder / "node_modules" / "a"
    damage(package)
    folders._known.clear()  # as in a new process
    assert installed() == folder
    assert {file.name: file.read_text(encoding="utf-8") for file in package.iterdir()} == {
        "package.json": "package.json",
        "index.js": "index.js",
    }


def test_packages_not_installed_by_npm_are_named(
    installed: Callable[[], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(node, "install_packages", lambda _lock, target: target.mkdir())
    with pytest.raises(NodeError, match=r"not installed node_modules/a$"):
        installed()


@pytest.mark.parametrize("damaged", [b"", b"x" * 99, bytes(20)])
def test_damaged_compiled_template_is_compiled_again(damaged: bytes, tmp_path: Path) -> None:
    def render() -> str:
        environment = Environment(
            bytecode_cache=CompiledTemplates(tmp_path), loader=DictLoader({"t": "{{ 1 + 1 }}"})
        )
        return environment.get_template("t").render()

    assert render() == "2"
    (file,) = tmp_path.iterdir()
    whole = file.read_bytes()
    file.write_bytes(damaged or whole[:-3])
    assert render() == "2"
    assert file.read_bytes() == whole


def test_temporary_folder_replaces_a_cache_folder_that_cannot_be_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    folder = folders.cache_folder.__wrapped__()
    assert folder.is_dir()
    assert folder.is_relative_to(tmp_path)
    assert "XDG_CACHE_HOME" in capsys.readouterr().err


def test_book_is_built_with_warnings_without_editor_and_search(
    make_book: MakeBook, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_given: object) -> EditorBundle | SearchLibrary:
        raise NodeError("no network")

    for name in ("bundle_editor", "fetch_library"):
        monkeypatch.setattr(browser_parts, name, refuse)
    bare = RuntimeBundle({}, VERSIONS)
    monkeypatch.setattr(browser_python, "pack_runtime", lambda _root, **_shown: bare)
    warnings: list[Diagnostic] = []
    options = make_book("::::{simulation} demo\nText.\n::::\n")
    files = render_site(replace(options, runtime=True, search=True, warn=warnings.append))
    page = content_bytes(files["first/index.html"])
    assert b"data-editor" not in page
    assert b"data-search" not in page
    assert any(name.endswith("python/demo.json") for name in files), "the code can still be read"
    assert not any(name.startswith("search/") for name in files)
    assert ["no network" in str(warning) for warning in warnings] == [True, True]


def record(number: int) -> Record:
    return Record(
        id=number,
        address=f"page/#{number}",
        chapter="Page",
        title="Title",
        introduced=(),
        explains=(),
        asked=(),
        text="Some text.",
        figures="",
        questions="",
    )


def test_index_has_every_section_and_a_fault_under_node_is_reported(tmp_path: Path) -> None:
    library = fetch_library("en")
    records = ((record(0), record(1)), (record(2),))
    assert json.loads(index_of(records, library, ENGLISH))["documentCount"] == 3
    missing = SearchLibrary({**library.scripts, "stemmer.js": tmp_path / "missing.js"})
    with pytest.raises(RuntimeError, match="missing"):
        index_of(records, missing, ENGLISH)
    assert set(STEMMERS) == set(languages())


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_sources_of_a_scene_include_every_definition_as_in_its_file(scene_id: str) -> None:
    scene = load_scene(scene_id)
    found: Any = json.loads(scene_sources(scene))
    for item in found["definitions"].values():
        lines = (ROOT / item["path"]).read_text(encoding="utf-8").split("\n")
        text = item["text"].split("\n")
        assert lines[item["line"] - 1 : item["line"] - 1 + len(text)] == text
    named = {found["draw"], *(stage["definition"] for stage in found["stages"])}
    named |= {key for item in found["definitions"].values() for key in item["uses"]}
    assert named == set(found["definitions"])
    assert [stage["name"] for stage in found["stages"]] == [stage.name for stage in scene.stages]


OPTICS = """\
INDEX = 1.5


def bend(angle):
    return angle / INDEX


def spread(bend):
    return 2 * bend
"""
FIGURE = """\
from simulations.small import optics
from simulations.small.optics import spread as widened


def both(spread):
    return optics.bend(spread) + widened(spread)


def one(optics):
    return optics.bend
"""


@pytest.fixture
def rewritable_modules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Two modules that readers may rewrite."""
    monkeypatch.setattr(definitions, "ROOMS", ("small",))
    with small_package(tmp_path, {"optics": OPTICS, "figure": FIGURE}):
        yield


@pytest.mark.usefixtures("rewritable_modules")
@pytest.mark.parametrize(
    ("name", "uses"),
    [
        ("figure:both", ["optics:bend", "optics:spread"]),
        ("optics:bend", ["optics:INDEX"]),
        ("figure:one", []),
        ("optics:spread", []),
    ],
)
def test_uses_are_found_through_imports_but_not_in_argument_names(
    name: str, uses: list[str]
) -> None:
    assert list(uses_of(f"{PACKAGE}.{name}")) == [f"{PACKAGE}.{one}" for one in uses]
    assert "optics" in read_module(f"{PACKAGE}.figure").imported
