"""What pages load besides their assets: Python, the code editor, the search, and the decoder of raw
files. One that cannot be fetched is left out, with a warning."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from simulations.registry import LADDER_MODULES, SCENE_MODULES
from site_builder.assets.page_assets import Files
from site_builder.cache.results import cached_result
from site_builder.diagnostics.blame import place_of
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.document.blocks import contents
from site_builder.document.book import Book
from site_builder.editor.scene_code import scene_sources
from site_builder.files.engine import ENGINE
from site_builder.files.folders import folder_hash
from site_builder.files.text import Sources
from site_builder.markdown.directives.measured import LadderFigure
from site_builder.output.scripts import EditorBundle, bundle_editor
from site_builder.output.writer import hashed_folder
from site_builder.pages.environment import render_template
from site_builder.programs.node import NodeError
from site_builder.raw.decoder import RawDecoder, fetch_decoder
from site_builder.runtime.downloads import PackageError, differing
from site_builder.runtime.freeze import MissingModuleError
from site_builder.runtime.pack import PACKAGE, RuntimeBundle, pack_runtime
from site_builder.runtime.store import Versions, is_intact_file
from site_builder.search.index import SearchLibrary, fetch_library
from site_builder.settings.model import FILE_NAME, read_settings

type Warn = Callable[[Diagnostic], None]
RUNTIME = Path(__file__).parents[1] / "runtime"
"""What makes it, with programs for other interpreters."""


def pack_for_browser(root: Path, book: Book, warn: Warn, *, compiled: bool) -> RuntimeBundle | None:
    """What the browser runs, with the scenes and ladders inside that the book shows; None of a book
    that shows none. An author who tries a change does not wait until it is ``compiled``. Raises
    `BuildError` where the browser could not run it."""
    figures = (contents(chapter.body, LadderFigure) for chapter in book.chapters)
    shown = {each.measured.ladder.id for some in figures for each in some}
    if not (book.scenes or shown):
        return None
    scenes = _select(SCENE_MODULES, {scene.id for scene in book.scenes})
    ladders = _select(LADDER_MODULES, shown)
    simulations, packages = root / "simulations", book.settings.runtime.packages

    def pack() -> RuntimeBundle:
        return pack_runtime(
            simulations, scenes=scenes, ladders=ladders, compiled=compiled, packages=packages
        )

    folders = (simulations, ENGINE / "simulations")
    sources = [folder_hash(RUNTIME), *(folder_hash(folder, "*.py") for folder in folders)]
    try:
        bundle = cached_result("runtime", (sources, scenes, ladders, compiled, packages), pack)
        if bundle.snapshot_error or not all(map(is_intact_file, bundle.files.values())):
            bundle = pack()
    except PackageError as error:
        raise BuildError([_about_packages(root, str(error))]) from error
    except MissingModuleError as error:
        path, _, line = error.place.rpartition(":")
        expected = f"its standard library, numpy, and 'packages' of [runtime] in {FILE_NAME}"
        message = f"{error.message}; legal: {expected}"
        raise BuildError([Diagnostic(path, int(line), message)]) from error
    except SyntaxError as error:  # in a module that no chapter shows
        path, _, line = place_of(error).rpartition(":")
        raise BuildError([Diagnostic(path, int(line), f"no Python: {error.msg}")]) from error
    sizes = (file.stat().st_size for name, file in bundle.files.items() if name.startswith(PACKAGE))
    weight = sum(sizes)
    wait = f"{weight / 1e6:.1f} MB, for which readers of the figures that import them wait"
    heavy = f"packages of {wait}; better: at most {MOST_PACKAGES / 1e6:g} MB"
    for message in (*differing(bundle.packages), *([heavy] if weight > MOST_PACKAGES else [])):
        warn(_about_packages(root, message, fails=False))
    return bundle


MOST_PACKAGES = 5_000_000
"""Bytes; numpy and Python together are as many."""


def _about_packages(root: Path, message: str, *, fails: bool = True) -> Diagnostic:
    """A message about the packages that the outline declares."""
    _, toml = read_settings(Sources(root))
    return Diagnostic(FILE_NAME, toml.line("runtime", "packages"), message, fails=fails)


def _select(modules: Mapping[str, str], shown: Collection[str]) -> dict[str, str]:
    return {name: module for name, module in modules.items() if name in shown}


RUNTIME_NOW = "runtime/now/"
"""Folder of the browser's Python while the book is written: a changed scene changes only the pages
that show it."""


@dataclass(frozen=True, slots=True, kw_only=True)
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
    def part[T](make: Callable[[], T], without: T, name: str, lost: str) -> T:
        """The part, or nothing and a warning where its packages cannot be had."""
        try:
            return make()
        except NodeError as error:
            message = f"{lost}; its packages could not be had from npm: {error}"
            warn(Diagnostic(f"site_builder/{name}/package-lock.json", 1, message, fails=False))
            return without

    library, editor, decoder = SearchLibrary({}), EditorBundle(), RawDecoder({})
    if search:
        fetch = partial(fetch_library, book.words.language)
        library = part(fetch, library, "search", "the book cannot be searched")
    if bundle and book.scenes:
        lost = "the figures' Python can be read but not edited"
        editor = part(bundle_editor, editor, "editor", lost)
    if bundle and any(scene.instrument.measures_photographs for scene in book.scenes):
        decoder = part(fetch_decoder, decoder, "raw", "instruments open no raw files")
    runtime, files = _runtime(bundle, warn, reload=reload)
    bundle = bundle or RuntimeBundle({}, Versions())
    return BrowserParts(
        runtime=runtime,
        runtime_files=files,
        bundle=bundle,
        editor=editor,
        search=library,
        decoder=decoder,
    )


def _runtime(bundle: RuntimeBundle | None, warn: Warn, *, reload: bool) -> tuple[str, Files]:
    if bundle is None:
        return "", {}
    if bundle.snapshot_error:
        message = f"figures start later at a first visit: {bundle.snapshot_error}"
        warn(Diagnostic("site_builder/runtime/snapshot.mjs", 1, message, fails=False))
    if reload:
        return RUNTIME_NOW, {RUNTIME_NOW + name: file for name, file in bundle.files.items()}
    return hashed_folder("runtime", dict(bundle.files))


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
