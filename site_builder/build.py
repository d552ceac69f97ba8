"""The build, from sources to files: read, check, render, write. Start here.

All pages are checked before one is written, so a mistake anywhere leaves the last good site as
it was. `render_site` touches no output folder: it returns the site in memory.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from simulations.engine.ladder import Ladder
from simulations.engine.scene import Scene
from simulations.registry import load_ladder, load_scene
from site_builder.benchmarks.measurements import read_measurements
from site_builder.book import Book
from site_builder.book_root import own_or_engine
from site_builder.browser_python import pack_for_browser, shown_ladders
from site_builder.charts.pareto import pareto_chart
from site_builder.checks.declared import check_declarations
from site_builder.checks.frames import check_frames
from site_builder.checks.pictures import check_pictures
from site_builder.checks.purity import check_purity
from site_builder.checks.whole_book import check_book
from site_builder.diagnostics import BuildError, Diagnostic, Diagnostics
from site_builder.editor.bundle import EditorBundle, EditorBundleError, bundle_editor
from site_builder.editor.npm import NodeError
from site_builder.editor.sources import scene_sources
from site_builder.kept.ahead import Ask, helpers
from site_builder.kept.keeper import kept_as, reads_folder, was_made
from site_builder.kept.told import kept_reading
from site_builder.offline.manifest import MANIFEST, manifest
from site_builder.offline.release import no_release, release_files
from site_builder.output.assets import hashed_folder
from site_builder.output.joined_scripts import join_scripts
from site_builder.output.writer import write_site
from site_builder.pages.catalogue import catalogue
from site_builder.pages.initial_frames import InitialFrames, render_initial_frames
from site_builder.pages.licences import Licence, gather_licences
from site_builder.pages.render import Site, page_makers, render_pages, render_template
from site_builder.publishing.cards import make_cards
from site_builder.publishing.compressed import compressed_copies
from site_builder.publishing.hosting import host_files
from site_builder.publishing.icons import make_icons
from site_builder.publishing.listings import make_listings
from site_builder.runtime.pack import RuntimeBundle
from site_builder.runtime.pinned import Versions
from site_builder.search.index import ADDRESS as SEARCH_INDEX
from site_builder.search.index import Indexer, index_of, indexing
from site_builder.search.library import SearchLibrary, SearchLibraryError, fetch_library
from site_builder.search.records import PageRecords, explained_terms, make_records
from site_builder.site_assets import (
    NOW,
    SCRIPT,
    Files,
    gather_assets,
    handed_out,
    in_page,
    strips_of,
)
from site_builder.source import read_book
from site_builder.tools import tools

RUNTIME_NOW = "runtime/now/"
"""Likewise of the browser's Python: a changed scene changes the pages that show it."""
LIBRARY = "search"
"""Folder of what searches, among the assets."""
type Write = Callable[[Files, Path], object]
type Warn = Callable[[Diagnostic], None]


def ignore(_warning: Diagnostic) -> None:
    """Where nobody reads warnings."""


@dataclass(frozen=True, slots=True)
class Options:
    """What one build is made from and how."""

    root: Path
    """The book's folder: holds ``content/`` and ``simulations/``."""
    runtime: bool = True
    """Whether to ship Python for the browser; without it figures stay stills."""
    reload: bool = False
    """Whether pages reload themselves after a rebuild (``serve``)."""
    load_scene: Callable[[str], Scene[Any]] = load_scene
    load_ladder: Callable[[str], Ladder] = load_ladder
    warn: Warn = ignore
    """Told each warning once, in the order of files and lines."""
    search: bool = True
    """Whether pages can be searched."""
    address: str = ""
    """Where the site will be, in place of what the book says."""
    source: str = ""
    """Where its sources can be read, likewise."""


def build_site(
    root: Path,
    out: Path,
    *,
    runtime: bool = True,
    reload: bool = False,
    warn: Warn = ignore,
    write: Write = write_site,
    address: str = "",
    source: str = "",
) -> Files:
    """Build the book at ``root`` into the folder ``out``. Raises `BuildError`."""
    files = render_site(
        Options(root, runtime=runtime, reload=reload, warn=warn, address=address, source=source)
    )
    write(files, out)
    return files


