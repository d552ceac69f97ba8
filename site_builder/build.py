"""The build, from sources to files: read, check, render, write. Start here.

All pages are checked before one is written, so a mistake anywhere leaves the last good site as
it was. `render_site` touches no output folder: it returns the site in memory.
"""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from simulations.engine.ladder import Ladder
from simulations.engine.scene import Scene
from simulations.registry import LADDER_MODULES, SCENE_MODULES, load_ladder, load_scene
from site_builder.blame import place_of
from site_builder.book import Book
from site_builder.book_root import ENGINE, own_or_engine
from site_builder.charts.pareto import pareto_chart
from site_builder.checks.declared import check_declarations
from site_builder.checks.frames import check_frames
from site_builder.checks.pictures import check_pictures
from site_builder.checks.purity import check_purity
from site_builder.checks.whole_book import check_book
from site_builder.diagnostics import BuildError, Diagnostic, Diagnostics
from site_builder.editor.bundle import EditorBundle, EditorBundleError, bundle_editor
from site_builder.editor.sources import scene_sources
from site_builder.kept.ahead import Ask, helpers
from site_builder.kept.files import folder_files, folder_hash
from site_builder.kept.keeper import kept_as, reads_folder
from site_builder.kept.told import kept_reading
from site_builder.markdown.directives.figure import SUFFIXES
from site_builder.markdown.directives.ladder import LadderFigure
from site_builder.measured.measurements import read_measurements
from site_builder.offline.manifest import MANIFEST, manifest
from site_builder.offline.release import SCRIPT as RELEASE_SCRIPT
from site_builder.offline.release import integrity, no_release, release_files
from site_builder.output.assets import Content, content_bytes, hashed_folder
from site_builder.output.book_files import book_css, book_script
from site_builder.output.font_faces import Face, chosen_faces, face_rule, used_maths
from site_builder.output.fonts import subset_fonts
from site_builder.output.scripts import imported_scripts, reachable
from site_builder.output.style_sheets import join_style_sheets, without_comments
from site_builder.output.writer import write_site
from site_builder.page_model.blocks import contents
from site_builder.pages.catalogue import catalogue
from site_builder.pages.features import kinds_script, parts_script, sheets_not_for, shown_in
from site_builder.pages.formulae import formula_characters
from site_builder.pages.licences import Licence, gather_licences
from site_builder.pages.render import Site, back_matter, render_pages, render_template
from site_builder.pages.stills import Stills, render_stills
from site_builder.publishing.cards import make_cards
from site_builder.publishing.compressed import compressed_copies
from site_builder.publishing.hosting import host_files
from site_builder.publishing.icons import make_icons
from site_builder.publishing.listings import make_listings
from site_builder.runtime.freeze import MissingModuleError
from site_builder.runtime.modules import Modules
from site_builder.runtime.pack import RuntimeBundle, pack_runtime
from site_builder.runtime.pinned import Versions
from site_builder.runtime.store import is_whole
from site_builder.search.index import ADDRESS as SEARCH_INDEX
from site_builder.search.index import index_of
from site_builder.search.library import SearchLibrary, SearchLibraryError, fetch_library
from site_builder.search.records import Record, explained_terms, make_records
from site_builder.source import read_book
from site_builder.tools import tools

RUNTIME = Path(__file__).parent / "runtime"
"""What makes it, with programs for other interpreters."""
NOW = "assets/now/"
"""Folder of the assets while the book is written: a changed style sheet changes no page."""
RUNTIME_NOW = "runtime/now/"
"""Likewise of the browser's Python: a changed scene changes the pages that show it."""
LIBRARY = "search"
"""Folder of what searches, among the assets."""
STYLE_SHEET = "css/book.css"
"""The one that pages hold or, while the book is written, link to, below ``static/``."""
SCRIPT = "js/main.js"
IN_HEAD = (SCRIPT,)
"""Scripts that the head of a page runs."""
ENTRIES = (SCRIPT, RELEASE_SCRIPT)
"""Scripts that something else than a script asks for."""

type Files = Mapping[str, Content]
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
    records: Callable[[], Sequence[Record]]
    """What can be found; nothing where there is no search."""
    index: Callable[[Sequence[Record]], Files]
    """Of these records; nothing where there is no search."""
    finish: Callable[[Files], Files]
    """What follows from all files."""


def render_site(options: Options) -> Files:
    """Every file of the site. Raises `BuildError` with all mistakes found."""
    site = render_parts(options)
    files = {**site.files, **site.index(site.records())}
    return {**files, **site.finish(files)}


