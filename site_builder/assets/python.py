"""What the browser runs of a book: the scenes and ladders that its pages show."""

from collections.abc import Callable, Collection, Mapping, Sequence
from pathlib import Path

from simulations.registry import LADDER_MODULES, SCENE_MODULES
from site_builder.cache.results import cached_result
from site_builder.diagnostics.blame import place_of
from site_builder.diagnostics.diagnostic import BuildError, Diagnostic
from site_builder.document.blocks import contents
from site_builder.document.book import Book
from site_builder.files.engine import ENGINE
from site_builder.files.folders import folder_hash
from site_builder.files.text import Sources
from site_builder.markdown.directives.ladder import LadderFigure
from site_builder.runtime.freeze import MissingModuleError
from site_builder.runtime.imports import Modules
from site_builder.runtime.pack import RuntimeBundle, pack_runtime
from site_builder.runtime.packages import PackageError, differing
from site_builder.runtime.store import is_whole
from site_builder.settings.model import FILE_NAME, read_settings

RUNTIME = Path(__file__).parents[1] / "runtime"
"""What makes it, with programs for other interpreters."""


def pack_for_browser(
    root: Path, book: Book, warn: Callable[[Diagnostic], None], *, compiled: bool
) -> RuntimeBundle | None:
    """What the browser runs, with the scenes and ladders inside that the book shows; None of a book
    that shows none. An author who tries a change does not wait until it is ``compiled``. Raises
    `BuildError` where the browser could not run it."""
    scenes = {scene.id for scene in book.scenes}
    ladders = {item.measured.ladder.id for item in shown_ladders(book)}
    if not (scenes or ladders):
        return None
    packages = book.settings.runtime.packages
    try:
        bundle = _bundle(
            root / "simulations",
            _only(SCENE_MODULES, scenes),
            _only(LADDER_MODULES, ladders),
            compiled=compiled,
            packages=packages,
        )
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
    for message in differing(bundle.packages):
        warn(_about_packages(root, message, fails=False))
    return bundle


def _about_packages(root: Path, message: str, *, fails: bool = True) -> Diagnostic:
    """A message about the packages that the outline declares."""
    _, toml = read_settings(Sources(root))
    return Diagnostic(FILE_NAME, toml.line("runtime", "packages"), message, fails=fails)


def _bundle(
    simulations: Path,
    scenes: Modules,
    ladders: Modules,
    *,
    compiled: bool,
    packages: Sequence[str],
) -> RuntimeBundle:
    """The runtime, packed again where it is not cached or files of it are gone."""

    def pack() -> RuntimeBundle:
        return pack_runtime(
            simulations, scenes=scenes, ladders=ladders, compiled=compiled, packages=packages
        )

    folders = (simulations, ENGINE / "simulations")
    sources = [folder_hash(RUNTIME), *(folder_hash(folder, "*.py") for folder in folders)]
    bundle = cached_result("runtime", (sources, scenes, ladders, compiled, packages), pack)
    is_good = all(map(is_whole, bundle.files.values())) and not bundle.snapshot_error
    return bundle if is_good else pack()


def shown_ladders(book: Book) -> list[LadderFigure]:
    return [item for chapter in book.chapters for item in contents(chapter.body, LadderFigure)]


def _only(modules: Mapping[str, str], shown: Collection[str]) -> dict[str, str]:
    return {name: module for name, module in modules.items() if name in shown}
