"""What no chapter changes, and takes long once on each machine: fetched, cut and compiled while
the book is read. Each keeps files of its own, and the build asks for them as if it were the first
to do so."""

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from simulations.registry import LADDER_MODULES, SCENE_MODULES
from site_builder.diagnostics import Diagnostics
from site_builder.editor.bundle import bundle_editor
from site_builder.kept.ahead import Ask
from site_builder.kept.keeper import kept_as
from site_builder.output.fonts import subset_fonts
from site_builder.runtime.pack import pack_runtime
from site_builder.search.library import fetch_library
from site_builder.settings.model import Settings
from site_builder.settings.reading import read_settings


def tools(root: Path, *, runtime: bool, compiled: bool, search: bool) -> Iterator[Ask]:
    """Makes each of them for the book at ``root``; that it was made is kept."""
    settings, _ = read_settings(root, Diagnostics())
    for name, make in _makers(root, settings, runtime=runtime, compiled=compiled, search=search):
        yield partial(kept_as, f"tool {name}", str(root), partial(_made, make), __name__)


def _made(make: Callable[[], object]) -> None:
    make()


def _makers(
    root: Path, settings: Settings, *, runtime: bool, compiled: bool, search: bool
) -> Iterator[tuple[str, Callable[[], object]]]:
    if runtime and (SCENE_MODULES or LADDER_MODULES):
        # Of all that the book has: what its pages do not show rarely imports anything else.
        yield f"runtime {compiled}", partial(pack_runtime, root / "simulations", compiled=compiled)
        yield "editor", bundle_editor
    yield "fonts", subset_fonts
    if search:
        yield f"search {settings.language}", partial(fetch_library, settings.language)
