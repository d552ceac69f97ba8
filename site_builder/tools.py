"""What no chapter changes, and takes long once on each machine: fetched, cut and compiled while
the book is read. Each of these keeps files of its own; the build asks for them as if it were the
first to do so."""

from collections.abc import Iterator
from pathlib import Path

from simulations.registry import LADDER_MODULES, SCENE_MODULES
from site_builder.diagnostics import Diagnostics
from site_builder.editor.bundle import bundle_editor
from site_builder.kept.ahead import Ask
from site_builder.output.font_faces import chosen_faces
from site_builder.output.fonts import subset_fonts
from site_builder.runtime.pack import pack_runtime
from site_builder.search.library import fetch_library
from site_builder.settings.reading import read_settings


def tools(root: Path, *, runtime: bool, search: bool) -> Iterator[Ask]:
    """Makes each of them for the book at ``root``; raises what its maker raises."""
    settings, _ = read_settings(root, Diagnostics())
    if runtime and (SCENE_MODULES or LADDER_MODULES):
        # Of all that the book has: what its pages do not show rarely imports anything else.
        yield lambda: pack_runtime(root / "simulations")
        yield bundle_editor
    if search:
        yield lambda: fetch_library(settings.language)
    yield lambda: subset_fonts(chosen_faces(settings, root))
