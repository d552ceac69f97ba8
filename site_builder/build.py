"""The build: load, check, render, assemble, write. Start here.

Each stage is a function from one frozen value to the next. All pages are checked before one is
written, so a mistake anywhere leaves the last good site as it was. `render_site` touches no output
folder: it returns the site in memory.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from dataclasses import KW_ONLY, dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

from simulations.engine.ladder import Ladder
from simulations.engine.scene import Scene
from simulations.registry import load_ladder, load_scene
from site_builder.assets.browser_parts import (
    BrowserParts,
    browser_parts,
    pack_for_browser,
    scene_files,
)
from site_builder.assets.page_assets import NOW, Files, gather_assets, page_parts, prerendered_files
from site_builder.benchmarks.measurements import read_measurements
from site_builder.cache.results import cached_result
from site_builder.checks.frames import check_data, check_frames
from site_builder.checks.pictures import check_pictures
from site_builder.checks.whole_book import check_book, check_skeletons
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.document.book import Book
from site_builder.figures.initial_frames import InitialFrames, describing, render_initial_frames
from site_builder.files.engine import static_files
from site_builder.files.folders import file_hash
from site_builder.files.text import Sources
from site_builder.output.writer import write_site
from site_builder.pages.licences import Licence, gather_licences
from site_builder.pages.render import render_pages
from site_builder.pages.single_page import Site
from site_builder.pages.views.question import catalogue
from site_builder.photographs import credits_of
from site_builder.publishing.hosting import (
    MANIFEST,
    compressed_copies,
    host_files,
    make_listings,
    manifest,
    no_release,
    release_files,
)
from site_builder.publishing.vector import make_cards, make_icons
from site_builder.raw.decoder import FOLDER
from site_builder.runtime.pack import RuntimeBundle
from site_builder.search.index import SearchLibrary, index_of, make_records
from site_builder.sources.book import read_book

LIBRARY = "search"
"""Folder of what searches, among the assets."""
type Warn = Callable[[Diagnostic], None]


def ignore(_warning: Diagnostic) -> None:
    """For builds without warnings."""


@dataclass(frozen=True, slots=True)
class Options:
    """What one build is made from and how."""

    root: Path
    """The book's folder: holds ``content/`` and ``simulations/``."""
    _: KW_ONLY
    runtime: bool = True
    """Whether to ship Python for the browser; without it figures stay stills."""
    reload: bool = False
    """Whether pages reload themselves after a rebuild (``serve``)."""
    load_scene: Callable[[str], Scene[Any]] = load_scene
    load_ladder: Callable[[str], Ladder] = load_ladder
    warn: Warn = ignore
    """Called once with each warning, in the order of files and lines."""
    search: bool = True
    """Whether pages can be searched."""
    address: str = ""
    """The site's address, in place of the book's own."""
    source: str = ""
    """Where its sources can be read, likewise."""


def build_site(options: Options, out: Path) -> Files:
    """Build the book into the folder ``out``. Raises `BuildError`."""
    files = render_site(options)
    write_site(files, out)
    return files


class LoadedBook(NamedTuple):
    """The book as it was read, and the mistakes so far."""

    book: Book
    sources: Sources


class CheckedBook(NamedTuple):
    """A book without mistakes, its figures drawn."""

    book: Book
    initial_frames: InitialFrames
    pictures: Mapping[str, bytes]
    """Pictures of the initial frames, by file name."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RenderedSite:
    """The pages and all that they load."""

    checked: CheckedBook
    options: Options
    parts: BrowserParts
    assets: str
    """Folder of style sheets, scripts, fonts and pictures, below the site's root."""
    pages: Mapping[str, bytes]
    files: Files
    """The assets and the browser's Python."""
    search_index: Future[Files]


def render_site(options: Options) -> Files:
    """Every file of the site. Raises `BuildError` with all mistakes found.

    What runs under Node does so beside this process: the browser's Python is packed while figures
    are drawn, the search index is made while pages are rendered.
    """
    with ThreadPoolExecutor() as threads:
        loaded = load(options)
        bundle = threads.submit(_pack, loaded.book, options)
        checked = check_loaded(loaded, options)
        return assemble(render(checked, options, bundle.result(), threads))


def check_site(options: Options) -> CheckedBook:
    """Read and check everything, figures drawn included. Raises `BuildError`."""
    return check_loaded(load(options), options)


