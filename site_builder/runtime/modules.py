"""The simulations in chunks: what the worker starts with, and what each scene and ladder adds."""

from collections import Counter
from collections.abc import Collection, Mapping
from pathlib import Path

from site_builder.runtime.imports import Table, archive_path, reach

ENTRY = "simulations.browser"
"""The module that the browser's worker imports."""
CORE = "core"
"""The chunk that it starts with."""

type Modules = Mapping[str, str]
"""Id to the name of a module."""


def cut(imports: Table, scenes: Modules, ladders: Modules) -> dict[str, frozenset[str]]:
    """Chunk to the modules in it: all that its scene or ladder imports, beyond the `CORE`.

    That has what most scenes import. What fewer share is in the chunk of each, so that a page
    fetches one chunk for each of its scenes.
    """
    reached = {f"scene-{key}": reach(imports, name) for key, name in scenes.items()}
    uses = Counter(module for modules in reached.values() for module in modules)
    shared = {module for module, count in uses.items() if 2 * count > len(scenes)}
    core = reach(imports, ENTRY) | shared
    reached |= {f"ladder-{key}": reach(imports, name) for key, name in ladders.items()}
    return {CORE: core, **{chunk: modules - core for chunk, modules in reached.items()}}


def sources_of(files: Mapping[str, Path], modules: Collection[str]) -> dict[str, Path]:
    """The files of those ``modules`` that have one, by their path in an archive."""
    return {archive_path(name, file): file for name, file in files.items() if name in modules}