def render_parts(options: Options) -> RenderedSite:
    """The site in parts. Raises `BuildError` with all mistakes found."""
    with helpers() as beside:
        wanted = {"runtime": options.runtime, "search": options.search}
        beside.begin([*tools(options.root, **wanted, compiled=not options.reload)])
        book, stills, pictures = check_site(options)
        beside.begin([*_charts(book), *_sources(options, book)])
        beside.join()
    runtime, runtime_files, bundle = _runtime(options, book)
    editor, library = _editor(options, book), _search_library(options, book)
    scripts = {f"{LIBRARY}/{name}": path for name, path in library.scripts.items()}
    made = {
        **_python(options, book, editor),
        **scripts,
        **_handed_out(options, book),
        **_strips(stills),
        **make_icons(options.root),
    }
    folder = NOW if options.reload else ""
    assets, asset_files = gather_assets(book, options.root, pictures, made, folder)
    site = Site(
        options.root, book, stills, assets, runtime, code_editor=bool(editor.script),
        # A changed scene would change all pages that say what it was.
        sources="" if options.reload else bundle.sources,
        search=bool(scripts), reload=options.reload,
        **_in_page(asset_files, assets, options),
    )  # fmt: skip
    licences = _licences(options.root, bundle.versions, editor, library, book)
    pages = render_pages(site, licences)
    static = own_or_engine(options.root, "static")

    def records() -> Sequence[Record]:
        return make_records(pages, explained_terms(book)) if scripts else ()

    def index(records: Sequence[Record]) -> Files:
        return {SEARCH_INDEX: index_of(records, library, static, book.words)} if scripts else {}

    files = {
        **pages,
        **_outside(options, book, pages, stills, pictures),
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
    )


def _finished(files: Files, assets: str, book: Book) -> Files:
    """What makes the files a release, and what their host is given beside them."""
    release = release_files(files, assets)
    whole = {**files, **release}
    copies = compressed_copies(whole) if book.settings.publishing.compressed else {}
    return {**release, **host_files(whole, book), **copies}


def _in_page(files: Files, assets: str, options: Options) -> dict[str, Any]:
    """What a page holds of its assets, besides their addresses. While the book is written no more
    than the scripts' names, so that a changed style sheet changes no page."""
    scripts = _scripts(files, assets)
    if options.reload:
        return {"scripts": scripts}
    sheet = content_bytes(files[assets + STYLE_SHEET]).decode("utf-8")
    named = {name: files[assets + name] for name in (*IN_HEAD, *scripts) if assets + name in files}
    hashes = {name: integrity(content_bytes(file)) for name, file in named.items()}
    return {"scripts": scripts, "styles": without_comments(sheet), "hashes": hashes}


def check_site(options: Options) -> tuple[Book, Stills, dict[str, bytes]]:
    """Read and check everything, figures drawn included. Raises `BuildError`."""
    problems = Diagnostics()
    _check_declared(options.root, problems)
    measurements = read_measurements(options.root, problems, options.load_ladder)
    book = read_book(options.root, problems, options.load_scene, measurements)
    check_book(book, problems)
    check_pictures(options.root, problems, trusted=book.settings.trust.raw_html)
    stills, pictures = render_stills(book, problems, strips=options.runtime and not options.reload)
    check_frames(book, stills, own_or_engine(options.root, "static"), problems)
    for warning in sorted(set(problems.doubts)):
        options.warn(warning)
    if problems:
        raise BuildError(problems.found)
    book = replace(
        book, address=options.address or book.address, source=options.source or book.source
    )
    return book, stills, pictures


def _check_declared(root: Path, problems: Diagnostics) -> None:
    def check(own: Diagnostics) -> None:
        reads_folder(root / "simulations")
        check_declarations(root, own)
        check_purity(root / "simulations", own)

    kept_reading("declared", str(root), problems, check)


def gather_assets(
    book: Book, root: Path, pictures: Mapping[str, bytes], made: Files, folder: str = ""
) -> tuple[str, Files]:
    """Style sheets, scripts, fonts, stills, the author's pictures, what opens the figures' Python
    and what searches, in one folder: ``folder``, or one that is named by what is in it."""
    content = folder_files(root / "content")
    # While the book is written, a new letter in a formula is to change no style sheet.
    used = () if folder else (used_maths(formula_characters(book)),)
    files: Files = {
        **_engine_files(book, folder_files(own_or_engine(root, "static")), used),
        **{
            f"fonts/{name}": data
            for name, data in subset_fonts((*chosen_faces(book.settings, root), *used)).items()
        },
        **{f"stills/{name}": data for name, data in pictures.items()},
        **{f"content/{name}": file for name, file in content.items() if name.endswith(SUFFIXES)},
        **made,
    }
    if folder:
        return folder, {folder + name: content for name, content in files.items()}
    return hashed_folder("assets", files)


