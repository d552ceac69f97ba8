"""Hashes of what a result depends on: plain data, and the sources of code.

Scenes, ladders and functions count as their sources.
"""

import functools
import hashlib
import platform
import re
import sys
import time
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import fields, is_dataclass
from enum import Enum
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np

import simulations
from simulations.engine.ladder import Ladder
from simulations.engine.scene import Scene
from site_builder import STARTED_NS
from site_builder.files.engine import DISTRIBUTION, ENGINE
from site_builder.files.folders import SIZE, data_of

OWN = DISTRIBUTION.replace("-", "_") + "-"
"""With which the engine's own entry among the installed packages begins."""
HOLDERS: Mapping[type, str] = {Scene: "SCENE", Ladder: "LADDER"}
"""Values that are code, and the name under which their module holds them."""
IMPORT = re.compile(
    r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]+(\([^)]*\)|.*)|import[ \t]+(.*))", re.MULTILINE
)


class UnhashableError(TypeError):
    """A value that is no plain data."""


def hash_of(*values: object) -> bytes:
    """The hash of plain data, arrays, dataclasses, scenes, ladders and functions, the same in every
    process. Raises `UnhashableError`."""
    digest = hashlib.blake2b(digest_size=SIZE)
    _add(values, digest.update)
    return digest.digest()


def _add(value: Any, update: Callable[[bytes], None]) -> None:
    """Every part with its kind and length, so that no two values look alike."""

    def put(kind: str, data: bytes) -> None:
        update(f"{kind} {len(data)} ".encode() + data)

    match value:  # the most frequent first; abstract classes, slow to ask about, last
        case str() | Path():
            put(type(value).__name__, str(value).encode("utf-8", "surrogatepass"))
        case None | bool() | int() | float() | complex():
            put(type(value).__name__, repr(value).encode())
        case bytes():
            put("bytes", value)
        case Enum():
            put("enum", f"{type(value).__qualname__}.{value.name}".encode())
        case np.ndarray() | np.generic():
            put(f"array {value.dtype.str} {value.shape}", value.tobytes())
        case functools.partial():
            _add((value.func, value.args, value.keywords), update)
        case Scene() | Ladder() | FunctionType():
            module = module_of(value)
            if module is None or getattr(value, "__closure__", None):
                raise UnhashableError(f"{value!r} belongs to no module")
            put("code", f"{module} {getattr(value, '__qualname__', '')} ".encode())
            put("sources", source_hash(module))
        case tuple() | list():
            put("sequence", str(len(value)).encode())
            for item in value:
                _add(item, update)
        case _ if getattr(value, "cache_key", b""):
            put("cached", value.cache_key)
        case _ if is_dataclass(value) and not isinstance(value, type):
            put("dataclass", type(value).__qualname__.encode())
            for name in _field_names(type(value)):
                _add(getattr(value, name), update)
        case Mapping():
            put("mapping", str(len(value)).encode())
            for key, item in value.items():
                _add(key, update)
                _add(item, update)
        case Set():
            put("set", b"".join(sorted(hash_of(item) for item in value)))
        case Sequence():
            _add(tuple(value), update)
        case _:
            raise UnhashableError(f"{type(value).__qualname__}; legal: plain data")


@functools.cache
def _field_names(kind: type[Any]) -> tuple[str, ...]:
    return tuple(each.name for each in fields(kind))


def module_of(value: object) -> str | None:
    """The module that holds a scene, ladder or table of hard cases, or that defines a function;
    None where there is none."""
    name = HOLDERS.get(type(value))
    if name is None:
        return getattr(value, "__module__", None)
    if entry := _copies.get(id(value)):
        return entry[0]
    known = sys.modules.get(_holders.get(id(value), ""))
    if known and vars(known).get(name) is value:
        return known.__name__
    modules = [module for module in [*sys.modules.values()] if module is not None]
    found = next((each.__name__ for each in modules if vars(each).get(name) is value), None)
    if found:
        _holders[id(value)] = found
    return found


def know_module[T](copy: T, module: str) -> T:
    """The copy of a scene or ladder that ``module`` holds; `module_of` finds it from now on."""
    _copies[id(copy)] = module, copy
    return copy


_holders: dict[int, str] = {}
"""Modules that held a value when it was last looked for, by its identity."""
_copies: dict[int, tuple[str, object]] = {}
"""Modules of copies, by their identity, with the copies, whose identity stays theirs."""


@functools.cache
def source_hash(module: str) -> bytes:
    """The hash of the sources of ``module`` and all our modules that it imports, also indirectly,
    and of the versions of Python and the installed packages."""
    return hash_of(_imported(module), _versions())


def imports_hash(text: str) -> bytes:
    """The hash of the sources of all our modules that the code ``text`` imports, likewise."""
    return hash_of([source_hash(name) for name in sorted(_names_imported(text))])


def book_hash(module: str) -> str:
    """The same, in hexadecimal digits, without the engine and the versions."""
    engine = ("simulations.engine", "site_builder")
    return hash_of([each for each in _imported(module) if not each[0].startswith(engine)]).hex()


def _imported(module: str) -> list[tuple[str, bytes]]:
    """Names and hashes of ``module`` and all our modules that it imports."""
    found: dict[str, bytes] = {}
    waiting = [module]
    while waiting:
        name = waiting.pop()
        if name not in found and (source := _source(name)):
            found[name], imported = source
            waiting += imported
    return sorted(found.items())


@functools.cache
def _source(module: str) -> tuple[bytes, tuple[str, ...]] | None:
    """The hash of a module's source and data, and names that may be modules which it imports; None
    for a module of another package."""
    package = module.partition(".")[0]
    if package not in ("simulations", "site_builder"):
        return None
    is_shared = package == "simulations"
    roots = [Path(folder).parent for folder in simulations.__path__] if is_shared else [ENGINE]
    places = [root.joinpath(*module.split(".")) for root in roots]
    files = (file for each in places for file in (each.with_suffix(".py"), each / "__init__.py"))
    file = next((file for file in files if file.is_file()), None)
    if file is None:
        return None
    text = file.read_bytes().decode("utf-8", "replace")
    _written_ns.append(file.stat().st_mtime_ns)
    names = {module.rpartition(".")[0], *_names_imported(text)}
    data = [each.read_bytes() for each in data_of(file).values()]
    return hash_of(text, *data), tuple(sorted(names))


def _names_imported(text: str) -> set[str]:
    """Names that may be modules which the code ``text`` imports."""
    names: set[str] = set()
    for origin, members, plain in IMPORT.findall(text):
        names |= {origin, *re.findall(r"[\w.]+", plain)}
        names |= {f"{origin}.{member}" for member in re.findall(r"\w+", members)}
    return names


DAY_NS = 86_400 * 10**9
_written_ns: list[int] = []
"""Times of change of the sources that were hashed."""


def changed_sources() -> bool:
    """Whether a source was written since this process began: what it runs may be older. A time that
    lies a day ahead, of a wrong clock, tells nothing."""
    return any(STARTED_NS <= written < time.time_ns() + DAY_NS for written in _written_ns)


@functools.cache
def _versions() -> tuple[object, ...]:
    found = {file.name for folder in sys.path for file in Path(folder).glob("*.dist-info")}
    ours = {name for name in found if name.startswith(OWN)}  # known by their sources
    return sys.version, platform.machine(), found - ours
