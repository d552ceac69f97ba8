"""The hash of what a piece of code can do: its module, all modules of ours that it imports, however
indirectly, and the versions of Python and of every library."""

import ast
import functools
import hashlib
import os
import platform
import sys
import sysconfig
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from site_builder.book_root import ENGINE, is_engine
from site_builder.kept.files import file_hash

type Recall = Callable[[bytes, Callable[[], tuple[str, ...]]], tuple[str, ...]]
"""The names imported by a file of that hash: kept, or read by the function."""

SIZE = 20


def read_at_once(_hash: bytes, read: Callable[[], tuple[str, ...]]) -> tuple[str, ...]:
    """Keeps nothing."""
    return read()


@dataclass(frozen=True, slots=True)
class Module:
    """One of ours, as it was when it was looked at."""

    file: Path
    hashed: bytes
    written_ns: int
    imported: tuple[str, ...]
    """Names that may be modules of ours; its package too."""


type Modules = dict[str, Module | None]
"""By name; None of what is none of ours."""


def code_hash(
    module: str, recall: Recall = read_at_once, known: Modules | None = None
) -> tuple[bytes, int]:
    """Of the module and what it imports; and when the latest of these files was written. ``known``
    are modules that were looked at before, and get those that are looked at now."""
    digest, latest = hashlib.blake2b(libraries(), digest_size=SIZE), 0
    for name, found in sorted(_reach(module, recall, {} if known is None else known).items()):
        digest.update(name.encode() + b"\0" + found.hashed)
        latest = max(latest, found.written_ns)
    return digest.digest(), latest


def is_ours(module: str) -> bool:
    """Whether it lies neither in the standard library nor among the installed ones."""
    return _root(module.partition(".")[0]) is not None


def module_file(module: str) -> Path | None:
    """Its source, where it is one of ours."""
    package = module.partition(".")[0]
    root = _root(package)
    if root is None:
        return None
    if package == "simulations" and is_engine(module):
        root = ENGINE
    place = os.path.join(root, *module.split("."))  # noqa: PTH118  (of a thousand names a build)
    files = (f"{place}.py", f"{place}{os.sep}__init__.py")
    return next((Path(file) for file in files if os.path.isfile(file)), None)  # noqa: PTH113


@functools.cache
def libraries() -> bytes:
    """Python, and every installed library with its version."""
    folders = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    installed = sorted(
        entry.name for folder in folders for entry in Path(folder).glob("*.dist-info")
    )
    told = repr((sys.version, platform.machine(), installed))
    return hashlib.blake2b(told.encode(), digest_size=SIZE).digest()


def _reach(module: str, recall: Recall, known: Modules) -> dict[str, Module]:
    found: dict[str, Module] = {}
    seen = {""}
    waiting = [module]
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        if name not in known:
            known[name] = _look_at(name, recall)
        if there := known[name]:
            found[name] = there
            waiting += there.imported
    return found


def _look_at(name: str, recall: Recall) -> Module | None:
    file = module_file(name)
    if file is None or (hashed := file_hash(file)) is None:
        return None
    imported = recall(hashed, functools.partial(_imported, file))
    return Module(file, hashed, file.stat().st_mtime_ns, (*imported, name.rpartition(".")[0]))


def is_as_it_was(modules: Modules) -> bool:
    """Whether no file has been written since it was looked at: what is imported later is no other
    code than what was hashed."""
    return all(file_hash(each.file) == each.hashed for each in modules.values() if each)


def importers(changed: Collection[str], modules: Modules) -> frozenset[str]:
    """The names of those that are ``changed`` and, of ``modules``, of all that import one of them,
    however indirectly."""
    importing: dict[str, list[str]] = {}
    for name, module in modules.items():
        for each in module.imported if module else ():
            importing.setdefault(each, []).append(name)
    found: set[str] = set()
    waiting = list(changed)
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += importing.get(name, ())
    return frozenset(found)


def look_at_loaded(recall: Recall, known: Modules) -> None:
    """Add to ``known`` the modules of ours that this process has imported."""
    for name in list(sys.modules):
        if name not in known and is_ours(name):
            known[name] = _look_at(name, recall)


def _imported(file: Path) -> tuple[str, ...]:
    """Names that may be modules of ours: a name imported from a package may be one too. None of
    what is no Python, which is told where it is imported."""
    return _imported_by(file.read_bytes())


@functools.lru_cache(maxsize=1024)
def _imported_by(source: bytes) -> tuple[str, ...]:
    """Remembered, as each keeper begins with the same few hundred modules."""
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError):
        return ()
    return tuple(dict.fromkeys(_names(tree)))


def _names(tree: ast.Module) -> Iterator[str]:
    for node in _statements(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if is_ours(alias.name))
        elif isinstance(node, ast.ImportFrom) and node.module and is_ours(node.module):
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def _statements(block: ast.AST) -> Iterator[ast.stmt]:
    """All in it, however deep: in no expression is a statement, and expressions are most nodes."""
    for part in ("body", "handlers", "cases", "orelse", "finalbody"):
        for node in getattr(block, part, ()):
            if isinstance(node, ast.stmt):
                yield node
            yield from _statements(node)


@functools.cache
def _root(package: str) -> Path | None:
    """The folder that a package of ours lies in."""
    if not package or package in sys.stdlib_module_names:
        return None
    try:
        spec = find_spec(package)
    except (ImportError, ValueError):
        return None
    loaded = getattr(sys.modules.get(package), "__path__", None)
    places = list(loaded or (spec and spec.submodule_search_locations) or ())
    if not places:
        return None
    folder = Path(places[0]).resolve()
    installed = (sysconfig.get_path("purelib"), sysconfig.get_path("platlib"))
    if any(folder.is_relative_to(Path(each).resolve()) for each in installed):
        return None
    return folder.parent
