"""Parts of the site that a book's readers may use: the code editor, the search, the decoder of raw
files. Each is pinned, fetched once, and done without where it cannot be had."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from support.little_book import MakeBook
from support.places import ROOT
from support.small_package import PACKAGE, small_package

from simulations.editing import definitions
from simulations.registry import SCENE_MODULES, load_scene
from site_builder.assets import browser_parts
from site_builder.assets import browser_parts as browser_python
from site_builder.build import render_site
from site_builder.diagnostics.diagnostic import Diagnostic
from site_builder.editor.scene_code import read_module, scene_sources, uses_of
from site_builder.files.engine import ENGINE
from site_builder.languages.words import ENGLISH, languages
from site_builder.output.scripts import EditorBundle
from site_builder.output.writer import content_bytes
from site_builder.programs.node import NodeError
from site_builder.runtime.pack import RuntimeBundle
from site_builder.runtime.store import VERSIONS
from site_builder.search.index import (
    STEMMERS,
    Means,
    Record,
    SearchLibrary,
    fetch_library,
    index_of,
    indexing,
)


def test_every_package_is_pinned_by_a_hash_and_no_lock_names_an_address() -> None:
    for lock in (ENGINE / "site_builder").rglob("package-lock.json"):
        locked = json.loads(lock.read_text(encoding="utf-8"))["packages"]
        packages = [item for name, item in locked.items() if name]
        assert all(item["integrity"].startswith("sha512-") for item in packages), lock
        assert not any("resolved" in item for item in packages), lock


def test_without_editor_and_search_the_book_is_built_and_says_so(
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
    return Record(number, f"page/#{number}", "Page", "Title", (), (), "Some text.", "", "")


def test_the_index_has_every_section_and_a_fault_under_node_is_reported(tmp_path: Path) -> None:
    means = indexing(fetch_library("en"), ENGLISH)
    records = ((record(0), record(1)), (record(2),))
    assert json.loads(index_of(records, means))["documentCount"] == 3
    missing = Means((tmp_path / "missing.js", *means.scripts[1:]), ("", ""))
    with pytest.raises(RuntimeError, match="missing"):
        index_of(records, missing)
    assert set(STEMMERS) == set(languages())


@pytest.mark.parametrize("scene_id", SCENE_MODULES)
def test_readers_can_open_all_that_a_scene_names_as_it_stands_in_its_file(scene_id: str) -> None:
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
def small(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Two modules that readers may rewrite."""
    monkeypatch.setattr(definitions, "ROOMS", ("small",))
    with small_package(tmp_path, {"optics": OPTICS, "figure": FIGURE}):
        yield


@pytest.mark.usefixtures("small")
@pytest.mark.parametrize(
    ("name", "uses"),
    [
        ("figure:both", ["optics:bend", "optics:spread"]),
        ("optics:bend", ["optics:INDEX"]),
        ("figure:one", []),
        ("optics:spread", []),
    ],
)
def test_uses_are_found_through_imports_and_not_in_names_of_arguments(
    name: str, uses: list[str]
) -> None:
    assert list(uses_of(f"{PACKAGE}.{name}")) == [f"{PACKAGE}.{one}" for one in uses]
    assert "optics" in read_module(f"{PACKAGE}.figure").imported