def load(options: Options) -> LoadedBook:
    sources = Sources(options.root)
    measurements = read_measurements(sources, options.load_ladder)
    book = read_book(sources, options.load_scene, measurements)
    return LoadedBook(book, sources)


def check_loaded(loaded: LoadedBook, options: Options) -> CheckedBook:
    """Raises `BuildError` with all mistakes found."""
    book, sources = loaded
    problems = sources.problems
    check_book(book, problems)
    check_skeletons(sources, book)
    check_data(sources)
    check_pictures(sources)
    initial_frames, pictures = render_initial_frames(
        book, problems, prerendered=options.runtime and not options.reload
    )
    check_frames(book, initial_frames, static_files(options.root), problems)
    for warning in sorted(set(problems.doubts)):
        options.warn(warning)
    if problems:
        raise BuildError(problems.found)

    address, source = options.address or book.address, options.source or book.source
    return CheckedBook(replace(book, address=address, source=source), initial_frames, pictures)


def _pack(book: Book, options: Options) -> RuntimeBundle | None:
    if not options.runtime:
        return None
    return pack_for_browser(options.root, book, options.warn, compiled=not options.reload)


def render(
    checked: CheckedBook, options: Options, bundle: RuntimeBundle | None, threads: Executor
) -> RenderedSite:
    book, initial_frames, pictures = checked
    root, reload = options.root, options.reload
    parts = browser_parts(book, bundle, options.warn, search=options.search, reload=reload)
    search_index = threads.submit(_search_index, checked, parts.search)
    made = {
        **(scene_files(book, parts.editor) if options.runtime else {}),
        **{f"{LIBRARY}/{name}": path for name, path in parts.search.scripts.items()},
        **{f"{FOLDER}{name}": path for name, path in parts.decoder.files.items()},
        **prerendered_files(initial_frames),
        **make_icons(root),
    }

    assets = gather_assets(book, root, pictures, made, NOW if reload else "")
    site = Site(
        root=root,
        book=book,
        initial_frames=initial_frames,
        assets=assets.folder,
        runtime=parts.runtime,
        # With them a changed scene would change all pages.
        sources="" if reload else parts.bundle.sources,
        table="" if reload else parts.bundle.table,
        code_editor=bool(parts.editor.script),
        search=bool(parts.search.scripts),
        reload=reload,
        **page_parts(assets, reload=reload),
    )
    pages = render_pages(site, _licences(root, parts, book))
    files = {**assets.files, **parts.runtime_files}
    return RenderedSite(
        checked=checked,
        options=options,
        parts=parts,
        assets=assets.folder,
        pages=pages,
        files=files,
        search_index=search_index,
    )


def _search_index(checked: CheckedBook, library: SearchLibrary) -> Files:
    if not library.scripts:
        return {}
    book = checked.book
    records = make_records(book, describing(checked.initial_frames))
    return {"search/index.json": index_of(records, library, book.words)}


def assemble(site: RenderedSite) -> Files:
    """The pages, what they load, and what is made of these, in order: lists of what there is, what
    others see of a site that has an address, the search index, what stores the site for use
    offline, and what the host is given beside it."""
    book, initial_frames, pictures = site.checked
    reload, assets = site.options.reload, site.assets
    files = {
        **site.pages,
        **site.files,
        "book.json": catalogue(book, site.parts.bundle.versions),
        MANIFEST: manifest(book.title, book.subtitle, assets, book.words.language),
    }
    if book.address:
        files |= make_listings(book, site.pages)
        files |= make_cards(book, initial_frames, pictures, site.options.root)
    files |= site.search_index.result()
    if reload:
        return {**files, **no_release(assets)}
    files |= release_files(files, assets)
    copies = compressed_copies(files) if book.settings.publishing.compressed else {}
    return {**files, **host_files(files, book), **copies}


def _licences(root: Path, parts: BrowserParts, book: Book) -> tuple[Licence, ...]:
    built_in = (parts.editor.packages, parts.search.packages, parts.decoder.packages)
    given = (parts.bundle.versions, *built_in, parts.bundle.packages)

    def gather() -> tuple[Licence, ...]:
        return gather_licences(root, *given, book.settings, book.words)

    return cached_result(
        "licences",
        (*given, book.settings, book.words, file_hash(root / "LICENSE"), credits_of(root)),
        gather,
    )
