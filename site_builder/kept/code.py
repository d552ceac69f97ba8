"""The hash of what a piece of code can do: its module, all modules of ours that it imports, however
indirectly, and the versions of Python and of every library."""

import ast
import functools
import hashlib
import platform
import sys
import sysconfig
from collections.abc import Callable, Iterator
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


def code_hash(module: str, recall: Recall = read_at_once) -> tuple[bytes, int]:
    """Of the module and what it imports; and when the latest of these files was written."""
    digest, latest = hashlib.blake2b(libraries(), digest_size=SIZE), 0
    for name, (file, found) in sorted(_reach(module, recall).items()):
        digest.update(name.encode() + b"\0" + found)
        latest = max(latest, file.stat().st_mtime_ns)
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
    place = root.joinpath(*module.split("."))
    file = place.with_suffix(".py")
    return next((one for one in (file, place / "__init__.py") if one.is_file()), None)


@functools.cache
def libraries() -> bytes:
    """Python, and every installed library with its version."""
    folders = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    installed = sorted(
        entry.name for folder in folders for entry in Path(folder).glob("*.dist-info")
    )
    told = repr((sys.version, platform.machine(), installed))
    return hashlib.blake2b(told.encode(), digest_size=SIZE).digest()


def _reach(module: str, recall: Recall) -> dict[str, tuple[Path, bytes]]:
    found: dict[str, tuple[Path, bytes]] = {}
    seen = {""}
    waiting = [module]
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        file = module_file(name)
        if file is None or (hashed := file_hash(file)) is None:
            continue
        found[name] = file, hashed
        waiting += recall(hashed, functools.partial(_imported, file))
        waiting.append(name.rpartition(".")[0])
    return found


def _imported(file: Path) -> tuple[str, ...]:
    """Names that may be modules of ours: a name imported from a package may be one too. None of
    what is no Python, which is told where it is imported."""
    try:
        tree = ast.parse(file.read_bytes())
    except (SyntaxError, ValueError):
        return ()
    return tuple(dict.fromkeys(_names(tree)))


def _names(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if is_ours(alias.name))
        elif isinstance(node, ast.ImportFrom) and node.module and is_ours(node.module):
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


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