def _engine_files(book: Book, static: Files, faces: Iterable[Face]) -> Files:
    """Of the engine's style sheets and scripts those that the book uses, with rules for ``faces``
    that are the book's own."""
    shown = shown_in(book, dict(back_matter(book)))
    own = book_css(book.settings, book.words) + "".join(map(face_rule, faces))
    files = {
        **join_style_sheets(static, STYLE_SHEET, own, without=sheets_not_for(shown)),
        "js/book.js": book_script(book.settings, book.words),
        "js/book_parts.js": parts_script(shown),
        "js/question/book_kinds.js": kinds_script(shown),
    }
    used = reachable(files, ENTRIES) | {STYLE_SHEET}
    loaded = ("css/", "js/")
    return {
        name: file for name, file in files.items() if name in used or not name.startswith(loaded)
    }


def _scripts(files: Files, assets: str) -> tuple[str, ...]:
    """What pages run at once, below the folder ``assets``."""
    return imported_scripts({name.removeprefix(assets): files[name] for name in files}, SCRIPT)


def _strips(stills: Stills) -> Files:
    strips = [still.strip for still in stills.values() if still.strip]
    return {f"strips/{strip.file}": strip.data for strip in strips}


def _handed_out(options: Options, book: Book) -> Files:
    """The author's films, captions and downloads."""
    names = {name for chapter in book.chapters for name in chapter.files}
    return {f"content/{name}": options.root / "content" / name for name in sorted(names)}


def _runtime(options: Options, book: Book) -> tuple[str, Files, RuntimeBundle]:
    """Python for the browser, with the scenes and ladders inside that the book shows."""
    root, compiled = options.root, not options.reload
    bundle = pack_for_browser(root, book, compiled=compiled) if options.runtime else None
    if bundle is None:
        return "", {}, RuntimeBundle({}, Versions())
    if options.reload:
        there: Files = {RUNTIME_NOW + name: content for name, content in bundle.files.items()}
        return RUNTIME_NOW, there, bundle
    folder, files = hashed_folder("runtime", dict(bundle.files))
    return folder, files, bundle


def pack_for_browser(root: Path, book: Book, *, compiled: bool) -> RuntimeBundle | None:
    """What the browser runs, with the scenes and ladders inside that the book shows; None of a book
    that shows none. An author who tries a change does not wait until it is ``compiled``. Raises
    `BuildError` where the browser could not run it."""
    scenes = {scene.id for scene in book.scenes}
    ladders = {item.measured.ladder.id for item in _shown(book, LadderFigure)}
    if not (scenes or ladders):
        return None
    try:
        return _bundle(
            root / "simulations",
            _only(SCENE_MODULES, scenes),
            _only(LADDER_MODULES, ladders),
            compiled=compiled,
        )
    except MissingModuleError as error:
        path, _, line = error.place.rpartition(":")
        told = f"{error.message}; legal: its standard library, and numpy"
        raise BuildError([Diagnostic(path, int(line), told)]) from error
    except SyntaxError as error:  # in a module that no chapter shows
        path, _, line = place_of(error).rpartition(":")
        raise BuildError([Diagnostic(path, int(line), f"no Python: {error.msg}")]) from error


def _bundle(
    simulations: Path, scenes: Modules, ladders: Modules, *, compiled: bool
) -> RuntimeBundle:
    """The runtime, packed anew where nothing is kept of these sources or files of it are gone."""

    def pack() -> RuntimeBundle:
        reads_folder(RUNTIME)
        return pack_runtime(simulations, scenes=scenes, ladders=ladders, compiled=compiled)

    sources = [folder_hash(folder, "*.py") for folder in (simulations, ENGINE / "simulations")]
    bundle = kept_as("runtime", (sources, scenes, ladders, compiled), pack)[0]
    return bundle if all(map(is_whole, bundle.files.values())) else pack()


def _licences(
    root: Path, versions: Versions, editor: EditorBundle, search: SearchLibrary, book: Book
) -> tuple[Licence, ...]:
    given = (versions, editor.packages, search.packages, book.settings, book.words)

    def gather() -> tuple[Licence, ...]:
        return gather_licences(root, *given)

    return kept_as("licences", given, gather)[0]


def _shown[T](book: Book, kind: type[T]) -> list[T]:
    return [item for chapter in book.chapters for item in contents(chapter.body, kind)]


def _only(modules: Mapping[str, str], shown: Collection[str]) -> dict[str, str]:
    return {name: module for name, module in modules.items() if name in shown}


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
    shown = _shown(book, LadderFigure)
    return [partial(pareto_chart, item.measured, book.words) for item in shown]


def _outside(
    options: Options, book: Book, pages: Files, stills: Stills, pictures: Mapping[str, bytes]
) -> Files:
    """What others see of a site that has an address."""
    if not book.address:
        return {}
    return {**make_listings(book, pages), **make_cards(book, stills, pictures, options.root)}


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