@dataclass(frozen=True, slots=True)
class RenderedSite:
    """The site, with its search still to be made: that takes longer than all else of a rebuild."""

    files: Files
    records: Callable[[], PageRecords]
    """What can be found; nothing where there is no search."""
    index: Callable[[PageRecords], Files]
    """Of these records; nothing where there is no search."""
    finish: Callable[[Files], Files]
    """What follows from all files."""
    again: Sequence[Ask] = ()
    """What has to be made again, besides drawings, once any code of the book has changed."""


def render_site(options: Options) -> Files:
    """Every file of the site. Raises `BuildError` with all mistakes found."""
    with Indexer() as indexer:
        site = render_parts(options, indexer)
        files = {**site.files, **site.index(site.records())}
    return {**files, **site.finish(files)}


def render_parts(options: Options, indexer: Indexer | None = None) -> RenderedSite:
    """The site in parts. Raises `BuildError` with all mistakes found. An ``indexer`` begins with
    pages as they are made; without one, nobody waits for what can be searched."""
    with helpers() as beside:
        wanted = {"runtime": options.runtime, "search": options.search}
        beside.begin([*tools(options.root, **wanted, compiled=not options.reload)])
        book, initial_frames, pictures = check_site(options)
        beside.begin([*_charts(book), *_sources(options, book)])
        beside.join()
    runtime, runtime_files, bundle = _runtime(options, book)
    editor, library = _editor(options, book), _search_library(options, book)
    scripts = {f"{LIBRARY}/{name}": path for name, path in library.scripts.items()}
    made = {
        **_python(options, book, editor),
        **scripts,
        **handed_out(book, options.root),
        **strips_of(initial_frames),
        **make_icons(options.root),
    }
    folder = NOW if options.reload else ""
    # While the book is written, a changed script is sent by itself.
    join: Callable[[Files], Files] = dict if folder else partial(_joined, options)
    assets, asset_files = gather_assets(book, options.root, pictures, made, folder, join)
    site = Site(
        options.root, book, initial_frames, assets, runtime, code_editor=bool(editor.script),
        # A changed scene would change all pages that say what it was.
        sources="" if options.reload else bundle.sources,
        table="" if options.reload else bundle.table,
        search=bool(scripts), reload=options.reload,
        **in_page(asset_files, assets, reload=options.reload),
    )  # fmt: skip
    licences = _licences(options.root, bundle.versions, editor, library, book)
    means = (
        indexing(library, own_or_engine(options.root, "static"), book.words) if scripts else None
    )
    makers = page_makers(site, licences, indexer.hear if means and indexer else None)
    if means and indexer and was_made():
        indexer.begin(means, explained_terms(book), makers)
    pages = render_pages(makers)

    def records() -> PageRecords:
        return make_records(pages, explained_terms(book)) if means else ()

    def index(records: PageRecords) -> Files:
        maker = indexer or Indexer()
        return {SEARCH_INDEX: index_of(records, means, maker)} if means else {}

    files = {
        **pages,
        **_outside(options, book, pages, initial_frames, pictures),
        **asset_files,
        **runtime_files,
        "book.json": catalogue(book, bundle.versions),
        MANIFEST: manifest(book.title, book.subtitle, assets, book.words.language),
    }
    return RenderedSite(
        files,
        records,
        index,
        lambda files: no_release(assets) if options.reload else _finished(files, assets, book),
        (
            partial(_runtime, options, book),
            partial(_check_declared, options.root, Diagnostics()),
        ),
    )


def _finished(files: Files, assets: str, book: Book) -> Files:
    """What makes the files a release, and what their host is given beside them."""
    release = release_files(files, assets)
    whole = {**files, **release}
    copies = compressed_copies(whole) if book.settings.publishing.compressed else {}
    return {**release, **host_files(whole, book), **copies}


def check_site(options: Options) -> tuple[Book, InitialFrames, dict[str, bytes]]:
    """Read and check everything, figures drawn included. Raises `BuildError`."""
    problems = Diagnostics()
    _check_declared(options.root, problems)
    measurements = read_measurements(options.root, problems, options.load_ladder)
    book = read_book(options.root, problems, options.load_scene, measurements)
    check_book(book, problems)
    check_pictures(options.root, problems, trusted=book.settings.trust.raw_html)
    initial_frames, pictures = render_initial_frames(
        book, problems, strips=options.runtime and not options.reload
    )
    check_frames(book, initial_frames, own_or_engine(options.root, "static"), problems)
    for warning in sorted(set(problems.doubts)):
        options.warn(warning)
    if problems:
        raise BuildError(problems.found)
    book = replace(
        book, address=options.address or book.address, source=options.source or book.source
    )
    return book, initial_frames, pictures


