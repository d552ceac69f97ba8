"""A build with a cache makes what one without makes, whatever was edited since."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import pytest
from support.little_book import files_of

from simulations.registry import load_scene
from site_builder.build import Options, render_site
from site_builder.cache import hashing
from site_builder.cache.results import Cache, using
from site_builder.diagnostics.diagnostic import BuildError
from site_builder.document.book import Chapter
from site_builder.markdown.chapter import Draft, read_chapter
from site_builder.markdown.targets import Targets
from site_builder.output.assets import content_bytes
from site_builder.sources import chapters

EDITS = {
    "a sentence": ("content/00-first.md", "is small", "is tiny"),
    "the title of a section": ("content/00-first.md", "## A section", "## The section"),
    "the title of a chapter": ("content/01-second.md", "title: Second", "title: The second"),
    "a setting of a figure": ("content/01-second.md", ":amount: 20", ":amount: 25"),
    "a picture": ("content/images/plan.svg", "0 0 40 30", "0 0 80 30"),
    "the bibliography": ("content/references.bib", "A flexible", "One flexible"),
    "the glossary": ("content/glossary.toml", "A small hole.", "A hole."),
    "the title of the book": ("content/book.toml", "Small Book", "Little Book"),
    "a mistake": ("content/01-second.md", "{ref}`a-section`", "{ref}`no-section`"),
}
type Built = Mapping[str, bytes] | str


@pytest.fixture
def book(make_book: Callable[..., Options], monkeypatch: pytest.MonkeyPatch) -> Options:
    monkeypatch.setattr(hashing, "STARTED_NS", float("inf"))  # else sources may be too young
    return replace(make_book(files=files_of("cached")), load_scene=load_scene)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def read(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Titles of the chapters that are read and not found in the cache."""
    titles: list[str] = []

    def note(draft: Draft, targets: Targets) -> Chapter:
        titles.append(draft.matter.title)
        return read_chapter(draft, targets)

    monkeypatch.setattr(chapters, "read_chapter", note)
    return titles


def built(options: Options, store: Cache | None = None) -> Built:
    """The files of the site, or its mistakes."""
    try:
        with using(store):
            files = render_site(options)
    except BuildError as error:
        return str(error)
    return {name: content_bytes(content) for name, content in files.items()}


@pytest.mark.parametrize(("path", "old", "new"), EDITS.values(), ids=EDITS)
def test_a_cached_build_is_a_clean_one(
    path: str, old: str, new: str, book: Options, folder: Path
) -> None:
    file = book.root / path
    first = built(book, Cache(folder))
    file.write_text(file.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    second = built(book, Cache(folder))
    assert second != first
    assert second == built(book)


def test_a_chapter_is_read_again_only_when_it_changes(
    book: Options, tmp_path: Path, read: list[str]
) -> None:
    built(book, Cache(tmp_path))
    read.clear()
    file = book.root / "content/00-first.md"
    file.write_text(file.read_text().replace("is small", "is tiny"), encoding="utf-8")
    built(book, Cache(tmp_path))
    assert read == ["First"]


@pytest.mark.parametrize(("scene", "chapters"), [("transform_2d", ["Second"]), ("brdf", [])])
def test_the_code_of_a_scene_concerns_the_chapters_that_name_it(
    scene: str, chapters: list[str], book: Options, tmp_path: Path, read: list[str]
) -> None:
    file = book.root / "simulations" / "scenes" / scene / "stages.py"
    file.parent.mkdir(parents=True)
    file.write_text("first", encoding="utf-8")
    built(book, Cache(tmp_path))
    read.clear()
    file.write_text("second", encoding="utf-8")
    built(book, Cache(tmp_path))
    assert read == chapters
