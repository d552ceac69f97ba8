"""Which modules the simulations import, read from their sources."""

import ast
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path

from site_builder.cache.results import cached
from site_builder.files.folders import folder_files

ENTRY = "simulations.browser"
"""The module that the browser's worker imports."""
CORE = "core"
"""The chunk that it starts with."""


@dataclass(frozen=True, slots=True)
class Imports:
    """What one module imports, in functions too."""

    inside: frozenset[str]
    """Modules of the same package."""
    outside: Mapping[str, str]
    """Other modules, and where each is imported: ``path:line``."""


type Table = Mapping[str, Imports]
"""Every module of a package by its full name."""
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


def imports_of(files: Mapping[str, Path]) -> Table:
    """The imports of every module, given the files of all by their full names."""
    return {name: _imports(file, archive_path(name, file), files) for name, file in files.items()}


def archive_path(name: str, file: Path) -> str:
    """Where the module lies, relative to what the package lies in."""
    return name.replace(".", "/") + ("/__init__.py" if file.stem == "__init__" else ".py")


def module_files(package: Path) -> dict[str, Path]:
    """The file of every module in the folder ``package``, by full name."""
    files = folder_files(package).items()
    return {_module_name(file, package): file for name, file in files if name.endswith(".py")}


def reach(table: Table, start: str) -> frozenset[str]:
    """The module ``start`` and all modules that it imports, however indirectly, of its package.

    Importing a module imports the packages around it.
    """
    found: set[str] = set()
    waiting = [start]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += table[name].inside
            around = name.rpartition(".")[0]
            if around in table:
                waiting.append(around)
    return frozenset(found)


def outside(table: Table, modules: Iterable[str]) -> dict[str, str]:
    """What ``modules`` import from outside the package, and one place that imports it."""
    return {
        name: place for module in sorted(modules) for name, place in table[module].outside.items()
    }


def _imports(file: Path, path: str, files: Mapping[str, Path]) -> Imports:
    inside, others = set[str](), dict[str, str]()
    ours = {each.partition(".")[0] for each in files}
    for name, line, certain in _mentions(file.read_bytes(), path):
        if name in files:
            inside.add(name)
        elif name.partition(".")[0] not in ours and (certain or _is_installed(name)):
            others.setdefault(name, f"{path}:{line}")
    return Imports(frozenset(inside), others)


@cached
def _mentions(source: bytes, path: str) -> tuple[tuple[str, int, bool], ...]:
    """Names that may be modules, where each is first used, and whether they certainly are.

    A package of numpy need not be imported by name: ``np.fft`` imports it on first use.
    """
    aliases: dict[str, str] = {}
    attributes: list[ast.Attribute] = []
    found: dict[tuple[str, bool], int] = {}
    for node in ast.walk(ast.parse(source, path)):
        if isinstance(node, ast.Attribute):
            attributes.append(node)
        elif isinstance(node, ast.Import):
            for alias in node.names:
                aliases[alias.asname or alias.name] = alias.name
                found.setdefault((alias.name, True), node.lineno)
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.setdefault((node.module, True), node.lineno)
            for alias in node.names:
                found.setdefault((f"{node.module}.{alias.name}", False), node.lineno)
    for node in attributes:
        if isinstance(node.value, ast.Name) and (package := aliases.get(node.value.id)):
            found.setdefault((f"{package}.{node.attr}", False), node.lineno)
    return tuple((name, line, certain) for (name, certain), line in found.items())


@cached
def _is_installed(name: str) -> bool:
    """Whether a name from outside the book is a module; to find out may import what it lies in."""
    return is_module(name)


@cache
def is_module(name: str) -> bool:
    try:
        return find_spec(name) is not None
    except ModuleNotFoundError:  # what it would lie in is no package
        return False


def _module_name(file: Path, package: Path) -> str:
    parts = file.relative_to(package.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
