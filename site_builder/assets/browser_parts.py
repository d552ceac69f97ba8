"""What pages load besides their assets: Python, the code editor, the search, and the decoder of raw
files. One that cannot be fetched is left out, with a warning."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from site_builder.assets.pages import Files
from site_builder.diagnostics.diagnostic import Diagnostic
from site_builder.document.book import Book
from site_builder.editor.bundle import EditorBundle, bundle_editor
from site_builder.editor.scene_code import scene_sources
from site_builder.output.assets import hashed_folder
from site_builder.pages.environment import render_template
from site_builder.programs.node import NodeError
from site_builder.raw.decoder import RawDecoder, fetch_decoder
from site_builder.runtime.pack import RuntimeBundle
from site_builder.runtime.pinned import Versions
from site_builder.search.index import SearchLibrary, fetch_library

RUNTIME_NOW = "runtime/now/"
"""Folder of the browser's Python while the book is written: a changed scene changes only the pages
that show it."""
type Warn = Callable[[Diagnostic], None]


@dataclass(frozen=True, slots=True)
class BrowserParts:
    """Each empty where it is left out."""

    runtime: str
    """Folder of the browser's Python, below the site's root."""
    runtime_files: Files
    bundle: RuntimeBundle
    editor: EditorBundle
    search: SearchLibrary
    decoder: RawDecoder


def browser_parts(
    book: Book, bundle: RuntimeBundle | None, warn: Warn, *, search: bool, reload: bool
) -> BrowserParts:
    return BrowserParts(
        *_runtime(bundle, warn, reload=reload),
        bundle or RuntimeBundle({}, Versions()),
        _editor(warn) if bundle and book.scenes else EditorBundle(),
        _search_library(book, warn) if search else SearchLibrary({}),
        _decoder(warn) if bundle and _measures_photographs(book) else RawDecoder({}),
    )


def _measures_photographs(book: Book) -> bool:
    return any(scene.measures_photographs for scene in book.scenes)


def _or_without[T](make: Callable[[], T], without: T, part: str, message: str, warn: Warn) -> T:
    """What ``make`` returns; ``without`` it, and a warning, where its packages cannot be had."""
    try:
        return make()
    except NodeError as error:
        message = f"{message}; its packages could not be had from npm: {error}"
        warn(Diagnostic(f"site_builder/{part}/package-lock.json", 1, message, fails=False))
        return without


def _runtime(bundle: RuntimeBundle | None, warn: Warn, *, reload: bool) -> tuple[str, Files]:
    if bundle is None:
        return "", {}
    if bundle.snapshot_error:
        message = f"figures start later at a first visit: {bundle.snapshot_error}"
        warn(Diagnostic("site_builder/runtime/snapshot.mjs", 1, message, fails=False))
    if reload:
        return RUNTIME_NOW, {RUNTIME_NOW + name: file for name, file in bundle.files.items()}
    return hashed_folder("runtime", dict(bundle.files))


def _editor(warn: Warn) -> EditorBundle:
    message = "the figures' Python can be read but not edited"
    return _or_without(bundle_editor, EditorBundle(), "editor", message, warn)


def _search_library(book: Book, warn: Warn) -> SearchLibrary:
    message = "the book cannot be searched"
    fetch = partial(fetch_library, *(book.languages or (book.words.language,)))
    return _or_without(fetch, SearchLibrary({}), "search", message, warn)


def _decoder(warn: Warn) -> RawDecoder:
    message = "instruments open no raw files"
    return _or_without(fetch_decoder, RawDecoder({}), "raw", message, warn)


def scene_files(book: Book, editor: EditorBundle) -> Files:
    """What opens the Python of the figures: the sources of each scene, and the code editor."""
    if not book.scenes:
        return {}
    script = {"editor/code_editor.js": editor.script} if editor.script else {}
    return {
        "js/editor/workshop.html": render_template("editor/workshop.html", book).encode(),
        **{f"python/{scene.id}.json": scene_sources(scene) for scene in book.scenes},
        **script,
    }