def _check_declared(root: Path, problems: Diagnostics) -> None:
    def check(own: Diagnostics) -> None:
        reads_folder(root / "simulations")
        check_declarations(root, own)
        check_purity(root / "simulations", own)

    kept_reading("declared", str(root), problems, check)


def _runtime(options: Options, book: Book) -> tuple[str, Files, RuntimeBundle]:
    """Python for the browser, with the scenes and ladders inside that the book shows."""
    root, compiled = options.root, not options.reload
    bundle = pack_for_browser(root, book, compiled=compiled) if options.runtime else None
    if bundle is None:
        return "", {}, RuntimeBundle({}, Versions())
    if bundle.snapshot_error:
        told = f"figures live later at a first visit: {bundle.snapshot_error}"
        options.warn(Diagnostic("site_builder/runtime/memory.mjs", 1, told, fails=False))
    if options.reload:
        there: Files = {RUNTIME_NOW + name: content for name, content in bundle.files.items()}
        return RUNTIME_NOW, there, bundle
    folder, files = hashed_folder("runtime", dict(bundle.files))
    return folder, files, bundle


def _licences(
    root: Path, versions: Versions, editor: EditorBundle, search: SearchLibrary, book: Book
) -> tuple[Licence, ...]:
    given = (versions, editor.packages, search.packages, book.settings, book.words)

    def gather() -> tuple[Licence, ...]:
        return gather_licences(root, *given)

    return kept_as("licences", given, gather)[0]


def _editor(options: Options, book: Book) -> EditorBundle:
    """The code editor of the figures; where it cannot be had, a warning, and they do without."""
    if not (options.runtime and book.scenes):
        return EditorBundle()
    try:
        return bundle_editor()
    except EditorBundleError as error:
        told = f"the figures' Python can be read but not edited, for want of the editor: {error}"
        options.warn(Diagnostic("site_builder/editor/package-lock.json", 1, told, fails=False))
        return EditorBundle()


def _joined(options: Options, files: Files) -> Files:
    """With the page's scripts in few files; where what joins them cannot be had, a warning, and
    pages load them one by one."""
    try:
        return join_scripts(files, SCRIPT)
    except NodeError as error:
        told = f"pages load somewhat later, since their scripts could not be joined: {error}"
        options.warn(Diagnostic("site_builder/editor/package-lock.json", 1, told, fails=False))
        return files


def _search_library(options: Options, book: Book) -> SearchLibrary:
    """What searches the pages; where it cannot be had, a warning, and they do without."""
    if not options.search:
        return SearchLibrary({})
    try:
        return fetch_library(book.words.language)
    except SearchLibraryError as error:
        told = f"the book cannot be searched, for want of the library: {error}"
        options.warn(Diagnostic("site_builder/search/package-lock.json", 1, told, fails=False))
        return SearchLibrary({})


def _charts(book: Book) -> list[Ask]:
    return [partial(pareto_chart, item.measured, book.words) for item in shown_ladders(book)]


def _outside(
    options: Options,
    book: Book,
    pages: Files,
    initial_frames: InitialFrames,
    pictures: Mapping[str, bytes],
) -> Files:
    """What others see of a site that has an address."""
    if not book.address:
        return {}
    return {
        **make_listings(book, pages),
        **make_cards(book, initial_frames, pictures, options.root),
    }


def _sources(options: Options, book: Book) -> list[Ask]:
    """In one, since scenes share modules."""
    shown = book.scenes if options.runtime else ()
    return [lambda: [scene_sources(scene) for scene in shown]]


def _python(options: Options, book: Book, editor: EditorBundle) -> Files:
    """What opens the Python of the figures: the sources of each scene, and the code editor."""
    if not (options.runtime and book.scenes):
        return {}
    script = {"editor/code_editor.js": editor.script} if editor.script else {}
    return {
        "js/editor/workshop.html": render_template("editor/workshop.html", book).encode(),
        **{f"python/{scene.id}.json": scene_sources(scene) for scene in book.scenes},
        **script,
    }
